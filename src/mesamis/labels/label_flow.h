// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "mesamis/fem/solve.h"
#include "mesamis/labels/flow_memberships.h"

namespace mesamis::detail::labels {

/// The nodes of a label's own: a range of each axis.
struct LabelExtent {
  std::array<Index, 3> lo{}, hi{};  ///< both within
};

/// Where the membership of one label is open, and what it is there.
struct LabelMembership {
  std::vector<std::size_t> nodes;  ///< of the grid, increasing
  std::vector<float> value;        ///< 0 to 1; what is next to nothing is left out
  SolveReport solved;
};

/// What smooth_memberships() says of a label at a node: 0 to 1.
float smooth_membership(const GridMemberships& smooth, std::size_t node, std::uint16_t label);

/// The flow of one label after the other, see flow_memberships(). Labels may be solved at once.
class LabelFlow {
 public:
  /// @param grid, fields, options  as for flow_memberships(); they must live longer than this.
  LabelFlow(const LabelGrid& grid, const FlowFields& fields, const FlowOptions& options);

  /// Solves for one label. O(open nodes within reach * iterations), and the nodes of the block that
  /// holds the label and its reach.
  LabelMembership solve(std::uint16_t label, const LabelExtent& extent) const;

 private:
  struct Window;
  struct System;

  bool is_open(std::size_t node) const;
  Window window_around(const LabelExtent& extent) const;
  std::size_t node_of(const Window& w, std::size_t place) const;
  std::vector<std::uint8_t> reached(std::uint16_t label, const Window& w) const;
  System collect(std::uint16_t label, const LabelExtent& extent) const;
  void add_row(std::uint16_t label, const Window& w, std::size_t place,
               const std::vector<Index>& unknown, System& system) const;

  const LabelGrid& grid_;
  const FlowFields& fields_;
  const FlowOptions& options_;
  double mass_ = 0;
  std::array<double, 3> per_length_{};  // conductance of an edge where v is 1
  int most_steps_ = 0;
};

}  // namespace mesamis::detail::labels
