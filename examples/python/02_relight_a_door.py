"""A door opens, and the probes of the room behind it follow, frame by frame, without a bake."""

# %% A session begins in the scene's pose, the door shut. Surfaces keep light wherever any pose of the animation asks for it.
import numpy as np

import example
import ssphh

scene = ssphh.load("builtin:two-rooms")
coarse = dict(surfel_size=0.4, directions=128, link_rays=32, records=1024) if example.small else dict()
session = ssphh.RelightSession(scene, **coarse)
session.update()

# %% Points of the room that has no lamp.
points, normals, moves = scene.surface_points(512)
behind = (points[:, 0] > 0.3) & ~moves
points, normals = points[behind], normals[behind]

# %% Open the door; hold three frames against path tracing.
frames = 5 if example.small else 31
times = np.linspace(0, scene.duration, frames)
light, truth, pictures = [], {}, {}
for frame, session.time in enumerate(times):
    session.update()
    light.append(session.irradiance(points, normals).mean())
    if frame in (0, frames // 2, frames - 1):
        truth[session.time] = session.trace_irradiance(points, normals, spp=256)[1].mean()
        pictures[session.time] = session.render(
            width=96 if example.small else 640, height=54 if example.small else 360, spp=8, camera=scene.cameras[-1].name)
for time, true in truth.items():
    found = light[list(times.astype(np.float32)).index(np.float32(time))]
    print(f"door at {time:.1f} s: the dark room gets {1e3 * found:.0f} mW/m2, path traced {1e3 * true:.0f}")

# %% Switch the lamp to red: no ray is needed.
session.set_group("lamp", [1, 0.1, 0.05])
session.update()
red, green, blue = session.irradiance(points, normals).mean(axis=0)
print(f"in red light: {1e3 * red:.0f} red, {1e3 * green:.1f} green, {1e3 * blue:.1f} blue")

# %%
if plt := example.pyplot():
    figure = plt.figure(figsize=(12, 6))
    axes = figure.subplot_mosaic([[f"{i}" for i in range(len(pictures))], ["curve"] * len(pictures)])
    for i, (time, picture) in enumerate(pictures.items()):
        axes[f"{i}"].imshow(ssphh.tone_map(picture, exposure=2))
        axes[f"{i}"].set_title(f"{time:.1f} s")
        axes[f"{i}"].axis("off")
    axes["curve"].plot(times, light, "o-", ms=3, label="probes and records")
    axes["curve"].plot(list(truth), list(truth.values()), "kx", label="path traced")
    axes["curve"].set(xlabel="time of the door [s]", ylabel="indirect light behind it [W/m²]")
    axes["curve"].legend()
    figure.tight_layout()
    figure.savefig(example.path("02_relight_a_door.png"), dpi=100)
