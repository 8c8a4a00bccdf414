# SPDX-License-Identifier: Apache-2.0
"""The scripts of docs/tutorial.md."""
import importlib.util
import os
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

import mesamis

TUTORIAL = Path(__file__).resolve().parents[2] / "examples/tutorial"


def test_slices_hold_the_phantom(tmp_path):
    """The DICOM folder has the values of the phantom in HU, at their places."""
    program = os.environ.get("MESAMIS_PROGRAM")
    if not program:
        pytest.skip("MESAMIS_PROGRAM names no program")
    scan, folder = tmp_path / "scan.nrrd", tmp_path / "dicom"
    subprocess.run([program, "phantom", "femur", "--size", "16,16,24", "--spacing", "4,4,4", "--type", "short",
                    "-o", scan], check=True, capture_output=True)
    subprocess.run([sys.executable, TUTORIAL / "make_dicom.py", scan, folder], check=True)
    grey, slices = mesamis.read_volume(scan), mesamis.read_volume(folder)
    assert np.array_equal(slices.array, 10 * (grey.array - 120))
    assert np.allclose(slices.spacing, grey.spacing) and np.allclose(slices.origin, grey.origin)
    assert slices.modality == "CT"


def thickness_script():
    pytest.importorskip("scipy")
    spec = importlib.util.spec_from_file_location("thickness", TUTORIAL / "thickness.py")
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


def test_thickness_of_a_plate_of_large_triangles_is_that_of_the_plate():
    """Also at its rims, and where no corner of a triangle is near: 8 x 6 x 0.5 mm, a few corners along the edges."""
    x, y = np.linspace(0, 8, 9), np.linspace(0, 6, 7)
    rim = [(a, 0) for a in x[:-1]] + [(8, b) for b in y[:-1]] + [(a, 6) for a in x[:0:-1]] + [(0, b) for b in y[:0:-1]]
    n = len(rim)
    points = np.array([(*p, z) for z in (0, 0.5) for p in rim] + [(4, 3, 0), (4, 3, 0.5)], dtype=float)
    triangles = []
    for i in range(n):
        j = (i + 1) % n
        triangles += [(j, i, 2 * n), (n + i, n + j, 2 * n + 1), (i, j, n + i), (j, n + j, n + i)]
    values = thickness_script().thickness(points, np.array(triangles), count=20_000)
    assert values.max() < 1, "no larger than a ball that touches a rim and the other side"
    assert np.allclose(values[-2:], 0.5, atol=0.02)


def test_thickness_of_a_ball_is_its_diameter():
    """No ball inside is larger; at narrow triangles normals are off, and balls smaller. Those are few."""
    module = thickness_script()
    ball = mesamis.decimate(mesamis.phantom_surface("sphere", size=(24, 24, 24)), tolerance=0.005)
    values = module.thickness(np.array(ball.points), np.array(ball.triangles), count=20_000)
    assert values.max() < 15 * (1 + 1e-3)
    assert np.median(values) > 0.98 * 15 and np.quantile(values, 0.05) > 0.93 * 15
