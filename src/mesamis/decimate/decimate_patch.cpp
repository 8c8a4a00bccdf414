// SPDX-License-Identifier: Apache-2.0
#include "mesamis/decimate/decimate_patch.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "mesamis/base/parallel.h"
#include "mesamis/surface/farthest.h"

namespace mesamis {
namespace {

/// After so many passes a patch stays as it was.
constexpr int kMostPasses = 24;
/// From this pass on, wider and wider rings are held.
constexpr int kPatience = 6;

constexpr std::size_t kTrianglesPerBlock = 256;

/// Those of n triangles that reach farther than the tolerance.
template <class CornersOf>
std::vector<Index> triangles_beyond(std::size_t n, CornersOf corners_at, const TriangleTree& to,
                                    double tolerance) {
  return parallel_collect<Index>(
      n, kTrianglesPerBlock, [&](std::size_t begin, std::size_t end, auto& found) {
        std::size_t hint = 0;
        for (std::size_t t = begin; t < end; ++t) {
          const double d = farthest_distance(corners_at(t), to, {tolerance, tolerance}, hint);
          if (d > tolerance) found.push_back(static_cast<Index>(t));
        }
      });
}

/// Repeats passes over a patch.
class Decimation {
 public:
  Decimation(const DecimateTask& task, Patch patch) : task_(task), patch_(std::move(patch)) {
    for (const auto& of_triangle : patch_.cover.originals) {
      originals_.insert(originals_.end(), of_triangle.begin(), of_triangle.end());
    }
    std::sort(originals_.begin(), originals_.end());
    originals_.erase(std::unique(originals_.begin(), originals_.end()), originals_.end());
  }

  DecimatedPatch run() {
    const auto before = held();
    DecimatedPatch done;
    while (++done.passes < kMostPasses) {
      done.cover = decimate_pass(task_, patch_);
      const bool proved = std::isinf(task_.tolerance) || task_.quick;
      if (proved || !hold_what_is_too_far(done)) break;
    }
    if (done.passes == kMostPasses) done.cover = std::move(patch_.cover);
    done.points_held = held() - before;
    return done;
  }

 private:
  std::int64_t held() const { return std::count(patch_.held.begin(), patch_.held.end(), 1); }

  Corners original(Index t) const { return corners_of(task_.surface, task_.surface.triangles[t]); }

  /// An interface, or the whole surface: originals, and what is to be near them.
  struct Part {
    std::vector<Index> originals;
    std::vector<Corners> placed;
  };

  /// Triangles over the patch's points, and what touches the patch, interface by interface.
  std::map<Index, Part> in_their_place(const std::vector<Triangle>& triangles) const {
    std::map<Index, Part> parts;
    const auto place = [&](const Triangle& t) {
      parts[task_.interface_at(t[0])].placed.push_back(corners_of(task_.surface, t));
    };
    for (const Triangle& t : triangles) {
      place({patch_.points[t[0]], patch_.points[t[1]], patch_.points[t[2]]});
    }
    for (const Triangle& t : patch_.around) place(t);
    for (const Index t : originals_) {
      parts[task_.interface_at(task_.surface.triangles[t][0])].originals.push_back(t);
    }
    return parts;
  }

  /// The pass has made sure that new triangles are near the original, but not all of the reverse. A
  /// triangle whose corners are all held is never removed.
  /// @return whether any original was too far.
  bool hold_what_is_too_far(DecimatedPatch& done) {
    std::vector<Index> lost;
    for (const auto& of_interface : in_their_place(done.cover.triangles)) {
      const Part& part = of_interface.second;
      const std::vector<Index> beyond = triangles_beyond(
          part.originals.size(), [&](std::size_t i) { return original(part.originals[i]); },
          TriangleTree(part.placed), task_.tolerance);
      for (const Index t : beyond) lost.push_back(part.originals[t]);
    }
    std::sort(lost.begin(), lost.end());
    hold(patch_, {}, lost, 1 + std::max(0, done.passes - kPatience));
    return !lost.empty();
  }

  const DecimateTask& task_;
  Patch patch_;
  std::vector<Index> originals_;  // that the patch stands for
};

}  // namespace

DecimatedPatch decimate_patch(const DecimateTask& task, const Patch& patch) {
  return Decimation(task, patch).run();
}

void hold(Patch& patch, const std::vector<Index>& points, const std::vector<Index>& originals,
          int rings) {
  std::vector<char> chosen(patch.held.size(), 0);
  for (const Index p : points) chosen[p] = 1;
  for (std::size_t t = 0; t < patch.cover.triangles.size(); ++t) {
    const auto& own = patch.cover.originals[t];
    const bool stands = std::any_of(own.begin(), own.end(), [&](Index original) {
      return std::binary_search(originals.begin(), originals.end(), original);
    });
    if (!stands) continue;
    for (const Index p : patch.cover.triangles[t]) chosen[p] = 1;
  }
  choose_rings(patch.cover.triangles, rings, chosen);
  for (std::size_t p = 0; p < chosen.size(); ++p) patch.held[p] |= chosen[p];
}

}  // namespace mesamis
