"""Types of the package ssphh, and what each thing takes and gives (docs/python.md)."""

import os
from collections.abc import Callable, Mapping, Sequence
from typing import Any, final

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import sh as sh

__all__: list[str]
__version__: str

#: float32, C order.
_Floats = NDArray[np.float32]
_Path = str | os.PathLike[str]
#: Told of (stage, done, total, unit) at most twenty times a second, in the thread that called.
_Progress = Callable[[str, int, int, str], object]

class Error(Exception):
    """Bad input, or something around the program that fails; str() reads "WHERE: PROBLEM (HINT)"."""

    where: str
    problem: str
    hint: str
    def __init__(self, where: str, problem: str, hint: str = "") -> None: ...

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
        """point, spot, directional or sphere."""
    @property
    def position(self) -> _Floats:
        """World [m], 3."""
    @property
    def direction(self) -> _Floats:
        """Unit vector, 3."""
    @property
    def color(self) -> _Floats:
        """Linear RGB factor, 3."""
    @property
    def intensity(self) -> float:
        """Point and spot [W/sr], directional [W/m2], sphere [W/sr/m2]."""
    @property
    def radius(self) -> float:
        """Of a sphere [m]."""

@final
class Camera:
    """A camera of a scene, posed at the scene's time."""

    @property
    def name(self) -> str: ...
    @property
    def position(self) -> _Floats:
        """World [m], 3."""
    @property
    def direction(self) -> _Floats:
        """Unit vector, 3."""
    @property
    def up(self) -> _Floats:
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
    def position(self) -> _Floats:
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
    def bounds(self) -> _Floats:
        """Lowest and highest corner of all surfaces [m], 2x3."""
    @property
    def triangle_count(self) -> int: ...
    @property
    def ignored(self) -> list[str]:
        """What the file holds and nobody uses, a line each."""
    def surface_points(
        self, count: int = 1024, *, seed: int = 0, clearance: float = 0.0, progress: _Progress | None = None
    ) -> tuple[_Floats, _Floats, NDArray[np.bool_]]:
        """Points uniform by area over what cameras, lamps and probes can reach: positions Nx3 [m], unit normals Nx3, and
        whether each stands on a moving part, N. `clearance`: free space before each [m]."""
    def with_probes(self, positions: ArrayLike, *, radius: float = 0.1, names: Sequence[str] = []) -> Scene:
        """The same scene with these places for probes, Nx3 [m], instead of its own."""

@final
class Placement:
    """Places that place() found."""

    def __len__(self) -> int: ...
    @property
    def positions(self) -> _Floats:
        """Nx3 [m], the scene's own first."""
    @property
    def names(self) -> list[str]: ...
    @property
    def kinds(self) -> list[str]:
        """manual, grid, refined or passage, of each."""
    @property
    def radii(self) -> _Floats:
        """Of the spheres that VIZ lights [m], N."""
    @property
    def edges(self) -> NDArray[np.uint32]:
        """Pairs of neighbours that see each other, Mx2."""
    @property
    def spacing(self) -> float:
        """Of the coarse grid [m]."""
    @property
    def warnings(self) -> list[str]: ...

