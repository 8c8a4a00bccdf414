#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Writes tables, pictures and figures in prose of README.md and docs/ from fresh runs on real scans.

    bench/tables.py --scans FOLDER --all               every table and picture; goes on where it was stopped
    bench/tables.py --scans FOLDER --only README       those of one page
    bench/tables.py --scans FOLDER --texts             figures in prose
    bench/tables.py --scan pelvis=ct.nii.gz            one scan, wherever it is: its rows
    bench/tables.py --list                             the scans, and where FOLDER has them
    bench/tables.py --stale                            what is older than the last change of output bytes, and
                                                       tables and pictures that no command makes
    bench/tables.py --prune                            deletes pictures that no command makes and no page shows

A table stands between <!-- table:NAME --> and <!-- /table:NAME -->, figures in prose between <!-- text:NAME --> and
<!-- /text:NAME -->. A row is replaced if its scan is
there; the other rows stay as they are, with a note on stderr. Under each table the script names the
command, and the last column names the version and the commit of the program that made the row.
docs/figures.json has the commit of each of them. The bytes of outputs have changed with the last commit that
touched tests/output_bytes.txt (scripts/bytes).
One run at a time, with default settings. Times mean something only on a machine without other work.
--folder keeps surfaces and reports and does not repeat a run whose report is there (--all: build/tables). `mesamis` is
the one in build/release, or that of the variable MESAMIS.
"""
import argparse
import importlib.util
import json
import math
import os
import pathlib
import re
import subprocess
import sys
import tempfile

from mesamis_runs import once
from pictures import PICTURES
from texts import TEXTS

ROOT = pathlib.Path(__file__).resolve().parent.parent

# Name: first cell of its row, place in FOLDER.
SCANS = {
    "pelvis": ("pelvis CT, 3 mm", "pelvis_ts/ct.nii.gz"),
    "trabecular": ("trabecular bone, micro-CT", "trabecular_microct/ct.nrrd"),
    "head": ("head CT", "cranium_inv/ct.nrrd"),
    "mouse": ("mouse, micro-CT", "mouse_skull/ct_A_J.nii.gz"),
    "spine": ("thoracic spine CT", "thoracic_spine_ts/ct.nii.gz"),
    "abdomen": ("abdominal CT, DICOM, JPEG 2000", "dicom_ct_j2k"),
    "skull": ("skull phantom CT", "skull_phantom/ct_soft_1mm.nrrd"),
    "template": ("", "mouse_skull/ct_template.nii.gz"),
}
README_SCANS = ("pelvis", "head", "skull")
SIZE_SCANS = ("trabecular", "mouse", "spine", "abdomen")  # beside those of README

# First cell of the row: scan, its reference in FOLDER (labels, or a surface), options of segment.
DISTANCES = {
    "pelvis CT, bone labels (voxel 3 mm)": ("pelvis", "pelvis_ts/bone.nii.gz", []),
    "mouse template, bone label (voxel 0.141 mm)": ("template", "mouse_skull/bone.nii.gz", []),
    "head CT, InVesalius (voxel 0.96 x 0.96 x 1.5 mm)":
        ("head", "cranium_inv/surface_invesalius.ply.gz", ["--level", "226", "--keep-surroundings"]),
}

# First cell of the row: scan, options of segment.
DECIMATED = {
    "pelvis CT": ("pelvis", []),
    "trabecular bone, micro-CT": ("trabecular", []),
    "head CT at 226 HU": ("head", ["--level", "226"]),
    "mouse template, micro-CT": ("template", []),
    "thoracic spine CT": ("spine", []),
}
TOLERANCES = (0.05, 0.1, 0.2, 0.3)  # voxels; the time is that of the second one

SEGMENT = "`mesamis segment SCAN -o ours.ply --mesh ours.vtu --report report.json`"
BASELINE = "`mesamis baseline SCAN --level LEVEL_OF_THE_REPORT -o cubes.ply`"
NOTES = {
    "readme-scans": f"`bench/tables.py` writes this table. It runs {SEGMENT} and, for the triangles "
                    f"of marching cubes, {BASELINE}.",
    "results-sizes": f"`bench/tables.py` writes this table. It runs {SEGMENT}.",
    "results-distances": "`bench/tables.py` writes this table with the commands above.",
    "printing-decimation": "`bench/tables.py` writes this table with the commands above.",
    "labels-bones": "`bench/tables.py` writes this table with what `bench/looks_study.py` measures.",
}


def note(text):
    print(f"tables: {text}", file=sys.stderr, flush=True)


class Runs:
    """Runs mesamis on the scans that are there, each command once."""

    def __init__(self, folder, scans, places):
        self.folder, self.scans, self.places = folder, scans, places

    def scan(self, name):
        """The scan's file or folder, or None."""
        path = self.places.get(name)
        if path is None and self.scans:
            path = self.scans / SCANS[name][1]
        return path if path and path.exists() else None

    def reference(self, place):
        """The reference as a surface, or None; labels become one by marching cubes."""
        path = self.scans / place if self.scans else None
        if not path or not path.exists():
            return None
        if ".ply" in path.suffixes:
            return path
        surface = self.folder / (path.parent.name + ".reference.ply")
        once(surface.with_suffix(".json"), "baseline", path, "--level", 0.5, "-o", surface)
        return surface

    def segment(self, name, options=()):
        """Report and surface of a run."""
        stem = "".join([name, *options])
        surface = self.folder / f"{stem}.ply"
        if not surface.with_suffix(".json").exists():
            note(f"segmenting {self.scan(name)} {' '.join(options)}".rstrip())
        return once(surface.with_suffix(".json"), "--quiet", "segment", self.scan(name), *options,
                    "-o", surface, "--mesh", surface.with_suffix(".vtu")), surface

    def extracted(self, name, options):
        """Report and surface of a run that decimates nothing."""
        surface = self.folder / f"{''.join([name, *options])}.extracted.ply"
        return once(surface.with_suffix(".json"), "segment", self.scan(name), *options, "--tolerance", 0,
                    "--min-volume", 0, "-o", surface), surface

    def decimated(self, surface, tolerance):
        """Report of a decimation within a distance, mm."""
        few = surface.with_suffix(f".{tolerance:.4g}.ply")
        return once(few.with_suffix(".json"), "decimate", surface, "--tolerance", tolerance, "-o", few)

    def cubes(self, name, level):
        """Report and surface of marching cubes at a level."""
        surface = self.folder / f"{name}.{level:g}.cubes.ply"
        return once(surface.with_suffix(".json"), "baseline", self.scan(name), "--level", level,
                    "-o", surface), surface

    def distances(self, reference, surface):
        """Mean distances by area: reference to surface, and back."""
        report = once(surface.with_suffix(".compare.json"), "compare", reference, surface)
        return [report[d]["by_area"]["mean"]
                for d in ("reference_to_surface", "surface_to_reference")]


