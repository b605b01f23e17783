"""What the tests share: small scenes, the tool, folders."""

import logging
import os
import subprocess
import tempfile
import unittest

import numpy as np

import ssphh

TOOL = os.environ["SSPHH_TOOL"]
SOURCE = os.environ["SSPHH_SOURCE"]
logging.getLogger("ssphh").addHandler(logging.NullHandler())  # warnings are tested, not printed


def run_tool(*arguments):
    """What the tool prints."""
    done = subprocess.run([TOOL, *map(str, arguments)], check=True, capture_output=True, text=True)
    return done.stdout


class InAFolder(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = folder.name

    def path(self, name):
        return os.path.join(self.folder, name)

    def bytes_of(self, name):
        with open(self.path(name), "rb") as file:
            return file.read()


def error_of(test, function, *arguments, **keywords):
    """The ssphh.Error that a call must raise."""
    with test.assertRaises(ssphh.Error) as caught:
        function(*arguments, **keywords)
    return caught.exception


def constant(radiance, degree=2):
    """Coefficients Kx3 of the same radiance from everywhere."""
    coefficients = np.zeros(((degree + 1) ** 2, 3), np.float32)
    coefficients[0] = np.asarray(radiance) * np.sqrt(4 * np.pi)
    return coefficients
