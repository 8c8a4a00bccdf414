// SPDX-License-Identifier: Apache-2.0
#include "mesamis/surface/decimate_pass.h"

#include <OpenMesh/Tools/Decimater/BaseDecimaterT.hh>
#include <OpenMesh/Tools/Decimater/ModNormalFlippingT.hh>
#include <OpenMesh/Tools/Decimater/ModQuadricT.hh>
#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <queue>
#include <tuple>

#include "mesamis/base/parallel.h"
#include "mesamis/mesh/tet_mesh.h"
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

/// Hausdorff distance in both directions, over whole triangles: of the new ones to the original,
/// and of the original ones that lie near to the new. Each original triangle is listed with those
/// that its corners and its middle are nearest to; what else it may reach is seen to afterwards.
///
/// OpenMesh's own ModHausdorff knows the second direction only, at points only, and takes any
/// distance to a triangle without area for good.
class ModHausdorff : public Module {
 public:
  explicit ModHausdorff(Mesh& mesh) : Module(mesh, true) {}

  void set_task(const DecimateTask& task) {
    task_ = &task;
    if (std::isinf(task.tolerance)) return;
    hint_.assign(task.surface.points.size(), 0);
    of_face_.resize(task.surface.triangles.size());
    for (std::size_t t = 0; t < of_face_.size(); ++t) of_face_[t] = {static_cast<Index>(t)};
  }

  float collapse_priority(const Info& collapse) override {
    if (std::isinf(task_->tolerance)) return LEGAL_COLLAPSE;
    const Star star = star_of(mesh(), collapse);
    return removed_is_near(collapse, star) && old_are_near(collapse, star) &&
                   new_are_near(collapse, star)
               ? LEGAL_COLLAPSE
               : ILLEGAL_COLLAPSE;
  }

  void preprocess_collapse(const Info& collapse) override {
    if (std::isinf(task_->tolerance)) return;
    waiting_ = listed_around(collapse);
    for (auto f = mesh().cvf_iter(collapse.v0); f.is_valid(); ++f) of_face_[index(*f)].clear();
    star_ = star_of(mesh(), collapse);
  }

  void postprocess_collapse(const Info&) override {
    if (std::isinf(task_->tolerance)) return;
    for (const Index t : waiting_) {
      const Corners c = original(t);
      for (const Vec3& p : {c[0], c[1], c[2], (1.0 / 3) * (c[0] + c[1] + c[2])}) list(t, p);
    }
  }

 private:
  Corners shape(const Triangle& t) const { return corners_of(task_->surface, t); }
  Corners original(Index t) const { return shape(task_->surface.triangles[t]); }
  Enough enough() const { return {task_->tolerance, task_->tolerance}; }

  /// The originals listed around the point to be removed, each once.
  std::vector<Index> listed_around(const Info& collapse) {
    std::vector<Index> all;
    for (auto f = mesh().cvf_iter(collapse.v0); f.is_valid(); ++f) {
      all.insert(all.end(), of_face_[index(*f)].begin(), of_face_[index(*f)].end());
    }
    std::sort(all.begin(), all.end());
    all.erase(std::unique(all.begin(), all.end()), all.end());
    return all;
  }