def count(n):
    return f"{n:,}".replace(",", " ")


def distance(mm):
    return f"{mm:.2f}" if mm >= 0.1 else f"{mm:.3f}"


def share(x):
    return f"{x:.2f}".lstrip("0")


def duration(seconds):
    return f"{seconds:.0f} s" if seconds < 100 else f"{seconds / 60:.1f} min"


def version(report):
    return f"{report['program']['version']} ({report['program']['commit']})"


def readme_row(runs, name):
    report, _ = runs.segment(name)
    cubes, _ = runs.cubes(name, report["surface"]["level_native"])
    millions = 1e-6
    for n in report["input"]["size"]:
        millions *= n
    return [f"{millions:.1f} million" if millions < 10 else f"{millions:.0f} million",
            duration(report["seconds"]), f"{report['peak_memory_mb'] / 1000:.1f} GB",
            count(report["mesh"]["tets"]), count(report["surface"]["triangles"]),
            count(cubes["surface"]["triangles"]), version(report)]


def size_row(runs, name):
    report, _ = runs.segment(name)
    mesh, surface = report["mesh"], report["surface"]
    return [" x ".join(map(str, report["input"]["size"])), f"{report['seconds']:.0f}",
            f"{report['peak_memory_mb']:.0f}", count(mesh["tets"]),
            count(surface["triangles_extracted"]), count(surface["triangles"]),
            f"{100 * mesh['edge_unit_fraction']:.1f} %",
            f"{share(mesh['quality_min'])} / {share(mesh['quality_mean'])}", version(report)]