@final
class ProbeSet:
    """Probes and their light: what a bake makes and a file holds. K = (degree + 1)^2 coefficients of red, green, blue."""

    @staticmethod
    def load(path: _Path, scene: Scene | None = None, *, force: bool = False) -> ProbeSet:
        """Reads .sphl or .sphl.json. With `scene`, probes that were baked in another one are an Error, or with `force` a
        warning."""
    @staticmethod
    def from_arrays(
        positions: ArrayLike,
        reflected: ArrayLike,
        *,
        light_groups: Sequence[str] = ["light"],
        names: Sequence[str] | None = None,
        radius: float = 0.1,
    ) -> ProbeSet:
        """N positions Nx3 [m] and the radiance that surfaces reflect toward them, NxKx3, or for several light groups
        groups x N x K x 3 [W/sr/m2]."""
    def with_light(self, reflected: ArrayLike) -> ProbeSet:
        """The same probes with other reflected light, of any degree, as from_arrays() takes it; edges, records, fitted weights
        and emitters seen directly are left out."""
    def save(self, path: _Path) -> None:
        """Writes .sphl (every bit) or .sphl.json (five digits), by a temporary file beside it."""
    def __len__(self) -> int: ...
    def __eq__(self, other: object) -> bool: ...
    @property
    def degree(self) -> int:
        """Highest band, 0..10."""
    @property
    def positions(self) -> _Floats:
        """Nx3 [m]."""
    @property
    def names(self) -> list[str]: ...
    @property
    def radii(self) -> _Floats:
        """Of the spheres that VIZ lights [m], N."""
    @property
    def light_groups(self) -> dict[str, _Floats]:
        """Factor of each light group, 3 each."""
    @property
    def light_modes(self) -> dict[str, str]:
        """realtime, mixed or baked, of each light group."""
    @property
    def generator(self) -> dict[str, Any]:
        """How the set was made."""
    @property
    def reflected(self) -> _Floats:
        """What surfaces look up: the light of all groups times their factors [W/sr/m2], NxKx3; a copy."""
    @property
    def radiance(self) -> _Floats:
        """The same with emitters seen directly, NxKx3; a copy."""
    @property
    def hierarchy(self) -> _Floats | None:
        """What hier() found, NxKx3; None before."""
    def group(self, name: str) -> tuple[_Floats, _Floats]:
        """Emitted and reflected light of one group as baked, NxKx3 each; copies."""
    def light(self, index: int) -> dict[str, tuple[_Floats, _Floats]]:
        """Emitted and reflected light of each group as baked, of one probe: Kx3 where the numbers lie, read only; 0x3 where
        nothing emits."""
    @property
    def edges(self) -> tuple[NDArray[np.int32], _Floats]:
        """(from, to) of every edge, Mx2, and how much light takes it, P, M."""
    @property
    def records(self) -> tuple[_Floats, _Floats, _Floats] | None:
        """Positions [m], normals and irradiance [W/m2] of surface records, Mx3 each; None without."""
    def relight(self, group: str, scale: ArrayLike) -> None:
        """Dims or colours a light group without a bake, by one factor or three, relative to the bake. Drops the hierarchy."""
    def hier(self, operator: str = "coefficient", *, neighbors: int = -1, threshold: float = 0.0) -> int:
        """Adds neighbours' light over the edges by coefficient, mean or matrix; returns the number of edges used."""

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
        self, points: ArrayLike, normals: ArrayLike, moves: ArrayLike | None = None, *, progress: _Progress | None = None
    ) -> _Floats:
        """Irradiance [W/m2] at points Nx3 [m] of surfaces with normals Nx3: Nx3. A Lambertian surface of albedo a leaves
        a E / pi. `moves`: N, whether each point stands on a moving part."""
    def irradiance_by_group(
        self, points: ArrayLike, normals: ArrayLike, moves: ArrayLike | None = None, *, progress: _Progress | None = None
    ) -> dict[str, _Floats]:
        """The same of each light group alone, times its factor. The sum is irradiance() but for windows against ringing."""
    @property
    def direct_groups(self) -> list[str]:
        """Light groups whose direct light is in it, too."""

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
        progress: _Progress | None = None,
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
    def update(self, progress: _Progress | None = None) -> dict[str, Any]:
        """Brings the probes up to date: milliseconds, iterations, converged, rays, changed_probes."""
    @property
    def positions(self) -> _Floats:
        """Of the probes, Nx3 [m]."""
    @property
    def reflected(self) -> _Floats:
        """Light of the last update, NxKx3 [W/sr/m2]."""
    def irradiance(
        self, points: ArrayLike, normals: ArrayLike, moves: ArrayLike | None = None, *, progress: _Progress | None = None
    ) -> _Floats:
        """Indirect irradiance [W/m2] of the last update at surface points: Nx3."""
    def trace_irradiance(
        self,
        points: ArrayLike,
        normals: ArrayLike,
        *,
        spp: int = 512,
        max_depth: int = 25,
        seed: int = 0,
        progress: _Progress | None = None,
    ) -> tuple[_Floats, _Floats]:
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
        progress: _Progress | None = None,
    ) -> _Floats:
        """A picture of the last update: linear radiance, height x width x 3."""
    def probe_set(self, progress: _Progress | None = None) -> ProbeSet:
        """The light of the last update as a bake would store it."""

