// SPDX-License-Identifier: Apache-2.0
#include "mesamis/decimate/collapse_intersections.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "mesamis/mesh/tet_mesh.h"
#include "mesamis/surface/triangle_intersection.h"

namespace mesamis::detail::decimate {
namespace {

/// What parts a triangle from most of those around it: its plane, and that through the side opposite
/// to its first corner across it.
class Partition {
 public:
  explicit Partition(const Corners& t)
      : at_(t[1]), normal_(cross(t[1] - t[0], t[2] - t[0])), outward_(cross(t[2] - t[1], normal_)) {
    const double size = norm(t[2] - t[1]) + norm(t[1] - t[0]);
    height_ = kMargin * norm(normal_) * size;
    distance_ = kMargin * norm(outward_) * size;
  }
  /// Whether another triangle lies above, below, or beyond, but for the corners that both have: then
  /// these alone are common.
  bool parts(const Triangle& own, const Triangle& other, const Corners& corners) const {
    bool above = true, below = true, beyond = true;
    for (std::size_t i = 0; i < 3; ++i) {
      const bool at_side = other[i] == own[1] || other[i] == own[2];
      if (at_side) continue;
      const double side = dot(outward_, corners[i] - at_);
      beyond &= side > distance_;
      if (other[i] == own[0]) continue;
      const double height = dot(normal_, corners[i] - at_);
      above &= height > height_;
      below &= height < -height_;
    }
    return above || below || beyond;
  }

 private:
  static constexpr double kMargin = 1e-9;  // far above rounding
  Vec3 at_, normal_, outward_;
  double height_, distance_;
};

std::vector<Box> boxes_of(const EditableSurface& surface, const std::vector<Vec3>& points) {
  std::vector<Box> boxes;
  for (Index t = 0; t < surface.count(); ++t) {
    const Triangle k = surface.triangle(t);
    boxes.push_back(bounding_box(Corners{points[k[0]], points[k[1]], points[k[2]]}));
  }
  return boxes;
}

}  // namespace

CollapseIntersections::CollapseIntersections(const EditableSurface& surface,
                                             const std::vector<Vec3>& points,
                                             std::vector<Index> first_copies)
    : first_copies_(std::move(first_copies)), tree_(boxes_of(surface, points)) {}

bool CollapseIntersections::meets(const std::vector<Vec3>& points, const Triangle& a,
                                  const Triangle& b) const {
  if (first_copies_.empty()) return intersect(points, a, b);
  const auto first = [this](const Triangle& t) {
    return Triangle{first_copies_[t[0]], first_copies_[t[1]], first_copies_[t[2]]};
  };
  return intersect(points, first(a), first(b));
}

/// The triangles that stay and reach into a box.
template <class Changes>
void CollapseIntersections::look_near(const EditableSurface& surface,
                                      const std::vector<Vec3>& points, const Box& whole,
                                      Changes&& changes) {
  near_.clear();
  tree_.for_each_overlap(whole, [&](std::size_t other) {
    const auto t = static_cast<Index>(other);
    if (changes(t)) return true;
    const Triangle k = surface.triangle(t);
    const Corners corners{points[k[0]], points[k[1]], points[k[2]]};
    near_.push_back({k, corners, bounding_box(corners)});
    return true;
  });
}

bool CollapseIntersections::meets_others(const std::vector<Vec3>& points,
                                         const Changed& own) const {
  if (!has_area(points, own.triangle)) return true;
  const Box box = bounding_box(own.corners);
  const Partition partition(own.corners);
  return std::any_of(near_.begin(), near_.end(), [&](const Near& other) {
    return overlap(box, other.box) &&
           !partition.parts(own.triangle, other.triangle, other.corners) &&
           meets(points, own.triangle, other.triangle);
  });
}

bool CollapseIntersections::occur(const EditableSurface& surface, std::vector<Vec3>& points,
                                  std::span<const Collapse> collapses) {
  Box whole = kNoBox;
  for (const Collapse& collapse : collapses) {
    for (const Corners& t : collapse.after) whole = united(whole, bounding_box(t));
  }
  look_near(surface, points, whole, [&collapses](Index t) {
    return std::any_of(collapses.begin(), collapses.end(), [t](const Collapse& c) {
      return t == c.beside[0] || t == c.beside[1] ||
             std::find(c.faces.begin(), c.faces.end(), t) != c.faces.end();
    });
  });
  before_.clear();
  changed_.clear();
  for (const Collapse& collapse : collapses) {
    before_.push_back(std::exchange(points[collapse.kept], collapse.place));
  }
  bool found = false;
  for (std::size_t c = 0; c < collapses.size() && !found; ++c) {
    const Collapse& collapse = collapses[c];
    const bool folds = std::isinf(collapse.height);  // at rims always
    for (std::size_t i = 0; i < collapse.faces.size() && !found; ++i) {
      const Index h = collapse.outer[i];
      const Changed own{{collapse.kept, surface.from(h), surface.to(h)}, collapse.after[i]};
      found = meets_others(points, own) ||
              (folds && std::any_of(changed_.begin(), changed_.end(), [&](const Changed& other) {
                 return meets(points, own.triangle, other.triangle);
               }));
      changed_.push_back(own);
    }
  }
  for (std::size_t c = 0; c < collapses.size(); ++c) points[collapses[c].kept] = before_[c];
  return found;
}

bool CollapseIntersections::occur(const EditableSurface& surface, const std::vector<Vec3>& points,
                                  const Flip& flip) {
  const auto [t, u] = flip.faces;
  look_near(surface, points, united(bounding_box(flip.after[0]), bounding_box(flip.after[1])),
            [&flip](Index k) { return k == flip.faces[0] || k == flip.faces[1]; });
  const Changed one{surface.triangle(t), flip.after[0]}, other{surface.triangle(u), flip.after[1]};
  return meets_others(points, one) || meets_others(points, other) ||
         meets(points, one.triangle, other.triangle);
}

void CollapseIntersections::apply(const Flip& flip) {
  for (std::size_t i = 0; i < flip.faces.size(); ++i) {
    tree_.update(static_cast<std::size_t>(flip.faces[i]), bounding_box(flip.after[i]));
  }
}

void CollapseIntersections::apply(const Collapse& collapse) {
  for (const Index t : collapse.gone()) tree_.update(static_cast<std::size_t>(t), kNoBox);
  for (std::size_t i = 0; i < collapse.faces.size(); ++i) {
    tree_.update(static_cast<std::size_t>(collapse.faces[i]), bounding_box(collapse.after[i]));
  }
}

}  // namespace mesamis::detail::decimate
