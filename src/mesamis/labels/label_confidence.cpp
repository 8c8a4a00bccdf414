// SPDX-License-Identifier: Apache-2.0
#include "mesamis/labels/label_confidence.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>

#include "mesamis/base/error.h"
#include "mesamis/base/parallel.h"
#include "mesamis/base/types.h"

namespace mesamis::detail::labels {
namespace {

constexpr double kLeast = 0.005;  // so that what lies between two edges goes where most labels say
constexpr double kSlope = 0.03;   // weight half way to the middle
constexpr double kBesideThin = 1.5;  // steps: margin beside what is thinner than that

constexpr float kFall = 0.4F;             // steps, by which the depth falls beside a middle
constexpr double kWrongLabels = 4;        // ridges of fewer labels may be an error
constexpr Index kMixed = -1;              // no label
constexpr double kLabelsPerMargin = 0.4;  // a label's side, see label_margin()

using Place = std::array<Index, 3>;

/// A step between nodes.
struct Step {
  Place by{};
  std::ptrdiff_t to = 0;  // among the nodes
  float mm = 0;           // from the centre of a voxel to where the other begins
};

Index most_of(const Place& by) {
  return std::max({std::abs(by[0]), std::abs(by[1]), std::abs(by[2])});
}

class Depths {
 public:
  Depths(const LabelGrid& grid, double margin, std::span<const LabelPair> unseen)
      : grid_(grid),
        unseen_(unseen),
        step_(static_cast<float>(std::min({grid.spacing.x, grid.spacing.y, grid.spacing.z}))),
        margin_(static_cast<float>(margin)),
        sweeps_(static_cast<int>(std::ceil(margin / step_))) {
    for (std::size_t a = 0; a < 3; ++a) {
      const double steps = margin / grid.spacing[static_cast<int>(a)];
      steps_of_ball_[a] = std::max(1, static_cast<Index>(std::lround(steps)));
    }
    list_steps();
  }

  std::vector<float> confidence() const {
    std::vector<char> at_unseen(grid_.labels.size(), 0);
    const std::vector<float> depth = depths(at_unseen);
    std::vector<float> middle = depth;
    parallel_for(middle.size(), [&](std::size_t n) {
      if (grid_.labels[n] == 0) middle[n] = margin_;
    });
    for (int sweep = 0; sweep < sweeps_; ++sweep) middle = swept(middle, /*within_label=*/true);
    const std::vector<float> zone = thin_beside(middle);
    const std::vector<std::uint8_t> ridge = large_ridges(depth);
    std::vector<float> weight(depth.size());
    parallel_for(weight.size(), [&](std::size_t n) {
      const bool certain = ridge[n] != 0 || at_unseen[n] != 0;
      weight[n] = certain ? kCertain : weight_of(depth[n], zone[n]);
    });
    return weight;
  }

 private:
  /// The voxels that begin within the margin, the nearest first, and those around a voxel.
  void list_steps() {
    const Place& most = steps_of_ball_;
    for (Index k = -most[2]; k <= most[2]; ++k) {
      for (Index j = -most[1]; j <= most[1]; ++j) {
        for (Index i = -most[0]; i <= most[0]; ++i) {
          const Step s = step_by({i, j, k});
          if (s.to == 0) continue;
          if (s.mm < margin_) ball_.push_back(s);
          if (most_of(s.by) == 1) around_.push_back(s);
        }
      }
    }
    std::stable_sort(ball_.begin(), ball_.end(),
                     [](const Step& a, const Step& b) { return a.mm < b.mm; });
  }

  Step step_by(const Place& by) const {
    if (by == Place{}) return {};
    const Vec3 d{by[0] * grid_.spacing.x, by[1] * grid_.spacing.y, by[2] * grid_.spacing.z};
    const double share = 1 - 0.5 / most_of(by);
    return {by, offset_of(by), static_cast<float>(share * norm(d))};
  }

  std::ptrdiff_t offset_of(const Place& by) const {
    const std::ptrdiff_t row = grid_.size[0];
    return by[0] + row * (by[1] + static_cast<std::ptrdiff_t>(grid_.size[1]) * by[2]);
  }

  bool is_inside(const Place& p) const {
    for (std::size_t a = 0; a < 3; ++a) {
      if (p[a] < 0 || p[a] >= grid_.size[a]) return false;
    }
    return true;
  }

