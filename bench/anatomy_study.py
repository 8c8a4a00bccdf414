#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Distances from the truth on degraded real scans, simulated scans, phantoms and thin walls.

    bench/anatomy_study.py FOLDER --data DATA [--groups abcd] [--cases NAME,...] [--half tuning]
                           [--tag TAG] [--options "--gamma 10"] [--restored]

DATA is the tests' data folder; the groups are told in study_cases.py. Half of the cases is set aside:
settings are tuned by the others (--half tuning, the default), and judged once by these (--half judging).
The truth of real scans has one level, and so has our surface (--level auto).
The rivals are common tools that know the truth: isosurfaces of the smoothed scan, of its doubled grid
(cubic splines), and smoothed by a windowed sinc, their settings tuned case by case. `untuned` is the
sinc with usual settings at the level midway. Each surface counts by the sum of its mean distances, truth
to surface and back, in voxels (the geometric mean of the spacing). `at our level` compares with the
isosurface of the best width at the level that `segment` chose. Missed and invented: per cent of the
truth's and the surface's area further than a voxel from the other one, ours / the best rival's.

The error that `segment` expects is compared with the real one on the cases whose truth is exact, as a
whole and by tenths of the surface.

--restored adds a line per case: the isosurface of the image that `segment` works on (bench_restored_image,
beside `mesamis`), of its grid or the doubled one, at our level, decimated by quadrics to our count of
triangles. It tells what the adapted mesh buys.

