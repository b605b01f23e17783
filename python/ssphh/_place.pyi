"""Places for probes."""

from typing import final

import numpy as np
from numpy.typing import NDArray

from ._common import Floats, Progress
from ._scene import Scene

@final
class Placement:
    """Places that place() found."""

    def __len__(self) -> int: ...
    @property
    def positions(self) -> Floats:
        """Nx3 [m], the scene's own first."""
    @property
    def names(self) -> list[str]: ...
    @property
    def kinds(self) -> list[str]:
        """manual, grid, refined or passage, of each."""
    @property
    def radii(self) -> Floats:
        """Of the spheres that VIZ lights [m], N."""
    @property
    def edges(self) -> NDArray[np.uint32]:
        """Pairs of neighbours that see each other, Mx2."""
    @property
    def spacing(self) -> float:
        """Of the coarse grid [m]."""
    @property
    def warnings(self) -> list[str]: ...

def place(
    scene: Scene,
    probes: str | int | None = None,
    *,
    clearance: float = 0.04,
    refine: int = 1,
    max_probes: int = 65536,
    progress: Progress | None = None,
) -> Placement:
    """Finds places for probes: auto (None), auto:METRES, or so many."""