  /// Lists t with the new triangle that is nearest to p.
  void list(Index t, const Vec3& p) {
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

  /// The cheapest test, and the one that refuses most.
  bool removed_is_near(const Info& collapse, const Star& star) const {
    const Vec3& p = task_->surface.points[index(collapse.v0)];
    return std::any_of(star.after.begin(), star.after.end(), [&](const Triangle& t) {
      return squared_distance(p, shape(t)) <= task_->tolerance * task_->tolerance;
    });
  }

  bool new_are_near(const Info& collapse, const Star& star) {
    std::size_t& hint = hint_[index(collapse.v0)];
    return std::all_of(star.after.begin(), star.after.end(), [&](const Triangle& t) {
      return farthest_distance(shape(t), task_->tree, enough(), hint) <= task_->tolerance;
    });
  }

  bool old_are_near(const Info& collapse, const Star& star) {
    std::vector<Index> open = listed_around(collapse);
    std::erase_if(open, [&](Index t) { return is_near_one(original(t), star.after); });
    if (open.empty()) return true;
    const TriangleTree after(surroundings(collapse, star));
    std::size_t hint = 0;
    return std::all_of(open.begin(), open.end(), [&](Index t) {
      return farthest_distance(original(t), after, enough(), hint) <= task_->tolerance;
    });
  }

  /// Is the whole triangle near to one of them? The distance to one is convex: corners decide. Most
  /// are, and are spared the search.
  bool is_near_one(const Corners& triangle, const std::vector<Triangle>& others) const {
    const double most = task_->tolerance * task_->tolerance;
    return std::any_of(others.begin(), others.end(), [&](const Triangle& t) {
      const Corners other = shape(t);
      return std::all_of(triangle.begin(), triangle.end(),
                         [&](const Vec3& p) { return squared_distance(p, other) <= most; });
    });
  }

  /// The triangles after the collapse, those of the ring's other points included.
  TriMesh surroundings(const Info& collapse, const Star& star) {
    std::vector<Triangle> triangles = star.after;
    for (auto v = mesh().cvv_iter(collapse.v0); v.is_valid(); ++v) {
      for (auto f = mesh().cvf_iter(*v); f.is_valid(); ++f) {
        const Triangle t = corner_indices(mesh(), *f);
        if (std::find(t.begin(), t.end(), collapse.v0.idx()) == t.end()) triangles.push_back(t);
      }
    }
    TriMesh local;
    for (const Triangle& t : triangles) {
      const auto first = static_cast<Index>(local.points.size());
      for (const Vec3& p : shape(t)) local.points.push_back(p);
      local.triangles.push_back({first, first + 1, first + 2});
    }
    return local;
  }

  const DecimateTask* task_ = nullptr;
  std::vector<std::vector<Index>> of_face_;
  std::vector<Index> waiting_;
  Star star_;
  std::vector<std::size_t> hint_;  // of each point, where the last search for its triangles ended
};

/// Refuses triangles that meet others.
class ModIntersection : public Module {
 public:
  explicit ModIntersection(Mesh& mesh) : Module(mesh, true) {}

