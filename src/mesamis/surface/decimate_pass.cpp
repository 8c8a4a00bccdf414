// SPDX-License-Identifier: Apache-2.0
#include "mesamis/surface/decimate_pass.h"

#include <OpenMesh/Tools/Decimater/BaseDecimaterT.hh>
#include <OpenMesh/Tools/Decimater/ModNormalFlippingT.hh>
#include <OpenMesh/Tools/Decimater/ModQuadricT.hh>
#include <algorithm>
#include <cmath>
#include <memory>
#include <queue>

#include "mesamis/surface/box_tree.h"
#include "mesamis/surface/farthest.h"
#include "mesamis/surface/openmesh.h"
#include "mesamis/surface/triangle_intersection.h"

namespace mesamis {
namespace {

using Mesh = HalfedgeMesh;
using Info = OpenMesh::Decimater::CollapseInfoT<Mesh>;
using Module = OpenMesh::Decimater::ModBaseT<Mesh>;

constexpr double kMaxNormalChange = 75;  // degrees, of a triangle in one collapse
/// Height over longest side: a collapse may not make a triangle flatter than this and than the
/// flattest one it starts from.
constexpr double kFlattest = 0.01;

/// Triangles around the point to be removed that stay: before, and after.
struct Star {
  std::vector<OpenMesh::FaceHandle> faces;
  std::vector<Triangle> before, after;
};

Star star_of(const Mesh& mesh, const Info& collapse) {
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

/// Refuses triangles that are nearly degenerate.
class ModFlatness : public Module {
 public:
  explicit ModFlatness(Mesh& mesh) : Module(mesh, true) {}
  void set_surface(const TriMesh& surface) { points_ = &surface.points; }
  float collapse_priority(const Info& collapse) override {
    const Star star = star_of(mesh(), collapse);
    double least = kFlattest * kFlattest;
    for (const Triangle& t : star.before) least = std::min(least, flatness(*points_, t));
    for (const Triangle& t : star.after) {
      if (flatness(*points_, t) < least || !has_area(*points_, t)) return ILLEGAL_COLLAPSE;
    }
    return LEGAL_COLLAPSE;
  }

 private:
  const std::vector<Vec3>* points_ = nullptr;
};

/// Hausdorff distance in both directions, at samples: the points and the middles of the sides of
/// the original, each kept with the triangle nearest to it; and the middles of new triangles and
/// sides.
///
/// OpenMesh's own ModHausdorff knows the first direction only, at the points only, and takes any
/// distance to a triangle without area for good.
class ModHausdorff : public Module {
 public:
  explicit ModHausdorff(Mesh& mesh) : Module(mesh, true) {}

  void set_task(const DecimateTask& task) {
    task_ = &task;
    squared_ = task.tolerance * task.tolerance;
    samples_ = task.surface.points;
    of_face_.assign(task.surface.triangles.size(), {});
    for (std::size_t t = 0; t < task.surface.triangles.size(); ++t) {
      const Triangle& k = task.surface.triangles[t];
      for (std::size_t i = 0; i < 3; ++i) {
        if (k[i] > k[(i + 1) % 3]) continue;  // the triangle beyond adds it
        of_face_[t].push_back(static_cast<Index>(samples_.size()));
        samples_.push_back(0.5 * (task.surface.points[k[i]] + task.surface.points[k[(i + 1) % 3]]));
      }
    }
  }

  float collapse_priority(const Info& collapse) override {
    if (std::isinf(squared_)) return LEGAL_COLLAPSE;
    const Star star = star_of(mesh(), collapse);
    return old_is_near(collapse, star) && new_is_near(collapse, star) ? LEGAL_COLLAPSE
                                                                      : ILLEGAL_COLLAPSE;
  }

  void preprocess_collapse(const Info& collapse) override {
    if (std::isinf(squared_)) return;
    waiting_ = gather(collapse);
  }

  void postprocess_collapse(const Info& collapse) override {
    if (std::isinf(squared_)) return;
    std::vector<OpenMesh::FaceHandle> faces;
    std::vector<Corners> shapes;
    for (auto f = mesh().cvf_iter(collapse.v1); f.is_valid(); ++f) {
      faces.push_back(*f);
      shapes.push_back(corners_of(task_->surface, corner_indices(mesh(), *f)));
    }
    for (const Index sample : waiting_) {
      std::size_t nearest = 0;
      double least = std::numeric_limits<double>::infinity();
      for (std::size_t i = 0; i < shapes.size(); ++i) {
        const double d = squared_distance(samples_[sample], shapes[i]);
        if (d >= least) continue;
        least = d;
        nearest = i;
      }
      of_face_[index(faces[nearest])].push_back(sample);
    }
  }

 private:
  /// The samples around the point to be removed, and the point itself; the lists end empty.
  std::vector<Index> gather(const Info& collapse) {
    std::vector<Index> all{collapse.v0.idx()};
    for (auto f = mesh().cvf_iter(collapse.v0); f.is_valid(); ++f) {
      std::vector<Index>& own = of_face_[index(*f)];
      all.insert(all.end(), own.begin(), own.end());
      own.clear();
    }
    return all;
  }

  bool near_one(Index sample, const std::vector<Corners>& shapes, std::size_t& last) const {
    if (squared_distance(samples_[sample], shapes[last]) <= squared_) return true;
    for (std::size_t i = 0; i < shapes.size(); ++i) {
      if (i != last && squared_distance(samples_[sample], shapes[i]) <= squared_) {
        last = i;
        return true;
      }
    }
    return false;
  }

  bool old_is_near(const Info& collapse, const Star& star) {
    std::vector<Corners> shapes;
    for (const Triangle& t : star.after) shapes.push_back(corners_of(task_->surface, t));
    std::size_t last = 0;
    if (!near_one(collapse.v0.idx(), shapes, last)) return false;
    for (auto f = mesh().cvf_iter(collapse.v0); f.is_valid(); ++f) {
      for (const Index sample : of_face_[index(*f)]) {
        if (!near_one(sample, shapes, last)) return false;
      }
    }
    return true;
  }

  bool new_is_near(const Info& collapse, const Star& star) {
    const auto& points = task_->surface.points;
    const Vec3& hub = points[index(collapse.v1)];
    for (const Triangle& t : star.after) {
      const Vec3 sum = points[t[0]] + points[t[1]] + points[t[2]];
      if (!near_original((1.0 / 3) * sum)) return false;
      for (const Index i : t) {
        if (i != collapse.v1.idx() && !near_original(0.5 * (hub + points[i]))) return false;
      }
    }
    return true;
  }

  bool near_original(const Vec3& p) {
    return task_->tree.squared_distance_to(p, hint_) <= squared_;
  }

  const DecimateTask* task_ = nullptr;
  double squared_ = 0;
  std::vector<Vec3> samples_;                // the points of the original, then middles of sides
  std::vector<std::vector<Index>> of_face_;  // samples nearest to each triangle
  std::vector<Index> waiting_;
  std::size_t hint_ = 0;
};

/// Refuses triangles that meet others.
class ModIntersection : public Module {
 public:
  explicit ModIntersection(Mesh& mesh) : Module(mesh, true) {}

  void set_surface(const TriMesh& surface) {
    points_ = &surface.points;
    std::vector<Box> boxes;
    for (const Triangle& t : surface.triangles) boxes.push_back(box_of(corners_of(surface, t)));
    tree_ = std::make_unique<BoxTree>(boxes);
  }

  float collapse_priority(const Info& collapse) override {
    const Star star = star_of(mesh(), collapse);
    for (std::size_t i = 0; i < star.after.size(); ++i) {
      for (std::size_t j = 0; j < i; ++j) {
        if (intersect(*points_, star.after[i], star.after[j])) return ILLEGAL_COLLAPSE;
      }
    }
    for (const Triangle& t : star.after) {
      if (meets_others(t, collapse, star)) return ILLEGAL_COLLAPSE;
    }
    return LEGAL_COLLAPSE;
  }

  void postprocess_collapse(const Info& collapse) override {
    tree_->update(index(collapse.fl), kNoBox);
    tree_->update(index(collapse.fr), kNoBox);
    for (auto f = mesh().cvf_iter(collapse.v1); f.is_valid(); ++f) {
      tree_->update(index(*f), box(corner_indices(mesh(), *f)));
    }
  }

 private:
  Box box(const Triangle& t) const {
    return box_of(Corners{(*points_)[t[0]], (*points_)[t[1]], (*points_)[t[2]]});
  }

  bool meets_others(const Triangle& t, const Info& collapse, const Star& star) {
    bool met = false;
    tree_->for_each_overlap(box(t), [&](std::size_t other) {
      const OpenMesh::FaceHandle f(static_cast<int>(other));
      const bool changes = f == collapse.fl || f == collapse.fr ||
                           std::find(star.faces.begin(), star.faces.end(), f) != star.faces.end();
      met = !changes && intersect(*points_, t, corner_indices(mesh(), f));
      return !met;
    });
    return met;
  }

  const std::vector<Vec3>* points_ = nullptr;
  std::unique_ptr<BoxTree> tree_;
};

/// OpenMesh's decimater with one change: the modules that say yes or no, which are dear, are asked
/// only when a collapse's turn has come, and against the surface as it is then.
class LateDecimater : public OpenMesh::Decimater::BaseDecimaterT<Mesh> {
 public:
  LateDecimater(Mesh& mesh, const DecimateTask& task) : BaseDecimaterT<Mesh>(mesh), mesh_(mesh) {
    OpenMesh::Decimater::ModNormalFlippingT<Mesh>::Handle flips;
    ModuleHandle<ModFlatness> flatness;
    ModuleHandle<ModHausdorff> hausdorff;
    ModuleHandle<ModIntersection> intersection;
    add(quadric_);
    add(flips);
    add(flatness);
    add(hausdorff);
    add(intersection);
    module(quadric_).unset_max_err();
    module(flips).set_max_normal_deviation(kMaxNormalChange);
    module(flatness).set_surface(task.surface);
    module(hausdorff).set_task(task);
    module(intersection).set_surface(task.surface);
    initialize();
  }

  void run(std::int64_t triangles, const std::function<void(double)>& progress) {
    stamps_.assign(mesh_.n_vertices(), 0);
    for (const auto v : mesh_.vertices()) push_around(v);
    std::size_t turns = 0;
    const std::size_t first_count = queue_.size();
    auto count = static_cast<std::int64_t>(mesh_.n_faces());
    while (!queue_.empty() && count > triangles) {
      const Candidate next = queue_.top();
      queue_.pop();
      if (++turns % 4096 == 0) {
        progress(1 - static_cast<double>(queue_.size()) / static_cast<double>(first_count));
      }
      if (next.stamp != stamps_[next.point]) continue;
      if (collapse(next)) count -= 2;
    }
  }

 private:
  template <class M>
  using ModuleHandle = OpenMesh::Decimater::ModHandleT<M>;

  struct Candidate {
    float priority;
    Index halfedge, point, stamp;
    /// The smallest error, then the smallest index comes out first.
    bool operator<(const Candidate& other) const {
      return priority != other.priority ? priority > other.priority : halfedge > other.halfedge;
    }
  };

  void push_around(Mesh::VertexHandle v) {
    const Index stamp = ++stamps_[index(v)];
    if (mesh_.status(v).locked()) return;
    for (auto h = mesh_.cvoh_iter(v); h.is_valid(); ++h) push(*h, v, stamp);
  }

  void push(Mesh::HalfedgeHandle h, Mesh::VertexHandle v, Index stamp) {
    queue_.push({module(quadric_).collapse_priority(Info(mesh_, h)), h.idx(), v.idx(), stamp});
  }

  bool collapse(const Candidate& candidate) {
    const Mesh::HalfedgeHandle h(candidate.halfedge);
    Info info(mesh_, h);
    if (!is_collapse_legal(info)) return false;
    const float now = module(quadric_).collapse_priority(info);
    if (now > candidate.priority) {  // the target has gathered errors meanwhile
      queue_.push({now, candidate.halfedge, candidate.point, candidate.stamp});
      return false;
    }
    if (collapse_priority(info) < 0) return false;
    std::vector<Mesh::VertexHandle> ring;
    for (auto v = mesh_.cvv_iter(info.v0); v.is_valid(); ++v) ring.push_back(*v);
    preprocess_collapse(info);
    mesh_.collapse(h);
    ++stamps_[index(info.v0)];
    for (auto f = mesh_.cvf_iter(info.v1); f.is_valid(); ++f) mesh_.update_normal(*f);
    postprocess_collapse(info);
    for (const auto v : ring) push_around(v);
    return true;
  }

  Mesh& mesh_;
  OpenMesh::Decimater::ModQuadricT<Mesh>::Handle quadric_;
  std::priority_queue<Candidate> queue_;
  std::vector<Index> stamps_;
};

}  // namespace

std::vector<Triangle> decimate_pass(const DecimateTask& task, const std::vector<char>& held) {
  // Near the origin quadrics lose less to round-off; all else works with the original's points.
  const Box box = box_of(task.surface.points);
  HalfedgeMesh mesh;
  build_halfedges(task.surface, 0.5 * (box.lo + box.hi), mesh);
  mesh.request_face_normals();
  mesh.update_face_normals();
  for (std::size_t v = 0; v < held.size(); ++v) {
    mesh.status(OpenMesh::VertexHandle(static_cast<int>(v))).set_locked(held[v] != 0);
  }
  LateDecimater(mesh, task).run(task.triangles, task.progress);
  return remaining_triangles(mesh);
}

}  // namespace mesamis
