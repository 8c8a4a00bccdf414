// SPDX-License-Identifier: Apache-2.0
#include "mesamis/phantom/phantom.h"

#include <string>

#include "mesamis/base/error.h"
#include "mesamis/base/parallel.h"
#include "mesamis/phantom/phantom_designs.h"

namespace mesamis::detail::phantom {
namespace {

constexpr Index kSizeMax = 4096;
constexpr int kSamplesMax = 16;
constexpr Index kBrick = 8;  // voxels per direction that are decided at once

const PhantomDesign& design_called(std::string_view name) {
  std::string names;
  for (const PhantomDesign& design : phantom_designs()) {
    if (name == design.name) return design;
    names += std::string(names.empty() ? "" : ", ") + design.name;
  }
  throw InputError("phantom: expected one of " + names + ", found '" + std::string(name) + "'");
}

void require_grid(const std::array<Index, 3>& size, const Vec3& spacing) {
  for (int a = 0; a < 3; ++a) {
    const Index n = size[static_cast<std::size_t>(a)];
    if (n < kPhantomSizeMin || n > kSizeMax) {
      throw InputError("size: expected " + std::to_string(kPhantomSizeMin) + " to " +
                       std::to_string(kSizeMax) + " voxels, found " + std::to_string(n));
    }
    if (!(spacing[a] >= 1e-6 && spacing[a] <= 1e6)) {
      throw InputError("spacing: expected 1e-6 to 1e6 mm, found " + std::to_string(spacing[a]));
    }
  }
}

/// From lo to hi in steps of at most `step`, evenly; hi is left out.
void append_lines(std::vector<double>& lines, double lo, double hi, double step) {
  const auto count = static_cast<int>(std::ceil((hi - lo) / step - 1e-9));
  for (int i = 0; i < count; ++i) lines.push_back(lo + (hi - lo) * i / count);
}

/// Along one axis of a design, its origin in the middle.
std::vector<double> design_lines(const PhantomDesign& design, int axis) {
  const double half = 0.5 * design.size[static_cast<std::size_t>(axis)];
  std::vector<double> lines;
  double at = -half;
  for (const FineSlab& slab : design.fine) {
    if (slab.axis != axis) continue;
    append_lines(lines, at, slab.lo, design.step);
    append_lines(lines, slab.lo, slab.hi, slab.step);
    at = slab.hi;
  }
  append_lines(lines, at, half, design.step);
  lines.push_back(half);
  return lines;
}

/// How a design lies in the world.
struct Placement {
  double scale;
  Vec3 center;
  Vec3 to_design(const Vec3& p) const { return (1 / scale) * (p - center); }
};

Placement placement_of(const PhantomDesign& design, const std::array<Index, 3>& size,
                       const Vec3& spacing) {
  const auto extent = [&](int a) { return size[static_cast<std::size_t>(a)] * spacing[a]; };
  Placement placement{extent(0) / design.size[0], {}};
  for (int a = 0; a < 3; ++a) {
    placement.scale =
        std::min(placement.scale, extent(a) / design.size[static_cast<std::size_t>(a)]);
    placement.center[a] = extent(a) / 2;
  }
  return placement;
}

/// Samples of the slices [first, end) of a grid.
struct Slab {
  Index first, end;
  std::vector<float>& samples;
};

/// Samples the voxels of one brick.
class Sampler {
 public:
  Sampler(const Phantom& phantom, int samples, const VoxelGrid& grid)
      : phantom_(phantom), samples_(samples), grid_(grid) {}

  /// Fills what the slab has of a brick. The brick is decided as a whole: the slab changes nothing.
  void fill(const std::array<Index, 3>& begin, Slab& slab) const {
    std::array<Index, 3> end;
    for (std::size_t a = 0; a < 3; ++a) end[a] = std::min(begin[a] + kBrick, grid_.size[a]);
    const Vec3 first = center(begin), last = center({end[0] - 1, end[1] - 1, end[2] - 1});
    const double reach = 0.5 * norm(last - first + grid_.spacing);
    const bool is_outside = phantom_.inside(0.5 * (first + last)) < -reach;
    for (Index k = std::max(begin[2], slab.first); k < std::min(end[2], slab.end); ++k) {
      for (Index j = begin[1]; j < end[1]; ++j) {
        for (Index i = begin[0]; i < end[0]; ++i) {
          const double value = is_outside ? phantom_.background : voxel(center({i, j, k}));
          slab.samples[grid_.offset(i, j, k - slab.first)] = static_cast<float>(value);
        }
      }
    }
  }

