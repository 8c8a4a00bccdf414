#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Distances from the truth: ours with default settings against the best tuned marching cubes.

    bench/accuracy_study.py FOLDER [--cases fracture:4,hemipelvis:30,...]

A case is a phantom and a fault of its scan: the noise in grey values, `sp` (2 % salt and pepper) or
`speckle` (0.1). The blur is one voxel. The rival is an isosurface of the smoothed scan at the true
level. The width of the Gaussian is the one of WIDTHS that gives the smallest distance from the truth.
The rival is taken in full, and decimated by quadrics to a tenth of the triangles of the noiseless
scan's isosurface. Ours is taken as extracted, and decimated to the same count. Distances are means by
area in mm, truth to surface and back, added; the ratio is ours to the rival's. The script leaves
surfaces and reports in FOLDER and prints tables, whose ratios docs/accuracy.md sums up. It does not repeat a run
whose report is there. `mesamis` is the one in build/release, or that of the variable MESAMIS.
"""
import argparse
import pathlib

from mesamis_runs import once

CASES = ",".join(f"{phantom}:{fault}" for phantom in ("fracture", "hemipelvis")
                 for fault in ("4", "15", "30", "sp", "speckle"))
FAULTS = {"sp": ["--salt-pepper", "0.02"], "speckle": ["--speckle", "0.1"]}
WIDTHS = (0, 0.5, 0.7, 0.9, 1.1, 1.4)  # voxels
LEVEL = 175  # midway between bone and its surroundings
GAPS = {"fracture": "26,23,26,47,41,38", "hemipelvis": "121,108,172,139,126,270"}


def distances(folder, truth, surface, box=None):
    """Both means by area, truth to surface first."""
    suffix = ".gap.json" if box else ".distance.json"
    report = once(folder / (surface.stem + suffix), "compare", truth, surface, "--frames", "as-is",
                  *(["--box", box] if box else []))
    return [report[d]["by_area"]["mean"] for d in ("reference_to_surface", "surface_to_reference")]


def rival(folder, name, scan, truth, triangles):
    """The isosurface of the best width: its file and width."""
    found = []
    for width in WIDTHS:
        surface = folder / f"{name}.mc{width}.{triangles or 'full'}.ply"
        once(surface.with_suffix(".json"), "baseline", scan, "--level", LEVEL, "--smooth", width,
             *(["--triangles", triangles] if triangles else []), "-o", surface)
        found.append((sum(distances(folder, truth, surface)), width, surface))
    return min(found)[2], min(found)[1]


def cell(found):
    """One entry of a table."""
    return f"{found[0]:.3f} / {found[1]:.3f}"


def study(folder, case):
    """Prints the two lines of a case."""
    phantom, fault = case.split(":")
    name = f"{phantom}_{fault}"
    clean, scan = folder / f"{phantom}.nrrd", folder / f"{name}.nrrd"
    truth, ours = folder / f"{phantom}.truth.ply", folder / f"{name}.ours.ply"
    once(folder / f"{phantom}.json", "phantom", phantom, "-o", clean, "--truth", truth)
    once(folder / f"{name}.json", "phantom", phantom, "-o", scan,
         *FAULTS.get(fault, ["--noise", fault]))
    cubes = once(folder / f"{phantom}.mc.json", "baseline", clean, "--level", LEVEL, "-o",
                 folder / f"{phantom}.mc.ply")
    tenth = cubes["surface"]["triangles"] // 10
    segment = once(ours.with_suffix(".json"), "segment", scan, "-o", ours, "--tolerance", "0",
                   "--quiet")
    few = folder / f"{name}.ours.{tenth}.ply"
    once(few.with_suffix(".json"), "decimate", ours, "--triangles", tenth, "-o", few, "--quiet")
    for what, surface, triangles in (("full", ours, 0), ("tenth", few, tenth)):
        best, width = rival(folder, name, scan, truth, triangles)
        our, rivals = distances(folder, truth, surface), distances(folder, truth, best)
        our_gap, rivals_gap = (distances(folder, truth, s, GAPS[phantom]) for s in (surface, best))
        print("| " + " | ".join([
            phantom, fault, what, str(triangles or segment["surface"]["triangles"]), cell(our),
            f"{cell(rivals)} ({width})", f"**{sum(our) / sum(rivals):.2f}**", cell(our_gap),
            cell(rivals_gap), f"{sum(our_gap) / sum(rivals_gap):.2f}"]) + " |", flush=True)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("folder", type=pathlib.Path)
    parser.add_argument("--cases", default=CASES)
    arguments = parser.parse_args()
    arguments.folder.mkdir(parents=True, exist_ok=True)
    head = ["phantom", "noise", "surface", "our triangles", "ours", "rival (width)", "ratio",
            "gap: ours", "gap: rival", "ratio"]
    print("| " + " | ".join(head) + " |\n|" + "---|" * len(head))
    for case in arguments.cases.split(","):
        study(arguments.folder, case)


if __name__ == "__main__":
    main()
