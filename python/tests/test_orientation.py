# SPDX-License-Identifier: Apache-2.0
"""The same scan is the same surface, whatever it is given as."""

import ctypes
import gc
import sys
import types

import numpy as np
import pytest
from conftest import AFFINES, FakeSitkImage

import mesamis

# Runs are kept short: that they have not converged is no matter here.
pytestmark = pytest.mark.filterwarnings("ignore:not converged")


def surface_bytes(result, tmp_path):
    result.save(tmp_path / "s.ply")
    return (tmp_path / "s.ply").read_bytes()


def as_sitk(samples, path):
    """What SimpleITK would read from the file: the grid in LPS, the array z, y, x."""
    grid = mesamis.read_volume(path)
    return FakeSitkImage(samples.T.copy(), grid.spacing, grid.origin, grid.direction)


@pytest.mark.parametrize("name", AFFINES)
def test_all_inputs_give_the_same_bytes(name, nifti, samples, tmp_path):
    import nibabel

    matrix = AFFINES[name]
    path = nifti(matrix)
    image = as_sitk(samples, path)
    inputs = {
        "path": (path, {}),
        "array": (samples, {"affine": matrix}),
        "array in another order of memory": (np.ascontiguousarray(samples), {"affine": matrix}),
        "array, z y x": (samples.T, {"affine": matrix, "order": "zyx"}),
        "nibabel, in memory": (nibabel.Nifti1Image(samples, matrix), {}),
        "nibabel, of the file": (nibabel.load(path), {}),
        "SimpleITK": (image, {}),
        "array with axes": (image.GetArrayViewFromImage(),
                            {"spacing": image.GetSpacing(), "origin": image.GetOrigin(),
                             "direction": np.reshape(image.GetDirection(), (3, 3))}),
        "volume": (mesamis.read_volume(path), {}),
    }
    settings = {"preview": True} if name not in ("oblique mirrored",) else {"max_tets": 6000, "adaptations": 1}
    found = {key: mesamis.segment(scan, **place, **settings) for key, (scan, place) in inputs.items()}
    expected = surface_bytes(found["path"], tmp_path)
    for key, result in found.items():
        assert surface_bytes(result, tmp_path) == expected, key


@pytest.mark.parametrize("name", AFFINES)
def test_points_lie_where_the_affine_says(name, samples):
    """The centre of mass of the bright voxels, brought to the world by nibabel's rule."""
    matrix = AFFINES[name]
    result = mesamis.segment(samples, affine=matrix, preview=True, frame="ras")
    bright = np.argwhere(samples > 500)
    expected = (matrix @ [*bright.mean(axis=0), 1])[:3]
    a, b, c = (result.points[result.triangles[:, n]] for n in range(3))
    volumes = np.einsum("ij,ij->i", a, np.cross(b, c)) / 6
    assert volumes.sum() > 0, "outward"
    centre = (volumes[:, None] * (a + b + c) / 4).sum(axis=0) / volumes.sum()
    assert np.abs(centre - expected).max() < 0.25
    voxel = abs(np.linalg.det(matrix[:3, :3]))
    assert volumes.sum() == pytest.approx(len(bright) * voxel, rel=0.05)


def fake_sitk(monkeypatch):
    """A module as SimpleITK, whose images end with their memory, and whose views do not hold them."""

    class Image(FakeSitkImage):
        GetArrayViewFromImage = None

        def __init__(self, source, *place):
            if not place:  # a copy shares the buffer
                place = (source.GetSpacing(), source.GetOrigin(), source.GetDirection())
                self.buffer, source = source.buffer, source._array
            else:
                self.buffer = [source, 0]
            self.buffer[1] += 1
            super().__init__(source, *place)

        def __del__(self):
            self.buffer[1] -= 1
            if not self.buffer[1]:
                self.buffer[0][:] = np.nan  # what is freed is written over

    def view(image):
        pointer, _ = image._array.__array_interface__["data"]
        memory = (ctypes.c_float * image._array.size).from_address(pointer)
        return np.frombuffer(memory, dtype=np.float32).reshape(image._array.shape)

    module = types.ModuleType("SimpleITK")
    module.Image, module.GetArrayViewFromImage = Image, view
    monkeypatch.setitem(sys.modules, "SimpleITK", module)
    return module


