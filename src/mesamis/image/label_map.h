// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "mesamis/image/volume.h"

/// Label maps: objects of a scan, marked voxel by voxel on a grid of their own.
namespace mesamis {

/// The largest label; 0 is the background.
inline constexpr Index kMaxLabel = 65535;

/// An object of a label map: the voxels of one layer that have one label.
struct Segment {
  std::string name;                      ///< not empty; need not be unique
  Index label = 1;                       ///< 1 to kMaxLabel: the number of the object
  Index layer = 0;                       ///< which of the map's layers
  std::array<std::uint8_t, 3> colour{};  ///< red, green, blue (sRGB)
  /// The object's number in the file if it exceeds kMaxLabel; 0: the number is the label.
  std::int64_t number_in_file = 0;
  friend bool operator==(const Segment&, const Segment&) = default;
};

/// Labels on a regular grid. Objects that overlap lie in different layers. The segments name the
/// labels: one for each label that occurs, and possibly some without voxels.
struct LabelMap : VoxelGrid {
  std::vector<std::vector<std::uint16_t>> layers;  ///< a label per voxel each; i runs fastest
  std::vector<Segment> segments;  ///< at most kMaxLabel, no two of one layer and label
};

/// The probability that a voxel belongs to an object: one layer per object.
struct Probabilities : VoxelGrid {
  std::vector<std::vector<float>> layers;  ///< 0 to 1 per voxel each; i runs fastest
  std::vector<Segment> segments;           ///< segment n belongs to layer n and has the label n + 1
};

/// Finds a segment by its name or number.
///
/// The text is the whole name of a segment, or its label or its number in the file in decimals. If
/// none fits exactly, names are compared without regard to the case of ASCII letters.
/// @return a copy of the only segment that fits.
/// @throws InputError  if none or several match; the message lists the nearest names or the matches.
Segment find_segment(std::span<const Segment> segments, std::string_view name_or_label);

/// Finds segments by name or number, each once, in the order of the texts.
/// @throws InputError  as find_segment().
std::vector<Segment> find_segments(std::span<const Segment> segments,
                                   std::span<const std::string> names_or_labels);

/// Finds the label at a point of the world: that of the nearest voxel centre of the map. On the
/// face between two voxels (to 1e-6 of a voxel) the one of the greater index counts.
/// @param layer  one of the map's.
/// @param world  LPS, mm.
/// @return 0 outside of the map's voxels.
Index label_at(const LabelMap& map, Index layer, const Vec3& world);

/// Brings a label map onto another grid, of any spacing, direction and extent: each voxel gets the
/// labels at the world position of its centre, see label_at().
/// @param grid  such as that of the scan; its voxels outside of the map are background.
/// @return the map on the grid, with all its segments.
///
/// O(voxels of the grid * layers), in threads.
LabelMap labels_on(const LabelMap& map, const VoxelGrid& grid);

/// Marks some segments on another grid, as labels_on() would.
/// @param segments  of the map; together they are the object.
/// @return 1 for each voxel of the grid in one of the segments, else 0; i runs fastest.
///
/// O(voxels of the grid * layers), in threads.
std::vector<std::uint8_t> mask_on(const LabelMap& map, std::span<const Segment> segments,
                                  const VoxelGrid& grid);

/// Brings the probabilities of one object onto another grid, linear between the voxels.
/// @param layer  one of the probabilities'.
/// @return one value, 0 to 1, per voxel of the grid (no unit); 0 beyond the probabilities' voxels.
/// @throws InputError  if the probabilities have fewer than 2 voxels along an axis.
///
/// O(voxels of the grid), in threads.
std::vector<float> probability_on(const Probabilities& from, Index layer, const VoxelGrid& grid);

/// Assigns to each voxel the label of its most probable object, the first of equals; 0 where the
/// background, the rest of the probability, exceeds each of them.
/// @return one layer with the segments of the probabilities.
///
/// O(voxels * objects), in threads.
LabelMap most_probable(const Probabilities& from);

/// Finds the smallest range of the map's voxels that contains a segment; none if it has no voxel.
std::optional<CropRange> range_of(const LabelMap& map, const Segment& segment);

/// Finds the ranges of all segments of the map, in their order, in one pass over the voxels.
///
/// O(voxels * layers).
std::vector<std::optional<CropRange>> ranges_of(const LabelMap& map);

/// Adds a segment for each label that occurs and has none, after the others, by layer and label. It
/// is called "label N" and has the colour default_colour(N).
/// @throws InputError  if there are then more than kMaxLabel segments.
LabelMap with_all_segments(LabelMap map);

/// Whether samples look like labels: whole numbers from 0 (to 0.01), mostly equal where neighbours
/// along i are both foreground; without such neighbours, a single number besides 0.
/// @param samples  of the grid; i runs fastest.
/// @throws nothing
///
/// O(voxels).
bool look_like_labels(const VoxelGrid& grid, std::span<const float> samples);

/// Neighbouring voxels of a label map, at least one of them of an object.
struct LabelPairs {
  std::size_t all = 0;        ///< along all axes, in all layers
  std::size_t different = 0;  ///< of them, whose labels differ
};

/// Counts neighbours: of thick objects few differ, of a sheet of one voxel half, of noise more.
/// @throws nothing
///
/// O(voxels * layers).
LabelPairs count_pairs(const LabelMap& map);

/// Counts the voxels of the segments of the map, in their order.
/// @throws nothing
///
/// O(voxels * layers).
std::vector<std::size_t> voxel_counts(const LabelMap& map);

/// Gives the segments of every layer the names and colours of the rows with their labels, or with
/// their numbers in the file if they have any. Other rows are ignored.
/// @param table  as read_label_table() returns it.
///
/// O(segments + rows), up to a logarithm.
LabelMap with_names(LabelMap map, std::span<const Segment> table);

/// The colour of a label without one: it depends on the label alone, and successive labels differ
/// clearly.
/// @return red, green, blue (sRGB).
std::array<std::uint8_t, 3> default_colour(Index label);

/// Checks what LabelMap promises: as many labels as voxels in each layer, a segment for each label
/// that occurs, at most kMaxLabel segments, their labels and layers in range, no two of one layer
/// and label, no empty name.
/// @throws InputError  naming the first condition that does not hold.
void require_valid(const LabelMap& map);

}  // namespace mesamis
