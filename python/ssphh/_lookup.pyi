"""Light of surfaces, looked up and traced."""

from typing import final

from numpy.typing import ArrayLike

from ._common import Floats, Progress
from ._scene import Scene
from ._probe_set import ProbeSet

@final
class Lookup:
    """Indirect light of surfaces, looked up from probes in a scene that stands still. Later changes of the probes are not
    seen. Safe to call from several threads."""

    def __init__(
        self,
        scene: Scene,
        probes: ProbeSet,
        *,
        lookup: str = "irradiance",
        weights: str | None = None,
        light: str = "sum",
        force: bool = False,
    ) -> None:
        """lookup: irradiance, or light. weights: surface, fitted, mls, trilinear or distance; None: what the probes have.
        light: sum (with neighbours' light after hier()) or self."""
    def irradiance(
        self, points: ArrayLike, normals: ArrayLike, moves: ArrayLike | None = None, *, progress: Progress | None = None
    ) -> Floats:
        """Irradiance [W/m2] at points Nx3 [m] of surfaces with normals Nx3: Nx3. A Lambertian surface of albedo a leaves
        a E / pi. `moves`: N, whether each point stands on a moving part."""
    def irradiance_by_group(
        self, points: ArrayLike, normals: ArrayLike, moves: ArrayLike | None = None, *, progress: Progress | None = None
    ) -> dict[str, Floats]:
        """The same of each light group alone, times its factor. The sum is irradiance() but for windows against ringing."""
    @property
    def direct_groups(self) -> list[str]:
        """Light groups whose direct light is in it, too."""

def trace_irradiance(
    scene: Scene,
    points: ArrayLike,
    normals: ArrayLike,
    *,
    spp: int = 512,
    passes: int = 1,
    max_depth: int = 25,
    seed: int = 0,
    progress: Progress | None = None,
) -> tuple[Floats, Floats]:
    """Direct and indirect irradiance [W/m2] at surface points by path tracing, Nx3 each."""