def test_the_scan_keeps_the_image_that_it_lies_in(samples, monkeypatch):
    """A result reads the scan when its mesh is saved, long after the image has gone."""
    from mesamis._volume import scan_of

    sitk = fake_sitk(monkeypatch)
    zyx = np.ascontiguousarray(samples.T, dtype=np.float32)
    image = sitk.Image(zyx, (1, 2, 3), (0, 0, 0), np.eye(3))
    scan, _ = scan_of(image)
    assert np.shares_memory(scan.samples, zyx)
    del image
    gc.collect()
    assert np.array_equal(scan.samples, samples), "it lives as long as the scan"
    array = scan.samples
    del scan
    gc.collect()
    assert np.array_equal(array, samples), "and as an array of it"
    del array
    gc.collect()
    assert np.isnan(zyx).all(), "and no longer"


def test_images_of_simpleitk_and_itk_are_read_in_place(samples, monkeypatch):
    """SimpleITK has a function for the array, ITK images are arrays themselves."""
    from mesamis._volume import scan_of

    zyx = np.ascontiguousarray(samples.T, dtype=np.float32)
    place = ((1, 2, 3), (4, 5, 6), np.diag([1.0, -1, -1]))

    Image = fake_sitk(monkeypatch).Image

    class ItkImage:
        GetSpacing, GetOrigin, GetDirection = (lambda self, n=n: place[n] for n in range(3))

        def __array__(self, dtype=None):
            return zyx

    for image in (Image(zyx, *place), ItkImage(), FakeSitkImage(zyx, *place)):
        scan, order = scan_of(image)
        assert order == "zyx" and np.shares_memory(scan.samples, zyx)
        assert tuple(scan.size) == zyx.shape[::-1] and scan.orientation == "LAI"
        assert (tuple(scan.spacing), tuple(scan.origin)) == place[:2]


def test_ras_is_lps_turned(samples):
    lps = mesamis.segment(samples, affine=AFFINES["oblique"], preview=True)
    ras = mesamis.segment(samples, affine=AFFINES["oblique"], preview=True, frame="ras")
    assert np.array_equal(ras.points, lps.points * [-1, -1, 1])
    assert np.array_equal(ras.triangles, lps.triangles)


def test_scaled_files_are_read_as_nibabel_reads_them(tmp_path, samples):
    """Slope and intercept, and lengths in micrometres."""
    nibabel = pytest.importorskip("nibabel")
    image = nibabel.Nifti1Image(samples, np.diag([700.0, 800.0, 1250.0, 1]))
    image.header.set_slope_inter(0.37, -11.3)
    image.header.set_xyzt_units("micron")
    nibabel.save(image, tmp_path / "scaled.nii.gz")
    path = mesamis.read_volume(tmp_path / "scaled.nii.gz")
    loaded = nibabel.load(tmp_path / "scaled.nii.gz")
    from mesamis._volume import scan_of

    scan, order = scan_of(loaded)
    assert order == "ijk"
    assert tuple(scan.spacing) == path.spacing == pytest.approx((0.7, 0.8, 1.25))
    assert np.array_equal(scan.samples, path.array)


def test_volume_has_the_affine_of_its_file(nifti):
    for matrix in AFFINES.values():
        assert np.allclose(mesamis.read_volume(nifti(matrix)).affine, matrix, atol=1e-5)


def test_labels_follow_the_order_of_the_scan(samples):
    labels = (samples > 500).astype(np.uint8)
    one = mesamis.segment(samples, affine=AFFINES["mirrored"], labels=labels)
    other = mesamis.segment(samples.T, affine=AFFINES["mirrored"], order="zyx", labels=labels.T)
    assert np.array_equal(one.objects[0].points, other.objects[0].points)


