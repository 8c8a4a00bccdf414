// SPDX-License-Identifier: Apache-2.0
#include "mesamis/decimate/patchwork.h"

#include <algorithm>
#include <atomic>
#include <iterator>
#include <mutex>
#include <numeric>
#include <utility>

#include "mesamis/base/parallel.h"
#include "mesamis/surface/farthest.h"
#include "mesamis/surface/self_intersections.h"

namespace mesamis {
namespace {

/// So often patches are made anew.
constexpr int kMostRounds = 8;

class Patchwork {
 public:
  Patchwork(const DecimateTask& task, std::vector<Patch> patches)
      : task_(task), patches_(std::move(patches)), done_(patches_.size()) {}

  Cover run(PatchworkReport& report) {
    std::vector<std::size_t> open(patches_.size());
    std::iota(open.begin(), open.end(), std::size_t{0});
    for (int round = 0; !open.empty(); ++round) {
      decimate(open);
      open = patches_.size() > 1 ? hold_what_does_not_fit(round) : std::vector<std::size_t>{};
      if (round < kMostRounds) continue;
      for (std::size_t k = 0; k < patches_.size(); ++k) done_[k].cover = patches_[k].cover;
      break;
    }
    for (const DecimatedPatch& done : done_) {
      report.passes = std::max(report.passes, done.passes);
      report.points_held += done.points_held;
    }
    return joined();
  }

 private:
  /// A patch alone works in all threads, several in one each: a thread that waited within one would
  /// begin another.
  void decimate(const std::vector<std::size_t>& open) {
    if (open.size() == 1) {
      done_[open[0]] = decimate_patch(task_, patches_[open[0]]);
      return;
    }
    std::mutex telling;
    std::atomic<int> finished = 0;
    DecimateTask task = task_;
    task.progress = [&](double) {
      const std::lock_guard lock(telling);
      task_.progress(finished / static_cast<double>(open.size()));
    };
    parallel_for_each(open.size(), [&](std::size_t i) {
      const std::size_t k = open[i];
      done_[k] = with_threads(1, [&] { return decimate_patch(task, patches_[k]); });
      ++finished;
    });
  }

  Cover joined() const {
    Cover cover;
    for (std::size_t k = 0; k < patches_.size(); ++k) {
      for (Triangle t : done_[k].cover.triangles) {
        for (Index& p : t) p = patches_[k].points[p];
        cover.triangles.push_back(t);
      }
      const auto& originals = done_[k].cover.originals;
      cover.originals.insert(cover.originals.end(), originals.begin(), originals.end());
    }
    return cover;
  }

  /// @return the patches to make anew.
  std::vector<std::size_t> hold_what_does_not_fit(int round) {
    const TriMesh surface{task_.surface.points, joined().triangles};
    std::vector<std::vector<Index>> unfit(patches_.size());  // originals
    find_what_meets(surface, unfit);
    find_what_is_too_far(surface, unfit);
    std::vector<std::size_t> open;
    for (std::size_t k = 0; k < patches_.size(); ++k) {
      if (unfit[k].empty()) continue;
      std::sort(unfit[k].begin(), unfit[k].end());
      hold_what_stands_for(patches_[k], unfit[k], 1 + round);
      open.push_back(k);
    }
    return open;
  }

  static bool is_new(const Triangle& t, const Patch& patch) {
    const auto is_same = [&t](const Triangle& before) {
      return std::is_permutation(t.begin(), t.end(), before.begin());
    };
    return std::none_of(patch.cover.triangles.begin(), patch.cover.triangles.end(), is_same);
  }

  /// New triangles that intersect those of other patches.
  void find_what_meets(const TriMesh& surface, std::vector<std::vector<Index>>& unfit) const {
    std::vector<std::size_t> ends;  // of the patches' triangles in the surface
    for (const DecimatedPatch& done : done_) {
      ends.push_back((ends.empty() ? 0 : ends.back()) + done.cover.triangles.size());
    }
    const auto patch_of = [&ends](Index t) {
      return static_cast<std::size_t>(
          std::upper_bound(ends.begin(), ends.end(), static_cast<std::size_t>(t)) - ends.begin());
    };
    for (const auto& pair : find_self_intersections(surface)) {
      if (patch_of(pair[0]) == patch_of(pair[1])) continue;  // the patch has seen it: it was so before
      for (const Index t : pair) {
        const std::size_t k = patch_of(t);
        const Cover& cover = done_[k].cover;
        const std::size_t n = static_cast<std::size_t>(t) + cover.triangles.size() - ends[k];
        if (!is_new(cover.triangles[n], patches_[k])) continue;
        unfit[k].insert(unfit[k].end(), cover.originals[n].begin(), cover.originals[n].end());
      }
    }
  }

  /// Originals that several patches stand for.
  void find_what_is_too_far(const TriMesh& surface, std::vector<std::vector<Index>>& unfit) const {
    const bool any = std::any_of(done_.begin(), done_.end(),
                                 [](const DecimatedPatch& done) { return !done.in_part.empty(); });
    if (!any) return;
    const TriangleTree tree(surface);
    std::size_t hint = 0;
    for (std::size_t k = 0; k < done_.size(); ++k) {
      for (const Index t : done_[k].in_part) {
        const Corners corners = corners_of(task_.surface, task_.surface.triangles[t]);
        const Enough enough{task_.tolerance, task_.tolerance};
        if (farthest_distance(corners, tree, enough, hint) > task_.tolerance) {
          unfit[k].push_back(t);
        }
      }
    }
  }

  const DecimateTask& task_;
  std::vector<Patch> patches_;
  std::vector<DecimatedPatch> done_;
};

}  // namespace

Cover decimate_patchwork(const DecimateTask& task, std::vector<Patch> patches,
                         PatchworkReport& report) {
  return Patchwork(task, std::move(patches)).run(report);
}

}  // namespace mesamis
