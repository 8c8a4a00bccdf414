# SPDX-License-Identifier: Apache-2.0
"""Builds the wheel of the package with CMake: the back end of `pip install .` (PEP 517).

CMake, a compiler and the libraries that scripts/setup lists must be installed. pip downloads pybind11;
with --no-build-isolation the installed one is used, and below 2.12 the wheel requires NumPy 1.
MESAMIS_BUILD_FOLDER names the build folder (default: build/wheel), MESAMIS_JOBS the parallel
jobs, MESAMIS_CMAKE_ARGS further options of CMake. packaging/wheel.py makes the wheel for other
machines, with the program and all libraries.
"""

import base64
import hashlib
import os
import re
import shlex
import subprocess
import sys
import sysconfig
import tempfile
import zipfile
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
SUMMARY = "From a 3D scan to a printable surface and a mesh that follows the image"


def project_version():
    text = (ROOT / "CMakeLists.txt").read_text(encoding="utf-8")
    return re.search(r"project\(mesamis VERSION ([0-9.]+)", text).group(1)


def numpy_required(folder):
    """The NumPy that a module works with, by the cache of its build."""
    cache = (Path(folder) / "CMakeCache.txt").read_text(encoding="utf-8")
    return re.search(r"^MESAMIS_NUMPY_REQUIRED:INTERNAL=(.+)$", cache, re.M).group(1)


def pybind11_options():
    """The pybind11 of this interpreter, if it has one; otherwise CMake looks for that of the system."""
    try:
        import pybind11
    except ImportError:
        return []
    return [f"-Dpybind11_DIR={pybind11.get_cmake_dir()}"]


def metadata(version, numpy):
    page = (ROOT / "docs" / "python.md").read_text(encoding="utf-8")
    return (f"Metadata-Version: 2.1\nName: mesamis\nVersion: {version}\nSummary: {SUMMARY}\n"
            f"License: Apache-2.0\nRequires-Python: >=3.9\nRequires-Dist: {numpy}\n"
            f"Description-Content-Type: text/markdown\n\n{page}")


def platform_tag():
    python = f"cp{sys.version_info.major}{sys.version_info.minor}"
    return f"{python}-{python}-{re.sub('[-.]', '_', sysconfig.get_platform())}"


def build_folder():
    return Path(os.environ.get("MESAMIS_BUILD_FOLDER", ROOT / "build" / "wheel"))


def installed(stage):
    """Builds the package and installs it below a folder."""
    folder = build_folder()
    jobs = os.environ.get("MESAMIS_JOBS", str(os.cpu_count() or 1))
    options = ["-DMESAMIS_BUILD_PYTHON=ON", f"-DPython_EXECUTABLE={sys.executable}", *pybind11_options()]
    if not (folder / "CMakeCache.txt").exists():
        options += ["-G", "Ninja", "-DCMAKE_BUILD_TYPE=Release", "-DMESAMIS_BUILD_APP=OFF",
                    "-DMESAMIS_BUILD_BASELINE=OFF", "-DMESAMIS_BUILD_TESTS=OFF", "-DMESAMIS_BUILD_EXAMPLES=OFF"]
    options += shlex.split(os.environ.get("MESAMIS_CMAKE_ARGS", ""))
    for command in (["cmake", "-S", ROOT, "-B", folder, *options],
                    ["cmake", "--build", folder, "-j", jobs, "--target", "mesamis_python"],
                    ["cmake", "--install", folder, "--component", "python", "--prefix", stage, "--strip"]):
        subprocess.run([str(part) for part in command], check=True, stdout=sys.stderr)
    return next(Path(stage).rglob("mesamis"))


def files_below(folder, name):
    """Each file below a folder, by its name in the wheel, which begins with `name`."""
    return {f"{name}/{p.relative_to(folder)}": p for p in sorted(folder.rglob("*")) if p.is_file()}


def with_lists(contents, version, tag, numpy):
    """Adds what each wheel has: METADATA, WHEEL, LICENSE and RECORD. Contents are bytes by name."""
    info = f"mesamis-{version}.dist-info"
    files = dict(contents)
    files[f"{info}/METADATA"] = metadata(version, numpy).encode()
    files[f"{info}/WHEEL"] = (f"Wheel-Version: 1.0\nGenerator: mesamis {version}\nRoot-Is-Purelib: false\n"
                              f"Tag: {tag}\n").encode()
    files[f"{info}/LICENSE"] = (ROOT / "LICENSE").read_bytes()
    rows = []
    for name, data in sorted(files.items()):
        digest = base64.urlsafe_b64encode(hashlib.sha256(data).digest()).rstrip(b"=").decode()
        rows.append(f"{name},sha256={digest},{len(data)}\n")
    files[f"{info}/RECORD"] = ("".join(rows) + f"{info}/RECORD,,\n").encode()
    return files


def write_wheel(path, files, programs=()):
    """The same files give the same bytes. `programs` are the names of those that can be run."""
    with zipfile.ZipFile(path, "w", zipfile.ZIP_DEFLATED, compresslevel=9) as wheel:
        for name, data in sorted(files.items()):
            entry = zipfile.ZipInfo(name, (1980, 1, 1, 0, 0, 0))
            entry.compress_type = zipfile.ZIP_DEFLATED
            entry.external_attr = (0o100755 if name in programs else 0o100644) << 16
            wheel.writestr(entry, data)


def build_wheel(wheel_directory, config_settings=None, metadata_directory=None):
    """Writes the wheel for this machine; the same sources give the same bytes. Returns its name."""
    version, tag = project_version(), platform_tag()
    name = f"mesamis-{version}-{tag}.whl"
    with tempfile.TemporaryDirectory() as stage:
        files = {name: path.read_bytes() for name, path in files_below(installed(stage), "mesamis").items()}
    write_wheel(Path(wheel_directory) / name, with_lists(files, version, tag, numpy_required(build_folder())))
    return name


def build_sdist(sdist_directory, config_settings=None):
    raise NotImplementedError("mesamis: build from a checkout; there is no archive of the sources")
