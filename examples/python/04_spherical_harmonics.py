"""How few numbers hold the light that arrives at a place: a sky with a sun, by degree, windowed, turned, as irradiance."""

# %% Light as a function of direction: a blue sky, a warm and hazy sun, dark ground.
import numpy as np

import example
from ssphh import sh


def sky(d):
    up = np.clip(d[:, 1], 0, 1)[:, None]
    sun = (d @ np.array([0.48, 0.8, 0.36]) > np.cos(np.radians(20)))[:, None]
    return up**0.5 * [0.3, 0.5, 1.0] + sun * [3, 2.5, 1.8] + (d[:, 1] < 0)[:, None] * [0.08, 0.07, 0.06]


# %% Directions of a longitude-latitude picture, and the solid angle of each pixel.
rows = 64 if example.small else 256
theta, phi = np.meshgrid((np.arange(rows) + 0.5) * np.pi / rows, (np.arange(2 * rows) + 0.5) * np.pi / rows, indexing="ij")
directions = np.stack([np.sin(theta) * np.cos(phi), np.cos(theta), np.sin(theta) * np.sin(phi)], axis=-1).reshape(-1, 3)
weights = (np.sin(theta) * (np.pi / rows) ** 2).ravel()
radiance = sky(directions)
print(f"solid angle of all pixels: {weights.sum() / np.pi:.3f} pi")

# %% Projection and back, degree by degree.
shown = {}
for degree in (1, 2, 4, 10):
    coefficients = sh.project(degree, directions, weights, radiance)
    back = sh.evaluate(coefficients, directions)
    shown[f"degree {degree}"] = back
    rms = np.sqrt((weights[:, None] * (back - radiance) ** 2).sum() / (weights[:, None] * radiance**2).sum())
    print(f"degree {degree:2}: {len(coefficients):3} coefficients, error {rms:.2f}, lowest value {back.min():.2f}")

# %% Irradiance needs three bands: of a surface that faces any direction.
full = sh.irradiance(sh.project(10, directions, weights, radiance))
normals = directions[:: 37 if example.small else 997]
truth = np.array([(radiance * (weights * np.clip(directions @ n, 0, None))[:, None]).sum(axis=0) for n in normals])
for degree in (1, 2, 4):
    found = sh.evaluate(full[: sh.coefficient_count(degree)], normals)
    print(f"irradiance of degree {degree}: error {np.abs(found - truth).max() / truth.max():.2f} of the brightest")

# %% A window damps what rings below zero; a turned sky is the sky looked at from turned directions.
windowed = sh.window(sh.project(10, directions, weights, radiance), "lanczos", width=11)
print(f"lowest value with a window: {sh.evaluate(windowed, directions).min():.2f}")
quarter = np.array([[0, 0, 1], [0, 1, 0], [-1, 0, 0]])
turned = sh.evaluate(sh.rotate(full, quarter), normals @ quarter.T)
print("turned:", np.allclose(turned, sh.evaluate(full, normals), atol=1e-3))
shown["degree 10, windowed"] = sh.evaluate(windowed, directions)

# %%
if plt := example.pyplot():
    panels = {"the sky": radiance, **shown, "irradiance, degree 2": sh.evaluate(full[:9], directions) / np.pi}
    figure, axes = plt.subplots(2, 4, figsize=(15, 4.4))
    for ax in axes.flat:
        ax.axis("off")
    for ax, (title, values) in zip(axes.flat, panels.items()):
        ax.imshow(np.clip(values.reshape(rows, 2 * rows, 3), 0, 1) ** (1 / 2.2))
        ax.set_title(title)
    figure.tight_layout()
    figure.savefig(example.path("04_spherical_harmonics.png"), dpi=100)
