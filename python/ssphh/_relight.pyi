"""Light that follows lamps and doors."""

from typing import Any, final

from numpy.typing import ArrayLike

from ._common import Floats, Progress
from ._scene import Scene
from ._probe_set import ProbeSet

@final
class RelightSession:
    """Probes that follow lamps and doors, update by update."""

    def __init__(
        self,
        scene: Scene,
        probes: ProbeSet | str | int | None = None,
        *,
        operator: str = "surfel",
        degree: int = 4,
        records: int = 16384,
        directions: int | None = None,
        surfel_size: float | None = None,
        link_rays: int | None = None,
        warm_start: bool = True,
        progress: Progress | None = None,
    ) -> None:
        """probes: a set whose places to take; scene, auto, auto:METRES or a number; None: scene if it names places, else
        auto. records: surface points that keep light, at most."""
    time: float
    """Pose of doors and whatever moves [s]; update() goes there."""
    environment_rotation: float
    """Turn of sky and sun about +y beyond the scene's own [degrees]."""
    def set_light(
        self,
        name: str,
        *,
        position: ArrayLike | None = None,
        direction: ArrayLike | None = None,
        color: ArrayLike | None = None,
        intensity: float | None = None,
    ) -> None:
        """Moves, turns, colours or dims a lamp from the next update() on; what is None stays."""
    def set_group(self, name: str, scale: ArrayLike) -> None:
        """Factor on all light of a group, one or three, from the next update() on."""
    def update(self, progress: Progress | None = None) -> dict[str, Any]:
        """Brings the probes up to date: milliseconds, iterations, converged, rays, changed_probes."""
    @property
    def positions(self) -> Floats:
        """Of the probes, Nx3 [m]."""
    @property
    def reflected(self) -> Floats:
        """Light of the last update, NxKx3 [W/sr/m2]."""
    def irradiance(
        self, points: ArrayLike, normals: ArrayLike, moves: ArrayLike | None = None, *, progress: Progress | None = None
    ) -> Floats:
        """Indirect irradiance [W/m2] of the last update at surface points: Nx3."""
    def trace_irradiance(
        self,
        points: ArrayLike,
        normals: ArrayLike,
        *,
        spp: int = 512,
        max_depth: int = 25,
        seed: int = 0,
        progress: Progress | None = None,
    ) -> tuple[Floats, Floats]:
        """Direct and indirect irradiance [W/m2] by path tracing, Nx3 each: the truth for irradiance()."""
    def render(
        self,
        *,
        camera: str = "",
        width: int = 640,
        height: int = 360,
        max_depth: int = 25,
        spp: int = 8,
        seed: int = 0,
        progress: Progress | None = None,
    ) -> Floats:
        """A picture of the last update: linear radiance, height x width x 3."""
    def probe_set(self, progress: Progress | None = None) -> ProbeSet:
        """The light of the last update as a bake would store it."""