def distance_row(runs, name, place, options):
    reference = runs.reference(place)
    if not reference:
        return None
    report, ours = runs.segment(name, options)
    cubes_report, cubes = runs.cubes(name, report["surface"]["level_native"])
    return [*map(distance, runs.distances(reference, ours)), count(report["surface"]["triangles"]),
            *map(distance, runs.distances(reference, cubes)),
            count(cubes_report["surface"]["triangles"]), version(report)]


def decimation_row(runs, name, options):
    report, surface = runs.extracted(name, options)
    voxel = math.prod(report["input"]["spacing_mm"]) ** (1 / 3)
    few = [runs.decimated(surface, share * voxel) for share in TOLERANCES]
    return [f"{voxel:.3g}", count(report["surface"]["triangles"]),
            *(count(found["surface"]["triangles"]) for found in few), f"{few[1]['seconds']:.0f}",
            version(report)]


def bone_row(runs, name, case):
    from looks_study import Bone, measured  # which needs VTK and nibabel
    bone = Bone(runs.scans, *case)
    found = dict(measured(name, bone, runs.folder))
    scan, among, alone, slicer = (found[kind] for kind in ("with the scan", "all labels in one run", "label alone",
                                                           "3D Slicer"))
    report = json.loads(bone.ours(runs.folder, name).with_suffix(".json").read_text())
    return [*(f"{each['creases']:.3f}" for each in (scan, among, alone, slicer)),
            *(count(each["triangles"]) for each in (scan, alone, slicer)),
            *(str(each["genus"]) for each in (scan, slicer)),
            *(f"{each[what]:.2f}" for what in ("mean", "slope") for each in (scan, alone)), version(report)]


def bone_rows(runs):
    """The bones of the looks study whose scans are there."""
    try:
        from looks_study import GUIDING, JUDGING
    except ImportError as missing:
        note(f"bones of labels: {missing}, the old rows stay")
        return {}
    return {name: bone_row(runs, name, case) for name, case in (GUIDING | JUDGING).items()
            if runs.scans and all((runs.scans / file).exists() for file in case[:2])}


def scan_rows(runs, cases, row):
    """First cell and further cells of each case: `row` takes the scan's name and what the case adds; it returns
    None where something that it needs is missing."""
    rows = {}
    for title, (name, *more) in cases.items():
        cells = row(runs, name, *more) if runs.scan(name) else None
        if cells:
            rows[title] = cells
        else:
            note(f"{title}: no scan or no reference, the old row stays")
    return rows


def named(scans):
    """The cases of scans that have a row of their own name."""
    return {SCANS[name][0]: (name,) for name in scans}


def with_rows(text, name, rows):
    """The page with these rows in one of its tables, and the note under it."""
    begin, end = f"<!-- table:{name} -->\n", f"<!-- /table:{name} -->"
    start = text.index(begin) + len(begin)
    stop = text.index(end, start)
    header, rule, *old = [line for line in text[start:stop].splitlines() if line.startswith("|")]
    lines = [header, rule]
    for line in old:
        title = line.split("|")[1].strip()
        new = [title, *rows.pop(title)] if title in rows else None
        lines.append("| " + " | ".join(new) + " |" if new else line)
        if lines[-1].count("|") != header.count("|"):
            sys.exit(f"tables: {name}: {title}: the row does not fit the header")
    if rows:
        sys.exit(f"tables: {name}: no row is called {', '.join(rows)}")
    return text[:start] + "\n".join([*lines, "", NOTES[name], ""]) + text[stop:]


