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


def test_no_thickness_exceeds_the_largest_ball_inside():
    """Also not at the rims of a wall beside a ball of 1.2 mm: of 2.5 mm, and 0.015 to 0.15 mm thick."""
    module = thickness_script()
    found = mesamis.segment(mesamis.phantom("wall", spacing=(0.05, 0.05, 0.05), noise=5), preview=True)
    surface = mesamis.decimate(found, tolerance=0.002)
    values = module.thickness(np.array(surface.points), np.array(surface.triangles), count=20_000)
    assert values.max() < 1.2 + 0.05, "but for a voxel"


def test_thickness_of_a_ball_is_its_diameter():
    """No ball inside is larger; at narrow triangles normals are off, and balls smaller. Those are few."""
    module = thickness_script()
    ball = mesamis.decimate(mesamis.phantom_surface("sphere", size=(24, 24, 24)), tolerance=0.005)
    values = module.thickness(np.array(ball.points), np.array(ball.triangles), count=20_000)
    assert values.max() < 15 * (1 + 1e-3)
    assert np.median(values) > 0.98 * 15 and np.quantile(values, 0.05) > 0.93 * 15
