"""A probe file as arrays: where its light is, how few numbers would do, and a file made of arrays."""

# %% Any .sphl file would do; this one is baked here.
import numpy as np

import example
import ssphh
from ssphh import sh

scene = ssphh.load("builtin:gallery2")
ssphh.bake(scene, example.path("gallery.sphl"), probes=60, operator="surfel", viz="off", records=0, degree=9,
           **dict(quality="draft") if example.small else {})
probes = ssphh.ProbeSet.load(example.path("gallery.sphl"), scene)
light = probes.reflected  # N x K x 3
print("coefficients:", " x ".join(map(str, light.shape)), "of", light.dtype)
print("one probe's, where they lie:", probes.light(0)[scene.light_groups[0]][1].shape)

# %% Power by band: the l-th band holds 2 l + 1 coefficients.
band = np.repeat(np.arange(probes.degree + 1), 2 * np.arange(probes.degree + 1) + 1)
power = np.array([(light[:, band == l] ** 2).sum() for l in range(probes.degree + 1)])
share = np.cumsum(power) / power.sum()
print("bands 0..2 hold", f"{100 * share[2]:.0f} %", "of the power")

# %% How many patterns, of all probes together, hold 99 % of it?
matrix = light.reshape(len(probes), -1)
values = np.linalg.svd(matrix, compute_uv=False) ** 2
patterns = int(np.searchsorted(np.cumsum(values) / values.sum(), 0.99)) + 1
print(patterns, "patterns hold 99 % of the power of", len(probes), "probes")

# %% A file of the first nine coefficients alone, and what it does to looked-up light.
groups = np.array([probes.group(name)[1][:, : sh.coefficient_count(2)] for name in probes.light_groups])
short = probes.with_light(groups)
short.save(example.path("gallery-degree2.sphl"))
points, normals, moves = scene.surface_points(256)
of_all = ssphh.Lookup(scene, probes).irradiance(points, normals, moves)
of_nine = ssphh.Lookup(scene, short).irradiance(points, normals, moves)
error = np.linalg.norm(of_nine - of_all) / np.linalg.norm(of_all)
print(f"nine coefficients change the looked-up light by {100 * error:.1f} %")

# %%
if plt := example.pyplot():
    figure, axes = plt.subplots(1, 3, figsize=(14, 3.8))
    axes[0].bar(range(len(power)), power / power.sum(), log=True)
    axes[0].set(xlabel="band", ylabel="share of the power", title="light by band")
    axes[1].semilogy(values / values.sum(), "o-", ms=3)
    axes[1].set(xlabel="pattern", title="light by pattern over all probes")
    brightness = light[:, 0].mean(axis=1) / np.sqrt(4 * np.pi)
    seen = axes[2].scatter(probes.positions[:, 0], probes.positions[:, 2], c=brightness, cmap="inferno", s=60)
    axes[2].set(aspect="equal", xlabel="x [m]", ylabel="z [m]", title="mean radiance at each probe")
    figure.colorbar(seen, ax=axes[2], label="W/sr/m²")
    figure.tight_layout()
    figure.savefig(example.path("05_probe_file_to_numpy.png"), dpi=100)
