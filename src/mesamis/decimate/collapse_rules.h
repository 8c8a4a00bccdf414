// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <OpenMesh/Tools/Decimater/ModBaseT.hh>
#include <memory>
#include <utility>
#include <vector>

#include "mesamis/decimate/decimate_pass.h"
#include "mesamis/decimate/openmesh.h"
#include "mesamis/decimate/patch.h"
#include "mesamis/surface/box_tree.h"
#include "mesamis/surface/farthest.h"

/// The rules that forbid a collapse, as binary modules of OpenMesh's decimater. Their tests read
/// the patch's points and the connectivity, and write only the data of the point to be removed:
/// collapses that share no triangle may be tested at once, in threads.
namespace mesamis {

using CollapseInfo = OpenMesh::Decimater::CollapseInfoT<HalfedgeMesh>;
using CollapseRule = OpenMesh::Decimater::ModBaseT<HalfedgeMesh>;

/// The triangles around the point to be removed, but for the two that a collapse removes.
struct Star {
  std::vector<OpenMesh::FaceHandle> faces;
  std::vector<Triangle> before, after;
};

/// A rule that looks at the points of the surface.
class PointRule : public CollapseRule {
 public:
  explicit PointRule(HalfedgeMesh& mesh) : CollapseRule(mesh, true) {}
  void set_surface(const TriMesh& surface) { points_ = &surface.points; }

 protected:
  const std::vector<Vec3>& points() const { return *points_; }

 private:
  const std::vector<Vec3>* points_ = nullptr;
};

/// Refuses triangles that are nearly degenerate.
class ModFlatness : public PointRule {
 public:
  using PointRule::PointRule;
  float collapse_priority(const CollapseInfo& collapse) override;
};

/// Refuses creases: edges at which the new triangles bend by more than 25 degrees, and by more than
/// the surface did at any edge of those that they replace.
class ModCreases : public PointRule {
 public:
  using PointRule::PointRule;
  float collapse_priority(const CollapseInfo& collapse) override;
};

/// Refuses new edges between points at the rims of interfaces: another one might have the same
/// edge, which would join four triangles then.
class ModRims : public CollapseRule {
 public:
  explicit ModRims(HalfedgeMesh& mesh) : CollapseRule(mesh, true) {}
  /// @param at_rim  of each point, 1 or 0.
  void set_rims(std::vector<char> at_rim) { at_rim_ = std::move(at_rim); }
  float collapse_priority(const CollapseInfo& collapse) override;

 private:
  std::vector<char> at_rim_;
};

/// Hausdorff distance in both directions, over whole triangles: of the new ones to the original,
/// and of the original ones that they stand for to the new. New triangles stand for the originals
/// to whose corners or centroids they are nearest; decimate_patch() checks the rest of these
/// afterwards.
///
/// OpenMesh's own ModHausdorff measures the second direction only, at points only, and accepts any
/// distance to a triangle without area.
class ModHausdorff : public CollapseRule {
 public:
  explicit ModHausdorff(HalfedgeMesh& mesh) : CollapseRule(mesh, true) {}
  /// @param surface  of the half-edges, its triangles those of the patch.
  void set_task(const DecimateTask& task, const TriMesh& surface, const Patch& patch);
  /// The originals that a triangle stands for now.
  std::vector<Index> originals_of(OpenMesh::FaceHandle f) const;
  /// See Cover.
  double drift_of(OpenMesh::FaceHandle f) const;
  float collapse_priority(const CollapseInfo& collapse) override;
  void preprocess_collapse(const CollapseInfo& collapse) override;
  void postprocess_collapse(const CollapseInfo& collapse) override;

 private:
  Corners shape(const Triangle& t) const { return corners_of(*surface_, t); }
  Corners original(Index t) const {
    return corners_of(task_->surface, task_->surface.triangles[t]);
  }
  Enough enough() const { return {task_->tolerance, task_->tolerance}; }

  double drift_after(const CollapseInfo& collapse);
  std::vector<Index> listed_around(const CollapseInfo& collapse);
  void list(Index t, const Vec3& p);
  bool removed_is_near(const CollapseInfo& collapse, const Star& star) const;
  bool new_are_near(const CollapseInfo& collapse, const Star& star);
  bool old_are_near(const CollapseInfo& collapse, const Star& star);
  bool is_near_one(const Corners& triangle, const std::vector<Triangle>& others) const;
  std::vector<Corners> surroundings(const CollapseInfo& collapse, const Star& star);

  const DecimateTask* task_ = nullptr;
  const TriMesh* surface_ = nullptr;
  const Patch* patch_ = nullptr;
  std::vector<std::vector<Index>> of_face_;
  std::vector<double> drift_;  // of each triangle
  double next_drift_ = 0;
  std::vector<Index> waiting_;
  Star star_;
  std::vector<std::size_t> hint_;  // of each point, where the last search for its triangles ended
};

/// Refuses triangles that intersect others.
class ModIntersection : public CollapseRule {
 public:
  explicit ModIntersection(HalfedgeMesh& mesh) : CollapseRule(mesh, true) {}
  /// @param first_copies  of each point, the first one at the same place that is to be taken for
  ///                      the same; empty: all differ.
  void set_surface(const TriMesh& surface, std::vector<Index> first_copies = {});
  float collapse_priority(const CollapseInfo& collapse) override;
  void postprocess_collapse(const CollapseInfo& collapse) override;

 private:
  Box box(const Triangle& t) const;
  bool are_intersecting(const Triangle& a, const Triangle& b) const;
  bool meets_others(const Triangle& t, const CollapseInfo& collapse, const Star& star);

  const std::vector<Vec3>* points_ = nullptr;
  std::vector<Index> first_copies_;
  std::unique_ptr<BoxTree> tree_;
};

}  // namespace mesamis
