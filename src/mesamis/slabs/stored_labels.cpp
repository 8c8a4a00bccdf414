// SPDX-License-Identifier: Apache-2.0
#include "mesamis/slabs/stored_labels.h"

#include <array>
#include <cstddef>
#include <filesystem>
#include <string>

#include "mesamis/slabs/mapped_items.h"

namespace mesamis::detail::slabs {
namespace {

constexpr const char* kHeadFile = "labels";

/// A grid without its texts.
struct GridNumbers {
  std::array<Index, 3> size;
  Vec3 spacing, origin;
  Mat3 direction;
};

/// A segment without its name.
struct StoredSegment {
  std::int64_t number_in_file = 0;
  Index label = 0, layer = 0;
  std::array<std::uint8_t, 3> colour{};
};

/// Texts one after the other, and how many bytes each has.
void add_texts(ArchiveWriter& archive, const std::vector<std::string>& texts) {
  std::vector<std::size_t> sizes;
  std::vector<char> all;
  for (const std::string& text : texts) {
    sizes.push_back(text.size());
    all.insert(all.end(), text.begin(), text.end());
  }
  archive.add(sizes);
  archive.add(all);
}

std::vector<std::string> next_texts(ArchiveReader& archive) {
  const auto sizes = archive.next<std::size_t>();
  const auto all = archive.next<char>();
  std::vector<std::string> texts;
  auto at = all.begin();
  for (const std::size_t size : sizes) {
    const auto end = at + static_cast<std::ptrdiff_t>(size);
    texts.emplace_back(at, end);
    at = end;
  }
  return texts;
}

std::filesystem::path layer_file(const Scratch& scratch, Index layer) {
  return scratch.path("labels." + std::to_string(layer));
}

}  // namespace

void store_labels(const Scratch& scratch, const LabelMap& map,
                  const std::vector<std::string>& warnings) {
  for (std::size_t l = 0; l < map.layers.size(); ++l) {
    const auto path = layer_file(scratch, static_cast<Index>(l));
    make_item_file<std::uint16_t>(path, map.voxel_count());
    write_items<std::uint16_t>(path, 0, map.layers[l]);
  }
  std::vector<StoredSegment> segments;
  std::vector<std::string> names;
  for (const Segment& s : map.segments) {
    segments.push_back({s.number_in_file, s.label, s.layer, s.colour});
    names.push_back(s.name);
  }
  ArchiveWriter archive;
  archive.add_one(GridNumbers{map.size, map.spacing, map.origin, map.direction});
  archive.add(segments);
  add_texts(archive, names);
  add_texts(archive, {map.modality, map.frame_of_reference});
  add_texts(archive, warnings);
  scratch.write(kHeadFile, archive);
}

StoredLabels::StoredLabels(const Scratch& scratch) : scratch_(scratch) {
  ArchiveReader archive = scratch.read(kHeadFile);
  const auto grid = archive.next_one<GridNumbers>();
  const auto segments = archive.next<StoredSegment>();
  const std::vector<std::string> names = next_texts(archive), of_grid = next_texts(archive);
  warnings_ = next_texts(archive);
  static_cast<VoxelGrid&>(head_) = {grid.size,      grid.spacing,  grid.origin,
                                    grid.direction, of_grid.at(0), of_grid.at(1)};
  for (std::size_t n = 0; n < segments.size(); ++n) {
    const StoredSegment& s = segments[n];
    head_.segments.push_back({names.at(n), s.label, s.layer, s.colour, s.number_in_file});
  }
}

std::vector<std::uint16_t> StoredLabels::read(Index layer, Index first, Index count) const {
  const auto all = map_items<std::uint16_t>(layer_file(scratch_, layer), head_.voxel_count());
  const auto at = all.values.begin() + static_cast<std::ptrdiff_t>(head_.offset(0, 0, first));
  return {at, at + static_cast<std::ptrdiff_t>(head_.offset(0, 0, count))};
}

}  // namespace mesamis::detail::slabs
