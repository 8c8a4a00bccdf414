# SPDX-License-Identifier: Apache-2.0
"""What of a file is read, and what the user says of it."""

import numpy as np
import pytest

import mesamis


def test_one_of_several_volumes_is_read(tmp_path):
    nibabel = pytest.importorskip("nibabel")
    data = np.arange(4 * 3 * 5 * 2, dtype=np.int16).reshape(4, 3, 5, 2)
    nibabel.save(nibabel.Nifti1Image(data, np.eye(4)), tmp_path / "a.nii.gz")
    for number in (0, 1):
        volume = mesamis.read_volume(tmp_path / "a.nii.gz", volume_number=number)
        assert np.array_equal(volume.array, data[..., number])
    with pytest.raises(mesamis.InputError, match="2 volumes"):
        mesamis.read_volume(tmp_path / "a.nii.gz")


def test_a_modality_of_the_user_counts(tmp_path):
    nibabel = pytest.importorskip("nibabel")
    nibabel.save(nibabel.Nifti1Image(np.zeros((3, 4, 5), np.int16), np.eye(4)), tmp_path / "a.nii")
    assert mesamis.read_volume(tmp_path / "a.nii").modality == ""
    assert mesamis.read_volume(tmp_path / "a.nii", modality="CT").modality == "CT"
    with pytest.raises(mesamis.InputError, match="CT, MR or other"):
        mesamis.read_volume(tmp_path / "a.nii", modality="PET")


def test_padding_is_a_word_or_a_number():
    with pytest.raises(mesamis.InputError, match="auto, none or a number"):
        mesamis.segment(np.zeros((5, 5, 5)), spacing=1, padding="some")


@pytest.mark.parametrize("level", ["4", "5"])
@pytest.mark.parametrize("variable", ["mat", "M"])
def test_a_matrix_of_spm_places_an_image_as_nibabel_has_it(tmp_path, level, variable):
    nibabel = pytest.importorskip("nibabel")
    scipy_io = pytest.importorskip("scipy.io")
    data = np.arange(4 * 3 * 5, dtype=np.int16).reshape(4, 3, 5)
    image = nibabel.Spm99AnalyzeImage(data, None)
    image.header.set_zooms((2, 3, 4))
    nibabel.save(image, tmp_path / "a.img")
    turned = np.array([[0, -3, 0, 10], [2, 0, 0, 20], [0, 0, 4, 30], [0, 0, 0, 1.0]])
    scipy_io.savemat(tmp_path / "a.mat", {"other": np.arange(7.0), variable: turned}, format=level)
    expected = np.diag([-1, -1, 1, 1]) @ nibabel.Spm99AnalyzeImage.load(tmp_path / "a.img").affine
    volume = mesamis.read_volume(tmp_path / "a.img")
    assert np.array_equal(volume.array, data)
    found = np.eye(4)
    found[:3, :3] = np.asarray(volume.direction) * volume.spacing
    found[:3, 3] = volume.origin
    assert np.allclose(found, expected)
