// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "mesamis/image/volume.h"

namespace mesamis {

struct ReadOptions {
  std::string series;  ///< DICOM: UID of the series to take; empty: the only one there is
};

/// What a volume file holds beside the samples.
struct VolumeFile {
  Volume volume;
  std::string format;  ///< "NIfTI", "NRRD", "MetaImage", "TIFF", "DICOM", "InVesalius"
  std::vector<std::string> warnings;  ///< one line each: what was assumed or left out
};

/// Reads a 3D scan: .nii .nii.gz .nrrd .nhdr .mha .mhd .tif .tiff .inv3, a DICOM directory (and
/// those below it), or one file of a DICOM series (the rest is taken from its directory).
///
/// World frame: LPS, whatever the file's. Where a file states no orientation, a warning says what
/// was assumed. NIfTI: the sform if its code is above 0, else the qform. InVesalius: x to the
/// left, y to the front, z to the head, first voxel at the origin. Axes that are orthogonal to a
/// cosine of 1e-3 are made orthonormal, with a warning above 1e-5; beyond that the file is refused.
///
/// DICOM: slices are grouped by series, size and orientation and sorted along their normal; each
/// is rescaled by its own slope and intercept. Localizers are left out with a warning: frames that
/// call themselves so, and a stack across the main one that is single or at most a quarter of it.
/// Refused are several series (unless one is named or only one is a stack), steps that differ by
/// more than 2 %, missing slices, two slices at one place, tilted stacks, broken files of the
/// series. One slice is no volume: the file cannot say how thick it is.
///
/// What a format with a third axis does hold (one slice, unknown samples, a constant) is read;
/// require_usable() refuses it before any method runs.
///
/// @return samples in native units (rescale slope and intercept applied), finite grid. Samples of
///         more than 24 bits are rounded to float.
/// @throws InputError  one line that begins with the path: what, where, expected, found. Memory
///                     grows with the data that are there, never with what a header claims; at
///                     most the samples and one slice or file of the series are held at once.
VolumeFile read_volume(const std::filesystem::path& path, const ReadOptions& options = {});

/// One 3D image a path offers: what `mesamis info` lists.
struct VolumeInfo {
  std::string series;       ///< DICOM series UID, else empty
  std::string description;  ///< series description or file name
  std::string format, modality;
  std::array<Index, 3> size{0, 0, 0};
  Vec3 spacing;
  std::string problem;  ///< why read_volume would refuse it; empty if it would not
};

/// Lists what is in a file or a directory without decoding the samples: the DICOM series (of a
/// directory and those below it, or of the directory a DICOM file lies in), then the volume files
/// of the directory itself, in name order.
/// @throws InputError  if the path does not exist or holds nothing that can be read.
std::vector<VolumeInfo> list_volumes(const std::filesystem::path& path);

/// SHA-256 of a file, as 64 hex digits; of a directory: of its files and those below, one after
/// another in the order of their paths.
/// @throws InputError  if a file cannot be read.
std::string sha256(const std::filesystem::path& path);

}  // namespace mesamis
