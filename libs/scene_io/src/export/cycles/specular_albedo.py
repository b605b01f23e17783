"""What specular lobes reflect of an even environment, by view angle and roughness: of the lobes of ssphh
(docs/methods/materials.md) and of those of Cycles 3.4 that stand for them. A lobe of Cycles times the ratio of the two
reflects as much as ours at every view angle.

With a Fresnel term f0 (1 - s) + f90 s a lobe's albedo is f0 A + f90 B; tables hold (A, B).
"""
import numpy as np

SIZE = 32  # nodes in the view cosine and in the perceptual roughness, both 0..1, as in ssphh
STEPS = (24, 16)  # of the quadrature, polar and half the azimuth


def schlick(cosine):
    return (1 - np.clip(cosine, 0, 1)) ** 5


def dielectric(cosine, ior=1.5):
    """Fresnel's term, scaled to 0..1 as Cycles does to blend between a lobe's colour and white."""
    def exact(c):
        g = np.sqrt(ior * ior - 1 + c * c)
        return 0.5 * ((g - c) / (g + c)) ** 2 * (1 + ((c * (g + c) - 1) / (c * (g - c) + 1)) ** 2)

    return (exact(cosine) - exact(1.0)) / (1 - exact(1.0))


def ggx_lambda(alpha, cosine):
    """Smith's term: G1 = 1 / (1 + lambda)."""
    return 0.5 * (np.sqrt(alpha ** 2 + (1 - alpha ** 2) * cosine ** 2) / cosine - 1)


def slope(alpha, cosine):
    return cosine / (alpha * np.sqrt(np.maximum(1 - cosine ** 2, 1e-12)))


def beckmann_lambda(alpha, cosine):
    a = slope(alpha, cosine)
    return np.where(a >= 1.6, 0, (1 - 1.259 * a + 0.396 * a * a) / (a * (3.535 + 2.181 * a)))


def phong_lambda(alpha, cosine):
    weight = alpha ** 2 * (0.54 + 0.46 * alpha ** 4)
    return (1 - weight) * beckmann_lambda(alpha, cosine) + weight * ggx_lambda(alpha, cosine)


def ggx_density(alpha, h):
    return alpha ** 2 / (np.pi * (h[0] ** 2 + h[1] ** 2 + alpha ** 2 * h[2] ** 2) ** 2)


def phong_density(alpha, h):
    n = 2 / alpha ** 2 - 2
    return (n + 2) / (2 * np.pi) * np.exp(0.5 * n * np.log1p(-np.minimum(h[0] ** 2 + h[1] ** 2, 0.9999999)))


def beckmann_density(alpha, h):
    cos2 = h[2] ** 2
    return np.exp(-(1 - cos2) / cos2 / alpha ** 2) / (np.pi * alpha ** 2 * cos2 ** 2)


def visible_normals(alpha, view):
    """Midpoints of equal shares of the normals of GGX that `view` sees (Dupuy and Benyoub 2023): 3 x n."""
    u, v = ((np.arange(n) + 0.5) / n for n in STEPS)
    u, v = (x.ravel() for x in np.meshgrid(u, 0.5 * v))
    stretched = view * (alpha, alpha, 1)
    stretched /= np.linalg.norm(stretched)
    z = (1 - u) * (1 + stretched[2]) - stretched[2]
    r = np.sqrt(np.clip(1 - z * z, 0, 1))
    h = np.array([r * np.cos(2 * np.pi * v), r * np.sin(2 * np.pi * v), z]) + stretched[:, None]
    h *= np.array([[alpha], [alpha], [1]])
    h[2] = np.maximum(h[2], 1e-7)
    return h / np.linalg.norm(h, axis=0)


def albedo(alpha, cosine, density, smith, correlated, blend):
    """(A, B) of one lobe. `correlated`: height-correlated masking and shadowing; else their product."""
    view = np.array([np.sqrt(1 - cosine ** 2), 0, cosine])
    h = visible_normals(alpha, view)
    cos_h = view @ h
    light = 2 * cos_h * h[2] - cosine
    seen = (light > 0) & (cos_h > 0)
    to_view, to_light = smith(alpha, cosine), smith(alpha, np.where(seen, light, 1))
    masking = 1 + to_view + to_light if correlated else (1 + to_view) * (1 + to_light)
    sampled = ggx_density(alpha, h) / (1 + ggx_lambda(alpha, cosine))
    weight = np.where(seen, density(alpha, h) / masking / sampled, 0)
    s = blend(cos_h)
    return np.mean(weight * (1 - s)), np.mean(weight * s)


def table(density, smith, correlated, blend):
    """SIZE x SIZE x 2: by roughness, then by view cosine."""
    nodes = np.linspace(0, 1, SIZE)
    return np.array([[albedo(max(r * r, 1e-3), max(mu, 1e-3), density, smith, correlated, blend) for mu in nodes]
                     for r in nodes])


def tables(phong):
    """Ours and Cycles': GGX beside the Principled BSDF's (Fresnel's term of a half vector, IOR 1.5), or Blinn-Phong
    beside Beckmann's Glossy BSDF, whose A is its albedo and whose B is 0."""
    if phong:
        return (table(phong_density, phong_lambda, True, schlick),
                table(beckmann_density, beckmann_lambda, False, np.zeros_like))
    return (table(ggx_density, ggx_lambda, True, schlick), table(ggx_density, ggx_lambda, False, dielectric))
