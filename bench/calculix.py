# SPDX-License-Identifier: Apache-2.0
"""CalculiX on bodies of mesamis: write a job, run ccx, read what it prints. Needs numpy and ccx.

A job is a mesh file and lines that follow it: `*INCLUDE` keeps the mesh as mesamis wrote it. Sets and
materials carry the names of the mesh file; ALL are all of its elements.
"""
import os
import re
import shutil
import subprocess
import sys

import numpy as np

ONE_MATERIAL = ["*MATERIAL, NAME=BONE", "*ELASTIC", "{modulus},{poisson}",
                "*SOLID SECTION, ELSET=ALL, MATERIAL=BONE"]


def material(modulus, poisson):
    """The same material for all elements."""
    return [line.format(modulus=modulus, poisson=poisson) for line in ONE_MATERIAL]


def compression(shift, ends, glued):
    """A step that moves the set TOP against BOTTOM along z; `ends` hold what else has to be held."""
    held = ["BOTTOM,1,3", "TOP,1,2"] if glued else ["BOTTOM,3,3", *ends]
    return ["*BOUNDARY", *held, "*STEP", "*STATIC", "*BOUNDARY", f"TOP,3,3,{-shift!r}",
            "*NODE PRINT, NSET=TOP, TOTALS=ONLY", "RF", "*END STEP"]


def solve(mesh, lines):
    """Runs the job MESH with the lines; the path of its results without their extension."""
    if shutil.which("ccx") is None:
        sys.exit("calculix: expected the program ccx, found none (Debian package calculix-ccx)")
    job = mesh.with_name(mesh.stem + "_job")
    job.with_suffix(".inp").write_text("\n".join([f"*INCLUDE, INPUT={mesh.name}", *lines, ""]))
    done = subprocess.run(["ccx", "-i", job.name], cwd=job.parent, capture_output=True, text=True,
                          env={**os.environ, "OMP_NUM_THREADS": "2"})
    dat = job.with_suffix(".dat")
    if done.returncode != 0 or "*ERROR" in done.stdout or not dat.read_text().strip():
        errors = [line for line in done.stdout.splitlines() if "*ERROR" in line]
        sys.exit(f"calculix: {job}: {' '.join(errors) or f'exit status {done.returncode}'}")
    return job


def rows(job, title):
    """The numbers under a title of the .dat file, a list per line."""
    text = job.with_suffix(".dat").read_text()
    found = []
    for line in text[text.index(title):].splitlines()[1:]:
        numbers = re.findall(r"[-+.\d]+E[-+]\d+|[-+]?\d+", line)
        if not line.strip() and not found:
            continue
        if not numbers or len(numbers) != len(line.split()):
            break
        found.append([float(n) for n in numbers])
    return found


def total_force(job):
    """Of the set of *NODE PRINT, N."""
    return np.array(rows(job, "total force")[0])


def nodal(job, name, components):
    """A field of the last step of the .frd file: its rows by node, numbered from 1."""
    lines = job.with_suffix(".frd").read_text().splitlines()
    start = max(i for i, line in enumerate(lines) if line.startswith(f" -4  {name}"))
    table = {}
    for line in lines[start:]:
        if line.startswith(" -3"):
            break
        if line.startswith(" -1"):
            table[int(line[3:13])] = [float(line[13 + 12 * i:25 + 12 * i])
                                      for i in range(components)]
    return table


class Mesh:
    """Points (by number less one), elements and sets of nodes of a file of mesamis."""

    def __init__(self, path):
        sections = re.split(r"(?m)^\*(?!\*)", path.read_text())
        self.sets = {}
        for section in sections:
            head, _, body = section.partition("\n")
            numbers = re.sub(r"(?m)^\*\*.*$", "", body).replace(",", " ")
            if head.startswith("NODE"):
                self.points = np.array(numbers.split(), float).reshape(-1, 4)[:, 1:]
            elif head.startswith("ELEMENT"):
                width = 5 if "C3D4" in head else 11
                self.elements = np.array(numbers.split(), int).reshape(-1, width)[:, 1:] - 1
            elif head.startswith("NSET"):
                name = head.split("NSET=")[1].strip()
                self.sets[name] = np.array(numbers.split(), int) - 1

    def nearest(self, point):
        """The number of the node nearest to a point."""
        return int(np.argmin(np.linalg.norm(self.points - point, axis=1))) + 1

    def volume(self):
        """Of the elements with straight edges, mm^3."""
        a, b, c, d = (self.points[self.elements[:, i]] for i in range(4))
        return np.einsum("ij,ij->", np.cross(b - a, c - a), d - a) / 6
