#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Bodies of `mesamis segment --body` in a solver: CalculiX against closed forms and voxel models.

    bench/fe_study.py sphere                      a hollow ball under inner pressure, from its scan: energy and stress
    bench/fe_study.py column                      cylinders of graded density in compression, from their scans
    bench/fe_study.py trabecular --scan FILE      cubes of a micro-CT beside one element per voxel
    bench/fe_study.py trabecular --scan FILE --judging    other cubes of it, set aside
    bench/fe_study.py time                        the hollow ball: the time of the body beside that of the segmentation

--folder keeps what was made and does not repeat a run whose results are there. Needs numpy, scipy, vtk and ccx.
`mesamis` is the one in build/release, or that of the variable MESAMIS. Forces in N, lengths in mm, moduli in MPa.
"""
import argparse
import json
import pathlib
import tempfile

import numpy as np
from scipy import ndimage

import calculix
import fe_voxels
from mesamis_runs import once
from volumes import Volume, cropped, read_nrrd, write_nrrd

BLUR = 0.7  # voxels: the standard deviation of a scanner's blur
MODULUS, POISSON, PRESSURE = 1000.0, 0.3, 1.0


def table(head, lines):
    cells = [head, *[[c if isinstance(c, str) else f"{c:.4g}" for c in line] for line in lines]]
    widths = [max(len(row[i]) for row in cells) for i in range(len(head))]
    for row in cells:
        print("  ".join(cell.rjust(width) for cell, width in zip(row, widths)), flush=True)


# Scans

def scan_of(distance, side, spacing, value=lambda p: 1000.0, blur=BLUR, parts=4):
    """A CT of what a distance function holds: blur, partial volumes, whole HU. Nothing around it is 0 HU.

    The blur comes before the voxels, as in a scanner: voxels that are blurred make the surface waver along their
    planes, by 0.028 instead of 0.008 voxel (rms) at a blur of 0.7. A part of a voxel counts by how far the surface
    has come into it: parts that are in or out alone put steps of an eighth of a voxel on a surface.
    """
    p = np.meshgrid(*[spacing * ((np.arange(n * parts) + 0.5) / parts - 0.5) for n in side], indexing="ij", sparse=True)
    fine = (np.clip(0.5 - distance(*p) * parts / spacing, 0, 1) * value(p)).astype(np.float32)
    fine = ndimage.gaussian_filter(fine, blur * parts, mode="nearest")
    image = fine.reshape([k for n in side for k in (n, parts)]).mean(axis=(1, 3, 5))
    return Volume(np.rint(image).astype(np.int16), np.full(3, float(spacing)), np.zeros(3))


def body(folder, name, scan, options):
    """The report and the body of a scan; made once."""
    name = name.replace(".", "_")  # a point begins the extension
    mesh = folder / f"{name}.inp"
    report = once(folder / f"{name}.json", "--quiet", "segment", scan, "--body", mesh, *options)
    return report, mesh


def solved_once(mesh, lines):
    job = mesh.with_name(mesh.stem + "_job")
    return job if job.with_suffix(".done").exists() else finished(calculix.solve(mesh, lines))


def finished(job):
    job.with_suffix(".done").touch()
    return job


# A hollow ball under inner pressure

INNER, OUTER, CENTRE, BALL_VOXEL, BALL_SIDE = 10.0, 20.0, 24.9, 0.5, 100


def ball_scan(folder):
    path = folder / "ball.nrrd"
    if not path.exists():
        def distance(x, y, z):
            r = np.sqrt((x - CENTRE)**2 + (y - CENTRE)**2 + (z - CENTRE)**2)
            return np.maximum(r - OUTER, INNER - r)
        write_nrrd(path, scan_of(distance, (BALL_SIDE,) * 3, BALL_VOXEL))
    return path


def lame(inner, outer):
    """The energy, N mm, and the greatest hoop stress, MPa, which is at the cavity."""
    a3, b3 = inner**3, outer**3
    shift = PRESSURE * inner * a3 / (MODULUS * (b3 - a3)) * ((1 - 2 * POISSON) + (1 + POISSON) * b3 / (2 * a3))
    return 2 * np.pi * inner**2 * PRESSURE * shift, PRESSURE * a3 / (b3 - a3) * (1 + b3 / (2 * a3))


def ball_job(mesh):
    """Three nodes are held, as far as a rigid body moves: the load is in balance by itself."""
    ends = [mesh.nearest([CENTRE + x, CENTRE + y, CENTRE])
            for x, y in ((-OUTER, 0), (OUTER, 0), (0, OUTER))]
    return [*calculix.material(MODULUS, POISSON), "*BOUNDARY", f"{ends[0]},1,3", f"{ends[1]},2,3",
            f"{ends[2]},3,3", "*STEP", "*STATIC", "*DSLOAD", f"CAVITY, P, {PRESSURE}",
            "*EL PRINT, ELSET=ALL, TOTALS=ONLY", "ELSE", "*EL FILE", "S", "*END STEP"]


def hoop_stresses(job, mesh):
    """At the nodes of the cavity: half of the trace of the stress across the radius."""
    stress = calculix.nodal(job, "STRESS", 6)
    nodes = mesh.sets["CAVITY"]
    out = mesh.points[nodes] - CENTRE
    out /= np.linalg.norm(out, axis=1)[:, None]
    xx, yy, zz, xy, yz, zx = np.array([stress[n + 1] for n in nodes]).T
    radial = (xx * out[:, 0]**2 + yy * out[:, 1]**2 + zz * out[:, 2]**2 + 2 * xy * out[:, 0] * out[:, 1]
              + 2 * yz * out[:, 1] * out[:, 2] + 2 * zx * out[:, 2] * out[:, 0])
    return (xx + yy + zz - radial) / 2


def mean_radius(mesh, name):
    """Of the corners of elements in a set."""
    corners = np.intersect1d(mesh.sets[name], mesh.elements[:, :4])
    return np.linalg.norm(mesh.points[corners] - CENTRE, axis=1).mean()


def ball_row(folder, element, size):
    """The skin's tolerance follows the size: the middle of a triangle of this size lies so far off."""
    skin = size**2 / (6 * INNER)
    _, path = body(folder, f"ball_{element}_{size:g}", ball_scan(folder),
                   ["--tolerance", 0, "--element", element, "--element-size", size, "--skin-tolerance", skin,
                    "--set", "CAVITY=inner", "--set", "OUTSIDE=outer"])
    mesh = calculix.Mesh(path)
    job = solved_once(path, ball_job(mesh))
    energy, hoop = lame(INNER, OUTER)
    found = calculix.rows(job, "total internal energy")[0][0]
    radii = mean_radius(mesh, "CAVITY"), mean_radius(mesh, "OUTSIDE")
    stresses = hoop_stresses(job, mesh) / hoop - 1
    return [element, size, str(len(mesh.elements)), str(3 * len(mesh.points)), found / energy - 1,
            found / lame(*radii)[0] - 1, *(r - true for r, true in zip(radii, (INNER, OUTER))),
            stresses.mean(), np.percentile(abs(stresses), 95), stresses.max()]