def load(
    source: _Path,
    *,
    overlay: _Path | None = None,
    unit: str = "",
    environment: _Path | None = None,
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

def place(
    scene: Scene,
    probes: str | int | None = None,
    *,
    clearance: float = 0.04,
    refine: int = 1,
    max_probes: int = 4096,
    progress: _Progress | None = None,
) -> Placement:
    """Finds places for probes: auto (None), auto:METRES, or so many."""

def bake(
    scene: Scene,
    output: _Path | None = None,
    *,
    probes: str | int | None = None,
    degree: int = 9,
    operator: str | None = None,
    quality: str | None = None,
    max_memory: float = 0.0,
    seed: int = 0,
    face: int | None = None,
    max_depth: int | None = None,
    passes: int | None = None,
    spp: int | None = None,
    gen: str = "full",
    viz: str | None = None,
    neighbors: int | None = None,
    threshold: float | None = None,
    viz_source: str | None = None,
    viz_paths: str | None = None,
    viz_max_depth: int | None = None,
    viz_passes: int | None = None,
    viz_spp: int | None = None,
    viz_transfer: bool = False,
    directions: int | None = None,
    surfel_size: float | None = None,
    link_rays: int | None = None,
    records: int | None = None,
    fit: bool = False,
    clearance: float = 0.04,
    refine: int = 1,
    max_probes: int = 4096,
    resume: bool = True,
    progress: _Progress | None = None,
) -> ProbeSet:
    """Finds the light at every probe. Arguments and defaults are those of `ssphh bake`, and so is every bit of the result.
    An interrupted bake with an `output` leaves OUTPUT.checkpoint; the same call goes on there."""

def trace_irradiance(
    scene: Scene,
    points: ArrayLike,
    normals: ArrayLike,
    *,
    spp: int = 512,
    passes: int = 1,
    max_depth: int = 25,
    seed: int = 0,
    progress: _Progress | None = None,
) -> tuple[_Floats, _Floats]:
    """Direct and indirect irradiance [W/m2] at surface points by path tracing, Nx3 each."""

def render(
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
    progress: _Progress | None = None,
) -> _Floats:
    """A picture: linear radiance [W/sr/m2], height x width x 3. `method`: path, or one of methods(); `probes` are for
    ssphh. `projection`: camera, or of the whole sphere cube or equirect, around `at`."""

def render_layers(
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
    progress: _Progress | None = None,
) -> dict[str, _Floats]:
    """The same picture and what it is made of: color, direct, indirect, albedo, normal, depth [m], "group NAME"."""

def methods() -> dict[str, dict[str, Any]]:
    """What finds indirect light, and the parameters of each: default, least, most, choices, about."""

def read_image(path: _Path) -> _Floats:
    """Reads EXR, HDR, PNG, JPEG or WebP: linear, height x width, or height x width x 3 or 4."""

def write_image(path: _Path, picture: ArrayLike, *, exposure: float | None = None, tonemap: str = "clip") -> None:
    """Writes .exr or .hdr (linear), .png or .jpg (tone mapped; `exposure` in stops, None: what suits the picture)."""

def tone_map(picture: ArrayLike, *, exposure: float | None = None, tonemap: str = "clip") -> NDArray[np.uint8]:
    """8-bit sRGB of linear radiance, height x width x 3, as pyplot.imshow takes it. `tonemap`: clip or filmic."""

def compare(
    reference: ArrayLike,
    test: ArrayLike,
    *,
    mask: ArrayLike | None = None,
    display: bool = False,
    pixels_per_degree: float = ...,
) -> dict[str, Any]:
    """Errors of a picture, as `ssphh compare` tells them: mae, bias, max, mse, rmse, relmse, mape, smape, mean_ratio, flip
    (HDR-FLIP, or with `display` that of what a screen shows), psnr, ssim, pixels, left_out."""

def error_map(
    reference: ArrayLike, test: ArrayLike, map: str = "absolute", *, display: bool = False, pixels_per_degree: float = ...
) -> _Floats:
    """Where the errors are: absolute, signed, relmse or flip; height x width (x 3)."""
