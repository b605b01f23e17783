"""Pictures of scenes."""

from collections.abc import Mapping
from typing import Any, Protocol, TypeVar

from numpy.typing import ArrayLike

from ._common import Floats, Progress
from ._scene import Scene
from ._probe_set import ProbeSet

_Result = TypeVar("_Result", covariant=True)

class _Picture(Protocol[_Result]):
    """`method`: path, or one of methods(); `probes` are for ssphh. `projection`: camera, or of the whole sphere cube or
    equirect, around `at`."""

    def __call__(
        self,
        scene: Scene,
        method: str = "path",
        *,
        probes: ProbeSet | None = None,
        param: Mapping[str, float | str] = {},
        camera: str = "",
        width: int = 1280,
        height: int = 720,
        projection: str = "camera",
        at: ArrayLike | None = None,
        max_depth: int = 25,
        passes: int = 1,
        spp: int = 16,
        seed: int = 0,
        lookup: str = "irradiance",
        weights: str | None = None,
        light: str = "sum",
        force: bool = False,
        progress: Progress | None = None,
    ) -> _Result: ...

render: _Picture[Floats]
"""A picture: linear radiance [W/sr/m2], height x width x 3."""

render_layers: _Picture[dict[str, Floats]]
"""The same picture and what it is made of: color, direct, indirect, albedo, normal, depth [m], "group NAME"."""

def methods() -> dict[str, dict[str, Any]]:
    """What finds indirect light, and the parameters of each: default, least, most, choices, about."""
