"""A first bake: two rooms, the light between them, and how near it is to the truth."""

# %% A scene by name; a file (.glb .gltf .obj) goes as well.
import numpy as np

import example
import ssphh

scene = ssphh.load("builtin:two-rooms", time=1)  # the door is open
print(scene)
print("light groups:", *scene.light_groups)

# %% Find the light at its probes. Without arguments this is what `ssphh bake` does, to the bit.
quality = dict(quality="draft", operator="surfel", degree=4, records=1024) if example.small else dict()
probes = ssphh.bake(scene, example.path("two-rooms.sphl"), **quality)
print(len(probes), "probes of degree", probes.degree)

# %% Look it up where there are surfaces, and trace paths at the same points: the truth.
points, normals, moves = scene.surface_points(256 if example.small else 2048)
looked_up = ssphh.Lookup(scene, probes).irradiance(points, normals, moves)
direct, indirect = ssphh.trace_irradiance(scene, points, normals, spp=256 if example.small else 2048)
error = np.linalg.norm(looked_up - indirect) / np.linalg.norm(indirect)
print(f"mean indirect irradiance {looked_up.mean():.3f} W/m2, path traced {indirect.mean():.3f}")
print(f"relative error, root mean square: {error:.2f}")

# %% Draw both.
size = dict(width=96, height=54, spp=16) if example.small else dict(width=960, height=540, spp=128)
with_probes = ssphh.render(scene, "ssphh", probes=probes, **size)
by_paths = ssphh.render(scene, "path", **size)
errors = ssphh.compare(by_paths, with_probes)
print(f"FLIP {errors['flip']:.2f}, energy {np.mean(errors['mean_ratio']):.2f}")

# %%
if plt := example.pyplot():
    figure, axes = plt.subplots(1, 3, figsize=(15, 3.4), width_ratios=[1.5, 1.5, 1.6])
    for ax, picture, title in ((axes[0], with_probes, "lit by probes"), (axes[1], by_paths, "path traced")):
        ax.imshow(ssphh.tone_map(picture, exposure=-0.5))
        ax.set_title(title)
        ax.axis("off")
    floor = normals[:, 1] > 0.9
    axes[2].set_title("indirect light on the floor; + probes")
    seen = axes[2].scatter(points[floor, 0], points[floor, 2], c=looked_up[floor].mean(axis=1), s=20, cmap="inferno")
    axes[2].scatter(probes.positions[:, 0], probes.positions[:, 2], marker="+", c="tab:blue", s=80)
    axes[2].set(aspect="equal", xlabel="x [m]", ylabel="z [m]")
    axes[2].invert_yaxis()
    figure.colorbar(seen, label="W/m²", shrink=0.8)
    figure.tight_layout()
    figure.savefig(example.path("01_first_bake.png"), dpi=100)
