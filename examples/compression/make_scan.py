#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Writes a synthetic scan for the examples, without other libraries: HU as 16-bit NRRD.

    examples/compression/make_scan.py trabecular OUT.nrrd    a cube of rods, 1.6 mm, voxels of 0.05 mm
    examples/compression/make_scan.py vertebra OUT.nrrd      a vertebra of 44 mm across, voxels of 1 mm
"""
import array
import math
import sys


def trabecular(x, y, z):
    """Inside where a gyroid of wavelength 0.8 mm is above a level; mm."""
    a, b, c = (2 * math.pi / 0.8 * t for t in (x, y, 0.8 * z))
    wave = math.sin(a) * math.cos(b) + math.sin(b) * math.cos(c) + math.sin(c) * math.cos(a)
    return (wave - 0.45) * 0.08, 1200


def capsule(x, y, z, start, end, radius):
    along = [b - a for a, b in zip(start, end)]
    way = [p - a for p, a in zip((x, y, z), start)]
    share = max(0, min(1, sum(w * d for w, d in zip(way, along)) / sum(d * d for d in along)))
    return radius - math.dist(way, [share * d for d in along])


def vertebra(x, y, z):
    """A waisted body with a dense shell and soft ends of rods behind it; mm."""
    z -= 15
    waist = 1 - 0.12 * math.cos(math.pi * z / 26)
    body = min((1 - math.hypot((x - 30) / (20 * waist), (y - 22) / (15 * waist))) * 15, 13 - abs(z))
    arch = max(capsule(x, y, z, (20, 34, 3), (23, 50, 2), 4), capsule(x, y, z, (40, 34, 3), (37, 50, 2), 4),
               capsule(x, y, z, (23, 50, 2), (37, 50, 2), 4.5), capsule(x, y, z, (30, 50, 2), (30, 60, -4), 3.5))
    depth = max(body, arch)
    return depth, 300 + 700 * math.exp(-max(depth, 0) / 2)


SCANS = {"trabecular": (trabecular, (33, 33, 33), 0.05), "vertebra": (vertebra, (61, 70, 31), 1.0)}


def write(path, depth, size, spacing):
    """A voxel has the share of the object that its depth tells, over a voxel and a half."""
    values = array.array("h")
    for k in range(size[2]):
        for j in range(size[1]):
            for i in range(size[0]):
                d, inside = depth(i * spacing, j * spacing, k * spacing)
                share = 0.5 + 0.5 * math.erf(d / spacing)
                values.append(round(share * inside))
    if sys.byteorder == "big":
        values.byteswap()
    head = ["NRRD0004", "type: short", "dimension: 3", "space: left-posterior-superior",
            "sizes: %d %d %d" % size, f"space directions: ({spacing},0,0) (0,{spacing},0) (0,0,{spacing})",
            "kinds: domain domain domain", "endian: little", "encoding: raw", "space origin: (0,0,0)"]
    with open(path, "wb") as out:
        out.write("\n".join(head).encode() + b"\n\n" + values.tobytes())


def main():
    if len(sys.argv) != 3 or sys.argv[1] not in SCANS:
        sys.exit(__doc__)
    write(sys.argv[2], *SCANS[sys.argv[1]])


if __name__ == "__main__":
    main()