 private:
  Vec3 center(const std::array<Index, 3>& v) const {
    const Vec3& s = grid_.spacing;
    return grid_.origin + Vec3{v[0] * s.x, v[1] * s.y, v[2] * s.z};
  }

  double value(const Vec3& p) const {
    const double depth = phantom_.inside(p);
    return depth > 0 ? phantom_.grey(p, depth) : phantom_.background;
  }

  /// `inside` is 1-Lipschitz: what is further from zero than a corner is from the centre decides.
  double voxel(const Vec3& p) const {
    const double depth = phantom_.inside(p), reach = 0.5 * norm(grid_.spacing);
    if (depth < -reach) return phantom_.background;
    if (depth > reach + phantom_.constant_below) return phantom_.grey(p, depth);
    return mean(p);
  }

  double mean(const Vec3& p) const {
    const auto offset = [this](int i, double spacing) {
      return ((i + 0.5) / samples_ - 0.5) * spacing;
    };
    const Vec3& s = grid_.spacing;
    double sum = 0;
    for (int k = 0; k < samples_; ++k) {
      for (int j = 0; j < samples_; ++j) {
        for (int i = 0; i < samples_; ++i) {
          sum += value(p + Vec3{offset(i, s.x), offset(j, s.y), offset(k, s.z)});
        }
      }
    }
    return sum / (samples_ * samples_ * samples_);
  }

  const Phantom& phantom_;
  int samples_;
  const VoxelGrid& grid_;
};

}  // namespace

std::vector<PhantomInfo> phantom_list() {
  std::vector<PhantomInfo> list;
  for (const PhantomDesign& d : phantom_designs()) list.push_back({d.name, d.description, d.size});
  return list;
}

Phantom make_phantom(std::string_view name, const std::array<Index, 3>& size, const Vec3& spacing) {
  const PhantomDesign& design = design_called(name);
  Phantom phantom;
  phantom.name = design.name;
  phantom.size = size == std::array<Index, 3>{0, 0, 0} ? design.size : size;
  phantom.spacing = spacing;
  require_grid(phantom.size, spacing);
  const Placement place = placement_of(design, phantom.size, spacing);
  phantom.scale = place.scale;
  phantom.inside = [place, inside = design.inside](const Vec3& p) {
    return place.scale * inside(place.to_design(p));
  };
  phantom.grey = [place, grey = design.grey](const Vec3& p, double depth) {
    return grey == nullptr ? kBone : grey(place.to_design(p), depth / place.scale);
  };
  phantom.constant_below = place.scale * design.constant_below;
  phantom.background = kSoftTissue;
  for (int a = 0; a < 3; ++a) {
    for (const double x : design_lines(design, a)) {
      phantom.lines[static_cast<std::size_t>(a)].push_back(place.center[a] + place.scale * x);
    }
  }
  return phantom;
}

Volume sample_phantom(const Phantom& phantom, int samples) {
  const PhantomSlices slices(phantom, samples);
  if (slices.grid().voxel_count() >= std::size_t{1} << 31) {
    throw InputError("size: expected less than 2^31 voxels in memory at once, found " +
                     std::to_string(slices.grid().voxel_count()));
  }
  return read_slab(slices, 0, phantom.size[2]);
}

PhantomSlices::PhantomSlices(Phantom phantom, int samples)
    : phantom_(std::move(phantom)),
      samples_(samples),
      grid_{.size = phantom_.size, .spacing = phantom_.spacing, .origin = 0.5 * phantom_.spacing} {
  if (samples < 1 || samples > kSamplesMax) {
    throw InputError("samples: expected 1 to " + std::to_string(kSamplesMax) + ", found " +
                     std::to_string(samples));
  }
}

std::vector<float> PhantomSlices::read(Index first, Index count) const {
  std::vector<float> samples(grid_.offset(0, 0, count));
  const Sampler sampler(phantom_, samples_, grid_);
  Slab slab{first, first + count, samples};
  const auto bricks = [this](std::size_t a) { return (grid_.size[a] + kBrick - 1) / kBrick; };
  const auto rows = static_cast<std::size_t>(bricks(1));
  const Index layer = first / kBrick;
  const auto layers = static_cast<std::size_t>((slab.end + kBrick - 1) / kBrick - layer);
  parallel_for_each(layers * rows, [&](std::size_t n) {
    const auto j = static_cast<Index>(n % rows), k = layer + static_cast<Index>(n / rows);
    for (Index i = 0; i < bricks(0); ++i) {
      sampler.fill({i * kBrick, j * kBrick, k * kBrick}, slab);
    }
  });
  return samples;
}

}  // namespace mesamis::detail::phantom