  template <class Body>
  void for_each_node(Body&& body) const {
    const auto rows =
        static_cast<std::size_t>(grid_.size[1]) * static_cast<std::size_t>(grid_.size[2]);
    parallel_blocks(rows, 16, [&](std::size_t begin, std::size_t end) {
      for (std::size_t row = begin; row < end; ++row) {
        const auto j = static_cast<Index>(row % static_cast<std::size_t>(grid_.size[1]));
        const auto k = static_cast<Index>(row / static_cast<std::size_t>(grid_.size[1]));
        for (Index i = 0; i < grid_.size[0]; ++i) {
          body(row * static_cast<std::size_t>(grid_.size[0]) + static_cast<std::size_t>(i),
               Place{i, j, k});
        }
      }
    });
  }

  static Place moved(const Place& p, const Place& by) {
    return {p[0] + by[0], p[1] + by[1], p[2] + by[2]};
  }

  /// Nodes of a line that see another label: their run of equal labels ends within so many steps.
  /// They become kMixed; the end of the grid ends no run.
  void mix_line(std::vector<Index>& labels, std::size_t first, std::size_t stride, Index count,
                Index steps) const {
    const auto at = [&](Index i) -> Index& {
      return labels[first + static_cast<std::size_t>(i) * stride];
    };
    for (Index begin = 0, end; begin < count; begin = end) {
      const Index label = at(begin);
      for (end = begin + 1; end < count && at(end) == label;) ++end;
      const Index from = begin == 0 ? 0 : begin + steps, to = end == count ? count : end - steps;
      for (Index i = begin; i < end; ++i) {
        if (i < from || i >= to) at(i) = kMixed;
      }
    }
  }

  /// The labels of nodes around which the box of the margin holds no other; kMixed elsewhere. Axis
  /// after axis: the box is of one label if its lines are, and these agree.
  std::vector<Index> uniform_labels() const {
    std::vector<Index> labels(grid_.labels.begin(), grid_.labels.end());
    std::size_t stride = 1;
    for (std::size_t a = 0; a < 3; ++a) {
      const auto count = static_cast<std::size_t>(grid_.size[a]);
      parallel_for_each(labels.size() / (count * stride), [&](std::size_t slab) {
        for (std::size_t n = 0; n < stride; ++n) {
          mix_line(labels, slab * count * stride + n, stride, grid_.size[a], steps_of_ball_[a]);
        }
      });
      stride *= count;
    }
    return labels;
  }

  bool is_unseen(Index label, Index other) const {
    return std::any_of(unseen_.begin(), unseen_.end(), [&](const LabelPair& pair) {
      return pair == LabelPair{label, other} || pair == LabelPair{other, label};
    });
  }

  /// To where the nearest voxel of another label begins; at most the margin.
  /// @param at_unseen  1 where the image shows nothing between the two.
  std::vector<float> depths(std::vector<char>& at_unseen) const {
    const std::vector<Index> uniform = uniform_labels();
    std::vector<float> depth(grid_.labels.size());
    for_each_node([&](std::size_t n, const Place& p) {
      if (uniform[n] != kMixed) {
        depth[n] = margin_;
        return;
      }
      const auto other = std::find_if(ball_.begin(), ball_.end(), [&](const Step& s) {
        return is_inside(moved(p, s.by)) &&
               grid_.labels[n + static_cast<std::size_t>(s.to)] != grid_.labels[n];
      });
      depth[n] = other == ball_.end() ? margin_ : other->mm;
      if (other == ball_.end() || unseen_.empty()) return;
      const std::size_t m = n + static_cast<std::size_t>(other->to);
      at_unseen[n] = is_unseen(grid_.labels[n], grid_.labels[m]) ? 1 : 0;
    });
    return depth;
  }

  /// The greatest value of the neighbours, those of the same label; or the least of all.
  std::vector<float> swept(const std::vector<float>& value, bool within_label) const {
    std::vector<float> out(value.size());
    for_each_node([&](std::size_t n, const Place& p) {
      float best = value[n];
      if (within_label && best >= margin_) {
        out[n] = best;
        return;
      }
      for (const Step& s : around_) {
        const std::size_t m = n + static_cast<std::size_t>(s.to);
        if (!is_inside(moved(p, s.by))) continue;
        if (!within_label)
          best = std::min(best, value[m]);
        else if (grid_.labels[m] == grid_.labels[n])
          best = std::max(best, value[m]);
      }
      out[n] = best;
    });
    return out;
  }

