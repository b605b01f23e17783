"""Probes and their light."""

from collections.abc import Sequence
from typing import Any, final

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ._common import Floats, Path
from ._scene import Scene

@final
class ProbeSet:
    """Probes and their light: what a bake makes and a file holds. K = (degree + 1)^2 coefficients of red, green, blue."""

    @staticmethod
    def load(path: Path, scene: Scene | None = None, *, force: bool = False) -> ProbeSet:
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
    def save(self, path: Path) -> None:
        """Writes .sphl (every bit) or .sphl.json (five digits), by a temporary file beside it."""
    def __len__(self) -> int: ...
    def __eq__(self, other: object) -> bool: ...
    @property
    def degree(self) -> int:
        """Highest band, 0..10."""
    @property
    def positions(self) -> Floats:
        """Nx3 [m]."""
    @property
    def names(self) -> list[str]: ...
    @property
    def radii(self) -> Floats:
        """Of the spheres that VIZ lights [m], N."""
    @property
    def light_groups(self) -> dict[str, Floats]:
        """Factor of each light group, 3 each."""
    @property
    def light_modes(self) -> dict[str, str]:
        """realtime, mixed or baked, of each light group."""
    @property
    def generator(self) -> dict[str, Any]:
        """How the set was made."""
    @property
    def reflected(self) -> Floats:
        """What surfaces look up: the light of all groups times their factors [W/sr/m2], NxKx3; a copy."""
    @property
    def radiance(self) -> Floats:
        """The same with emitters seen directly, NxKx3; a copy."""
    @property
    def hierarchy(self) -> Floats | None:
        """What hier() found, NxKx3; None before."""
    def group(self, name: str) -> tuple[Floats, Floats]:
        """Emitted and reflected light of one group as baked, NxKx3 each; copies."""
    def light(self, index: int) -> dict[str, tuple[Floats, Floats]]:
        """Emitted and reflected light of each group as baked, of one probe: Kx3 where the numbers lie, read only; 0x3 where
        nothing emits."""
    @property
    def edges(self) -> tuple[NDArray[np.int32], Floats]:
        """(from, to) of every edge, Mx2, and how much light takes it, P, M."""
    @property
    def records(self) -> tuple[Floats, Floats, Floats] | None:
        """Positions [m], normals and irradiance [W/m2] of surface records, Mx3 each; None without."""
    def relight(self, group: str, scale: ArrayLike) -> None:
        """Dims or colours a light group without a bake, by one factor or three, relative to the bake. Drops the hierarchy."""
    def hier(self, operator: str = "coefficient", *, neighbors: int = -1, threshold: float = 0.0) -> int:
        """Adds neighbours' light over the edges by coefficient, mean or matrix; returns the number of edges used."""
