// SPDX-License-Identifier: Apache-2.0
#include "mesamis/decimate/decimate_pass.h"

#include <OpenMesh/Tools/Decimater/BaseDecimaterT.hh>
#include <OpenMesh/Tools/Decimater/ModNormalFlippingT.hh>
#include <OpenMesh/Tools/Decimater/ModQuadricT.hh>
#include <algorithm>
#include <cmath>
#include <optional>
#include <queue>
#include <tuple>

#include "mesamis/base/parallel.h"
#include "mesamis/decimate/collapse_rules.h"
#include "mesamis/mesh/tet_mesh.h"

namespace mesamis {
namespace {

using Mesh = HalfedgeMesh;
using Info = CollapseInfo;

constexpr double kMaxNormalChange = 75;  // degrees, of a triangle in one collapse

std::vector<char> rims_of(const Interfaces& interfaces, const Patch& patch) {
  std::vector<char> rims;
  rims.reserve(patch.points.size());
  for (const Index p : patch.points) rims.push_back(interfaces.at_rim[p]);
  return rims;
}

/// Of each point of a patch, the first of its points that is a copy of the same. Copies follow each
/// other.
/// @return empty without interfaces.
std::vector<Index> first_copies(const DecimateTask& task, const Patch& patch) {
  std::vector<Index> firsts;
  if (!task.interfaces) return firsts;
  for (Index p = 0; p < std::ssize(patch.points); ++p) {
    const bool is_copy =
        p > 0 && task.first_copy(patch.points[p]) == task.first_copy(patch.points[p - 1]);
    firsts.push_back(is_copy ? firsts.back() : p);
  }
  return firsts;
}

/// OpenMesh's decimater with one change: the binary modules, which are expensive, test a collapse
/// only when it is next in the order, and several collapses without a common triangle are tested at
/// once. Their number depends on the surface, never on the machine.
class LateDecimater : public OpenMesh::Decimater::BaseDecimaterT<Mesh> {
 public:
  LateDecimater(Mesh& mesh, const DecimateTask& task, const TriMesh& surface, const Patch& patch)
      : BaseDecimaterT<Mesh>(mesh),
        mesh_(mesh),
        points_(surface.points),
        points_left_(static_cast<std::int64_t>(mesh.n_vertices())) {
    const Vec3 extent = bounding_box(points_).extent();
    negligible_ = 1e-14 * dot(extent, extent);
    OpenMesh::Decimater::ModNormalFlippingT<Mesh>::Handle flips;
    ModuleHandle<ModFlatness> flatness;
    add(quadric_);
    add(flips);
    add(flatness);
    if (!std::isinf(task.tolerance)) {  // a number of triangles is reached all the same
      ModuleHandle<ModCreases> creases;
      add(creases);
      module(creases).set_surface(surface);
    }
    if (task.interfaces) {
      ModuleHandle<ModRims> rims;
      add(rims);
      module(rims).set_rims(rims_of(*task.interfaces, patch));
    }
    add(hausdorff_);
    add(intersection_);
    module(quadric_).unset_max_err();
    module(flips).set_max_normal_deviation(kMaxNormalChange);
    module(flatness).set_surface(surface);
    module(hausdorff_).set_task(task, surface, patch);
    module(intersection_).set_surface(surface, first_copies(task, patch));
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
    while (triangles_left() > triangles && (!queue_.empty() || push_woken())) {
      choose();
      parallel_blocks(chosen_.size(), 4, [this](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
          chosen_[i].allowed = is_legal(collapse_priority(chosen_[i].info));
        }
      });
      changed_.clear();
      for (Chosen& next : chosen_) {
        if (triangles_left() <= triangles) break;
        const Box around = box_around(next.info.v0);
        if (next.allowed && still_meets_none(next.info, around)) {
          changed_.push_back(around);
          collapse(next.info);
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

  /// What is left.
  Cover cover() {
    Cover left{remaining_triangles(mesh_), {}, {}};
    for (const auto f : mesh_.faces()) {
      if (mesh_.status(f).deleted()) continue;
      left.originals.push_back(module(hausdorff_).originals_of(f));
      left.drift.push_back(module(hausdorff_).drift_of(f));
    }
    return left;
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

  /// Each collapse takes one point and two triangles.
  std::int64_t triangles_left() const {
    const auto points = static_cast<std::int64_t>(mesh_.n_vertices());
    return static_cast<std::int64_t>(mesh_.n_faces()) - 2 * (points - points_left_);
  }

  std::vector<Mesh::VertexHandle> ring_of(Mesh::VertexHandle point) const {
    std::vector<Mesh::VertexHandle> ring;
    for (auto v = mesh_.cvv_iter(point); v.is_valid(); ++v) ring.push_back(*v);
    return ring;
  }

  /// A collapse that was refused may have become legal by a change up to two rings away.
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

  /// On flat parts the error is mere round-off and may be negative.
  float error_of(Mesh::HalfedgeHandle h) {
    const float error = module(quadric_).collapse_priority(Info(mesh_, h));
    return error > negligible_ * length_of(h) ? error : 0;
  }

  /// A legal priority may be slightly negative: the quadric's error is subject to round-off.
  static bool is_legal(float priority) {
    return priority > static_cast<float>(CollapseRule::ILLEGAL_COLLAPSE);
  }

  /// Chooses the next collapses in the order. A collapse whose surroundings overlap another's
  /// waits. Few are chosen on a small surface: else some would overtake many that wait.
  void choose() {
    const auto most =
        static_cast<std::size_t>(std::clamp<std::int64_t>(points_left_ / 200, 1, 128));
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

  /// Reserves the corners of the triangles around the point to be removed: the test of a collapse
  /// reads the triangles around them, so no two collapses of a turn may share one. OpenMesh's
  /// ModNormalFlipping even moves the mesh's own point v0 during its test; the other modules here
  /// read the patch's points alone.
  /// @return false if one of them is taken for this turn.
  bool reserve(const Info& collapse) {
    std::vector<Mesh::VertexHandle> corners = ring_of(collapse.v0);
    corners.push_back(collapse.v0);
    for (const auto v : corners) {
      if (turn_of_[index(v)] == turn_) return false;
    }
    for (const auto v : corners) turn_of_[index(v)] = turn_;
    return true;
  }

  /// Checks again for intersections with earlier collapses of this turn: their surroundings may be
  /// near in space where the surface comes close to itself.
  bool still_meets_none(const Info& collapse, const Box& around) {
    const bool changed = std::any_of(changed_.begin(), changed_.end(),
                                     [&](const Box& box) { return overlap(box, around); });
    return !changed || is_legal(module(intersection_).collapse_priority(collapse));
  }

  /// The box of all triangles around a point, and so of those that replace them.
  Box box_around(Mesh::VertexHandle point) const {
    std::vector<Vec3> points{points_[index(point)]};
    for (const auto v : ring_of(point)) points.push_back(points_[index(v)]);
    return bounding_box(points);
  }

  void collapse(Info& info) {
    const std::vector<Mesh::VertexHandle> ring = ring_of(info.v0);
    preprocess_collapse(info);
    mesh_.collapse(info.v0v1);
    --points_left_;
    ++stamps_[index(info.v0)];
    for (auto f = mesh_.cvf_iter(info.v1); f.is_valid(); ++f) mesh_.update_normal(*f);
    postprocess_collapse(info);
    for (const auto v : ring) {
      for (const auto w : ring_of(v)) wake(w);
    }
    for (const auto v : ring) push_around(v);
  }

  Mesh& mesh_;
  const std::vector<Vec3>& points_;
  std::int64_t points_left_;
  double negligible_;  // error, per squared length of the edge
  OpenMesh::Decimater::ModQuadricT<Mesh>::Handle quadric_;
  ModuleHandle<ModHausdorff> hausdorff_;
  ModuleHandle<ModIntersection> intersection_;
  std::priority_queue<Candidate> queue_;
  std::vector<Index> stamps_;
  std::vector<Mesh::VertexHandle> woken_;    // to be tried again at the end
  std::vector<char> is_woken_;               // of each point
  std::vector<std::vector<Index>> refused_;  // halfedges of each point, as it is now
  std::size_t turn_ = 0;
  std::vector<std::size_t> turn_of_;  // the last one that each point was reserved for
  std::vector<Chosen> chosen_;        // for the present turn
  std::vector<Candidate> waiting_;    // for the next one
  std::vector<Box> changed_;          // in the present turn
};

}  // namespace

Cover decimate_pass(const DecimateTask& task, const Patch& patch) {
  TriMesh surface{{}, patch.cover.triangles};
  for (const Index p : patch.points) surface.points.push_back(task.surface.points[p]);
  // Near the origin quadrics lose less to round-off; all else works with the points as they are.
  const Box box = bounding_box(surface.points);
  HalfedgeMesh mesh;
  build_halfedges(surface, 0.5 * (box.lo + box.hi), mesh);
  mesh.request_face_normals();
  mesh.update_face_normals();
  for (std::size_t v = 0; v < patch.held.size(); ++v) {
    mesh.status(OpenMesh::VertexHandle(static_cast<int>(v))).set_locked(patch.held[v] != 0);
  }
  LateDecimater decimater(mesh, task, surface, patch);
  decimater.run(task.triangles, task.progress);
  return decimater.cover();
}

}  // namespace mesamis
