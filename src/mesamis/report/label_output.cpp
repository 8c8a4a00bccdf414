// SPDX-License-Identifier: Apache-2.0
#include "mesamis/report/label_output.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>
#include <utility>
#include <vector>

#include "mesamis/base/error.h"
#include "mesamis/base/parallel.h"
#include "mesamis/report/centre_faces.h"
#include "mesamis/report/line_crossing.h"

namespace mesamis::detail::report {
namespace {

/// Of a voxel: no centre of a usual surface lies on such a line.
constexpr double kAside = 1.1e-6;
/// Of a voxel: how far from centres a face on them lies, beside the rounding of single precision.
constexpr double kHair = 1e-3;
constexpr double kMostHair = 0.1;
/// Of the volume of a label, by the surface of one that is shown well.
constexpr double kVolumeKept = 0.6;
constexpr std::size_t kFewVoxels = 27;

/// Which voxels an object gets.
enum class Marks {
  kInside,  ///< those with the centre inside, not on the surface
  kTouched  ///< those whose centre is on the surface and that no object has
};

/// Where a surface crosses a line of voxels.
struct Crossing {
  std::size_t row;  // j + k * voxels along j
  double x;         // voxels
  int inward;       // 1 inward, -1 outward, for increasing x
};

class Lines {
 public:
  Lines(const VoxelGrid& grid, const TriMesh& surface) : grid_(grid), surface_(surface) {
    voxels_.resize(surface.points.size());
    parallel_for(voxels_.size(), [&](std::size_t p) {
      const Vec3 q = grid.to_grid(surface.points[p]), &s = grid.spacing;
      voxels_[p] = {q.x / s.x, q.y / s.y, q.z / s.z};
    });
  }

  /// Moves faces through centres to outside or inside of these.
  /// @return whether there are any.
  bool move_centre_faces(Marks marks) {
    double far = 0;
    for (const Vec3& p : surface_.points) {
      far = std::max({far, std::abs(p.x), std::abs(p.y), std::abs(p.z)});
    }
    const double rounding = far * std::numeric_limits<float>::epsilon() / grid_.shortest_side();
    const double hair = std::min(kHair + rounding, kMostHair);
    const double by = marks == Marks::kTouched ? 2 * hair : -2 * hair;
    return report::move_centre_faces(voxels_, surface_.triangles, hair, by);
  }

  /// Increasing by row and place.
  std::vector<Crossing> crossings() const {
    std::vector<Crossing> found;
    for (const Triangle& t : surface_.triangles) add(t, found);
    std::sort(found.begin(), found.end(), [](const Crossing& a, const Crossing& b) {
      return a.row != b.row ? a.row < b.row : a.x != b.x ? a.x < b.x : a.inward < b.inward;
    });
    return found;
  }

 private:
  static Index first_from(double least) {
    return static_cast<Index>(std::ceil(std::max(0.0, least)));
  }

  void add(const Triangle& t, std::vector<Crossing>& found) const {
    const std::array<NumberedCorner, 3> c{
        {{beside(t[0]), t[0]}, {beside(t[1]), t[1]}, {beside(t[2]), t[2]}}};
    const auto [y0, y1] = std::minmax({c[0].at.y, c[1].at.y, c[2].at.y});
    const auto [z0, z1] = std::minmax({c[0].at.z, c[1].at.z, c[2].at.z});
    for (Index k = first_from(z0); k < grid_.size[2] && k <= z1; ++k) {
      for (Index j = first_from(y0); j < grid_.size[1] && j <= y1; ++j) {
        const auto crossing = line_crossing(c, j, k);
        if (crossing) found.push_back({row_of(j, k), crossing->x, crossing->inward});
      }
    }
  }

  /// A point, seen from the lines.
  Vec3 beside(Index p) const {
    return voxels_[static_cast<std::size_t>(p)] - Vec3{0, kAside, kAside};
  }

  std::size_t row_of(Index j, Index k) const {
    return static_cast<std::size_t>(k) * static_cast<std::size_t>(grid_.size[1]) +
           static_cast<std::size_t>(j);
  }