def with_text(text, name, made):
    """The page with these words in one of its places."""
    begin, end = f"<!-- text:{name} -->", f"<!-- /text:{name} -->"
    start = text.index(begin) + len(begin)
    return text[:start] + made + text[text.index(end, start):]


def rewrite(page, tables):
    text = page.read_text()
    for name, rows in tables.items():
        text = with_rows(text, name, rows)
    page.write_text(text)


def places_of(parser, entries):
    """NAME=PATH entries as a dictionary."""
    places = {}
    for entry in entries:
        name, _, path = entry.partition("=")
        if name not in SCANS or not pathlib.Path(path).exists():
            parser.error(f"--scan: expected NAME=PATH of an existing scan, found {entry}; "
                         f"names: {', '.join(SCANS)}")
        places[name] = pathlib.Path(path)
    return places


RECORD = ROOT / "docs/figures.json"
IMAGES = ROOT / "docs/images"
BYTES = "tests/output_bytes.txt"

# Page and rows of each table.
TABLES = {
    "readme-scans": ("README.md", lambda runs: scan_rows(runs, named(README_SCANS), readme_row)),
    "results-sizes": ("docs/results.md", lambda runs: scan_rows(runs, named(SIZE_SCANS), size_row)),
    "results-distances": ("docs/results.md", lambda runs: scan_rows(runs, DISTANCES, distance_row)),
    "labels-bones": ("docs/labels.md", bone_rows),
    "printing-decimation": ("docs/printing.md", lambda runs: scan_rows(runs, DECIMATED, decimation_row)),
}


def git(*words):
    return subprocess.run(["git", *words], cwd=ROOT, stdout=subprocess.PIPE, text=True, check=True).stdout.strip()


class Record:
    """Which commit of the program made each table and picture."""

    def __init__(self):
        self.commits = json.loads(RECORD.read_text()) if RECORD.exists() else {}

    def note(self, name, commit):
        self.commits[name] = commit
        RECORD.write_text(json.dumps(self.commits, indent=2, sort_keys=True) + "\n")


def commit_of(runs):
    """The commit that the program says it is."""
    report = runs.folder / "program.json"
    made = once(report, "phantom", "sphere", "--size", "8,8,8", "-o", runs.folder / "program.nrrd")
    return made["program"]["commit"]


def make_texts(runs, pages, record):
    """Figures in the prose of pages; None: of all."""
    commit = commit_of(runs)
    for name, (page, scans, words) in TEXTS.items():
        if pages is not None and page not in pages:
            continue
        if not all(runs.scan(scan) for scan in scans):
            note(f"{name}: no scan, the old text stays")
            continue
        path = ROOT / page
        path.write_text(with_text(path.read_text(), name, words(runs)))
        record.note(name, commit)


def make(runs, pages, record):
    """Tables and pictures of pages; None: of all. What the record has of this commit is not made again."""
    commit = commit_of(runs)
    if commit.endswith("-dirty"):
        note(f"the program is of {commit}: no commit has it")
    for name, (page, rows) in TABLES.items():
        if pages is None or page in pages:
            rewrite(ROOT / page, {name: rows(runs)})
            record.note(name, commit)
    for name, (page, scans, draw) in PICTURES.items():
        if pages is not None and page not in pages:
            continue
        if record.commits.get(name) == commit and (IMAGES / name).exists():
            continue
        if not all(runs.scan(scan) for scan in scans):
            note(f"{name}: no scan, the old picture stays")
            continue
        draw(runs, IMAGES / name)
        record.note(name, commit)


