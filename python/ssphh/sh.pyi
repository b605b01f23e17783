"""Spherical harmonics: real, orthonormal, no Condon-Shortley sign; index k = l (l + 1) + m. Coefficients are Kx3, red, green
and blue, K = (degree + 1)^2; directions are unit vectors."""

from numpy.typing import ArrayLike

from ._common import Floats as _Floats

max_degree: int

def coefficient_count(degree: int) -> int:
    """(degree + 1)^2."""

def basis(degree: int, directions: ArrayLike) -> _Floats:
    """Values of all Y_k in directions Nx3: NxK."""

def evaluate(coefficients: ArrayLike, directions: ArrayLike) -> _Floats:
    """The function in directions Nx3: Nx3."""

def project(degree: int, directions: ArrayLike, weights: ArrayLike, radiance: ArrayLike) -> _Floats:
    """Coefficients of radiance Nx3 in directions Nx3, each standing for a solid angle of `weights` [sr], N."""

def project_cube(degree: int, faces: ArrayLike) -> _Floats:
    """Coefficients of six faces +X -X +Y -Y +Z -Z, 6xMxMx3, oriented as OpenGL's."""

def irradiance(coefficients: ArrayLike) -> _Floats:
    """Coefficients of E(n) [W/m2] from those of radiance: cosine convolution, without a hidden 1/pi."""

def rotate(coefficients: ArrayLike, matrix: ArrayLike) -> _Floats:
    """The function turned by an orthogonal 3x3 matrix: (R f)(w) = f(R^-1 w). Mirrorings are allowed."""

def window(coefficients: ArrayLike, window: str = "auto", *, width: float | None = None) -> _Floats:
    """Higher bands damped: auto (just enough that E(n) is nowhere negative), or hanning or lanczos of a width in bands."""

def minimum(coefficients: ArrayLike) -> _Floats:
    """Lowest value over the sphere, of each colour, 3."""

def convert(coefficients: ArrayLike, to: str, *, from_convention: str = "ssphh") -> _Floats:
    """Coefficients in the convention of another program: ssphh, d3dx, unreal, unity, three, godot, filament ..."""
