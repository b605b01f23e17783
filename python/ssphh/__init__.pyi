"""Types of the package ssphh, and what each thing takes and gives (docs/python.md): a file for each topic."""

from . import sh as sh
from ._bake import bake as bake
from ._error import Error as Error
from ._images import (
    read_image as read_image,
    write_image as write_image,
    tone_map as tone_map,
    compare as compare,
    error_map as error_map,
)
from ._lookup import Lookup as Lookup, trace_irradiance as trace_irradiance
from ._place import Placement as Placement, place as place
from ._probe_set import ProbeSet as ProbeSet
from ._relight import RelightSession as RelightSession
from ._render import render as render, render_layers as render_layers, methods as methods
from ._scene import (
    Light as Light,
    Camera as Camera,
    ProbePlace as ProbePlace,
    Scene as Scene,
    load as load,
    builtin_scenes as builtin_scenes,
)

__all__: list[str]
__version__: str
