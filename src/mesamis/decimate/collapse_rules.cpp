// SPDX-License-Identifier: Apache-2.0
#include "mesamis/decimate/collapse_rules.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "mesamis/decimate/crease.h"
#include "mesamis/decimate/fan_distance.h"
#include "mesamis/mesh/tet_mesh.h"
#include "mesamis/surface/triangle_intersection.h"

namespace mesamis {
namespace {

/// Height over longest side: a collapse may not make a triangle flatter than this and than the
/// flattest one it starts from.
constexpr double kFlattest = 0.01;

Star star_of(const HalfedgeMesh& mesh, const CollapseInfo& collapse) {
  Star star;
  for (auto f = mesh.cvf_iter(collapse.v0); f.is_valid(); ++f) {
    if (*f == collapse.fl || *f == collapse.fr) continue;
    star.faces.push_back(*f);
    Triangle t = corner_indices(mesh, *f);
    star.before.push_back(t);
    std::replace(t.begin(), t.end(), Index{collapse.v0.idx()}, Index{collapse.v1.idx()});
    star.after.push_back(t);
  }
  return star;
}

/// Height over longest side, squared.
double flatness(const std::vector<Vec3>& p, const Triangle& t) {
  const Vec3 a = p[t[1]] - p[t[0]], b = p[t[2]] - p[t[1]], c = p[t[0]] - p[t[2]];
  const double longest = std::max({dot(a, a), dot(b, b), dot(c, c)});
  const Vec3 n = cross(a, b);
  return longest > 0 ? dot(n, n) / (longest * longest) : 0;
}

/// The normals of the triangles around the point to be removed, one per edge of its ring, from the
/// point on that it is collapsed to.
struct Fan {
  std::vector<Vec3> before;
  std::vector<Vec3> after;   ///< of the triangle that is there instead; of the first and the last,
                             ///< which go, the neighbour's beyond the ring
  std::vector<Vec3> beyond;  ///< of the neighbour beyond the ring; zero: there is none

