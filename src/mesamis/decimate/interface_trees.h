// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <vector>

#include "mesamis/surface/tri_mesh.h"
#include "mesamis/surface/triangle_tree.h"

namespace mesamis::detail::decimate {

/// A surface whose triangles belong to interfaces: of one object, a single one.
struct SplitSurface {
  TriMesh surface;
  std::vector<Index> interface;  ///< of each triangle, 0 to one less than their number
};

/// Of each point the interface of its triangles; kNoIndex: of several, or none.
std::vector<Index> interfaces_of_points(const SplitSurface& split);

/// A search for each interface of a surface, among its triangles alone.
class InterfaceTrees {
 public:
  /// @param count  of interfaces; each has a triangle.
  InterfaceTrees(const SplitSurface& split, std::size_t count);

  /// The tree of an interface.
  const TriangleTree& tree(Index interface) const { return trees_[at(interface)]; }
  /// The triangle of the surface that a search in the interface's tree ended at.
  Index index_of(Index interface, std::size_t hint) const {
    return chosen_[at(interface)][at(tree(interface).index_of(hint))];
  }
  /// Where searches start.
  std::vector<std::size_t> hints() const { return std::vector<std::size_t>(trees_.size(), 0); }

 private:
  static std::size_t at(Index n) { return static_cast<std::size_t>(n); }

  std::vector<std::vector<Index>> chosen_;  // triangles of each interface
  std::vector<TriangleTree> trees_;
};

}  // namespace mesamis::detail::decimate
