#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""The cost of printing a scan: the full marching cubes surface against ours, decimated.

    bench/printing_study.py SCAN FOLDER [--tolerances 0.05,0.1,0.2,0.3] [--slicers prusa,cura]

Leaves surfaces and reports in FOLDER and prints a table for docs/printing.md. Does not repeat a run
whose report is there. Distances are means by area in mm, from the full marching cubes surface to the
one printed and back. `mesamis` is the one in build/release, or that of the variable MESAMIS.
"""
import argparse
import pathlib

from mesamis_runs import once

BED = "500,500,500"  # large enough for any part of a patient


def slicings(surface, folder, slicers):
    """One report per slicer."""
    return {
        slicer: once(folder / f"{surface.stem}.{slicer}.json", "slice", surface, "--slicer", slicer,
                     "--bed", BED)
        for slicer in slicers
    }


def row(name, surface, cubes, folder, slicers):
    """A line of the table for a surface."""
    cells = [name, f"{(surface.stat().st_size - 84) // 50}", f"{surface.stat().st_size / 1e6:.1f}"]
    if surface == cubes:
        cells += ["0", "0"]
    else:
        compared = once(folder / f"{surface.stem}.compare.json", "compare", cubes, surface)
        cells += [f"{compared[d]['by_area']['mean']:.3f}"
                  for d in ("reference_to_surface", "surface_to_reference")]
    for report in slicings(surface, folder, slicers).values():
        cells += [f"{report['cpu_seconds']:.0f}", f"{report['peak_memory_mb']:.0f}",
                  f"{report['gcode_lines'] / 1e6:.2f}",
                  f"{report['estimated_print_seconds'] / 3600:.1f}"]
    print("| " + " | ".join(cells) + " |", flush=True)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("scan")
    parser.add_argument("folder", type=pathlib.Path)
    parser.add_argument("--tolerances", default="0.05,0.1,0.2,0.3")
    parser.add_argument("--slicers", default="prusa,cura")
    arguments = parser.parse_args()
    folder, slicers = arguments.folder, arguments.slicers.split(",")
    folder.mkdir(parents=True, exist_ok=True)
    extracted, cubes = folder / "extracted.stl", folder / "cubes.stl"
    segment = once(folder / "extracted.json", "segment", arguments.scan, "-o", extracted,
                   "--tolerance", "0", "--quiet")
    level = segment["surface"]["level_native"]
    once(folder / "cubes.json", "baseline", arguments.scan, "--level", level, "--close", "-o", cubes)
    head = ["surface", "triangles", "STL, MB", "cubes to it", "it to cubes"]
    for slicer in slicers:
        head += [f"{slicer}: CPU s", "MB", "10^6 lines", "print, h"]
    print("| " + " | ".join(head) + " |\n|" + "---|" * len(head))
    row("marching cubes", cubes, cubes, folder, slicers)
    row("ours as extracted", extracted, cubes, folder, slicers)
    for tolerance in arguments.tolerances.split(","):
        surface = folder / f"within_{tolerance}.stl"
        once(folder / f"{surface.stem}.json", "decimate", extracted, "--tolerance", tolerance, "-o",
             surface, "--quiet")
        row(f"{tolerance} mm", surface, cubes, folder, slicers)


if __name__ == "__main__":
    main()