  const VoxelGrid& grid_;
  const TriMesh& surface_;
  std::vector<Vec3> voxels_;
};

/// The voxels of a row between two places, as places in a layer.
std::array<std::size_t, 2> between(const VoxelGrid& grid, const Crossing& from, double to) {
  const auto nx = static_cast<double>(grid.size[0]);
  const std::size_t start = from.row * static_cast<std::size_t>(grid.size[0]);
  const auto place = [&](double x) {
    return start + static_cast<std::size_t>(std::clamp(std::ceil(x), 0.0, nx));
  };
  return {place(from.x), place(to)};
}

void mark(const VoxelGrid& grid, const FoundObject& object, std::vector<std::uint16_t>& layer,
          Marks marks) {
  Lines lines(grid, object.surface);
  if (!lines.move_centre_faces(marks) && marks == Marks::kTouched) return;
  const auto label = static_cast<std::uint16_t>(object.segment.label);
  const std::vector<Crossing> crossings = lines.crossings();
  int depth = 0;
  for (std::size_t n = 0; n + 1 < crossings.size(); ++n) {
    if (n > 0 && crossings[n].row != crossings[n - 1].row) depth = 0;
    depth += crossings[n].inward;
    if (depth == 0 || crossings[n + 1].row != crossings[n].row) continue;
    const auto [begin, end] = between(grid, crossings[n], crossings[n + 1].x);
    for (std::size_t v = begin; v < end; ++v) {
      if (marks == Marks::kInside || layer[v] == 0) layer[v] = label;
    }
  }
}

}  // namespace

std::vector<FoundObject> found_objects(const LabelResult& result) {
  std::vector<FoundObject> found;
  for (const LabelledObject& object : result.objects) {
    found.push_back({object.surface, object.segment});
  }
  return found;
}

std::vector<std::string> missing_objects(const LabelResult& result,
                                         std::span<const Segment> wanted) {
  if (result.objects.empty()) {
    throw InputError("labels: expected a surface of at least one object, found none");
  }
  std::vector<std::string> warnings;
  for (const Segment& s : wanted) {
    const bool found = std::any_of(result.objects.begin(), result.objects.end(),
                                   [&](const LabelledObject& o) { return o.segment == s; });
    if (!found) warnings.push_back("labels: nothing was found of '" + s.name + "'");
  }
  return warnings;
}

std::vector<std::string> noise_warnings(const LabelMap& map) {
  constexpr std::size_t kMany = 50'000;
  constexpr double kShareOfNoise = 0.55;  // of a sheet of one voxel it is a half
  const LabelPairs pairs = count_pairs(map);
  const double share = static_cast<double>(pairs.different) / static_cast<double>(pairs.all);
  if (pairs.different < kMany || share < kShareOfNoise) return {};
  std::ostringstream text;
  text.precision(2);
  text << "labels: " << 100 * share << " % of neighbouring voxels differ, as in noise: the surface "
       << "has about " << 2 * pairs.different << " triangles before decimation";
  return {text.str()};
}

std::vector<std::string> changed_volumes(const LabelResult& result, const LabelMap& map) {
  const std::vector<std::size_t> voxels = voxel_counts(map);
  const double of_voxel = map.spacing.x * map.spacing.y * map.spacing.z;
  std::vector<std::string> warnings;
  for (const LabelledObject& object : result.objects) {
    const auto segment = std::find(map.segments.begin(), map.segments.end(), object.segment);
    const std::size_t count = voxels[static_cast<std::size_t>(segment - map.segments.begin())];
    const double expected = static_cast<double>(count) * of_voxel,
                 volume = surface_volume(object.surface);
    const bool is_kept = volume >= kVolumeKept * expected && kVolumeKept * volume <= expected;
    if (count < kFewVoxels || is_kept) continue;
    std::ostringstream text;
    text.precision(3);
    text << "labels: the surface of '" << object.segment.name << "' holds " << volume / 1000
         << " cm^3, the voxels of its label " << expected / 1000 << " cm^3";
    warnings.push_back(text.str());
  }
  return warnings;
}

LabelMap label_map_of(const VoxelGrid& grid, std::span<const FoundObject> objects) {
  LabelMap map;
  static_cast<VoxelGrid&>(map) = grid;
  std::size_t layers = 1;
  for (const FoundObject& object : objects) {
    layers = std::max(layers, static_cast<std::size_t>(object.segment.layer) + 1);
    map.segments.push_back(object.segment);
  }
  map.layers.assign(layers, std::vector<std::uint16_t>(grid.voxel_count(), 0));
  for (const Marks marks : {Marks::kInside, Marks::kTouched}) {
    for (const FoundObject& object : objects) {
      mark(grid, object, map.layers[static_cast<std::size_t>(object.segment.layer)], marks);
    }
  }
  return map;
}

namespace {

/// The first layer that has no label where an object has one.
std::size_t free_layer(const LabelMap& map, const std::vector<std::uint16_t>& object) {
  const auto overlaps = [&](const std::vector<std::uint16_t>& layer) {
    for (std::size_t n = 0; n < object.size(); ++n) {
      if (object[n] != 0 && layer[n] != 0) return true;
    }
    return false;
  };
  const auto free = std::find_if_not(map.layers.begin(), map.layers.end(), overlaps);
  return static_cast<std::size_t>(free - map.layers.begin());
}

void add_object(LabelMap& map, Segment segment, std::vector<std::uint16_t> object) {
  const std::size_t layer = free_layer(map, object);
  segment.layer = static_cast<Index>(layer);
  map.segments.push_back(std::move(segment));
  if (layer == map.layers.size()) {
    map.layers.push_back(std::move(object));
    return;
  }
  for (std::size_t n = 0; n < object.size(); ++n) {
    if (object[n] != 0) map.layers[layer][n] = object[n];
  }
}

}  // namespace

SurfaceLabels labels_of_surfaces(const VoxelGrid& grid, std::span<const FoundObject> objects) {
  SurfaceLabels out;
  static_cast<VoxelGrid&>(out.map) = grid;
  for (const FoundObject& object : objects) {
    std::vector<std::uint16_t> alone(grid.voxel_count(), 0);
    mark(grid, object, alone, Marks::kInside);
    add_object(out.map, object.segment, std::move(alone));
  }
  for (std::size_t n = 0; n < objects.size(); ++n) {
    const auto layer = static_cast<std::size_t>(out.map.segments[n].layer);
    mark(grid, objects[n], out.map.layers[layer], Marks::kTouched);
  }
  const std::vector<std::size_t> counts = voxel_counts(out.map);
  if (std::all_of(counts.begin(), counts.end(), [](std::size_t n) { return n == 0; })) {
    throw InputError(
        "labels: expected surfaces around voxel centres of the scan, found none inside");
  }
  for (std::size_t n = 0; n < counts.size(); ++n) {
    const std::string& name = out.map.segments[n].name;
    if (counts[n] == 0) out.warnings.push_back("'" + name + "' has no voxel centre inside");
    if (out.map.segments[n].layer > 0) {
      out.warnings.push_back("'" + name +
                             "' overlaps another surface: it lies in a layer of its own");
    }
  }
  return out;
}

}  // namespace mesamis::detail::report
