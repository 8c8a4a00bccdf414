// SPDX-License-Identifier: Apache-2.0
#include "mesamis/decimate/patchwork.h"

#include <algorithm>
#include <atomic>
#include <mutex>
#include <numeric>
#include <utility>

#include "mesamis/base/parallel.h"
#include "mesamis/mesh/tet_mesh.h"
#include "mesamis/surface/box_tree.h"
#include "mesamis/surface/self_intersections.h"
#include "mesamis/surface/triangle_tree.h"

namespace mesamis::detail::decimate {
namespace {

/// So often patches are made anew.
constexpr int kMostRounds = 8;

class Patchwork {
 public:
  Patchwork(const DecimateTask& task, std::vector<Vec3> points, std::vector<Patch> patches)
      : task_(task),
        points_(std::move(points)),
        patches_(std::move(patches)),
        done_(patches_.size()) {}

  Cover run(PatchworkReport& report) {
    std::vector<std::size_t> open(patches_.size());
    std::iota(open.begin(), open.end(), std::size_t{0});
    decimate(open);
    for (int round = 1; !(open = hold_what_meets(round)).empty(); ++round) {
      ++report.rounds;
      if (round <= kMostRounds) {
        decimate(open);
      } else {
        for (const std::size_t k : open) done_[k] = patches_[k].cover;
      }
    }
    return joined();
  }

 private:
  static Cover decimated(const DecimateTask& task, const Patch& patch) {
    const bool is_held = std::find(patch.held.begin(), patch.held.end(), 0) == patch.held.end();
    return is_held ? patch.cover : decimate_pass(task, patch);
  }

  void decimate(const std::vector<std::size_t>& open) {
    if (open.size() == 1) {
      done_[open[0]] = decimated(task_, patches_[open[0]]);
      return;
    }
    std::mutex telling;
    std::atomic<int> finished = 0;
    DecimateTask task = task_;
    task.progress = [&](double) {
      const std::lock_guard lock(telling);
      task_.progress(finished / static_cast<double>(open.size()));
    };
    // The largest first, so that none is left to one thread in the end.
    std::vector<std::size_t> order = open;
    std::stable_sort(order.begin(), order.end(), [this](std::size_t a, std::size_t b) {
      return patches_[a].cover.triangles.size() > patches_[b].cover.triangles.size();
    });
    std::atomic<std::size_t> next = 0;
    parallel_for_each(order.size(), [&](std::size_t) {
      const std::size_t k = order[next++];
      done_[k] = decimated(task, patches_[k]);
      ++finished;
    });
  }

  Cover joined() const {
    Cover cover;
    cover.points = points_;
    for (std::size_t k = 0; k < patches_.size(); ++k) {
      const std::vector<Index>& points = patches_[k].points;
      const Cover& done = done_[k];
      for (std::size_t p = 0; p < points.size(); ++p) cover.points[points[p]] = done.points[p];
      for (Triangle t : done.triangles) {
        for (Index& p : t) p = points[p];
        cover.triangles.push_back(t);
      }
      cover.originals.insert(cover.originals.end(), done.originals.begin(), done.originals.end());
      cover.to_originals.insert(cover.to_originals.end(), done.to_originals.begin(),
                                done.to_originals.end());
      cover.from_originals.insert(cover.from_originals.end(), done.from_originals.begin(),
                                  done.from_originals.end());
    }
    return cover;
  }

  /// Whether a triangle was not there before, or a corner of it has moved.
  static bool is_new(const Triangle& t, const Cover& done, const Patch& patch) {
    const auto has_moved = [&](Index p) { return done.points[p] != patch.cover.points[p]; };
    if (std::any_of(t.begin(), t.end(), has_moved)) return true;
    const auto is_same = [&t](const Triangle& before) {
      return std::is_permutation(t.begin(), t.end(), before.begin());
    };
    return std::none_of(patch.cover.triangles.begin(), patch.cover.triangles.end(), is_same);
  }

