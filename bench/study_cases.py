# SPDX-License-Identifier: Apache-2.0
"""The cases of anatomy_study.py: how the scan and the truth of each come about.

a: real scans, low-passed, thinned and noisy; the truth is the isosurface of the scan as it was
b: shapes known exactly in a simulated scanner
c: the phantoms of mesamis
d: a wall that grows thin, and scans with nothing or a ball alone in them
"""
import dataclasses
import pathlib

import numpy as np

import ct_simulator
import wall_bins
from distances import read_surface, write_surface
from exact_shapes import exact_surface, fine_grid
from mesamis_runs import run
from volumes import (SPECK, cropped, isosurface, noisy, read_nifti, read_nrrd, smoothed,
                     thinned, upsampled, write_nrrd)

# Set aside on 2026-11-28: no setting of mesamis may be chosen by these. Once they have guided
# anything, others take their place.
JUDGING = """
    spine_f2_n8 template_z4_n2 aj_f3_n8 trabecular_z4_n8 cranium_z4_n2 skull_f3_n2
    ct_plates_fine ct_shell_fine ct_wing_thick ct_femur_coarse ct_fracture_coarse
    fracture_b1.5_n8 hemipelvis_b1_n30 femur_inverted_n30 plate_bias_n30 femur_b2_n15
    wall_b1.2_n8 noise_4 ball_n20
""".split()

MARGIN = 2.5  # voxels at the box where what is bright leaves it: nothing is measured there
TRUTH_SPECK = 16 * SPECK  # of the doubled grid: a voxel of a scan thinned by two


@dataclasses.dataclass
class Source:
    """A real scan: file, part, width of the Gaussian for the truth, values around and in the object."""
    file: str
    box: tuple
    width: float
    values: tuple


# Values: what lies beside the edges at full resolution; the level midway is the one that `mesamis baseline`
# chooses there.
SOURCES = {
    "template": Source("mouse_skull/ct_template.nii.gz", ((0, 130), (23, 183), (0, 114)), 0, (2, 31)),
    "aj": Source("mouse_skull/ct_A_J.nii.gz", ((2, 162), (2, 162), (0, 133)), 0.5, (6, 89)),
    "trabecular": Source("trabecular_microct/ct.nrrd", ((0, 140),) * 3, 0.5, (20, 180)),
    "cranium": Source("cranium_inv/ct.nrrd", ((45, 205), (85, 245), (0, 108)), 0.5, (50, 1084)),
    "spine": Source("thoracic_spine_ts/ct.nii.gz", ((20, 100), (10, 90), (40, 120)), 0.7, (53, 497)),
    "skull": Source("skull_phantom/ct_soft_1mm.nrrd", ((5, 165), (40, 200), (50, 112)), 0.5,
                    (-976, 714)),
}
REAL = """template_f2_n2 template_f3_n2 template_z4_n8 aj_f2_n8 aj_f3_n2 aj_z4_n2 trabecular_f2_n2
    trabecular_f3_n8 trabecular_z4_n2 trabecular_f2_n8 cranium_f2_n2 cranium_f2_n8 skull_f2_n2
    skull_f3_n8 spine_f2_n2 template_f2_n8 aj_f2_n2 trabecular_f3_n2 cranium_f3_n8 skull_f2_n8
    spine_f2_n8 template_z4_n2 aj_f3_n8 trabecular_z4_n8 cranium_z4_n2 skull_f3_n2""".split()
FACTORS = {"f1": (1, 1, 1), "f2": (2, 2, 2), "f3": (3, 3, 3), "z4": (1, 1, 4)}

SCANNERS = {"soft": ct_simulator.Scanner("soft", 9, 0.8, 1.0),
            "sharp": ct_simulator.Scanner("sharp", 80, 0.7, 1.0),
            "fine": ct_simulator.Scanner("soft", 30, 0.6, 1.5),
            "thick": ct_simulator.Scanner("soft", 9, 0.9, 2.5),
            "coarse": ct_simulator.Scanner("soft", 15, 1.2, 2.0)}
SIMULATED = """ct_femur_soft ct_femur_sharp ct_femur_thick ct_fracture_soft ct_fracture_sharp
    ct_fracture_thick ct_plates_soft ct_plates_sharp ct_shell_soft ct_shell_sharp ct_wing_soft
    ct_wing_sharp ct_femur_fine ct_fracture_fine ct_plates_thick ct_shell_thick ct_wing_fine
    ct_plates_fine ct_shell_fine ct_wing_thick ct_femur_coarse ct_fracture_coarse""".split()