  void set_surface(const TriMesh& surface) {
    points_ = &surface.points;
    std::vector<Box> boxes;
    for (const Triangle& t : surface.triangles)
      boxes.push_back(bounding_box(corners_of(surface, t)));
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
    return bounding_box(Corners{(*points_)[t[0]], (*points_)[t[1]], (*points_)[t[2]]});
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
/// only when a collapse's turn has come, and several collapses that have nothing in common have
/// their turn at once. How many depends on the surface, never on the machine.
class LateDecimater : public OpenMesh::Decimater::BaseDecimaterT<Mesh> {
 public:
  LateDecimater(Mesh& mesh, const DecimateTask& task)
      : BaseDecimaterT<Mesh>(mesh),
        mesh_(mesh),
        points_(task.surface.points),
        live_(static_cast<std::int64_t>(mesh.n_vertices())) {
    const Vec3 extent = bounding_box(points_).extent();
    negligible_ = 1e-14 * dot(extent, extent);
    OpenMesh::Decimater::ModNormalFlippingT<Mesh>::Handle flips;
    ModuleHandle<ModFlatness> flatness;
    ModuleHandle<ModHausdorff> hausdorff;
    add(quadric_);
    add(flips);
    add(flatness);
    add(hausdorff);
    add(intersection_);
    module(quadric_).unset_max_err();
    module(flips).set_max_normal_deviation(kMaxNormalChange);
    module(flatness).set_surface(task.surface);
    module(hausdorff).set_task(task);
    module(intersection_).set_surface(task.surface);
    initialize();
  }

  void run(std::int64_t triangles, const std::function<void(double)>& progress) {
    stamps_.assign(mesh_.n_vertices(), 0);
    refused_.resize(mesh_.n_vertices());
    turn_of_.assign(mesh_.n_vertices(), 0);
    is_woken_.assign(mesh_.n_vertices(), 0);
    for (const auto v : mesh_.vertices()) push_around(v);
    const auto first_count = static_cast<double>(queue_.size());
    double done = 0;
    auto count = static_cast<std::int64_t>(mesh_.n_faces());
    while (count > triangles && (!queue_.empty() || push_woken())) {
      choose();
      parallel_blocks(chosen_.size(), 4, [this](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
          chosen_[i].allowed = is_legal(collapse_priority(chosen_[i].info));
        }
      });
      changed_.clear();
      for (Chosen& next : chosen_) {
        if (count <= triangles) break;
        if (next.allowed && still_meets_none(next.info)) {
          collapse(next.info);
          count -= 2;
        } else {
          refuse(next.info);
        }
      }
      if (turn_ % 32 == 0) {
        done = std::max(done, 1 - static_cast<double>(queue_.size()) / first_count);
        progress(done);
      }
    }
  }

 private:
  template <class M>
  using ModuleHandle = OpenMesh::Decimater::ModHandleT<M>;

  struct Candidate {
    float error, length;
    Index halfedge, point, stamp;
    /// The smallest error comes out first; where the surface is flat, the shortest edge.
    bool operator<(const Candidate& other) const {
      return std::tie(error, length, halfedge) >
             std::tie(other.error, other.length, other.halfedge);
    }
  };

  struct Chosen {
    Info info;
    bool allowed = false;
  };

  /// What was refused may have become possible by what happened two rings away.
  /// @return whether there is anything to try.
  bool push_woken() {
    std::vector<Mesh::VertexHandle> woken;
    woken.swap(woken_);
    std::sort(woken.begin(), woken.end());
    for (const auto v : woken) {
      if (is_woken_[index(v)] != 0 && !mesh_.status(v).deleted()) push_around(v);
    }
    return !queue_.empty();
  }

  void wake(Mesh::VertexHandle v) {
    if (is_woken_[index(v)] == 0) woken_.push_back(v);
    is_woken_[index(v)] = 1;
  }

  void push_around(Mesh::VertexHandle v) {
    is_woken_[index(v)] = 0;
    ++stamps_[index(v)];
    refused_[index(v)].clear();
    if (!mesh_.status(v).locked()) push_best(v);
  }

  /// A point is in the queue once, with the best of its halfedges that has not been refused.
  void push_best(Mesh::VertexHandle v) {
    const std::vector<Index>& refused = refused_[index(v)];
    std::optional<Candidate> best;
    for (auto h = mesh_.cvoh_iter(v); h.is_valid(); ++h) {
      if (std::find(refused.begin(), refused.end(), h->idx()) != refused.end()) continue;
      const Candidate next{error_of(*h), length_of(*h), h->idx(), v.idx(), stamps_[index(v)]};
      if (!best || *best < next) best = next;
    }
    if (best) queue_.push(*best);
  }

  void refuse(const Info& collapse) {
    refused_[index(collapse.v0)].push_back(collapse.v0v1.idx());
    push_best(collapse.v0);
  }

  float length_of(Mesh::HalfedgeHandle h) const {
    return static_cast<float>(mesh_.calc_edge_sqr_length(h));
  }

  /// Where the surface is flat what is left is round-off, and may be negative.
  float error_of(Mesh::HalfedgeHandle h) {
    const float error = module(quadric_).collapse_priority(Info(mesh_, h));
    return error > negligible_ * length_of(h) ? error : 0;
  }

  /// What is legal may be negative all the same: the quadric's error, but for round-off.
  static bool is_legal(float priority) {
    return priority > static_cast<float>(Module::ILLEGAL_COLLAPSE);
  }

  /// The next collapses by their order. One whose surroundings reach into another's waits; not many
  /// are chosen of a small surface, or some would have their turn long before those that wait.
  void choose() {
    const auto most = static_cast<std::size_t>(std::clamp<std::int64_t>(live_ / 200, 1, 128));
    ++turn_;
    chosen_.clear();
    waiting_.clear();
    while (!queue_.empty() && chosen_.size() < most && waiting_.size() < 2 * most) {
      const Candidate next = queue_.top();
      queue_.pop();
      if (next.stamp != stamps_[next.point]) continue;
      Info info(mesh_, Mesh::HalfedgeHandle(next.halfedge));
      if (!is_collapse_legal(info)) {
        refuse(info);
      } else if (error_of(info.v0v1) > next.error) {  // the target has gathered errors meanwhile
        push_best(info.v0);
      } else if (reserve(info)) {
        chosen_.push_back({info});
      } else {
        waiting_.push_back(next);
      }
    }
    for (const Candidate& candidate : waiting_) queue_.push(candidate);
  }

  /// A collapse changes the triangles around the point removed, and its test looks at those around
  /// their corners: these corners may not be shared. Nor may they for the threads' sake, for during
  /// its test OpenMesh's ModNormalFlipping moves the mesh's own point v0; the other modules here
  /// look at the original's points alone.
  /// @return false if one of them is taken for this turn.
  bool reserve(const Info& collapse) {
    if (turn_of_[index(collapse.v0)] == turn_) return false;
    for (auto v = mesh_.cvv_iter(collapse.v0); v.is_valid(); ++v) {
      if (turn_of_[index(*v)] == turn_) return false;
    }
    turn_of_[index(collapse.v0)] = turn_;
    for (auto v = mesh_.cvv_iter(collapse.v0); v.is_valid(); ++v) turn_of_[index(*v)] = turn_;
    return true;
  }

  /// Other surroundings may still be near in space, where the surface has come close to itself.
  bool still_meets_none(const Info& collapse) {
    const Box around = box_around(collapse.v0);
    const bool changed = std::any_of(changed_.begin(), changed_.end(),
                                     [&](const Box& box) { return overlap(box, around); });
    return !changed || is_legal(module(intersection_).collapse_priority(collapse));
  }

  /// Of all triangles around a point, and thus of those that take their place.
  Box box_around(Mesh::VertexHandle point) const {
    std::vector<Vec3> points{points_[index(point)]};
    for (auto v = mesh_.cvv_iter(point); v.is_valid(); ++v) points.push_back(points_[index(*v)]);
    return bounding_box(points);
  }

  void collapse(Info& info) {
    std::vector<Mesh::VertexHandle> ring;
    for (auto v = mesh_.cvv_iter(info.v0); v.is_valid(); ++v) ring.push_back(*v);
    changed_.push_back(box_around(info.v0));
    preprocess_collapse(info);
    mesh_.collapse(info.v0v1);
    --live_;
    ++stamps_[index(info.v0)];
    for (auto f = mesh_.cvf_iter(info.v1); f.is_valid(); ++f) mesh_.update_normal(*f);
    postprocess_collapse(info);
    for (const auto v : ring) {
      for (auto w = mesh_.cvv_iter(v); w.is_valid(); ++w) wake(*w);
    }
    for (const auto v : ring) push_around(v);
  }

  Mesh& mesh_;
  const std::vector<Vec3>& points_;
  std::int64_t live_;  // points that are left
  double negligible_;  // error, per squared length of the edge
  OpenMesh::Decimater::ModQuadricT<Mesh>::Handle quadric_;
  ModuleHandle<ModIntersection> intersection_;
  std::priority_queue<Candidate> queue_;
  std::vector<Index> stamps_;
  std::vector<Mesh::VertexHandle> woken_;    // to be asked again in the end
  std::vector<char> is_woken_;               // of each point
  std::vector<std::vector<Index>> refused_;  // halfedges of each point, as it is now
  std::size_t turn_ = 0;
  std::vector<std::size_t> turn_of_;  // the last one that each point was reserved for
  std::vector<Chosen> chosen_;        // for the present turn
  std::vector<Candidate> waiting_;    // for the next one
  std::vector<Box> changed_;          // in the present turn
};

}  // namespace

std::vector<Triangle> decimate_pass(const DecimateTask& task, const std::vector<char>& held) {
  // Near the origin quadrics lose less to round-off; all else works with the original's points.
  const Box box = bounding_box(task.surface.points);
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
