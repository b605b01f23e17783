"""Builds the wheel by CMake, of what `cmake --install --component python` installs: a build backend of PEP 517 that needs nothing but Python.

The module links the shared libraries of this system's packages (fmt, oneTBB, Embree, OpenEXR, ...), which the wheel does not bring: its tag is
that of this system, linux_x86_64, and it is for machines with the same packages."""

import base64
import hashlib
import os
import pathlib
import re
import subprocess
import sys
import sysconfig
import tempfile
import zipfile

root = pathlib.Path(__file__).resolve().parents[2]
# Of the build alone: another folder, more options of CMake
build = pathlib.Path(os.environ.get("SSPHH_WHEEL_BUILD", root / "build/wheel"))
options = os.environ.get("SSPHH_WHEEL_OPTIONS", "").split()


def _version():
    return re.search(r"project\(ssphh VERSION ([\d.]+)", (root / "CMakeLists.txt").read_text())[1]


def _metadata():
    return f"""Metadata-Version: 2.1
Name: ssphh
Version: {_version()}
Summary: Light probes with spherical harmonics: scenes, bakes, relighting, lookups, pictures
License: Apache-2.0
Requires-Python: >=3.9
Requires-Dist: numpy
"""


def _tag():
    python = f"cp{sys.version_info.major}{sys.version_info.minor}"
    return f"{python}-{python}-{sysconfig.get_platform().replace('-', '_').replace('.', '_')}"


def _wheel_file():
    return f"Wheel-Version: 1.0\nGenerator: cmake_wheel\nRoot-Is-Purelib: false\nTag: {_tag()}\n"


def prepare_metadata_for_build_wheel(metadata_directory, config_settings=None):
    info = pathlib.Path(metadata_directory) / f"ssphh-{_version()}.dist-info"
    info.mkdir()
    (info / "METADATA").write_text(_metadata())
    (info / "WHEEL").write_text(_wheel_file())
    return info.name


def build_wheel(wheel_directory, config_settings=None, metadata_directory=None):
    cmake = ["cmake", "-S", root, "-B", build, "-G", "Ninja", "-DCMAKE_BUILD_TYPE=Release", "-DSSPHH_UNITY=ON", "-DSSPHH_BUILD_APPS=OFF", "-DSSPHH_BUILD_TESTS=OFF",
             "-DSSPHH_BUILD_BENCHMARKS=OFF", f"-DSSPHH_PYTHON={sys.executable}", "-DSSPHH_PYTHON_DIR=.", *options]
    subprocess.run(cmake, check=True)
    subprocess.run(["cmake", "--build", build, "--target", "ssphh_python"], check=True)
    info = f"ssphh-{_version()}.dist-info"
    name = f"ssphh-{_version()}-{_tag()}.whl"
    with tempfile.TemporaryDirectory() as staged:
        subprocess.run(["cmake", "--install", build, "--component", "python", "--prefix", staged, "--strip"], check=True)
        files = {str(path.relative_to(staged)): path.read_bytes() for path in sorted(pathlib.Path(staged).rglob("*")) if path.is_file()}
    if not any(path.endswith(".so") for path in files):
        sys.exit("the module was not built: this Python needs numpy and its headers, CMake pybind11 (scripts/install-deps)")
    files[f"{info}/LICENSE"] = (root / "LICENSE").read_bytes()
    files[f"{info}/METADATA"] = _metadata().encode()
    files[f"{info}/WHEEL"] = _wheel_file().encode()
    record = ""
    for path, data in files.items():
        digest = base64.urlsafe_b64encode(hashlib.sha256(data).digest()).rstrip(b"=").decode()
        record += f"{path},sha256={digest},{len(data)}\n"
    files[f"{info}/RECORD"] = f"{record}{info}/RECORD,,\n".encode()
    part = pathlib.Path(wheel_directory) / f"{name}.part"
    with zipfile.ZipFile(part, "w", zipfile.ZIP_DEFLATED) as wheel:
        for path, data in files.items():
            entry = zipfile.ZipInfo(path, (1980, 1, 1, 0, 0, 0))
            entry.external_attr = (0o755 if path.endswith(".so") else 0o644) << 16
            entry.compress_type = zipfile.ZIP_DEFLATED
            wheel.writestr(entry, data)
    part.rename(part.with_suffix(""))
    return name


def build_sdist(sdist_directory, config_settings=None):
    raise NotImplementedError("the repository is the source")
