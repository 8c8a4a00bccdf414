// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>

#include "mesamis/remesh/counters.h"
#include "mesamis/remesh/metric_sampler.h"
#include "mesamis/remesh/remesh.h"
#include "mesamis/remesh/workbench.h"
#include "mesamis/remesh/working_mesh.h"

namespace mesamis::detail::remesh {

/// What lengths new edges may have.
enum class Bands {
  kWide,      ///< a little shorter and longer than the goal: triggers and bands that meet would jam
  kBalanced,  ///< not much farther from 1 than the edge that goes
  kGoal,      ///< the goal's
};

/// The rounds of remesh() and remesh_body(): they adapt a mesh to a metric, then polish it.
class Remesher {
 public:
  /// @param mesh     valid; of a body, cut along its border.
  /// @param sampler  its size factor may be set here.
  /// @param options  are referred to.
  /// @throws InputError  if the metric asks for more cells than fit and max_cells is not set.
  Remesher(WorkingMesh mesh, const MetricSampler& sampler, const RemeshOptions& options);

  void adapt();
  void polish();
  /// Works on the shapes of the worst cells, whatever the metric.
  void repair();
  /// Balances the skin of a body around its border.
  void balance();
  /// The mesh, without unused slots.
  WorkingMesh& result();
  const RemeshReport& report() const { return report_; }

  /// Work beside the rounds, on the parts of the mesh in threads.
  /// @param round  turns the cuts between the parts.
  Counters on_parts(int round, const std::function<Counters(Workbench&)>& work);

 private:
  double share_of_vertices(const Counters& done) const;
  bool is_done(double change, double last_change) const;
  bool is_settled(int round, double change, double last_change) const;
  Bands next_bands(int round, double change, double last_change) const;
  void tell_progress(double fraction) const;
  void count(const Counters& done);
  std::int64_t most_cells() const;
  Counters explore();
  Counters run_round(int round);
  Index part_count() const;
  void keep_compact();
  void choose_size_factor();
  void set_size_factor(double factor);
  bool control_count(double change);
  void resize(double factor);

  const RemeshOptions& options_;
  MetricSampler sampler_;
  WorkingMesh mesh_;
  std::int64_t compact_count_ = 0;
  double growth_ = 1;  ///< of the number of cells in the last round
  Bands bands_ = Bands::kWide;
  RemeshReport report_;
};

}  // namespace mesamis::detail::remesh
