// SPDX-License-Identifier: Apache-2.0
#include "mesamis/label_files/mask_folder.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>

#include "mesamis/base/each_once.h"
#include "mesamis/base/error.h"
#include "mesamis/files/file_list.h"
#include "mesamis/files/refuse.h"
#include "mesamis/label_files/layer_stack.h"
#include "mesamis/label_files/voxel_lattice.h"
#include "mesamis/volume_files/formats.h"

namespace mesamis::detail::label_files {
namespace {

namespace fs = std::filesystem;

/// The largest distance of corresponding corners of two grids of one size, in voxels.
double shift_between(const VoxelGrid& a, const VoxelGrid& b) {
  double shift = 0;
  for (int corner = 0; corner < 8; ++corner) {
    Vec3 pa, pb;
    for (int axis = 0; axis < 3; ++axis) {
      const double steps = (corner >> axis & 1) ? a.size[static_cast<std::size_t>(axis)] - 1 : 0;
      pa[axis] = steps * a.spacing[axis];
      pb[axis] = steps * b.spacing[axis];
    }
    shift = std::max(shift, norm(a.to_world(pa) - b.to_world(pb)));
  }
  return shift / a.shortest_side();
}

bool is_page_stack(const fs::path& file, MemoryBudget& budget) {
  const std::string extension = lower_extension(file);
  if (extension != ".tif" && extension != ".tiff") return false;
  const ScopedFile scope(budget, file);
  try {
    return open_picture(file, Opening{budget}).grid.size[2] > 1;
  } catch (const InputError&) {
    return false;  // what cannot be read is no mask
  }
}

/// The one label of a mask; 0 for an empty one.
std::uint16_t label_of(const fs::path& file, const LabelFile& mask) {
  if (mask.map.layers.size() > 1) {
    refuse(file,
           message("expected one object in each file of a folder, found ", mask.map.layers.size(),
                   " layers; name the file itself if it holds all objects"));
  }
  std::uint16_t only = 0;
  for (const std::uint16_t label : mask.map.layers[0]) {
    if (label == 0 || label == only) continue;
    if (only != 0) {
      refuse(file, message("expected one object in each file of a folder, found the labels ", only,
                           " and ", label, "; name the file itself if it holds all objects"));
    }
    only = label;
  }
  return only;
}

void add_new(std::vector<std::string>& all, const std::vector<std::string>& more) {
  for (const std::string& one : more) {
    add_once(all, one);
  }
}

std::string empty_note(const std::vector<std::string>& names) {
  constexpr std::size_t kMostNamed = 5;
  std::string text =
      message(names.size(), names.size() == 1 ? " mask is" : " masks are", " empty: ");
  for (std::size_t n = 0; n < std::min(names.size(), kMostNamed); ++n) {
    text += (n > 0 ? ", " : "") + shown(names[n]);
  }
  return text + (names.size() > kMostNamed ? ", ..." : "");
}

/// The masks of a folder while they become one map.
class MaskCollector {
 public:
  /// @param grid  on which they are put together; none: all have that of the first.
  MaskCollector(const fs::path& first, const std::optional<VoxelGrid>& grid, MemoryBudget& budget)
      : first_(first), has_grid_(grid.has_value()), stack_(out_.map, budget) {
    if (grid) static_cast<VoxelGrid&>(out_.map) = *grid;
  }

  void add(const fs::path& file, LabelFile mask) {
    const auto number = static_cast<Index>(out_.map.segments.size() + 1);
    if (number == 1) {
      if (!has_grid_) static_cast<VoxelGrid&>(out_.map) = mask.map;
      out_.format = mask.format + " masks";
    }
    const LatticePlace place = place_of(file, mask.map);
    const std::uint16_t label = label_of(file, mask);
    Segment segment{object_name(file), number, 0, default_colour(number)};
    if (label == 0) {
      empty_.push_back(segment.name);
    } else {
      const auto& labels = mask.map.layers[0];
      stack_.add(segment, [&](const auto& visit) {
        for (std::size_t n = 0; n < labels.size(); ++n) {
          if (labels[n] == label) visit(offset_of(place.at(mask.map.voxel(n))));
        }
      });
    }
    out_.map.segments.push_back(std::move(segment));
    add_new(out_.warnings, mask.warnings);
  }