  bool has_beyond(std::size_t i) const { return norm(beyond[i]) > 0; }
};

Fan fan_of(const HalfedgeMesh& mesh, const std::vector<Vec3>& points,
           const CollapseInfo& collapse) {
  const auto normal = [&](OpenMesh::VertexHandle a, OpenMesh::VertexHandle b,
                          OpenMesh::VertexHandle c) {
    return unit_normal({points[index(a)], points[index(b)], points[index(c)]});
  };
  Fan fan;
  auto h = collapse.v0v1;
  do {
    const auto rim = mesh.next_halfedge_handle(h), across = mesh.opposite_halfedge_handle(rim);
    const auto a = mesh.from_vertex_handle(rim), b = mesh.to_vertex_handle(rim);
    fan.before.push_back(normal(collapse.v0, a, b));
    fan.after.push_back(normal(collapse.v1, a, b));
    fan.beyond.push_back(
        mesh.face_handle(across).is_valid()
            ? normal(b, a, mesh.to_vertex_handle(mesh.next_halfedge_handle(across)))
            : Vec3{});
    h = mesh.ccw_rotated_halfedge_handle(h);
  } while (h != collapse.v0v1);
  fan.after.front() = fan.beyond.front();
  fan.after.back() = fan.beyond.back();
  return fan;
}

}  // namespace

float ModFlatness::collapse_priority(const CollapseInfo& collapse) {
  const Star star = star_of(mesh(), collapse);
  double least = kFlattest * kFlattest;
  for (const Triangle& t : star.before) least = std::min(least, flatness(points(), t));
  for (const Triangle& t : star.after) {
    if (flatness(points(), t) < least || !has_area(points(), t)) return ILLEGAL_COLLAPSE;
  }
  return LEGAL_COLLAPSE;
}

float ModCreases::collapse_priority(const CollapseInfo& collapse) {
  const Fan fan = fan_of(mesh(), points(), collapse);
  const std::size_t n = fan.before.size();
  double sharpest = 1;
  for (std::size_t i = 0; i < n; ++i) {
    sharpest = std::min(sharpest, dot(fan.before[i], fan.before[(i + 1) % n]));
    if (fan.has_beyond(i)) sharpest = std::min(sharpest, dot(fan.before[i], fan.beyond[i]));
  }
  const auto bends = [&](const Vec3& one, const Vec3& other) {
    return norm(one) > 0 && norm(other) > 0 && makes_crease(sharpest, dot(one, other));
  };
  for (std::size_t i = 0; i + 1 < n; ++i) {
    if (bends(fan.after[i], fan.after[i + 1])) return ILLEGAL_COLLAPSE;
    if (i > 0 && bends(fan.after[i], fan.beyond[i])) return ILLEGAL_COLLAPSE;
  }
  return LEGAL_COLLAPSE;
}

float ModRims::collapse_priority(const CollapseInfo& collapse) {
  if (at_rim_[index(collapse.v1)] == 0) return LEGAL_COLLAPSE;
  for (auto v = mesh().cvv_iter(collapse.v0); v.is_valid(); ++v) {
    const bool is_joined = *v == collapse.v1 || *v == collapse.vl || *v == collapse.vr;
    if (!is_joined && at_rim_[index(*v)] != 0) return ILLEGAL_COLLAPSE;
  }
  return LEGAL_COLLAPSE;
}

void ModHausdorff::set_task(const DecimateTask& task, const TriMesh& surface, const Patch& patch) {
  task_ = &task;
  surface_ = &surface;
  patch_ = &patch;
  of_face_ = patch.cover.originals;
  drift_ = patch.cover.drift;
  hint_.assign(surface.points.size(), 0);
}

std::vector<Index> ModHausdorff::originals_of(OpenMesh::FaceHandle f) const {
  std::vector<Index> originals = of_face_[index(f)];
  std::sort(originals.begin(), originals.end());
  originals.erase(std::unique(originals.begin(), originals.end()), originals.end());
  return originals;
}

double ModHausdorff::drift_of(OpenMesh::FaceHandle f) const { return drift_[index(f)]; }

float ModHausdorff::collapse_priority(const CollapseInfo& collapse) {
  if (std::isinf(task_->tolerance)) return LEGAL_COLLAPSE;
  const Star star = star_of(mesh(), collapse);
  if (!removed_is_near(collapse, star)) return ILLEGAL_COLLAPSE;
  const bool near = drift_after(collapse) <= task_->tolerance ||
                    (!task_->quick && old_are_near(collapse, star) && new_are_near(collapse, star));
  return near ? LEGAL_COLLAPSE : ILLEGAL_COLLAPSE;
}

void ModHausdorff::preprocess_collapse(const CollapseInfo& collapse) {
  if (std::isinf(task_->tolerance)) return;
  if (!task_->quick) waiting_ = listed_around(collapse);
  next_drift_ = drift_after(collapse);
  for (auto f = mesh().cvf_iter(collapse.v0); f.is_valid(); ++f) of_face_[index(*f)].clear();
  star_ = star_of(mesh(), collapse);
}

void ModHausdorff::postprocess_collapse(const CollapseInfo&) {
  if (std::isinf(task_->tolerance)) return;
  for (const auto f : star_.faces) drift_[index(f)] = next_drift_;
  for (const Index t : waiting_) {
    const Corners c = original(t);
    for (const Vec3& p : {c[0], c[1], c[2], (1.0 / 3) * (c[0] + c[1] + c[2])}) list(t, p);
  }
}

/// How far the new triangles will have drifted at most. The fans before and after lie above each
/// other: as far as they are apart comes on top of what the triangles before have drifted.
double ModHausdorff::drift_after(const CollapseInfo& collapse) {
  std::vector<Vec3> ring;
  double before = 0;
  auto h = collapse.v0v1;
  do {
    ring.push_back(surface_->points[index(mesh().to_vertex_handle(h))]);
    before = std::max(before, drift_[index(mesh().face_handle(h))]);
    h = mesh().ccw_rotated_halfedge_handle(h);
  } while (h != collapse.v0v1);
  if (std::isinf(before)) return before;
  const double drift = before + fan_distance(surface_->points[index(collapse.v0)], ring);
  return kDistanceSlack * drift <= task_->tolerance ? drift : kFar;
}

/// The originals listed around the point to be removed, each once.
std::vector<Index> ModHausdorff::listed_around(const CollapseInfo& collapse) {
  std::vector<Index> all;
  for (auto f = mesh().cvf_iter(collapse.v0); f.is_valid(); ++f) {
    all.insert(all.end(), of_face_[index(*f)].begin(), of_face_[index(*f)].end());
  }
  std::sort(all.begin(), all.end());
  all.erase(std::unique(all.begin(), all.end()), all.end());
  return all;
}

/// Lists t with the new triangle that is nearest to p.
void ModHausdorff::list(Index t, const Vec3& p) {
  std::size_t nearest = 0;
  double least = kFar;
  for (std::size_t i = 0; i < star_.after.size(); ++i) {
    const double d = squared_distance(p, shape(star_.after[i]));
    if (d >= least) continue;
    least = d;
    nearest = i;
  }
  std::vector<Index>& own = of_face_[index(star_.faces[nearest])];
  if (own.empty() || own.back() != t) own.push_back(t);
}

/// The cheapest test.
bool ModHausdorff::removed_is_near(const CollapseInfo& collapse, const Star& star) const {
  const Vec3& p = surface_->points[index(collapse.v0)];
  return std::any_of(star.after.begin(), star.after.end(), [&](const Triangle& t) {
    return squared_distance(p, shape(t)) <= task_->tolerance * task_->tolerance;
  });
}

/// The most expensive test, which hardly ever refuses what passed the others.
bool ModHausdorff::new_are_near(const CollapseInfo& collapse, const Star& star) {
  std::size_t& hint = hint_[index(collapse.v0)];
  const TriangleTree& tree = task_->tree_at(patch_->points[index(collapse.v0)]);
  return std::all_of(star.after.begin(), star.after.end(), [&](const Triangle& t) {
    return farthest_distance(shape(t), tree, enough(), hint) <= task_->tolerance;
  });
}

bool ModHausdorff::old_are_near(const CollapseInfo& collapse, const Star& star) {
  std::vector<Index> open = listed_around(collapse);
  std::erase_if(open, [&](Index t) { return is_near_one(original(t), star.after); });
  if (open.empty()) return true;
  const TriangleTree after(surroundings(collapse, star));
  std::size_t hint = 0;
  return std::all_of(open.begin(), open.end(), [&](Index t) {
    return farthest_distance(original(t), after, enough(), hint) <= task_->tolerance;
  });
}

/// Whether the whole triangle is near one of the others. The distance to one triangle is convex:
/// its maximum is at a corner. Most triangles pass here and need no search.
bool ModHausdorff::is_near_one(const Corners& triangle, const std::vector<Triangle>& others) const {
  const double most = task_->tolerance * task_->tolerance;
  return std::any_of(others.begin(), others.end(), [&](const Triangle& t) {
    const Corners other = shape(t);
    return std::all_of(triangle.begin(), triangle.end(),
                       [&](const Vec3& p) { return squared_distance(p, other) <= most; });
  });
}

/// The triangles after the collapse, those of the ring's other points included.
std::vector<Corners> ModHausdorff::surroundings(const CollapseInfo& collapse, const Star& star) {
  std::vector<Triangle> triangles = star.after;
  for (auto v = mesh().cvv_iter(collapse.v0); v.is_valid(); ++v) {
    for (auto f = mesh().cvf_iter(*v); f.is_valid(); ++f) {
      const Triangle t = corner_indices(mesh(), *f);
      if (std::find(t.begin(), t.end(), collapse.v0.idx()) == t.end()) triangles.push_back(t);
    }
  }
  std::vector<Corners> corners;
  corners.reserve(triangles.size());
  for (const Triangle& t : triangles) corners.push_back(shape(t));
  return corners;
}

void ModIntersection::set_surface(const TriMesh& surface, std::vector<Index> first_copies) {
  points_ = &surface.points;
  first_copies_ = std::move(first_copies);
  std::vector<Box> boxes;
  for (const Triangle& t : surface.triangles) boxes.push_back(box(t));
  tree_ = std::make_unique<BoxTree>(boxes);
}

float ModIntersection::collapse_priority(const CollapseInfo& collapse) {
  const Star star = star_of(mesh(), collapse);
  for (std::size_t i = 0; i < star.after.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      if (are_intersecting(star.after[i], star.after[j])) return ILLEGAL_COLLAPSE;
    }
  }
  for (const Triangle& t : star.after) {
    if (meets_others(t, collapse, star)) return ILLEGAL_COLLAPSE;
  }
  return LEGAL_COLLAPSE;
}