def order(before, line):
    """Of the error against a ball with the radii of the skin, by the cube root of the elements' volume."""
    if before is None or before[0] != line[0]:
        return ""
    return 3 * np.log(abs(before[5] / line[5])) / np.log(int(line[2]) / int(before[2]))


def sphere(folder, _):
    lines = [ball_row(folder, "tet4", h) for h in (5, 3.5, 2.5, 1.75)]
    lines += [ball_row(folder, "tet10", h) for h in (9, 7, 5, 3.5)]
    orders = [order(before, line) for before, line in zip([None, *lines], lines)]
    table(["element", "size", "elements", "unknowns", "energy - 1", "of the skin's ball", "order",
           "inner - 10", "outer - 20", "hoop mean - 1", "95 % within", "greatest - 1"],
          [[*line[:6], order, *line[6:]] for line, order in zip(lines, orders)])


# Cylinders of graded density in compression

RADIUS, LENGTH, VOXEL = 12.0, 20.0, 0.5
LOW, HIGH = 800.0, 1200.0  # HU; as densities 0.8 and 1.2 g/cm^3
COEFFICIENT = 2000.0  # E = 2000 rho


def column_scan(folder, along, blur):
    """The column leaves the scan at both ends."""
    path = folder / f"column_{'z' if along else 'x'}_{10 * blur:.0f}.nrrd"
    centre = RADIUS + 4
    side = [int(2 * centre / VOXEL) + 1] * 2 + [int(LENGTH / VOXEL) + 1]
    if not path.exists():
        def value(p):
            share = p[2] / LENGTH if along else (p[0] - centre + RADIUS) / (2 * RADIUS)
            return LOW + (HIGH - LOW) * share
        write_nrrd(path, scan_of(lambda x, y, z: np.hypot(x - centre, y - centre) - RADIUS + 0 * z, side,
                                 VOXEL, value, blur))
    return path


