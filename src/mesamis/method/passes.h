// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "mesamis/adapt/grid_estimator.h"
#include "mesamis/adapt/size_control.h"
#include "mesamis/base/error.h"
#include "mesamis/base/progress.h"
#include "mesamis/fem/amis.h"
#include "mesamis/fem/grid_amis.h"
#include "mesamis/fem/grid_space.h"
#include "mesamis/mesh/tet_mesh.h"
#include "mesamis/method/expected_error.h"
#include "mesamis/method/iteration.h"
#include "mesamis/method/parameters.h"
#include "mesamis/method/prepare.h"
#include "mesamis/remesh/remesh.h"

/// The steps of Algorithm 2: each takes what is known on one mesh and returns what is known next.
/// Meshes lie in the grid's own axes, in length units.
namespace mesamis::detail::method {

/// A named part of the work that tells how far it has come.
class Stage {
 public:
  /// @throws Cancelled  if progress says stop.
  Stage(const Progress& progress, std::string name) : progress_(progress), name_(std::move(name)) {
    advance(0);
  }
  /// @throws Cancelled  if progress says stop.
  void advance(double share) const {
    if (progress_ && !progress_(name_, share)) throw Cancelled();
  }

 private:
  const Progress& progress_;
  std::string name_;
};

/// Tells that a stage begins whose share done is not told.
/// @throws Cancelled  if progress says stop.
inline void begin_stage(const Progress& progress, std::string_view name) {
  if (progress && !progress(name, 0)) throw Cancelled();
}

/// What all passes of a run share.
struct RunInput {
  const Parameters& parameters;
  const Volume& grey;        ///< the image, restored, in grey values
  const SplineImage& image;  ///< the same between the voxels
  Box box;                   ///< of the voxel centres, length units
  VolumeView excess;         ///< see Prepared
  double noise;              ///< left in the image, standard deviation, grey values
  ErrorOptions error;        ///< what else is known of the image, grey values
  /// Images on the same grid to whose edges the meshes are adapted as well; mostly none.
  std::vector<const RunInput*> beside{};

  explicit RunInput(const Prepared& prepared);
  /// How exactly Algorithm 1 is solved on the delivered mesh, and on those before it.
  AmisOptions final_options() const;
  AmisOptions draft_options() const;
  /// Cells of the mesh that adaptation k leads to, at most; k from 1.
  std::int64_t cells_after(int k) const;
};

/// A mesh and what was carried onto it.
struct State {
  TetMesh mesh;
  std::vector<Sym3> metric;  ///< asked for, at the nodes, 1 / length unit^2
  std::vector<double> u, v;  ///< interpolated from the mesh before: first guesses
  /// Cells the remesher makes per unit of complexity, as last measured.
  double cells_per_complexity = kCellsPerComplexity;
};

/// The fields that minimise the functional on a state's mesh.
struct Minimum {
  std::vector<double> f, u, v;      ///< nodal; grey values, and the edge indicator
  std::vector<double> lumped_mass;  ///< of the nodes, length units^3
};

/// One pass: what it works on, what it tells, what it records.
struct Pass {
  const RunInput& run;
  int number;  ///< of the adaptation that the pass leads to, from 1
  const Stage& stage;
  Iteration& record;
};

/// The fields on the first grid.
struct GridPass {
  KuhnGrid grid;
  std::vector<float> projected;  ///< the image on it; empty where it is the image's own grid
  GridMinimum minimum;

  std::span<const float> image(const RunInput& run) const {
    return projected.empty() ? std::span<const float>(run.grey.samples) : projected;
  }
};

/// Projects the image onto the first grid and minimises there. Records the pass but for what comes
/// of the estimator.
GridPass minimise_on_grid(const Pass& pass);

/// The logarithms of the metric that the fields on the first grid ask for, smoothed, with bounded
/// sizes and complexity. Records the estimator and whether the complexity was bounded.
/// @param fields  on the grid.
std::vector<PackedSym3> grid_log_metric(const Pass& pass, const KuhnGrid& grid,
                                        const GridFields& fields, const SizeControl& control);

/// Adaptation 1: minimises on the voxel grid, estimates, and refines the first mesh from a box.
State adapt_from_grid(const Pass& pass);

/// Algorithm 1 on any space; the minimum's u and v are first guesses going in (empty: f and 1).
/// Records energy and alternations.
void minimise_on(const P1Space& space, const AmisOptions& options, Minimum& minimum,
                 Iteration& record);

/// The nodal metric that the fields ask for, (9) to (11), before its sizes are bounded. Records the
/// estimator and the predicted cells.
/// @param cells  of the whole mesh, of which this may be a part.
std::vector<Sym3> asked_metric(const Pass& pass, const TetMesh& mesh, const Minimum& minimum,
                               std::int64_t cells);

/// The nodal metric that the fields ask for, (9) to (12), in length units. Records the estimator,
/// the predicted cells, and whether the complexity was bounded.
/// @param control  bounds of the sizes and of the complexity.
std::vector<Sym3> mesh_metric(const Pass& pass, const TetMesh& mesh, const Minimum& minimum,
                              const SizeControl& control);

/// Where Algorithm 1 starts: nodal fields; empty ones are f and 1.
struct Guess {
  std::vector<double> u{}, v{};
};

/// Projects the image onto the mesh and minimises there.
Minimum minimise(const Pass& pass, const TetMesh& mesh, Guess guess, const AmisOptions& options);

/// Adaptations from 2 on: estimates, builds the metric, remeshes, carries the fields over. Records
/// mesh_change beside what minimise() has recorded. Of the images beside, Algorithm 1 starts anew.
State adapt(const Pass& pass, const State& state, const Minimum& minimum);

/// From length units in the grid's axes to mm in the world frame.
void bring_to_world(const RunInput& run, std::vector<Vec3>& points);

/// How far the shape of a surface lies from the truth, mm: expected_error() without the uncertainty
/// of the level, which moves the surface as a whole and hides no detail of it.
/// @param surface  as extracted, world frame, mm.
ErrorSummary expected_shape_error(const RunInput& run, const TriMesh& surface);

/// Records how far the minimisation has moved the solid's surface, and how far it may; nothing for
/// a band.
/// @param before, now  u at the nodes of the mesh, as the mesh before had it and as it is now.
void record_surface(const Pass& pass, const TetMesh& mesh, std::span<const double> before,
                    std::span<const double> now);

/// Whether, by Parameters::until, no mesh is needed after the one that the last of these passes has
/// made. While the number of cells is still to grow, one is. Where the surface decides, three are
/// made, or two of more than 150 000 cells, if as many are allowed: the first tell how many cells
/// the remesher makes of a metric. The first may move the surface of the grid by a fifth more.
bool has_settled(const RunInput& run, const std::vector<Iteration>& passes);

}  // namespace mesamis::detail::method