void ModIntersection::postprocess_collapse(const CollapseInfo& collapse) {
  tree_->update(index(collapse.fl), kNoBox);
  tree_->update(index(collapse.fr), kNoBox);
  for (auto f = mesh().cvf_iter(collapse.v1); f.is_valid(); ++f) {
    tree_->update(index(*f), box(corner_indices(mesh(), *f)));
  }
}

Box ModIntersection::box(const Triangle& t) const {
  return bounding_box(Corners{(*points_)[t[0]], (*points_)[t[1]], (*points_)[t[2]]});
}

bool ModIntersection::are_intersecting(const Triangle& a, const Triangle& b) const {
  if (first_copies_.empty()) return intersect(*points_, a, b);
  const auto first = [this](const Triangle& t) {
    return Triangle{first_copies_[t[0]], first_copies_[t[1]], first_copies_[t[2]]};
  };
  return intersect(*points_, first(a), first(b));
}

bool ModIntersection::meets_others(const Triangle& t, const CollapseInfo& collapse,
                                   const Star& star) {
  bool met = false;
  tree_->for_each_overlap(box(t), [&](std::size_t other) {
    const OpenMesh::FaceHandle f(static_cast<int>(other));
    const bool changes = f == collapse.fl || f == collapse.fr ||
                         std::find(star.faces.begin(), star.faces.end(), f) != star.faces.end();
    met = !changes && are_intersecting(t, corner_indices(mesh(), f));
    return !met;
  });
  return met;
}

}  // namespace mesamis
