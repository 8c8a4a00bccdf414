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
