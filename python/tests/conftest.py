# SPDX-License-Identifier: Apache-2.0
"""What tests share: small scans, files of them, the program."""

import os
import subprocess

import numpy as np
import pytest

import mesamis


def rotation(x, y, z):
    """Turned about the axes, degrees; rounded to single precision, as files have it."""
    (a, b, c), (s, t, u) = np.cos(np.radians([x, y, z])), np.sin(np.radians([x, y, z]))
    about_x = np.array([[1, 0, 0], [0, a, -s], [0, s, a]])
    about_y = np.array([[b, 0, t], [0, 1, 0], [-t, 0, b]])
    about_z = np.array([[c, -u, 0], [u, c, 0], [0, 0, 1]])
    return about_z @ about_y @ about_x


def affine(spacing, turn=np.eye(3), origin=(12.5, -30.25, 7.0)):
    matrix = np.eye(4)
    matrix[:3, :3] = turn * np.array(spacing)
    matrix[:3, 3] = origin
    return matrix.astype(np.float32).astype(float)


AFFINES = {
    "plain": affine((1, 1, 1)),
    "anisotropic": affine((0.8, 0.9, 1.6)),
    "mirrored": affine((0.8, 0.9, 1.6), np.diag([-1, 1, 1])),
    "flipped twice": affine((0.8, 0.9, 1.6), np.diag([-1, -1, 1])),
    "permuted": affine((0.8, 0.9, 1.6), np.array([[0, 1, 0], [0, 0, -1], [1, 0, 0]])),
    "oblique": affine((0.8, 0.9, 1.6), rotation(20, -15, 40)),
    "oblique mirrored": affine((0.8, 0.9, 1.6), rotation(10, 35, -25) @ np.diag([1, 1, -1])),
}


def uneven_samples(dtype=np.int16):
    """Axes i, j, k: a lump without any symmetry, with a little noise."""
    i, j, k = np.meshgrid(np.arange(24), np.arange(20), np.arange(16), indexing="ij")
    lump = np.hypot(np.hypot(i - 10, 1.3 * (j - 8)), 1.7 * (k - 7)) - 6
    horn = np.hypot(np.hypot(i - 15, j - 12), k - 9) - 3.5
    inside = 1 / (1 + np.exp(2.5 * np.minimum(lump, horn)))
    noise = np.random.default_rng(3).normal(0, 8, inside.shape)
    return np.round(50 + 900 * inside + noise).astype(dtype)


@pytest.fixture(scope="session")
def samples():
    return uneven_samples()


@pytest.fixture
def nifti(tmp_path, samples):
    """Writes the samples as NIfTI with an affine."""
    nibabel = pytest.importorskip("nibabel")

    def write(matrix, name="scan.nii"):
        image = nibabel.Nifti1Image(samples, matrix)
        nibabel.save(image, tmp_path / name)
        return tmp_path / name

    return write


class FakeSitkImage:
    """Behaves like an image of SimpleITK: GetSize and the like are x, y, z; the array is z, y, x."""

    def __init__(self, array_zyx, spacing, origin, direction):
        self._array = array_zyx
        self._spacing, self._origin = tuple(spacing), tuple(origin)
        self._direction = tuple(np.asarray(direction).ravel())

    def GetSize(self):
        return self._array.shape[::-1]

    def GetSpacing(self):
        return self._spacing

    def GetOrigin(self):
        return self._origin

    def GetDirection(self):
        return self._direction

    def GetArrayViewFromImage(self):
        return self._array


@pytest.fixture
def program(tmp_path):
    """Runs the program and returns what it printed; skips where there is none."""
    path = os.environ.get("MESAMIS_PROGRAM", "")
    if not os.access(path, os.X_OK):
        pytest.skip("MESAMIS_PROGRAM names no program")

    def run(*arguments):
        done = subprocess.run([path, *map(str, arguments), "--quiet"], cwd=tmp_path, capture_output=True,
                              text=True, check=False)
        return done

    return run


@pytest.fixture(scope="session")
def ball():
    return mesamis.phantom("sphere", size=(24, 24, 24), noise=5)


@pytest.fixture(scope="session")
def result(ball):
    """A whole run, with a mesh."""
    return mesamis.segment(ball, max_tets=8000, adaptations=2, tol_mesh=0.2)