Scans, truths and the tuned rivals stay in FOLDER; ours too, per TAG. What is there is not made again:
take a new TAG for a new build or other options, and a new FOLDER after a change of the cases. `mesamis`
is the one in build/release, or that of the variable MESAMIS. Needs numpy, scipy and vtk.
"""
import argparse
import json
import pathlib
import resource
import shlex
import subprocess

import numpy as np

import wall_bins
from distances import Judge, read_surface, triangles_of
from mesamis_runs import MESAMIS, RESTORED_IMAGE
from rivals import Tuner, best_of, decimated, label
from study_cases import JUDGING, NOTHING, WALLS, all_cases
from volumes import isosurface, read_nrrd, upsampled

HEAD = ["case", "ours", "best rival", "which", "ratio", "at our level", "untuned", "level, %",
        "missed, %", "invented, %", "triangles", "s", "user s"]


def cached(path, make):
    """What `make` returns, kept as JSON."""
    if not path.exists():
        path.write_text(json.dumps(make()))
    return json.loads(path.read_text())


def segmented(case, tag, options):
    """Runs `segment`: its exit status and message, the level, seconds of the wall and of the user."""
    surface, report = (case.folder / f"{case.name}.{tag}{end}" for end in (".vtp", ".report.json"))
    before = resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime
    level = ["--level", "auto"] if case.group == "a" else []  # the truth has one
    done = subprocess.run([MESAMIS, "segment", case.scan, "-o", surface, "--report", report, "--quiet",
                           "--error", *level, *options], capture_output=True, text=True)
    user = resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime - before
    found = {"status": done.returncode, "user": user, "message": done.stderr.strip()[:200]}
    if done.returncode in (0, 4):
        told = json.loads(report.read_text())
        found |= {"seconds": told["seconds"], "level": told["surface"]["level_native"]}
    return found


def ours(case, arguments):
    """The run of `segment` and its surface, or None."""
    path = case.folder / f"{case.name}.{arguments.tag}.run.json"
    done = cached(path, lambda: segmented(case, arguments.tag, shlex.split(arguments.options)))
    found = done["status"] in (0, 4)
    return done, read_surface(case.folder / f"{case.name}.{arguments.tag}.vtp") if found else None


def measured(case, arguments):
    """Ours and the rivals of one case of a, b or c."""
    def tuner():
        scan = read_nrrd(case.scan)
        return Tuner(scan, case.values, Judge(read_surface(case.truth), scan, case.margin))

    def our_distances():
        tuning = tuner()
        return {"ours": tuning.judge.measure(surface), "level": tuning.at_level(done["level"]),
                "errors": tuning.judge.expected_and_real(surface, "expected_error").tolist()}

    found = cached(case.folder / f"{case.name}.rivals.json", lambda: tuner().all())
    done, surface = ours(case, arguments)
    if surface is None:
        return done, None, found
    return done, cached(case.folder / f"{case.name}.{arguments.tag}.json", our_distances), found


def row(cells):
    print("| " + " | ".join(cells) + " |", flush=True)


def per_cent(ours_share, rivals_share):
    return f"{100 * ours_share:.1f} / {100 * rivals_share:.1f}"


def study(case, arguments):
    """Prints the line of a case; its three ratios, or None."""
    done, mine, rivals = measured(case, arguments)
    name, best = best_of(rivals)
    told = [f"{best['sum']:.3f}", label(name, best)]
    if mine is None:
        row([case.name, f"failed ({done['status']})", *told, done["message"]])
        return None
    us, (outside, inside) = mine["ours"], case.values
    ratios = [us["sum"] / other for other in (best["sum"], mine["level"], rivals["untuned"]["sum"])]
    share = (done["level"] - outside) / (inside - outside)
    row([case.name, f"{us['sum']:.3f}", *told, f"**{ratios[0]:.2f}**", f"{ratios[1]:.2f}",
         f"{ratios[2]:.2f}", f"{100 * share:.0f}", per_cent(us["missed"], best["missed"]),
         per_cent(us["invented"], best["invented"]), str(us.get("triangles", 0)),
         f"{done['seconds']:.0f}", f"{done['user']:.0f}"])
    return ratios


def restored_distances(case, arguments, level, triangles):
    """Of the isosurfaces of our restored image and of its doubled grid, decimated: the nearer one."""
    path = case.folder / f"{case.name}.{arguments.tag}.restored.nrrd"
    if not path.exists():
        subprocess.run([RESTORED_IMAGE, case.scan, path], check=True)
    image = read_nrrd(path)
    judge = Judge(read_surface(case.truth), image, case.margin)
    return min((judge.measure(decimated(isosurface(grid, level), triangles))
                for grid in (image, upsampled(image))), key=lambda found: found["sum"])


def study_restored(case, arguments):
    """Prints what a plain way to the surface makes of the restored image."""
    done, mine, rivals = measured(case, arguments)
    found = cached(case.folder / f"{case.name}.{arguments.tag}.plain.json",
                   lambda: restored_distances(case, arguments, done["level"],
                                              mine["ours"]["triangles"]))
    best = best_of(rivals)[1]
    row([f"{case.name}, restored", f"{found['sum']:.3f}", f"{best['sum']:.3f}", "",
         f"**{found['sum'] / best['sum']:.2f}**", "", "", "",
         per_cent(found["missed"], best["missed"]), per_cent(found["invented"], best["invented"]),
         str(found["triangles"])])
    return mine["ours"]["sum"] / found["sum"]


def study_group(cases, arguments):
    print("\n| " + " | ".join(HEAD) + " |\n|" + "---|" * len(HEAD))
    found, bought = [], []
    for case in cases:
        found.append(study(case, arguments))
        if arguments.restored and found[-1]:
            bought.append(study_restored(case, arguments))
    ratios = np.array([r for r in found if r is not None])
    if len(ratios):
        means = [f"{m:.2f}" for m in np.exp(np.log(ratios).mean(0))]
        row([f"geometric mean of {len(ratios)}, {len(found) - len(ratios)} missing", "", "", "",
             *means])
    if bought:
        print(f"\nours against the isosurface of our restored image: {np.exp(np.log(bought).mean()):.2f}")


def errors(cases, arguments):
    """The error that `segment` expects against the real one, from the surface to the truth, voxels."""
    print("\n| case | real | expected | ratio | tenths within a factor of two |\n|---|---|---|---|---|")
    for case in cases:
        _, mine, _ = measured(case, arguments)
        expected, real = np.array(mine["errors"]) if mine else np.full((2, 10), np.nan)
        if not np.isfinite(expected).all():
            continue
        by_tenth = expected / real
        row([case.name, f"{real.mean():.3f}", f"{expected.mean():.3f}",
             f"{expected.mean() / real.mean():.2f}", str(np.sum((by_tenth > 0.5) & (by_tenth < 2)))])


def walls(cases, arguments):
    """Per bin of the true thickness, voxels: the share found and the mean error of the thickness."""
    bins = [f"{a}-{b}" for a, b in zip(wall_bins.BINS, wall_bins.BINS[1:])]
    print("\n| wall | surface | " + " | ".join(bins) + " |\n|" + "---|" * (len(bins) + 2))
    for case in cases:
        scan, level = read_nrrd(case.scan), np.mean(case.values)
        done, surface = ours(case, arguments)
        us = f"ours ({done['user']:.0f} user s)" if surface else done["message"]
        for what, found in ((us, surface), ("isosurface", isosurface(scan, level)),
                            ("isosurface, doubled", isosurface(upsampled(scan), level))):
            cells = [f"{100 * s:.0f} %" + ("" if e is None else f" {e:+.2f}")
                     for s, e in wall_bins.judged(found)]
            row([case.name, what, *cells])


def nothing(cases, arguments):
    """What is found where there is nothing."""
    print("\n| nothing there | invented, square voxels | remark |\n|---|---|---|")
    for case in cases:
        done, surface = ours(case, arguments)
        area = 0.0
        if surface and surface.GetNumberOfPolys():
            area = wall_bins.invented_area(*triangles_of(surface), case.name.startswith("ball"))
        row([case.name, f"{area:.1f}", f"exit {done['status']} {done['message']}"])


def chosen_cases(arguments):
    cases = all_cases(arguments.folder, arguments.data)
    if arguments.cases:
        return [c for c in cases if c.name in arguments.cases.split(",")]
    return [c for c in cases if c.group in arguments.groups and
            (arguments.half == "both" or (c.name in JUDGING) == (arguments.half == "judging"))]


def parsed():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("folder", type=pathlib.Path, help="where scans, truths and results stay")
    parser.add_argument("--data", type=pathlib.Path, help="the tests' data folder (group a)")
    parser.add_argument("--groups", default="abcd")
    parser.add_argument("--cases", default="", help="by name, of either half")
    parser.add_argument("--half", choices=("tuning", "judging", "both"), default="tuning")
    parser.add_argument("--tag", default="ours", help="results of ours are kept under this name")
    parser.add_argument("--options", default="", help="for segment")
    parser.add_argument("--restored", action="store_true",
                        help="also the isosurface of our restored image")
    parser.add_argument("--list", action="store_true", help="names of the cases, and end")
    return parser.parse_args()


def main():
    arguments = parsed()
    cases = chosen_cases(arguments)
    if arguments.list:
        print("\n".join(f"{c.group} {c.name}" for c in cases))
        return
    arguments.folder.mkdir(parents=True, exist_ok=True)
    for case in cases:
        case.prepare()
    for group in "abc":
        of_group = [c for c in cases if c.group == group]
        if of_group:
            study_group(of_group, arguments)
    exact = [c for c in cases if c.group in "bc"]
    if exact:
        errors(exact, arguments)
    for names, what in ((WALLS, walls), (NOTHING, nothing)):
        of_kind = [c for c in cases if c.name in names]
        if of_kind:
            what(of_kind, arguments)


if __name__ == "__main__":
    main()
