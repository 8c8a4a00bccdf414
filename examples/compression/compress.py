#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
r"""Presses the object of a scan along z and prints its stiffness: mesamis makes the body, CalculiX solves.

    examples/compression/compress.py [--depth MM] SCAN [options of mesamis segment]

Two commands each, from the scan to the stiffness:

    examples/compression/make_scan.py trabecular cube.nrrd
    examples/compression/compress.py --depth 0.02 cube.nrrd --element-size 0.2 --least-size 0.2 \
      --skin-tolerance 0.02 --wall-elements 0
    examples/compression/make_scan.py vertebra vertebra.nrrd
    examples/compression/compress.py vertebra.nrrd --element-size 4 --least-size 2 --skin-tolerance 0.4 \
      --material keyak-1994 --calibration 0,0.001

A scan of your own goes in the place of the synthetic one; the calibration of that one is made up.

Faces within the depth (1 mm) of the lower end are held, those of the upper end are moved down by a thousandth of
the height; both stay flat and do not slide.
Without --material all of it has 10 000 MPa. `mesamis` is the one in build/release, or that of the variable MESAMIS;
`ccx` is the Debian package calculix-ccx.
"""
import argparse
import os
import pathlib
import re
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent
MESAMIS = os.environ.get("MESAMIS", str(ROOT / "build/release/mesamis"))


def run(command, folder):
    try:
        done = subprocess.run(command, cwd=folder, capture_output=True, text=True)
    except FileNotFoundError:
        sys.exit(f"compress: expected the program {command[0]}, found none")
    if done.returncode not in (0, 4) or "*ERROR" in done.stdout:
        sys.exit(f"compress: {command[0]}: {done.stderr.strip() or done.stdout[-400:]}")


def make_body(scan, depth, options, folder):
    """1. The body, with quadratic elements and the sets TOP and BOTTOM."""
    run([MESAMIS, "--quiet", "segment", scan, "--body", str(folder / "body.inp"), "--element", "tet10",
         "--set", f"TOP=top:z,{depth}mm", "--set", f"BOTTOM=bottom:z,{depth}mm", *options], None)
    return (folder / "body.inp").read_text()


def extent(body):
    """2. The sides of the box around the nodes, mm."""
    nodes = re.search(r"\*NODE[^\n]*\n(.*?)\n\*", body, re.S).group(1)
    places = [[float(x) for x in line.split(",")[1:]] for line in nodes.splitlines()]
    return [max(axis) - min(axis) for axis in zip(*places)]


def job(body, height):
    """3. The step: materials, supports, a shift, and the force that it needs."""
    lines = ["*INCLUDE, INPUT=body.inp"]
    if "*SOLID SECTION" not in re.sub(r"(?m)^\*\*.*$", "", body):
        lines += ["*MATERIAL, NAME=BONE", "*ELASTIC", "10000, 0.3", "*SOLID SECTION, ELSET=ALL, MATERIAL=BONE"]
    return lines + ["*BOUNDARY", "BOTTOM, 1, 3", "TOP, 1, 2", "*STEP", "*STATIC", "*BOUNDARY",
                    f"TOP, 3, 3, {-1e-3 * height}", "*NODE PRINT, NSET=TOP, TOTALS=ONLY", "RF", "*END STEP", ""]


def force_along_z(folder):
    """4. What CalculiX printed: the sum over the nodes of TOP, N."""
    total = (folder / "job.dat").read_text().split("total force")[1].splitlines()[2]
    return abs(float(total.split()[2]))


def main():
    parser = argparse.ArgumentParser(description=__doc__, allow_abbrev=False,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--depth", type=float, default=1, metavar="MM")
    parser.add_argument("scan")
    arguments, options = parser.parse_known_args()
    with tempfile.TemporaryDirectory() as temporary:
        folder = pathlib.Path(temporary)
        body = make_body(arguments.scan, arguments.depth, options, folder)
        x, y, z = extent(body)
        (folder / "job.inp").write_text("\n".join(job(body, z)))
        run(["ccx", "-i", "job"], folder)
        force = force_along_z(folder)
    print(f"{x:.3f} x {y:.3f} x {z:.3f} mm, stiffness {force / (1e-3 * z):.6g} N/mm, "
          f"modulus of the box {force / (1e-3 * x * y):.6g} MPa")


if __name__ == "__main__":
    main()