def column_stiffness(along):
    """Force over shortening, N/mm: slices in a row, or chords side by side."""
    share = (np.arange(100000) + 0.5) / 100000
    modulus = COEFFICIENT * (LOW + (HIGH - LOW) * share) / 1000
    if along:
        return np.pi * RADIUS**2 / (LENGTH * np.mean(1 / modulus))
    x = RADIUS * (2 * share - 1)
    return np.mean(modulus * 2 * np.sqrt(RADIUS**2 - x**2)) * 2 * RADIUS / LENGTH


def column_row(folder, along, blur, rim, element="tet4", size=2.5):
    """Slices in a row have different stresses across unless the Poisson ratio is 0."""
    scan = column_scan(folder, along, blur)
    _, path = body(folder, f"{scan.stem}_{element}_{size:g}_{'rim' if rim else 'plain'}", scan,
                   ["--element", element, "--element-size", size, "--least-size", size / 2,
                    "--skin-tolerance", 0.1, "--level", (LOW + HIGH) / 4,
                    "--set", "TOP=top:z,0.1mm", "--set", "BOTTOM=bottom:z,0.1mm",
                    "--material", f"E={COEFFICIENT:g}*rho_qct^1", "--calibration=0,0.001",
                    "--material-gap", 10, "--poisson", 0 if along else POISSON,
                    *([] if rim else ["--material-rim", 0])])
    mesh = calculix.Mesh(path)
    middle = mesh.points[mesh.sets["BOTTOM"]].mean(axis=0)
    a, b = (mesh.nearest(middle + [d, 0, 0]) for d in (-RADIUS, RADIUS))
    job = solved_once(path, calculix.compression(0.1, [f"{a},1,2", f"{b},2,2"], glued=False))
    found, truth = abs(calculix.total_force(job)[2]) / 0.1, column_stiffness(along)
    return ["along" if along else "across", blur, "filled" if rim else "as scanned", str(len(mesh.elements)),
            mesh.volume() / (np.pi * RADIUS**2 * LENGTH) - 1, found, truth, found / truth - 1]


def column(folder, _):
    table(["graded", "blur, voxels", "rim", "elements", "volume - 1", "N/mm", "closed form", "ratio - 1"],
          [column_row(folder, along, blur, rim) for along in (True, False) for blur in (0.0, BLUR)
           for rim in (True, False)])


# Trabecular bone

GUIDING = ((0, 0, 0), (40, 40, 40))
JUDGING = ((80, 80, 80), (0, 80, 40))
SIDE = 50  # voxels
TISSUE = 10000.0


def modulus_of(job, extent):
    """Apparent: force over area and strain; the shortening was a thousandth."""
    return abs(calculix.total_force(job)[2]) / (extent[0] * extent[1] * 1e-3)