  LabelFile finish() {
    if (out_.map.layers.empty()) stack_.add_layer();
    if (has_grid_) {
      const auto& n = out_.map.size;
      out_.warnings.push_back(message("the masks have different grids: put together on ", n[0],
                                      " x ", n[1], " x ", n[2],
                                      " voxels by the places they state"));
    }
    if (!empty_.empty()) out_.warnings.push_back(empty_note(empty_));
    if (const std::string note = stack_.overlap_note(); !note.empty()) {
      out_.warnings.push_back(note);
    }
    return std::move(out_);
  }

 private:
  /// Where the voxels of a mask lie in the map.
  LatticePlace place_of(const fs::path& file, const VoxelGrid& grid) const {
    if (!has_grid_) require_same_grid(file, grid, first_, out_.map);
    if (const auto place = find_place(grid, out_.map)) return *place;
    refuse(file, "expected the grid of its header, found another one");
  }
  std::size_t offset_of(const std::array<std::int64_t, 3>& voxel) const {
    return out_.map.offset(static_cast<Index>(voxel[0]), static_cast<Index>(voxel[1]),
                           static_cast<Index>(voxel[2]));
  }

  fs::path first_;
  bool has_grid_;
  LabelFile out_;
  LayerStack stack_;
  std::vector<std::string> empty_;
};

/// The grid that holds all masks where their headers state different ones.
std::optional<VoxelGrid> grid_of_all(const std::vector<fs::path>& files, const MaskReader& reader,
                                     MemoryBudget& budget) {
  constexpr double kMostShift = 1e-3;
  std::vector<VoxelGrid> grids;
  bool alike = true;
  for (const fs::path& file : files) {
    const ScopedFile scope(budget, file);
    const std::optional<VoxelGrid> grid = reader.grid(file);
    if (!grid) return std::nullopt;
    grids.push_back(*grid);
    alike = alike && grid->size == grids[0].size && shift_between(grids[0], *grid) <= kMostShift;
  }
  if (alike) return std::nullopt;
  return enclosing_grid(files, grids);
}

}  // namespace

std::string object_name(const fs::path& file) {
  const fs::path stem = file.stem();
  const std::string inner = lower_extension(stem);
  return (inner == ".nii" || inner == ".seg" ? stem.stem() : stem).string();
}

void require_same_grid(const fs::path& file, const VoxelGrid& found, const fs::path& first,
                       const VoxelGrid& expected) {
  constexpr double kMostShift = 1e-3;
  const std::string grid = "expected the grid of " + shown(first.filename().string());
  const auto text = [](const std::array<Index, 3>& n) {
    return message(n[0], " x ", n[1], " x ", n[2], " voxels");
  };
  if (found.size != expected.size) {
    refuse(file, message(grid, ", ", text(expected.size), ", found ", text(found.size)));
  }
  const double shift = shift_between(expected, found);
  if (!(shift <= kMostShift)) {
    refuse(file, message(grid, ", found one that lies ", shift, " voxels away"));
  }
}

std::vector<fs::path> masks_in(const fs::path& folder, MemoryBudget& budget) {
  std::vector<fs::path> masks;
  for (const fs::path& file : files_in(folder)) {
    if (file.filename().string().starts_with('.')) continue;
    if (is_array_file(file) || is_page_stack(file, budget)) masks.push_back(file);
  }
  return masks;
}

LabelFile read_masks(const std::vector<fs::path>& files, const MaskReader& reader,
                     MemoryBudget& budget) {
  if (files.size() == 1) return reader.read(files[0]);
  if (files.size() > static_cast<std::size_t>(kMaxLabel)) {
    refuse(files[0].parent_path(),
           message("expected at most ", kMaxLabel, " masks, found ", files.size()));
  }
  MaskCollector collector(files[0], grid_of_all(files, reader, budget), budget);
  for (const fs::path& file : files) {
    LabelFile mask;
    {
      const ScopedFile scope(budget, file);
      mask = reader.read(file);
    }
    const ScopedClaim claim(budget, mask.map.voxel_count(), sizeof(std::uint16_t), "a mask");
    collector.add(file, std::move(mask));
  }
  return collector.finish();
}

}  // namespace mesamis::detail::label_files
