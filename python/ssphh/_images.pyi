"""Pictures and their errors."""

from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ._common import Floats, Path

def read_image(path: Path) -> Floats:
    """Reads EXR, HDR, PNG, JPEG or WebP: linear, height x width, or height x width x 3 or 4."""

def write_image(path: Path, picture: ArrayLike, *, exposure: float | None = None, tonemap: str = "clip") -> None:
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
) -> Floats:
    """Where the errors are: absolute, signed, relmse or flip; height x width (x 3)."""
