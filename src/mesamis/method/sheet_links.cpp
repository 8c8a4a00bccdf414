// SPDX-License-Identifier: Apache-2.0
#include "mesamis/method/sheet_links.h"

#include <algorithm>
#include <array>
#include <functional>
#include <map>

#include "mesamis/base/each_once.h"
#include "mesamis/fit/surface_moves.h"

namespace mesamis::detail::method {
namespace {

/// Least cosines between the normals of sheets that go on: of the smoothest, and of another.
constexpr double kSmooth = 0.52, kSmoothToo = 0.6;

using Materials = std::vector<Index>;
using Sides = std::span<const std::array<Index, 2>>;

std::vector<Materials> materials_of_points(const TriMesh& surface, Sides sides) {
  std::vector<Materials> found(surface.points.size());
  for (std::size_t t = 0; t < sides.size(); ++t) {
    for (const Index p : surface.triangles[t]) {
      for (const Index m : sides[t]) add_once(found[p], m);
    }
  }
  for (Materials& materials : found) std::ranges::sort(materials);
  return found;
}

bool has(const Materials& materials, Index m) { return std::ranges::count(materials, m) > 0; }

/// How alike the normals of a material's two sheets are over the curves of three materials.
struct Turns {
  std::array<double, 3> cosines{};  // sums
  int points = 0;

  double cosine(std::size_t material) const { return cosines[material] / points; }
};

class SheetLinker {
 public:
  SheetLinker(const TriMesh& surface, Sides sides, const std::vector<char>& on_curve, Through which)
      : neighbors_(surface),
        on_curve_(on_curve),
        which_(which),
        materials_(materials_of_points(surface, sides)),
        normals_(smoothed_normals(surface, neighbors_, on_curve)) {
    for (std::size_t p = 0; p < on_curve_.size(); ++p) add_turns(p);
  }

  Links links() const {
    Links links = links_along_curves(neighbors_, on_curve_);
    for (std::size_t p = 0; p < on_curve_.size(); ++p) {
      const Materials through = materials_through(p);
      if (through.empty()) continue;
      for (std::size_t n = neighbors_.start[p]; n < neighbors_.start[p + 1]; ++n) {
        const Index q = neighbors_.points[n];
        links[n] = has(materials_[q], through[0]) ? kLinked : 0;
        if (which_ == Through::kSmoothest) continue;
        const bool other = through.size() > 1 ? has(materials_[q], through[1]) : on_curve_[q] != 0;
        if (other) links[n] |= kLinkedOther;
      }
    }
    return links;
  }

 private:
  bool joins_three(std::size_t p) const { return on_curve_[p] != 0 && materials_[p].size() == 3; }

  /// The mean normal beside a point of the sheet between two materials, towards the second; 0: none.
  Vec3 sheet_normal(std::size_t p, Index behind, Index front) const {
    const Materials sides{std::min(behind, front), std::max(behind, front)};
    Vec3 sum;
    for (std::size_t n = neighbors_.start[p]; n < neighbors_.start[p + 1]; ++n) {
      const Index q = neighbors_.points[n];
      if (on_curve_[q] == 0 && materials_[q] == sides) sum += normals_[q];
    }
    return (behind < front ? 1 : -1) * unit_or_zero(sum);
  }

  void add_turns(std::size_t p) {
    if (!joins_three(p)) return;
    const Materials& m = materials_[p];
    Turns& turns = turns_[m];
    ++turns.points;
    for (std::size_t i = 0; i < 3; ++i) {
      turns.cosines[i] +=
          dot(sheet_normal(p, m[i], m[(i + 1) % 3]), sheet_normal(p, m[i], m[(i + 2) % 3]));
    }
  }

  /// Those whose boundaries go on through a point, the smoothest first: two at most, as the three
  /// cosines of unit vectors add up to 1.5 at most.
  Materials materials_through(std::size_t p) const {
    Materials through;
    if (!joins_three(p)) return through;
    const Turns& turns = turns_.at(materials_[p]);
    std::array<std::size_t, 3> order{0, 1, 2};
    std::ranges::sort(order, std::greater{}, [&](std::size_t i) { return turns.cosine(i); });
    if (turns.cosine(order[0]) > kSmooth) through.push_back(materials_[p][order[0]]);
    if (turns.cosine(order[1]) > kSmoothToo) through.push_back(materials_[p][order[1]]);
    return through;
  }

  Neighbors neighbors_;
  const std::vector<char>& on_curve_;
  Through which_;
  std::vector<Materials> materials_;
  std::vector<Vec3> normals_;
  std::map<Materials, Turns> turns_;
};

}  // namespace

Links sheet_links(const TriMesh& surface, Sides sides, const std::vector<char>& on_curve,
                  Through which) {
  return SheetLinker(surface, sides, on_curve, which).links();
}

}  // namespace mesamis::detail::method
