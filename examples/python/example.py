"""What the examples share: how large they are, and where their pictures go.

    python3 examples/python/01_first_bake.py [--small] [-o FOLDER]
"""

import argparse
import os
import sys

parser = argparse.ArgumentParser()
parser.add_argument("--small", action="store_true", help="a few seconds instead of a minute")
parser.add_argument("-o", "--output", default=".", help="folder for pictures (default: here)")
_given = parser.parse_args()
small = _given.small


def path(name):
    """Of a file to write."""
    os.makedirs(_given.output, exist_ok=True)
    return os.path.join(_given.output, name)


def pyplot():
    """matplotlib.pyplot, or None with a word where it is not installed (apt install python3-matplotlib)."""
    try:
        import matplotlib
    except ImportError:
        print("matplotlib is not installed: no pictures", file=sys.stderr)
        return None
    matplotlib.use("Agg")
    import matplotlib.pyplot

    return matplotlib.pyplot