def pages_of_project():
    return [ROOT / "README.md", *sorted((ROOT / "docs").glob("*.md"))]


def stale(record):
    """One line for each table, picture or text that is older than the outputs' bytes, or made by no command."""
    changed = git("log", "-1", "--format=%H", "--", BYTES)
    for name in [*TABLES, *PICTURES, *TEXTS]:
        commit = record.commits.get(name, "").removesuffix("-dirty")
        known = commit and subprocess.run(["git", "merge-base", "--is-ancestor", changed or "HEAD", commit], cwd=ROOT,
                                          check=False, stderr=subprocess.DEVNULL).returncode == 0
        if not known:
            yield f"{name}: made by {commit or 'an unknown commit'}, before outputs changed last ({changed[:7]})"
    for page in pages_of_project():
        text = re.sub(r"<!-- table:.*?<!-- /table:", "", page.read_text(), flags=re.S)
        tables = len(re.findall(r"^\|[-| :]+\|$", text, flags=re.M))
        if tables:
            yield f"{page.relative_to(ROOT)}: {tables} tables that no command makes"
    for picture in sorted(IMAGES.iterdir()):
        if picture.name not in PICTURES:
            yield f"docs/images/{picture.name}: made by no command"


def prune():
    shown = "".join(page.read_text() for page in pages_of_project())
    for picture in sorted(IMAGES.iterdir()):
        if picture.name not in PICTURES and f"images/{picture.name}" not in shown:
            note(f"deleted {picture.relative_to(ROOT)}")
            picture.unlink()


def arguments_of(parser):
    parser.add_argument("--scans", type=pathlib.Path, metavar="FOLDER")
    parser.add_argument("--scan", action="append", default=[], metavar="NAME=PATH")
    parser.add_argument("--only", choices=sorted({pathlib.Path(page).stem for page, *_ in
                                                  [*TABLES.values(), *PICTURES.values(), *TEXTS.values()]}))
    parser.add_argument("--all", action="store_true", help="every table and picture")
    parser.add_argument("--texts", action="store_true", help="figures in prose alone")
    parser.add_argument("--stale", action="store_true", help="names what is old or made by no command")
    parser.add_argument("--prune", action="store_true", help="deletes pictures that nothing makes or shows")
    parser.add_argument("--folder", type=pathlib.Path, help="keeps surfaces and reports")
    parser.add_argument("--list", action="store_true", help="names the scans")
    return parser.parse_args()


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    arguments = arguments_of(parser)
    if arguments.list:
        for name, (_, place) in SCANS.items():
            print(f"{name:12}{place}")
        return
    record = Record()
    if arguments.stale:
        print("\n".join(stale(record)))
        return
    if arguments.prune:
        prune()
        return
    if arguments.all and not importlib.util.find_spec("mesamis"):
        parser.error("expected the Python package mesamis, which the tutorial's pictures need, found none; "
                     "build it with scripts/python and set PYTHONPATH=build/release/python")
    places = places_of(parser, arguments.scan)
    if not (arguments.all or arguments.only or arguments.texts or places):
        parser.error("expected --all, --only PAGE, --texts or --scan NAME=PATH, found none of them")
    load = os.getloadavg()[0]
    if load > 0.5:
        note(f"the machine has other work (load {load:.1f}): times will be too long")
    pages = None if not arguments.only else {
        page for page, *_ in [*TABLES.values(), *PICTURES.values(), *TEXTS.values()]
        if pathlib.Path(page).stem == arguments.only}
    with tempfile.TemporaryDirectory() as temporary:
        folder = arguments.folder or (ROOT / "build/tables" if arguments.all else pathlib.Path(temporary))
        folder.mkdir(parents=True, exist_ok=True)
        runs = Runs(folder, arguments.scans, places)
        if not arguments.texts:
            make(runs, pages, record)
        make_texts(runs, pages, record)


if __name__ == "__main__":
    main()
