// SPDX-License-Identifier: Apache-2.0
#include "mesamis/remesh/piece.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>

#include "mesamis/base/parallel.h"
#include "mesamis/mesh/predicates.h"
#include "mesamis/mesh/region.h"
#include "support/metric_fields.h"
#include "support/perturbed_box.h"
#include "support/throws.h"

namespace mesamis {
namespace {

using testing::HasSubstr;
using Coordinates = std::array<double, 3>;
using Face = std::set<Coordinates>;

Coordinates coordinates(const Vec3& p) { return {p.x + 0.0, p.y + 0.0, p.z + 0.0}; }

double height_of(const TetMesh& mesh, const Cell& cell) {
  double sum = 0;
  for (const Index corner : cell) sum += mesh.points[static_cast<std::size_t>(corner)].z;
  return sum / 4;
}

/// The cells whose centroids lie below a height, or those above. The cut follows the cells.
TetMesh side_of(const TetMesh& mesh, double height, bool above) {
  std::vector<Index> cells;
  for (std::size_t c = 0; c < mesh.cells.size(); ++c) {
    if ((height_of(mesh, mesh.cells[c]) >= height) == above) cells.push_back(static_cast<Index>(c));
  }
  return restrict_mesh(mesh, cells).mesh;
}

TetMesh joined(const std::vector<TetMesh>& pieces) {
  TetMesh whole;
  std::map<Coordinates, Index> known;
  for (const TetMesh& piece : pieces) {
    for (Cell cell : piece.cells) {
      for (Index& corner : cell) {
        const Vec3& p = piece.points[static_cast<std::size_t>(corner)];
        const auto [place, is_new] =
            known.try_emplace(coordinates(p), static_cast<Index>(whole.points.size()));
        if (is_new) whole.points.push_back(p);
        corner = place->second;
      }
      whole.cells.push_back(cell);
    }
  }
  return whole;
}

bool lie_in_one_plane(const Face& face, const Box& box) {
  for (int axis = 0; axis < 3; ++axis) {
    for (const double plane : {box.lo[axis], box.hi[axis]}) {
      const auto at = static_cast<std::size_t>(axis);
      if (std::all_of(face.begin(), face.end(), [&](const auto& p) { return p[at] == plane; })) {
        return true;
      }
    }
  }
  return false;
}

/// The faces of one cell that lie in no plane of the box, by their coordinates.
std::set<Face> border_of(const TetMesh& piece, const Box& box) {
  std::map<Face, int> cells_at;
  for (const Cell& cell : piece.cells) {
    for (std::size_t without = 0; without < 4; ++without) {
      Face face;
      for (std::size_t i = 0; i < 4; ++i) {
        if (i != without) {
          face.insert(coordinates(piece.points[static_cast<std::size_t>(cell[i])]));
        }
      }
      ++cells_at[face];
    }
  }
  std::set<Face> border;
  for (const auto& [face, count] : cells_at) {
    if (count == 1 && !lie_in_one_plane(face, box)) border.insert(face);
  }
  return border;
}

std::set<Coordinates> corners_of(const std::set<Face>& faces) {
  std::set<Coordinates> corners;
  for (const Face& face : faces) corners.insert(face.begin(), face.end());
  return corners;
}

void expect_positive(const TetMesh& mesh) {
  for (const Cell& cell : mesh.cells) {
    const auto [p, q, r, s] = cell_corners(mesh, cell);
    ASSERT_TRUE(certified_positive(p, q, r, s));
  }
}

TetMesh start() { return perturbed_box(kUnitBox, {6, 5, 8}, 0.2); }

TEST(RemeshPiece, KeepsItsBorderBitForBit) {
  const TetMesh piece = side_of(start(), 0.5, false);
  const std::set<Face> border = border_of(piece, kUnitBox);
  ASSERT_GT(border.size(), 50U);
  for (const double size : {0.06, 0.4}) {  // finer and coarser than the piece
    const TetMesh adapted = remesh_piece(piece, kUnitBox, uniform_metric(size));
    EXPECT_EQ(border_of(adapted, kUnitBox), border);
    EXPECT_EQ(adapted.cells.size() > piece.cells.size(), size < 0.1);
    expect_positive(adapted);
    const std::set<Coordinates> corners = corners_of(border);
    std::set<Coordinates> first;
    for (std::size_t n = 0; n < corners.size(); ++n) first.insert(coordinates(adapted.points[n]));
    EXPECT_EQ(first, corners) << "the border's points come first";
  }
}

TEST(RemeshPiece, PiecesThatWereAdaptedApartFit) {
  const FormulaMetric metric([](const Vec3& p) {
    const double across = 0.15, up = 0.05 + 0.15 * std::abs(p.x - 0.3);
    return Sym3{1 / (across * across), 0, 0, 1 / (across * across), 0, 1 / (up * up)};
  });
  for (const Index part_cells : {40000, 300}) {
    RemeshOptions options;
    options.part_cells = part_cells;
    std::vector<TetMesh> pieces;
    for (const bool above : {false, true}) {
      pieces.push_back(remesh_piece(side_of(start(), 0.5, above), kUnitBox, metric, options));
    }
    const TetMesh whole = joined(pieces);
    EXPECT_EQ(find_flaw(whole, kUnitBox), "");
    // Then the cells around the border, as a piece between two others.
    const TetMesh low = side_of(whole, 0.25, false), rest = side_of(whole, 0.25, true);
    const TetMesh middle = side_of(rest, 0.75, false), high = side_of(rest, 0.75, true);
    const TetMesh seam = remesh_piece(middle, kUnitBox, metric, options);
    EXPECT_EQ(find_flaw(joined({low, seam, high}), kUnitBox), "");
    EXPECT_NE(seam.cells.size(), middle.cells.size()) << "what was the border is adapted now";
  }
}

/// The least volume of a cell, as a share of the cube of its longest edge.
double flattest(const TetMesh& mesh) {
  double least = 1;
  for (const Cell& cell : mesh.cells) {
    const auto corners = cell_corners(mesh, cell);
    double longest = 0;
    for (const auto& [i, j] : kCellEdges)
      longest = std::max(longest, norm(corners[i] - corners[j]));
    const double volume = six_volume(corners[0], corners[1], corners[2], corners[3]) / 6;
    least = std::min(least, volume / (longest * longest * longest));
  }
  return least;
}

// Edges of a border that stays may be far too long for the metric. What is adapted around them must
// not come nearer and nearer to them.
TEST(RemeshPiece, CellsAtABorderOfLongEdgesAreNotFlat) {
  const TetMesh piece = side_of(perturbed_box(kUnitBox, {3, 3, 4}, 0.2), 0.5, false);
  ASSERT_GT(flattest(piece), 1e-2);
  for (const double size : {0.1, 0.05}) {
    EXPECT_GT(flattest(remesh_piece(piece, kUnitBox, uniform_metric(size))), 1e-4) << size;
  }
}

TEST(RemeshPiece, IsRemeshWhereThePieceIsTheWhole) {
  const TetMesh adapted = remesh_piece(start(), kUnitBox, uniform_metric(0.12));
  EXPECT_EQ(find_flaw(adapted, kUnitBox), "");
  const TetMesh other = remesh(start(), uniform_metric(0.12));
  EXPECT_NEAR(static_cast<double>(adapted.cells.size()) / static_cast<double>(other.cells.size()),
              1, 0.05);
}

TEST(RemeshPiece, TheSameBitsForAnyNumberOfThreads) {
  const TetMesh piece = side_of(start(), 0.5, true);
  RemeshOptions options;
  options.part_cells = 400;
  const auto adapted = [&](int threads) {
    return with_threads(
        threads, [&] { return remesh_piece(piece, kUnitBox, uniform_metric(0.08), options); });
  };
  const TetMesh one = adapted(1);
  for (const int threads : {2, 4}) {
    const TetMesh other = adapted(threads);
    EXPECT_EQ(other.points, one.points);
    EXPECT_EQ(other.cells, one.cells);
  }
}

TEST(RemeshPiece, NothingStaysNothing) {
  const TetMesh adapted = remesh_piece({}, kUnitBox, uniform_metric(0.2));
  EXPECT_TRUE(adapted.cells.empty());
  EXPECT_TRUE(adapted.points.empty());
}

TEST(RemeshPiece, RefusesCellsWithoutPositiveVolume) {
  TetMesh piece = side_of(start(), 0.5, false);
  std::swap(piece.cells[7][0], piece.cells[7][1]);
  EXPECT_REFUSED(remesh_piece(piece, kUnitBox, uniform_metric(0.2)), HasSubstr("cell 7 "));
}

TEST(RemeshPiece, StopsWhereProgressSays) {
  RemeshOptions options;
  options.progress = [](std::string_view, double) { return false; };
  EXPECT_THROW(remesh_piece(side_of(start(), 0.5, false), kUnitBox, uniform_metric(0.05), options),
               Cancelled);
}

}  // namespace
}  // namespace mesamis
