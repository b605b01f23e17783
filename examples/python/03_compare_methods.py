"""One view by several methods of global illumination, and what a person would notice of each."""

# %%
import time

import numpy as np

import example
import ssphh

scene = ssphh.load("builtin:cornell")
size = dict(width=48, height=48) if example.small else dict(width=400, height=400)
reference = ssphh.render(scene, "path", spp=64 if example.small else 1024, seed=1, **size)

# %% Each by its defaults; ssphh.methods() tells of their parameters.
found = {}
for method in ("direct", "ambient", "vpl", "ssphh"):
    began = time.perf_counter()
    picture = ssphh.render(scene, method, spp=16, param={"photons": 128} if method == "vpl" else {}, **size)
    found[method] = picture, ssphh.compare(reference, picture), time.perf_counter() - began

# %%
for method, (picture, errors, seconds) in sorted(found.items(), key=lambda item: -item[1][1]["flip"]):
    print(f"{method:8} FLIP {errors['flip']:.2f}, energy {np.mean(errors['mean_ratio']):.2f}")

# %%
if plt := example.pyplot():
    figure, axes = plt.subplots(2, len(found) + 1, figsize=(3 * len(found) + 3, 6.4))
    axes[0, 0].imshow(ssphh.tone_map(reference, exposure=1))
    axes[0, 0].set_title("path traced")
    for column, (method, (picture, errors, seconds)) in zip(axes.T[1:], found.items()):
        column[0].imshow(ssphh.tone_map(picture, exposure=1))
        column[0].set_title(f"{method}, {seconds:.1f} s")
        column[1].imshow(ssphh.error_map(reference, picture, "flip"), vmin=0, vmax=1, cmap="magma")
        column[1].set_title(f"FLIP {errors['flip']:.3f}")
    for ax in axes.flat:
        ax.axis("off")
    figure.tight_layout()
    figure.savefig(example.path("03_compare_methods.png"), dpi=100)
