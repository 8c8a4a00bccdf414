#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Puts the libraries that the installed program needs beside it, so that its folder can be moved.

  bundle.py --prefix FOLDER --version VERSION

lib/mesamis holds libraries that are ours to bring, as Debian built them, byte for byte.
lib/mesamis/fallback holds those of the compiler: the system's own go first. glibc is the system's. The program finds
them by its DT_RPATH, which holds for the libraries' own needs too."""

import argparse
import glob
import os
import re
import shutil
import subprocess
import sys

import licences

OF_GLIBC = re.compile(r"^(ld-linux.*|lib(c|m|dl|pthread|rt|resolv|util|mvec|nsl)\.so\.\d+)$")
SYSTEM_FIRST = {"libstdc++6", "libgcc-s1"}


def output_of(*command):
    return subprocess.run(command, check=True, stdout=subprocess.PIPE, text=True).stdout


def needed_libraries(program):
    """Name and path of every library that the loader brings, in order of their names. What only a
    library needs that another stands for is left out."""
    paths = dict(re.findall(r"^\s*(\S+) => (\S+) \(", output_of("ldd", program), re.M))
    found, waiting = {}, [program]
    while waiting:
        for name in re.findall(r"NEEDED\s+(\S+)", output_of("objdump", "-p", waiting.pop())):
            if OF_GLIBC.match(name) or name in found:
                continue
            if name not in paths:
                sys.exit(f"bundle: error: not found: {name}")
            found[name] = os.path.realpath(paths[name])
            if name not in licences.STAND_INS:
                waiting.append(found[name])
    return dict(sorted(found.items()))


def package_of(path):
    """The Debian package of a file; dpkg may know it with or without /usr before /lib."""
    for known in (path, re.sub(r"^/usr", "", path)):
        answer = subprocess.run(["dpkg-query", "--search", known], capture_output=True, text=True)
        if answer.returncode == 0:
            return answer.stdout.split(":")[0]
    sys.exit(f"bundle: error: {path}: expected a file of a Debian package")


def copy_library(name, path, package, folder):
    licences.require_known(name, package)
    target = os.path.join(folder, "fallback" if package in SYSTEM_FIRST else "", name)
    shutil.copyfile(path, target)
    os.chmod(target, 0o644)


def copy_licence(package, folder):
    target = os.path.join(folder, package)
    shutil.copyfile(f"/usr/share/doc/{package}/copyright", target)
    os.chmod(target, 0o644)


def compile_stand_in(name, folder):
    """Without a build id and a comment: the same bytes from every folder."""
    here = os.path.dirname(os.path.abspath(__file__))
    source, versions = licences.STAND_INS[name]
    target = os.path.join(folder, name)
    script = [f"-Wl,--version-script={os.path.join(here, versions)}"] if versions else []
    subprocess.run(["cc", "-O2", "-shared", "-fPIC", "-s", f"-Wl,-soname,{name}", "-Wl,--build-id=none", *script,
                    "-o", target, os.path.join(here, source)], check=True)
    os.chmod(target, 0o644)


def search_path():
    triplet = output_of("cc", "-print-multiarch").strip()
    system = [f"/usr/lib/{triplet}", "/usr/lib64", "/usr/lib"]
    return ":".join(["$ORIGIN/../lib/mesamis", *system, "$ORIGIN/../lib/mesamis/fallback"])


def least_glibc(files):
    """The newest version of glibc's symbols that any of the files asks for."""
    versions = set()
    for file in files:
        versions |= set(re.findall(r"GLIBC_(\d+)\.(\d+)", output_of("objdump", "-T", file)))
    return ".".join(map(str, max((int(a), int(b)) for a, b in versions)))


READ_ME = """mesamis {version}, for Linux with glibc {glibc} or newer, {machine}

  bin/mesamis --help               runs from any folder; copy the whole folder, or link bin/mesamis
  man -l share/man/man1/mesamis.1  the manual
  share/bash-completion, share/zsh completion of the command line

The licences of the libraries in lib/mesamis are in share/doc/mesamis/licences.
"""


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--prefix", required=True)
    parser.add_argument("--version", required=True)
    arguments = parser.parse_args()
    program = f"{arguments.prefix}/bin/mesamis"
    libraries = f"{arguments.prefix}/lib/mesamis"
    texts = f"{arguments.prefix}/share/doc/mesamis/licences"
    for folder in (f"{libraries}/fallback", texts):
        os.makedirs(folder, exist_ok=True)
    for name, path in needed_libraries(program).items():
        if name in licences.STAND_INS:
            compile_stand_in(name, libraries)
            continue
        package = package_of(path)
        copy_library(name, path, package, libraries)
        copy_licence(package, texts)
    for package in licences.compiled_into("mesamis"):
        copy_licence(package, texts)
    root = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
    shutil.copyfile(f"{root}/LICENSE", f"{arguments.prefix}/LICENSE")
    subprocess.run(["patchelf", "--force-rpath", "--set-rpath", search_path(), program], check=True)
    files = [program, *glob.glob(f"{libraries}/**/*.so*", recursive=True)]
    with open(f"{arguments.prefix}/README", "w", encoding="utf-8") as page:
        page.write(READ_ME.format(version=arguments.version, glibc=least_glibc(files),
                                  machine=os.uname().machine))


if __name__ == "__main__":
    main()