  /// Whether a voxel is the middle of something thin: along one axis the depth falls to both sides,
  /// at once or a voxel later.
  bool is_ridge(std::size_t n, const Place& p, const std::vector<float>& depth) const {
    if (grid_.labels[n] == 0 || depth[n] >= margin_) return false;
    const auto falls = [&](const Place& to) {
      if (!is_inside(to)) return false;
      const std::size_t m = node_at(to);
      return grid_.labels[m] != grid_.labels[n] || depth[m] <= depth[n] - kFall * step_;
    };
    for (std::size_t a = 0; a < 3; ++a) {
      const auto at = [&](Index by) {
        Place to = p;
        to[a] += by;
        return to;
      };
      const bool before = falls(at(-1)), after = falls(at(1));
      if ((before && (after || falls(at(2)))) || (after && falls(at(-2)))) return true;
    }
    return false;
  }

  /// The ridges that are larger than what a few wrong labels make: 1 there, else 0.
  std::vector<std::uint8_t> large_ridges(const std::vector<float>& depth) const {
    std::vector<std::uint8_t> ridge(depth.size());
    for_each_node([&](std::size_t n, const Place& p) { ridge[n] = is_ridge(n, p, depth) ? 1 : 0; });
    const Vec3& h = grid_.spacing;
    const double wrong = kWrongLabels * std::pow(kLabelsPerMargin * margin_, 3) / (h.x * h.y * h.z);
    std::vector<std::size_t> part;
    for (std::size_t n = 0; n < ridge.size(); ++n) {
      if (ridge[n] != 1) continue;
      part.assign(1, n);
      ridge[n] = 2;
      for (std::size_t next = 0; next < part.size(); ++next) spread(part[next], ridge, part);
      if (static_cast<double>(part.size()) >= wrong) continue;
      for (const std::size_t m : part) ridge[m] = 0;
    }
    return ridge;
  }

  /// Adds the marked neighbours of the same label to a part and marks them as seen.
  void spread(std::size_t n, std::vector<std::uint8_t>& ridge,
              std::vector<std::size_t>& part) const {
    const Place p = grid_place(grid_.size, n);
    for (const Step& s : around_) {
      if (!is_inside(moved(p, s.by))) continue;
      const std::size_t m = n + static_cast<std::size_t>(s.to);
      if (ridge[m] != 1 || grid_.labels[m] != grid_.labels[n]) continue;
      ridge[m] = 2;
      part.push_back(m);
    }
  }

  std::size_t node_at(const Place& p) const { return static_cast<std::size_t>(offset_of(p)); }

  /// The depth of the middle, but beside what is thin no more than kBesideThin steps.
  std::vector<float> thin_beside(const std::vector<float>& middle) const {
    std::vector<float> least = middle;
    for (int sweep = 0; sweep < sweeps_; ++sweep) least = swept(least, false);
    std::vector<float> zone(middle.size());
    const auto beside = std::min(margin_, static_cast<float>(kBesideThin * step_));
    parallel_for(zone.size(),
                 [&](std::size_t n) { zone[n] = std::min(middle[n], std::max(least[n], beside)); });
    return zone;
  }

  static float weight_of(float depth, float zone) {
    const double r = std::min(1.0, static_cast<double>(depth) / zone);
    if (r >= 1) return kCertain;
    const double odds = r / (1 - r);
    return static_cast<float>(std::min<double>(kCertain, kLeast + kSlope * odds * odds));
  }

  const LabelGrid& grid_;
  std::span<const LabelPair> unseen_;
  float step_;  // the shortest
  float margin_;
  int sweeps_;
  Place steps_of_ball_{};  // within the margin, at least one
  std::vector<Step> ball_, around_;
};

}  // namespace

std::vector<float> label_confidence(const LabelGrid& grid, double margin,
                                    std::span<const LabelPair> unseen) {
  const std::size_t nodes = grid.node_count();
  if (grid.labels.size() != nodes) {
    throw InputError("labels: expected " + std::to_string(nodes) + " of them, found " +
                     std::to_string(grid.labels.size()));
  }
  if (!(margin > 0) || !std::isfinite(margin)) {
    throw InputError("margin of labels: expected more than 0 mm, found " + std::to_string(margin));
  }
  return Depths(grid, margin, unseen).confidence();
}

}  // namespace mesamis::detail::labels
