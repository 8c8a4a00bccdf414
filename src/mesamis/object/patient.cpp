// SPDX-License-Identifier: Apache-2.0
#include "mesamis/object/patient.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "mesamis/base/median.h"
#include "mesamis/base/parallel.h"
#include "mesamis/image/grey_values.h"
#include "mesamis/object/keep.h"
#include "mesamis/object/voxel_islands.h"
#include "mesamis/object/voxel_neighbours.h"

namespace mesamis::detail::object {
namespace {

constexpr float kNoAir = -300;     // HU
constexpr double kSheet = 3;       // mm: balls of this radius do not fit into skins of tables
constexpr double kOpening = 6;     // mm
constexpr double kHollow = 15;     // mm
constexpr double kLongPart = 100;  // mm

std::size_t at(Index n) { return static_cast<std::size_t>(n); }

/// Voxels about 2 mm apart suffice.
std::array<Index, 3> coarse_stride(const VoxelGrid& grid) {
  constexpr double kApart = 2;  // mm
  std::array<Index, 3> stride{};
  for (int a = 0; a < 3; ++a) {
    const Index most = (grid.size[at(a)] - 1) / 2;
    const auto wanted = std::floor(kApart / grid.spacing[a] * (1 + 1e-6));
    stride[at(a)] = static_cast<Index>(std::clamp<double>(wanted, 1, std::max(1, most)));
  }
  return stride;
}

/// The grid's axis along the patient: across axial slices.
int patient_axis(const VoxelGrid& grid) {
  const Vec3 z = grid.direction.rows[2];
  int axis = 2;
  for (int a = 0; a < 3; ++a) {
    if (std::abs(z[a]) > std::abs(z[axis]) + 1e-6) axis = a;
  }
  return axis;
}

/// What balls that fit into a mask reach.
VoxelMask opened(const VoxelMask& mask, const VoxelGrid& grid, double mm) {
  return dilated(eroded(mask, grid, mm), grid, mm);
}

/// What balls that fit beside a mask do not reach: the mask and its hollows.
VoxelMask closed(const VoxelMask& mask, const VoxelGrid& grid, double mm) {
  return eroded(dilated(mask, grid, mm), grid, mm);
}

/// What is dense, and what it encloses in a slice: sinuses, airways, lungs. What sheets enclose is
/// left open, such as the gap between patient and table.
VoxelMask dense_and_filled(const VoxelMask& dense, const VoxelGrid& grid) {
  VoxelMask solid =
      without_cavities_in_slices(opened(dense, grid, kSheet), grid, patient_axis(grid));
  for (std::size_t n = 0; n < solid.size(); ++n) solid[n] |= dense[n];
  return solid;
}

/// What an island is made of, in voxels.
struct Content {
  std::size_t dense = 0, tissue = 0, deep = 0;
  /// Whether half of what is dense is soft tissue, fat included.
  bool is_tissue() const { return 2 * tissue >= dense; }
};

/// @param deep  the centres of the balls of the opening.
std::vector<Content> contents(const VolumeView& volume, const VoxelIslands& islands,
                              const VoxelMask& deep) {
  constexpr float kLow = -200, kHigh = 200;  // HU
  std::vector<Content> all(islands.voxels.size());
  for (std::size_t n = 0; n < deep.size(); ++n) {
    if (islands.of_voxel[n] == 0) continue;
    Content& content = all[at(islands.of_voxel[n] - 1)];
    const float x = volume.samples[n];
    content.dense += x > kNoAir;
    content.tissue += x > kLow && x < kHigh;
    content.deep += deep[n];
  }
  return all;
}

/// Where the opening's balls fit into the patient; empty if there seems to be none.
VoxelMask find_core(const VolumeView& volume, const VoxelMask& solid) {
  constexpr std::size_t kOneIn = 100;
  VoxelMask core = eroded(solid, volume, kOpening);
  const VoxelIslands islands = find_islands(solid, volume);
  const std::vector<Content> of_island = contents(volume, islands, core);
  const auto largest =
      std::max_element(of_island.begin(), of_island.end(),
                       [](const Content& a, const Content& b) { return a.deep < b.deep; });
  if (largest == of_island.end() || largest->deep == 0 || !largest->is_tissue()) return {};
  for (std::size_t n = 0; n < core.size(); ++n) {
    if (core[n] == 0) continue;
    const Content& content = of_island[at(islands.of_voxel[n] - 1)];
    core[n] = content.is_tissue() && kOneIn * content.deep >= largest->deep;
  }
  return core;
}

double longest_side(const CropRange& range, const VoxelGrid& grid) {
  double longest = 0;
  for (int a = 0; a < 3; ++a) {
    longest = std::max(longest, (range.end[at(a)] - range.begin[at(a)]) * grid.spacing[a]);
  }
  return longest;
}

/// Whether each island shares a face with a mask.
std::vector<std::uint8_t> touch(const VoxelIslands& islands, const VoxelMask& mask,
                                const VoxelGrid& grid) {
  std::vector<std::uint8_t> touches(islands.voxels.size(), 0);
  for (std::size_t n = 0; n < mask.size(); ++n) {
    if (islands.of_voxel[n] == 0) continue;
    for_each_neighbour(grid, n, [&](std::size_t next, int) {
      if (mask[next] != 0) touches[at(islands.of_voxel[n] - 1)] = 1;
    });
  }
  return touches;
}

/// Gives back what the opening took from the body: short parts that hang on, and what lies in its
/// hollows.
void add_thin_parts(VoxelMask& patient, const VoxelMask& solid, const VoxelGrid& grid) {
  const VoxelMask rest = only_in(solid, patient);
  const VoxelIslands parts = find_islands(rest, grid);
  const std::vector<CropRange> ranges = ranges_of(parts, grid);
  const std::vector<std::uint8_t> hangs_on = touch(parts, patient, grid);
  const VoxelMask in_hollow = closed(patient, grid, kHollow);
  for (std::size_t n = 0; n < rest.size(); ++n) {
    if (rest[n] == 0) continue;
    const std::size_t part = at(parts.of_voxel[n] - 1);
    const bool is_short = longest_side(ranges[part], grid) <= kLongPart;
    patient[n] = in_hollow[n] != 0 || (hangs_on[part] != 0 && is_short);
  }
}

/// Fills what the outside does not reach, and lungs that the scan's border cuts.
void fill_enclosed(VoxelMask& patient, const VolumeView& volume) {
  constexpr double kLung = -950;  // HU; air is darker
  patient =
      without_cavities(without_cavities_in_slices(patient, volume, patient_axis(volume)), volume);
  const VoxelIslands gaps = find_islands(complement(patient), volume);
  std::vector<std::vector<double>> values(gaps.voxels.size() + 1);
  for (std::size_t n = 0; n < patient.size(); ++n) {
    if (patient[n] == 0) values[at(gaps.of_voxel[n])].push_back(volume.samples[n]);
  }
  std::vector<std::uint8_t> is_lung(values.size(), 0);
  for (std::size_t gap = 1; gap < values.size(); ++gap) {
    const double middle = median(values[gap]);
    is_lung[gap] = middle > kLung && middle < kNoAir;
  }
  for (std::size_t n = 0; n < patient.size(); ++n) patient[n] |= is_lung[at(gaps.of_voxel[n])];
}

/// Whether the rest has more of what is dense than the body, and more of what is as bright as bone: a
/// dry skull on a head rest of foam has.
bool is_the_lesser_part(const VoxelMask& patient, const VoxelMask& dense,
                        const VolumeView& volume) {
  constexpr float kBone = 250;  // HU
  std::array<std::size_t, 2> solid{}, bright{};
  for (std::size_t n = 0; n < patient.size(); ++n) {
    const std::size_t inside = patient[n] != 0 ? 1 : 0;
    solid[inside] += dense[n];
    bright[inside] += volume.samples[n] > kBone ? 1 : 0;
  }
  return solid[0] > solid[1] && bright[0] > bright[1];
}

/// What is dense and not in the body, by name.
std::vector<Surroundings> name_surroundings(const VoxelMask& patient, const VoxelMask& dense,
                                            const VoxelGrid& grid) {
  const VoxelIslands islands = find_islands(only_in(dense, patient), grid);
  const std::vector<CropRange> ranges = ranges_of(islands, grid);
  const auto axis = at(patient_axis(grid));
  std::vector<Surroundings> kinds{{"table or head rest", 0}, {"other objects", 0}};
  for (std::size_t island = 0; island < ranges.size(); ++island) {
    const bool is_long =
        2 * (ranges[island].end[axis] - ranges[island].begin[axis]) >= grid.size[axis];
    kinds[is_long ? 0 : 1].mm3 += static_cast<double>(islands.voxels[island]) * grid.voxel_volume();
  }
  std::erase_if(kinds, [](const Surroundings& kind) { return kind.mm3 == 0; });
  std::stable_sort(kinds.begin(), kinds.end(),
                   [](const auto& a, const auto& b) { return a.mm3 > b.mm3; });
  return kinds;
}

/// The mark of the nearest coarse voxel for every voxel.
VoxelMask spread_out(const VoxelMask& coarse, const VoxelGrid& from, const VoxelGrid& grid,
                     const std::array<Index, 3>& stride) {
  const auto nearest = [&](Index n, std::size_t axis) {
    return std::min((n + stride[axis] / 2) / stride[axis], from.size[axis] - 1);
  };
  VoxelMask mask(grid.voxel_count());
  parallel_for(mask.size(), [&](std::size_t n) {
    const auto [i, j, k] = grid.voxel(n);
    mask[n] = coarse[from.offset(nearest(i, 0), nearest(j, 1), nearest(k, 2))];
  });
  return mask;
}

}  // namespace

std::optional<Patient> find_patient(const VolumeView& volume) {
  if (volume.samples.empty() || !is_hounsfield(volume)) return std::nullopt;
  if (*std::min_element(volume.size.begin(), volume.size.end()) < 2) return std::nullopt;
  const std::array<Index, 3> stride = coarse_stride(volume);
  const Volume coarse = subsample(volume, stride);
  const VoxelMask dense = mask_above(coarse, kNoAir);
  const VoxelMask solid = dense_and_filled(dense, coarse);
  const VoxelMask core = find_core(coarse, solid);
  if (core.empty()) return std::nullopt;

  VoxelMask inside = dilated(core, coarse, kOpening);
  add_thin_parts(inside, solid, coarse);
  fill_enclosed(inside, coarse);
  if (is_the_lesser_part(inside, dense, coarse)) return std::nullopt;
  Patient patient;
  patient.grain = std::max({coarse.spacing.x, coarse.spacing.y, coarse.spacing.z});
  patient.removed = name_surroundings(inside, dense, coarse);
  patient.mm3 = static_cast<double>(count_marked(inside)) * coarse.voxel_volume();
  patient.mask = spread_out(inside, coarse, volume, stride);
  return patient;
}

Volume without_surroundings(Volume volume, const Patient& patient) {
  constexpr double kAir = -1000;  // HU
  return kept_to(std::move(volume), patient.mask, {.margin = patient.grain, .background = kAir});
}

}  // namespace mesamis::detail::object
