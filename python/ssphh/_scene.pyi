"""Scenes and what stands in them."""

from collections.abc import Mapping, Sequence
from typing import final

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ._common import Floats, Path, Progress

@final
class Light:
    """A lamp of a scene that is no surface, posed at the scene's time."""

    @property
    def name(self) -> str: ...
    @property
    def group(self) -> str:
        """Light group by which it is dimmed."""
    @property
    def type(self) -> str:
        """point, spot, directional, sphere, sphl, rectangle or disc."""
    @property
    def position(self) -> Floats:
        """World [m], 3."""
    @property
    def direction(self) -> Floats:
        """Unit vector, 3."""
    @property
    def color(self) -> Floats:
        """Linear RGB factor, 3."""
    @property
    def intensity(self) -> float:
        """Point and spot [W/sr], directional [W/m2], sphere, rectangle and disc [W/sr/m2]."""
    @property
    def radius(self) -> float:
        """Of a sphere, an SPHL or a disc [m]."""
    @property
    def size(self) -> tuple[float, float]:
        """Width and height of a rectangle [m]."""

@final
class Camera:
    """A camera of a scene, posed at the scene's time."""

    @property
    def name(self) -> str: ...
    @property
    def position(self) -> Floats:
        """World [m], 3."""
    @property
    def direction(self) -> Floats:
        """Unit vector, 3."""
    @property
    def up(self) -> Floats:
        """Unit vector, 3."""
    @property
    def orthographic(self) -> bool: ...
    @property
    def yfov_degrees(self) -> float:
        """Vertical field of view."""

@final
class ProbePlace:
    """A place that a scene names for a probe."""

    @property
    def name(self) -> str: ...
    @property
    def position(self) -> Floats:
        """World [m], 3."""
    @property
    def radius(self) -> float:
        """Of the sphere that VIZ lights [m]."""

@final
class Scene:
    """A scene as load() read it. It never changes, so any number of threads may use it."""

    @property
    def name(self) -> str: ...
    @property
    def source(self) -> str:
        """What load() was given."""
    @property
    def time(self) -> float:
        """Pose of what moves [s]."""
    @property
    def duration(self) -> float:
        """Time of the last key of any animation [s]; 0 where nothing moves."""
    @property
    def lights(self) -> list[Light]: ...
    @property
    def light_groups(self) -> list[str]:
        """Every emitter belongs to one of them, surfaces and sky included."""
    @property
    def light_modes(self) -> dict[str, str]:
        """realtime, mixed or baked, of each light group."""
    @property
    def cameras(self) -> list[Camera]: ...
    @property
    def probe_places(self) -> list[ProbePlace]: ...
    @property
    def bounds(self) -> Floats:
        """Lowest and highest corner of all surfaces [m], 2x3."""
    @property
    def triangle_count(self) -> int: ...
    @property
    def ignored(self) -> list[str]:
        """What the file holds and nobody uses, a line each."""
    def surface_points(
        self, count: int = 1024, *, seed: int = 0, clearance: float = 0.0, progress: Progress | None = None
    ) -> tuple[Floats, Floats, NDArray[np.bool_]]:
        """Points uniform by area over what cameras, lamps and probes can reach: positions Nx3 [m], unit normals Nx3, and
        whether each stands on a moving part, N. `clearance`: free space before each [m]."""
    def with_probes(self, positions: ArrayLike, *, radius: float = 0.1, names: Sequence[str] = []) -> Scene:
        """The same scene with these places for probes, Nx3 [m], instead of its own."""

def load(
    source: Path,
    *,
    overlay: Path | None = None,
    unit: str = "",
    environment: Path | None = None,
    environment_intensity: float = 1.0,
    environment_rotation: float = 0.0,
    lambert: bool = False,
    sun_sky: bool = False,
    sun_elevation: float = 45.0,
    sun_azimuth: float = 120.0,
    turbidity: float = 3.0,
    time: float = 0.0,
    light_mode: Mapping[str, str] = {},
) -> Scene:
    """Reads a scene: .glb, .gltf, .obj, an overlay .ssphh.json, or builtin:NAME. Angles are degrees, `time` seconds,
    `light_mode` realtime, mixed or baked by light group. A scene without lights gets a neutral studio, and a warning."""

def builtin_scenes() -> dict[str, str]:
    """Every built-in scene, as load() takes it, and what it is."""
