"""What arguments and results are made of."""

import os
from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray

#: float32, C order.
Floats = NDArray[np.float32]
Path = str | os.PathLike[str]
#: Told of (stage, done, total, unit) at most twenty times a second, in the thread that called.
Progress = Callable[[str, int, int, str], object]
