#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Makes the wheel for machines that have nothing of ours: the Python module, the program `mesamis`,
and the libraries that they need, by auditwheel.

  wheel.py --build FOLDER --prefix FOLDER --version VERSION --out FOLDER

--build is CMake's folder; --prefix holds the program and the module, installed and stripped. auditwheel chooses the tag: the
oldest systems that will do. The same files give the same bytes. It runs with the interpreter that the
module was built for, which has auditwheel; patchelf is on the PATH."""

import argparse
import glob
import os
import subprocess
import sys
import tempfile
import zipfile
from pathlib import Path

import bundle
import licences

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent / "python"))
import build_backend  # noqa: E402

MOST_BYTES = 25_000_000
PROGRAM = "mesamis/bin/mesamis"


def contents(prefix, version):
    """Bytes by name: the package with the program, the command, manual pages and completion."""
    package = next(Path(prefix).rglob("mesamis/__init__.py")).parent
    files = build_backend.files_below(package, "mesamis")
    files[PROGRAM] = Path(prefix) / "bin" / "mesamis"
    data = f"mesamis-{version}.data"
    files[f"{data}/scripts/mesamis"] = HERE / "mesamis_command.py"
    share = Path(prefix) / "share"
    for folder in ("man/man1", "bash-completion/completions", "zsh/site-functions"):
        files |= build_backend.files_below(share / folder, f"{data}/data/share/{folder}")
    return {name: path.read_bytes() for name, path in files.items()}


def licence_texts(prefix, version):
    """The texts of what is inside and not ours."""
    packages = set(licences.compiled_into("mesamis", "python3-mesamis"))
    for file in (f"{prefix}/bin/mesamis", *glob.glob(f"{prefix}/**/_core*.so", recursive=True)):
        for name, path in bundle.needed_libraries(file).items():
            if name in licences.STAND_INS:
                continue
            package = bundle.package_of(path)
            licences.require_known(name, package)
            packages.add(package)
    folder = f"mesamis-{version}.dist-info/licences"
    return {f"{folder}/{name}": Path(f"/usr/share/doc/{name}/copyright").read_bytes() for name in packages}


def repaired(wheel, folder):
    """The wheel with its libraries, and stand-ins for those that are not brought."""
    stand_ins = os.path.join(folder, "stand-ins")
    os.makedirs(stand_ins)
    for name in licences.STAND_INS:
        bundle.compile_stand_in(name, stand_ins)
    out = os.path.join(folder, "repaired")
    subprocess.run([sys.executable, "-m", "auditwheel", "repair", "--strip", "-w", out, str(wheel)], check=True,
                   env={**os.environ, "LD_LIBRARY_PATH": stand_ins})
    return next(Path(out).glob("*.whl"))


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--build", required=True)
    parser.add_argument("--prefix", required=True)
    parser.add_argument("--version", required=True)
    parser.add_argument("--out", required=True)
    arguments = parser.parse_args()
    version, tag = arguments.version, build_backend.platform_tag()
    numpy = build_backend.numpy_required(arguments.build)
    if "<" in numpy:
        sys.exit(f"wheel: error: {arguments.build}: expected pybind11 2.12 or newer, found a version for NumPy 1")
    files = contents(arguments.prefix, version) | licence_texts(arguments.prefix, version)
    programs = {PROGRAM, f"mesamis-{version}.data/scripts/mesamis"}
    with tempfile.TemporaryDirectory() as folder:
        raw = Path(folder) / f"mesamis-{version}-{tag}.whl"
        build_backend.write_wheel(raw, build_backend.with_lists(files, version, tag, numpy), programs)
        whole = repaired(raw, folder)
        with zipfile.ZipFile(whole) as wheel:
            listed = (".dist-info/RECORD", ".dist-info/METADATA", ".dist-info/WHEEL", ".dist-info/LICENSE")
            files = {n: wheel.read(n) for n in wheel.namelist() if not n.endswith(("/", *listed))}
        target = Path(arguments.out) / whole.name
        tags = whole.stem.split("-", 2)[2]
        build_backend.write_wheel(target, build_backend.with_lists(files, version, tags, numpy), programs)
    size = target.stat().st_size
    print(f"wheel: {target.name}: {size} bytes")
    if size > MOST_BYTES:
        sys.exit(f"wheel: error: {target.name}: expected at most {MOST_BYTES} bytes, found {size}")


if __name__ == "__main__":
    main()