@pytest.mark.filterwarnings("ignore:the file's spacing")
def test_labels_alone_give_the_same_bytes_whatever_they_are_given_as(nifti, samples, tmp_path):
    import nibabel

    matrix = AFFINES["plain"]
    labels = (samples > np.median(samples)).astype(np.uint8)
    grid = mesamis.read_volume(nifti(matrix))
    path, finer = tmp_path / "labels.nii", tmp_path / "finer.nii"
    nibabel.save(nibabel.Nifti1Image(labels, matrix), path)
    nibabel.save(nibabel.Nifti1Image(labels, matrix @ np.diag([0.5, 0.5, 0.5, 1])), finer)
    place = {"spacing": grid.spacing, "origin": grid.origin, "direction": grid.direction}
    inputs = {
        "path": (path, {}),
        "path, of another spacing": (finer, {"spacing": grid.spacing}),
        "nibabel": (nibabel.load(path), {}),
        "array": (labels, {"affine": matrix}),
        "array of 64 bits, z y x": (labels.T.astype(np.int64), place),
        "array with axes, i j k": (labels, {**place, "order": "ijk"}),
        "SimpleITK": (FakeSitkImage(labels.T.copy(), grid.spacing, grid.origin, grid.direction), {}),
    }
    found = {key: mesamis.segment(labels=given, **where) for key, (given, where) in inputs.items()}
    expected = surface_bytes(found["path"].objects[0], tmp_path)
    for key, result in found.items():
        assert surface_bytes(result.objects[0], tmp_path) == expected, key


def test_labels_of_an_array_alone_need_a_place(samples):
    labels = (samples > np.median(samples)).astype(np.uint8)
    with pytest.raises(mesamis.InputError, match="expected a scan, affine or spacing beside an array, found none"):
        mesamis.segment(labels=labels)
    with pytest.raises(mesamis.InputError, match="without resample"):
        mesamis.segment(labels=labels, spacing=1, resample=True)
    with pytest.raises(mesamis.InputError, match="expected a scan beside an array of labels, found none"):
        mesamis.segment(labels=labels, spacing=1, mask=labels)


@pytest.mark.parametrize("name, value", [("affine", np.eye(4)), ("spacing", 1), ("origin", (0, 0, 0)),
                                         ("direction", np.eye(3)), ("order", "ijk")])
def test_a_place_beside_what_has_one_is_refused(name, value, samples, nifti):
    import nibabel

    path = nifti(AFFINES["plain"])
    image = FakeSitkImage(samples.T, (1, 2, 3), (4, 5, 6), np.eye(3))
    for scan, kind in [(mesamis.read_volume(path), "a Volume"), (nibabel.load(path), "an image of nibabel"),
                       (image, "an image of ITK"), (path, "a path")]:
        if (kind, name) == ("a path", "spacing"):
            continue  # taken instead of the file's
        with pytest.raises(mesamis.InputError, match=f"expected {kind} without {name}, found both"):
            mesamis.segment(scan, **{name: value}, preview=True)
    with pytest.raises(mesamis.InputError, match=f"expected an image of nibabel without {name}, found both"):
        mesamis.segment(labels=nibabel.load(path), **{name: value})
    if name != "spacing":  # taken instead of the file's
        with pytest.raises(mesamis.InputError, match=f"expected labels of a path without {name}, found both"):
            mesamis.segment(labels=path, **{name: value})


def test_what_is_of_files_or_of_arrays_is_refused_elsewhere(samples, nifti):
    path = nifti(AFFINES["plain"])
    with pytest.raises(mesamis.InputError, match="without modality"):
        mesamis.segment(mesamis.read_volume(path), modality="CT", preview=True)
    for name, value in [("series", "1.2.3"), ("resample", True), ("volume_number", 0), ("channel", 0)]:
        with pytest.raises(mesamis.InputError, match=f"without {name}"):
            mesamis.segment(samples, spacing=1, **{name: value}, preview=True)