def cube_step(extent):
    return [*calculix.material(TISSUE, POISSON), *calculix.compression(1e-3 * extent[2], [], glued=True)]


def voxel_row(folder, name, volume, level):
    inside = fe_voxels.spanning(volume.values >= level)
    extent = volume.spacing * (np.array(volume.values.shape) - 1)
    path = folder / f"{name}_voxels.inp"
    nodes = fe_voxels.write_voxel_model(path, inside, volume.spacing)
    return modulus_of(solved_once(path, cube_step(extent)), extent), 3 * nodes, inside.mean()


def cube_body(folder, name, path, voxel, size):
    """All elements of one size: --least-size keeps curvature and thin walls from asking for smaller ones."""
    return body(folder, f"{name}_{size:g}", path,
                ["--element", "tet10", "--element-size", size * voxel, "--least-size", size * voxel,
                 "--skin-tolerance", size**2 / (6 * 8) * voxel, "--wall-elements", 0,
                 "--set", "TOP=top:z,0.001mm", "--set", "BOTTOM=bottom:z,0.001mm"])


def cube_rows(folder, scan, corner, sizes):
    """Bodies, and the voxel model at the level that mesamis chose for them."""
    name = "cube_" + "_".join(map(str, corner))
    volume = cropped(scan, [(c, c + SIDE) for c in corner])
    path = folder / f"{name}.nrrd"
    write_nrrd(path, volume)
    bodies = [cube_body(folder, name, path, volume.voxel, size) for size in sizes]
    level = bodies[0][0]["surface"]["level_native"]
    of_voxels, voxel_unknowns, share = voxel_row(folder, name, volume, level)
    lines = [[name, "voxels", "", str(voxel_unknowns), "", of_voxels, "", share]]
    extent = volume.spacing * (np.array(volume.values.shape) - 1)
    for size, (_, mesh_file) in zip(sizes, bodies):
        found = modulus_of(solved_once(mesh_file, cube_step(extent)), extent)
        mesh = calculix.Mesh(mesh_file)
        unknowns = 3 * len(mesh.points)
        lines.append([name, "tet10", size, str(unknowns), unknowns / voxel_unknowns, found,
                      found / of_voxels - 1, mesh.volume() / np.prod(extent)])
    return lines


def trabecular(folder, arguments):
    if arguments.scan is None:
        raise SystemExit("fe_study: expected --scan FILE.nrrd, found none")
    scan = read_nrrd(arguments.scan)
    lines = []
    for corner in JUDGING if arguments.judging else GUIDING:
        lines += cube_rows(folder, scan, corner, (6, 5, 4, 3))
    table(["cube", "model", "size, voxels", "unknowns", "of the voxels'", "modulus", "ratio - 1", "bone"], lines)


# Time

def time(folder, _):
    """The hollow ball, with about as many elements as cells of the method."""
    report, _ = body(folder, "timed", ball_scan(folder),
                     ["--max-tets", 110000, "--element-size", 1.85, "--skin-tolerance", 0.057])
    cells, elements = report["mesh"]["tets"], report["body"]["elements"]
    segmented, filled = report["seconds_parts"]["method"], report["body"]["seconds"]
    table(["cells", "seconds of segmentation", "elements", "seconds of the body", "ratio at equal count"],
          [[str(cells), segmented, str(elements), filled, filled / elements / (segmented / cells)]])


STUDIES = {"sphere": sphere, "column": column, "trabecular": trabecular, "time": time}


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("study", choices=STUDIES)
    parser.add_argument("--scan", type=pathlib.Path)
    parser.add_argument("--judging", action="store_true")
    parser.add_argument("--folder", type=pathlib.Path)
    arguments = parser.parse_args()
    with tempfile.TemporaryDirectory() as temporary:
        folder = arguments.folder or pathlib.Path(temporary)
        folder.mkdir(parents=True, exist_ok=True)
        STUDIES[arguments.study](folder, arguments)


if __name__ == "__main__":
    main()
