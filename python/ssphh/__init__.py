"""Light probes with spherical harmonics: scenes, bakes, relighting, lookups, pictures.

    import ssphh
    scene = ssphh.load("builtin:two-rooms")
    probes = ssphh.bake(scene, "rooms.sphl")
    picture = ssphh.render(scene, "ssphh", probes=probes, width=640, height=360)
    ssphh.write_image("rooms.png", picture)

docs/python.md tells of all of it. Arrays are numpy's, float32; lengths are metres, light is linear Rec.709 in W.
Long calls let other threads run, stop at Ctrl-C, and tell `progress(stage, done, total, unit)`; messages go to
logging.getLogger("ssphh").
"""

import sys as _sys

from ._error import Error
from ._ssphh import (
    Camera,
    Light,
    Lookup,
    Placement,
    ProbePlace,
    ProbeSet,
    RelightSession,
    Scene,
    __version__,
    bake,
    builtin_scenes,
    compare,
    error_map,
    load,
    methods,
    place,
    read_image,
    render,
    render_layers,
    sh,
    tone_map,
    trace_irradiance,
    write_image,
)

_sys.modules["ssphh.sh"] = sh  # so that `import ssphh.sh` finds it

__all__ = [
    "Camera",
    "Error",
    "Light",
    "Lookup",
    "Placement",
    "ProbePlace",
    "ProbeSet",
    "RelightSession",
    "Scene",
    "__version__",
    "bake",
    "builtin_scenes",
    "compare",
    "error_map",
    "load",
    "methods",
    "place",
    "read_image",
    "render",
    "render_layers",
    "sh",
    "tone_map",
    "trace_irradiance",
    "write_image",
]
