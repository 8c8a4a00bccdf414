// SPDX-License-Identifier: Apache-2.0
#include "mesamis/decimate/decimation.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "mesamis/base/error.h"
#include "mesamis/decimate/decimate_part.h"

namespace mesamis::detail::decimate {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// The side of the boxes that hold a patch each, mm. A box cuts the surface in about two layers.
double patch_side(const TriMesh& surface, const DecimateOptions& options, double per_patch) {
  const auto triangles = static_cast<double>(surface.triangles.size());
  if (triangles < 2 * per_patch || options.triangles > 0) return kInfinity;
  const double side = std::sqrt(surface_area(surface) / triangles * per_patch / 2);
  return side > 0 ? side : kInfinity;
}

/// Whether nothing was decimated yet. Else an original may be near triangles of several patches,
/// each of which would be too far from it: so the whole is one patch.
bool stands_for_itself(const Cover& cover) {
  return std::all_of(cover.originals.begin(), cover.originals.end(),
                     [](const std::vector<Index>& originals) { return originals.size() == 1; });
}

class Decimation {
 public:
  /// @param interfaces  of the surface; nullptr: it is closed.
  Decimation(const TriMesh& surface, const Interfaces* interfaces, const DecimateOptions& options,
             PatchworkReport& report)
      : surface_(surface), interfaces_(interfaces), options_(options), report_(report) {}

  /// @param side  of the patches' boxes, mm; infinity: one patch.
  Cover run(double side) {
    std::vector<char> held(surface_.points.size(), 0);
    for (std::size_t p = 0; interfaces_ && p < held.size(); ++p) {
      held[p] = interfaces_->at_rim[p] != 0 && interfaces_->within_curve[p] == 0 ? 1 : 0;
    }
    Cover cover = run(cover_of(surface_), held, side);
    for (const double to_originals : cover.to_originals)
      report_.to_originals = std::max(report_.to_originals, to_originals);
    for (const double from_originals : cover.from_originals) {
      report_.from_originals = std::max(report_.from_originals, from_originals);
    }
    return cover;
  }

  /// @param held  of each point of the surface 1 if it stays.
  Cover run(Cover cover, const std::vector<char>& held, double side) {
    std::vector<char> open(cover.points.size(), 1);  // of each point 1 if it may go
    const Box box = bounding_box(cover.points);
    const Vec3 size = box.hi - box.lo;
    const double extent = std::max({size.x, size.y, size.z});
    double done = 0;
    for (; side < extent; side *= 2) {  // each across the seams of the one before
      const double end = 0.5 * (done + 1);
      decimate_boxes(cover, held, open, {side, done, end});
      done = end;
    }
    decimate_boxes(cover, held, open, {kInfinity, done, 1});
    return cover;
  }

 private:
  static constexpr int kRingsAtSeams = 4, kRingsAroundOpen = 2;
  static constexpr double kRounding = 1e-9;

  struct Lattice {
    double side;        ///< see cut_into_patches()
    double begin, end;  ///< shares of the work
  };

  /// Decimates the patches in the boxes of a lattice.
  /// @param open  of each point 1 if it may go; then 1 at the seams: where patches touch.
  void decimate_boxes(Cover& cover, const std::vector<char>& held, std::vector<char>& open,
                      const Lattice& lattice) {
    const std::vector<Vec3> points = cover.points;
    const std::vector<char> around = points_around(cover, open);
    std::vector<Patch> patches = cut_into_patches(std::move(cover), lattice.side, around);
    std::vector<char> at_seams(points.size(), 0);
    for (Patch& patch : patches) {
      for (std::size_t i = 0; i < patch.points.size(); ++i) {
        const Index p = patch.points[i];
        if (patch.held[i] != 0 && open[p] != 0) at_seams[p] = 1;
        if (held[p] != 0 || open[p] == 0) patch.held[i] = 1;
      }
    }
    cover =
        decimate_patchwork(task(lattice.begin, lattice.end), points, std::move(patches), report_);
    choose_rings(cover.triangles, kRingsAtSeams, at_seams);
    open = std::move(at_seams);
  }

  /// The points that are open, all copies of them, and those around; empty where all are open.
  std::vector<char> points_around(const Cover& cover, std::vector<char> open) const {
    if (std::find(open.begin(), open.end(), 0) == open.end()) return {};
    if (interfaces_) {
      choose_rings(cover.triangles, interfaces_->first_copy, kRingsAroundOpen, open);
    } else {
      choose_rings(cover.triangles, kRingsAroundOpen, open);
    }
    return open;
  }

  /// @param begin, end  shares of the work.
  DecimateTask task(double begin, double end) {
    auto tell = [this, begin, end](double share) {
      // Passes that are repeated tell less than before.
      told_ = std::max(told_, begin + (end - begin) * std::clamp(share, 0.0, 1.0));
      if (options_.progress && !options_.progress("decimation", told_)) throw Cancelled();
    };
    return {.surface = surface_,
            .tolerance = (1 - kRounding) * options_.tolerance,
            .triangles = options_.triangles,
            .progress = tell,
            .interfaces = interfaces_};
  }

  const TriMesh& surface_;
  const Interfaces* interfaces_;
  const DecimateOptions& options_;
  PatchworkReport& report_;
  double told_ = 0;  // share of the work
};

}  // namespace

void require_valid(const DecimateOptions& options) {
  if (!(options.tolerance >= 0)) {
    throw InputError("decimate: expected a tolerance of 0 mm or more, found " +
                     std::to_string(options.tolerance));
  }
  if (options.triangles < 0) {
    throw InputError("decimate: expected 0 or more triangles, found " +
                     std::to_string(options.triangles));
  }
}

Cover decimate_surface(const TriMesh& surface, const DecimateOptions& options,
                       double triangles_per_patch, PatchworkReport& report) {
  return Decimation(surface, nullptr, options, report)
      .run(patch_side(surface, options, triangles_per_patch));
}

TriMesh decimate_interfaces(const Interfaces& interfaces, const DecimateOptions& options,
                            double triangles_per_patch, PatchworkReport& report) {
  Cover cover = Decimation(interfaces.surface, &interfaces, options, report)
                    .run(patch_side(interfaces.surface, options, triangles_per_patch));
  return {std::move(cover.points), std::move(cover.triangles)};
}

Cover decimate_part(const TriMesh& original, Cover part, const std::vector<char>& held,
                    const DecimateOptions& options) {
  require_valid(options);
  if (!(options.tolerance > 0) || std::isinf(options.tolerance) || options.triangles > 0) {
    throw InputError("decimate: expected a part with a finite tolerance > 0 alone");
  }
  return decimate_patches(original, std::move(part), held, options, kTrianglesPerPatch);
}

Cover decimate_patches(const TriMesh& original, Cover part, const std::vector<char>& held,
                       const DecimateOptions& options, double triangles_per_patch) {
  if (part.triangles.empty()) return part;
  PatchworkReport work;
  const double side = stands_for_itself(part)
                          ? patch_side({part.points, part.triangles}, options, triangles_per_patch)
                          : kInfinity;
  return Decimation(original, nullptr, options, work).run(std::move(part), held, side);
}

}  // namespace mesamis::detail::decimate