  /// New triangles of each patch that intersect those of others.
  std::vector<std::vector<std::size_t>> find_what_meets() const {
    std::vector<std::size_t> ends;  // of the patches' triangles in the joined surface
    for (const Cover& done : done_) {
      ends.push_back((ends.empty() ? 0 : ends.back()) + done.triangles.size());
    }
    const auto patch_of = [&ends](Index t) {
      return static_cast<std::size_t>(
          std::upper_bound(ends.begin(), ends.end(), static_cast<std::size_t>(t)) - ends.begin());
    };
    std::vector<std::vector<std::size_t>> meeting(patches_.size());
    Cover cover = joined();
    TriMesh whole{std::move(cover.points), std::move(cover.triangles)};
    for (Triangle& t : whole.triangles) {
      for (Index& p : t) p = task_.first_copy(p);
    }
    const std::vector<Index> chosen = reaching_others(whole, ends);
    TriMesh few{std::move(whole.points), {}};
    for (const Index t : chosen) few.triangles.push_back(whole.triangles[t]);
    for (const auto& pair : find_self_intersections(few)) {
      if (patch_of(chosen[pair[0]]) == patch_of(chosen[pair[1]])) continue;  // it was so before
      for (const Index place : pair) {
        const Index t = chosen[place];
        const std::size_t k = patch_of(t);
        const auto& triangles = done_[k].triangles;
        const std::size_t n = static_cast<std::size_t>(t) + triangles.size() - ends[k];
        if (is_new(triangles[n], done_[k], patches_[k])) meeting[k].push_back(n);
      }
    }
    return meeting;
  }

  /// The triangles that reach into the box of another patch, increasing: no others meet one of it.
  /// @param ends  of the patches' triangles in the joined surface.
  static std::vector<Index> reaching_others(const TriMesh& whole,
                                            const std::vector<std::size_t>& ends) {
    const auto box_of = [&whole](std::size_t t) {
      return bounding_box(corners_of(whole, whole.triangles[t]));
    };
    std::vector<Box> boxes(ends.size(), kNoBox);
    for (std::size_t t = 0, k = 0; t < whole.triangles.size(); ++t) {
      while (t >= ends[k]) ++k;
      boxes[k] = united(boxes[k], box_of(t));
    }
    const BoxTree tree(boxes);
    std::vector<Index> reaching;
    for (std::size_t t = 0, k = 0; t < whole.triangles.size(); ++t) {
      while (t >= ends[k]) ++k;
      bool reaches = false;
      tree.for_each_overlap(box_of(t), [&](std::size_t other) {
        reaches = other != k;
        return !reaches;
      });
      if (reaches) reaching.push_back(static_cast<Index>(t));
    }
    return reaching;
  }

  /// A new triangle whose corners are held with a ring around them cannot come back.
  /// @return the patches to make anew.
  std::vector<std::size_t> hold_what_meets(int round) {
    std::vector<std::size_t> open;
    if (patches_.size() == 1) return open;
    const auto meeting = find_what_meets();
    for (std::size_t k = 0; k < patches_.size(); ++k) {
      if (meeting[k].empty()) continue;
      std::vector<Index> corners, originals;
      for (const std::size_t n : meeting[k]) {
        const Cover& cover = done_[k];
        corners.insert(corners.end(), cover.triangles[n].begin(), cover.triangles[n].end());
        originals.insert(originals.end(), cover.originals[n].begin(), cover.originals[n].end());
      }
      std::sort(originals.begin(), originals.end());
      hold(patches_[k], corners, originals, round);
      open.push_back(k);
    }
    return open;
  }

  const DecimateTask& task_;
  std::vector<Vec3> points_;
  std::vector<Patch> patches_;
  std::vector<Cover> done_;
};

}  // namespace

Cover decimate_patchwork(const DecimateTask& task, std::vector<Vec3> points,
                         std::vector<Patch> patches, PatchworkReport& report) {
  return Patchwork(task, std::move(points), std::move(patches)).run(report);
}

}  // namespace mesamis::detail::decimate
