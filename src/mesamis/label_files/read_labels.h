// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "mesamis/files/reading.h"
#include "mesamis/image/label_map.h"

namespace mesamis {

/// A label map and the other contents of its file.
struct LabelFile {
  LabelMap map;  ///< valid, see require_valid(); spacing and origin in mm, LPS
  /// As VolumeFile::format, "Zarr", "OME-Zarr", "HDF5"; of a folder of masks "NIfTI masks" and so
  /// on
  std::string format;
  std::vector<std::string> warnings;  ///< one line each: what was assumed or left out
};

/// How a label map is read.
struct LabelOptions {
  ReadLimits limits{};  ///< memory, and other folders, as for read_volume()
  /// Returns the grid of the scan that the labels belong to, with its frame of reference. Called at
  /// most once, for contours and for pictures, which state no place. May be empty.
  std::function<VoxelGrid()> scan{};
  std::optional<Vec3> spacing{};  ///< mm, positive: replaces the file's, as ReadOptions::spacing
  /// Take sheared grids of NIfTI, NRRD and MetaImage onto orthogonal ones: of labels the nearest,
  /// of probabilities those in between.
  bool resample = false;
};

/// Reads a label map: .nii .nii.gz .nrrd .nhdr .mha .mhd .tif .tiff .inv3, 3D Slicer's .seg.nrrd, a
/// DICOM segmentation, a DICOM structure set of radiotherapy, Zarr and HDF5, or a directory.
///
/// A directory is one of these: a Zarr store; one with one DICOM segmentation or structure set
/// (among other DICOM files); one with masks, an object per file, named after it; one with
/// pictures, which are the slices.
///
/// Labels are whole numbers of 0 (background) to 65535, of any number type. Values within 0.01 of a
/// whole number are rounded, NaN is background, and larger numbers, as those of an atlas, get
/// labels that are free, see Segment::number_in_file: each with a warning. The world frame is LPS
/// and the place of the grid is that of read_volume(). Every label that occurs gets a segment; what
/// a file does not name is called "label N".
///
/// NIfTI: names and colours from the label table of a CaretExtension in the header
/// (TotalSegmentator, Connectome Workbench). NRRD: names, colours, labels and layers from the
/// fields SegmentN_... of 3D Slicer; the values of a list axis, first or last of four, are layers;
/// where a segment has no label, it is 1, and where it has no layer, one layer per segment or the
/// only one.
///
/// Masks: 0, and one other value for the object. Those that overlap lie in different layers, with a
/// warning. OME-Zarr: of an image with labels in it, these. Pictures that have as many voxels as
/// the scan lie on its grid, with a warning.
///
/// DICOM segmentations (SOP classes Segmentation Storage and Label Map Segmentation Storage): the
/// label is the segment number. Binary and fractional ones (at least half of the maximum) get as
/// many layers as overlapping segments need. Frames may be missing where a segment is absent; their
/// positions must fit a regular grid to 2 % of its step, which is the Spacing Between Slices or,
/// where there is none, the least distance of two frames. Single bits must be coded natively or
/// deflated; other pixels also as the scans are.
///
/// @param path     file or directory; the extension decides, DICOM is known by its content.
/// @param options  see there.
/// @throws InputError  one line that begins with the path: what, where, expected, found.
///
/// O(voxels * layers). Memory: 2 bytes per voxel and layer and what one file takes, for DICOM at
/// most 8192 voxels per byte of the file; within the limits.
LabelFile read_label_map(const std::filesystem::path& path, const LabelOptions& options = {});

/// Whether a path holds nothing but labels, whatever its values: a DICOM segmentation or structure
/// set, a directory of such files alone, a .seg.nrrd, or an OME-Zarr image of labels. O(bytes) of
/// the DICOM files up to the first that holds none.
/// @throws InputError  if a DICOM file cannot be read or claims more memory than the limits allow.
bool is_label_file(const std::filesystem::path& path, const ReadLimits& limits = {});

/// Whether a directory holds masks or label maps and no DICOM, which read_label_map() takes as an
/// object per file, or is an OME-Zarr image that has labels in it. O(files).
/// @throws InputError  if the directory cannot be read.
bool is_mask_folder(const std::filesystem::path& path, const ReadLimits& limits = {});

/// Probabilities and the other contents of their files.
struct ProbabilityFile {
  Probabilities probabilities;        ///< spacing and origin in mm, LPS
  std::vector<std::string> warnings;  ///< one line each: what was assumed or left out
};

/// Reads probabilities of one or more objects: one file of four dimensions, or one volume per
/// object.
///
/// The objects of one file are called "label 1", "label 2", ...; NRRD and NIfTI files may name them
/// as read_label_map() says. Where the channels of one file add up to 1 in every voxel (to 0.01) and
/// fewer are named, the first is the background, as in networks with a softmax: it is left out, with
/// a warning. Of one volume each, the names of the files without their extensions
/// are the names. A fractional or binary DICOM segmentation gives its values divided by their
/// maximum.
/// @param paths    one file, or several volumes on one grid (to 1e-3 of a voxel).
/// @param options  as for read_label_map(), limits for all files together; without a scan.
/// @return values of 0 to 1 (no unit); those outside by at most 1e-3, as smoothing leaves, are clamped.
/// @throws InputError  one line that begins with a path, for other values, for grids that differ,
///                     and as read_label_map().
///
/// O(voxels * objects). Memory: 4 bytes per voxel and object, twice for one file.
ProbabilityFile read_probabilities(const std::vector<std::filesystem::path>& paths,
                                   const LabelOptions& options = {});

}  // namespace mesamis
