"""The light at probes."""

from ._common import Path, Progress
from ._scene import Scene
from ._probe_set import ProbeSet

def bake(
    scene: Scene,
    output: Path | None = None,
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
    max_probes: int = 65536,
    resume: bool = True,
    progress: Progress | None = None,
) -> ProbeSet:
    """Finds the light at every probe. Arguments and defaults are those of `ssphh bake`, and so is every bit of the result.
    An interrupted bake with an `output` leaves OUTPUT.checkpoint; the same call goes on there."""
