#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""The paper's experiments with the resolution, for docs/paper.md.

    bench/paper_study.py FOLDER                        the hemipelvis phantom; makes it first
    bench/paper_study.py FOLDER SCAN LABELS            a scan; its reference is that of its labels

Leaves scan, reference and all that `mesamis study` writes in FOLDER and prints the tables. Does not
repeat a run whose report is there. `mesamis` is the one in build/release, or that of the variable MESAMIS.
"""
import argparse
import json
import pathlib
import subprocess
import sys

from mesamis_runs import MESAMIS

PHANTOM = {
    "whole": ["--subsample", "1,2,4,6,8,10,12", "--stride", "2,2,1"],
    "region": ["--region", ":,:,225:263", "--region-subsample", "1,2,4"],
}
SCAN = {"whole": ["--subsample", "1,2,4"]}


def run(*arguments):
    """Runs mesamis; ends with its message if it fails. A run that has not converged is marked."""
    command = [MESAMIS, *map(str, arguments)]
    print("mesamis", *command[1:], file=sys.stderr, flush=True)
    done = subprocess.run(command, stdout=subprocess.DEVNULL)
    if done.returncode not in (0, 4):
        sys.exit(done.returncode)


def make_phantom(folder):
    scan, truth = folder / "scan.nrrd", folder / "truth.ply"
    if not truth.exists():
        run("phantom", "hemipelvis", "-o", scan, "--truth", truth, "--noise", 15)
    return scan, truth


def make_reference(folder, labels):
    reference = folder / "reference.ply"
    if not reference.exists():
        run("baseline", labels, "--level", 0.5, "-o", reference)
    return reference


def study(folder, name, scan, reference, options):
    report = folder / name / "study.json"
    if not report.exists():
        run("study", scan, "--reference", reference, *options, "-o", report.parent)
    return json.loads(report.read_text())


def at(run_report, place):
    """A figure of a run; None where it has none."""
    for step in place.split("/"):
        if step not in run_report:
            return None
        run_report = run_report[step]
    return run_report


COLUMNS = [
    ("s", "s", "{}"),
    ("tetrahedra", "mesh/tets", "{:,}"),
    ("triangles extracted", "surface/triangles_extracted", "{:,}"),
    ("delivered", "surface/triangles", "{:,}"),
    ("fewer than the reference, %", "compared/triangle_reduction_percent", "{:.2f}"),
    ("adaptations", "adaptations", "{}"),
    ("s1 max", "aspect_max", "{:.1f}"),
    ("s1 mean", "aspect_mean", "{:.2f}"),
    ("seconds", "seconds", "{:.0f}"),
    ("(15), mm", "distances/paper/average_hausdorff", "{:.3f}"),
    ("by area", "distances/reference_to_surface/by_area/mean", "{:.3f}"),
    ("back", "distances/surface_to_reference/mean", "{:.3f}"),
    ("by area", "distances/surface_to_reference/by_area/mean", "{:.3f}"),
    ("(14), mm", "distances/paper/hausdorff", "{:.2f}"),
]
VARIATION = ("variation, %", "compared/distance_variation_percent", "{:+.2f}")


def print_table(runs, columns):
    print("| " + " | ".join(name for name, _, _ in columns) + " |")
    print("|" + "---|" * len(columns))
    for one in runs:
        values = [(form, at(one, place)) for _, place, form in columns]
        cells = ["" if v is None else form.format(v).replace(",", " ") for form, v in values]
        if one["name"] == "region_full":
            cells[0] = "full"
        if not one["converged"]:
            cells[0] += " (not converged)"
        print("| " + " | ".join(cells) + " |")
    print()


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("folder", type=pathlib.Path)
    parser.add_argument("scan", nargs="?")
    parser.add_argument("labels", nargs="?")
    arguments = parser.parse_args()
    if (arguments.scan is None) != (arguments.labels is None):
        parser.error("expected both SCAN and LABELS, or neither")
    arguments.folder.mkdir(parents=True, exist_ok=True)
    if arguments.scan:
        studies = SCAN
        scan, reference = arguments.scan, make_reference(arguments.folder, arguments.labels)
    else:
        studies = PHANTOM
        scan, reference = make_phantom(arguments.folder)
    for name, options in studies.items():
        report = study(arguments.folder, name, scan, reference, options)
        for kind, columns in (("subsampling", COLUMNS), ("region", COLUMNS + [VARIATION])):
            if kind in report:
                print_table(report[kind]["runs"], columns)


if __name__ == "__main__":
    main()