SIZES = {"hemipelvis": "82,98,122"}
THICK_SIZES = dict.fromkeys(("fracture", "femur", "plate"), "64,64,26")
PHANTOM_VALUES = 120, 230
PHANTOMS = """fracture_b0.5_n4 fracture_b1_n30 fracture_b2_n15 fracture_inverted_n15 fracture_bias_n15
    fracture_thick_n15 hemipelvis_b0.5_n60 hemipelvis_b1_n15 hemipelvis_inverted_n15 femur_b2_n4
    femur_b1_n30 femur_bias_n15 plate_b1_n15 plate_thick_n15 femur_b0.5_n15
    femur_thick_n30 plate_b0.5_n15 hemipelvis_b2_n15 fracture_inverted_n60
    fracture_b1.5_n8 hemipelvis_b1_n30 femur_inverted_n30 plate_bias_n30 femur_b2_n15""".split()

WALLS = ["wall_b0.6_n4", "wall_b0.6_n15", "wall_b1_n4", "wall_b1_n15", "wall_b0.8_n8", "wall_b1.2_n8"]
NOTHING = ["noise_1", "noise_2", "noise_3", "noise_4", "ball_n20", "ball_n30", "ball_n60",
           "ball_n45"]

GROUPS = {"a": REAL, "b": SIMULATED, "c": PHANTOMS, "d": WALLS + NOTHING}


@dataclasses.dataclass
class Case:
    name: str
    group: str
    folder: pathlib.Path  # of the cache
    data: pathlib.Path | None  # of the tests' scans

    @property
    def scan(self):
        return self.folder / f"{self.name}.nrrd"

    @property
    def truth(self):
        return self.folder / f"{self.name}.truth.vtp"

    @property
    def margin(self):
        return MARGIN if self.group == "a" or "inverted" in self.name else 0

    @property
    def values(self):
        """Around the object and in it."""
        if self.group == "a":
            return SOURCES[self.name.split("_")[0]].values
        if self.group == "b":
            return ct_simulator.SOFT, ct_simulator.BONE
        return PHANTOM_VALUES[::-1] if "inverted" in self.name else PHANTOM_VALUES

    def prepare(self):
        """Writes scan and truth if they are not there."""
        if not self.scan.exists():  # it is written last
            {"a": make_real, "b": make_simulated, "c": make_phantom, "d": make_wall}[self.group](self)


def noise_of(name):
    return float(name.rsplit("_n", 1)[1])


def source_volume(case, source):
    if case.data is None:
        raise SystemExit(f"{case.name}: needs --data, the tests' data folder")
    path = case.data / source.file
    whole = read_nifti(path) if path.suffix == ".gz" else read_nrrd(path)
    return cropped(whole, source.box)


def make_real(case):
    source, way = SOURCES[case.name.split("_")[0]], case.name.split("_")[1]
    full = source_volume(case, source)
    truth = isosurface(upsampled(smoothed(full, source.width)), np.mean(source.values), TRUTH_SPECK)
    write_surface(case.truth, truth)
    contrast = source.values[1] - source.values[0]
    scan = thinned(full, np.array(FACTORS[way]))
    write_nrrd(case.scan, noisy(scan, noise_of(case.name) / 100 * contrast))


def make_simulated(case):
    _, shape, scanner = case.name.split("_")
    depth, grey = fine_grid(shape)
    write_surface(case.truth, exact_surface(shape, depth))
    write_nrrd(case.scan, ct_simulator.scan(grey, SCANNERS[scanner]))


def bias(volume):
    """Grey values from 10 % less to 10 % more across the box."""
    lines = [np.sin(np.linspace(-0.5, 0.5, n) * np.pi) for n in volume.values.shape]
    field = sum(np.meshgrid(*lines, indexing="ij")) / 3
    return dataclasses.replace(volume, values=volume.values * (1 + 0.1 * field))


def make_phantom(case):
    design, kind, _ = case.name.split("_")
    blur = kind[1:] if kind[1:].replace(".", "").isdigit() else "1"
    grid = ["--size", SIZES[design]] if design in SIZES else []
    if kind == "thick":
        grid = ["--size", THICK_SIZES[design], "--spacing", "1,1,2.5"]
    raw, truth = (case.folder / f"{case.name}.raw{end}" for end in (".nrrd", ".ply"))
    run("phantom", design, "-o", raw, "--truth", truth, "--blur", blur, "--noise",
        noise_of(case.name), *grid)
    write_surface(case.truth, read_surface(truth))
    scan = read_nrrd(raw)
    if kind == "inverted":
        scan = dataclasses.replace(scan, values=sum(PHANTOM_VALUES) - scan.values)
    write_nrrd(case.scan, bias(scan) if kind == "bias" else scan)
    raw.unlink()
    truth.unlink()


def make_wall(case):
    kind, *settings = case.name.split("_")
    if kind == "noise":
        scan = wall_bins.noise_alone(15, int(settings[0]))
    elif kind == "ball":
        scan = wall_bins.scan(wall_bins.ball, 1, noise_of(case.name), 1)
    else:
        scan = wall_bins.scan(wall_bins.wall_and_ball, float(settings[0][1:]), noise_of(case.name), 1)
    write_nrrd(case.scan, scan)


def all_cases(folder, data):
    return [Case(name, group, folder, data) for group, names in GROUPS.items() for name in names]
