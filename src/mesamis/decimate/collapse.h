// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <span>
#include <vector>

#include "mesamis/decimate/editable_surface.h"
#include "mesamis/surface/triangle_tree.h"

namespace mesamis::detail::decimate {

/// A collapse: of what it changes, before and after. An edge goes, with one of its points and the
/// triangles beside it; its other point may move.
struct Collapse {
  /// Inside the surface it runs from the point that goes to the other one.
  Index half_edge = kNoIndex, removed = kNoIndex, kept = kNoIndex;
  Vec3 place{0, 0, 0};  ///< of the kept point from now on, mm
  bool moves = false;   ///< whether that is another place
  bool at_rim = false;  ///< whether both points go on along a rim
  std::array<Index, 2>
      beside{};  ///< triangles of the edge, see gone(); at a rim one, then kNoIndex
  /// The triangles that change, counter-clockwise around the edge, from its left end or from the
  /// rim on: around the point that goes, and, if the other moves, around that too. Their first
  /// corner is the point that changes.
  std::vector<Index> faces;
  std::vector<Index> outer;    ///< of each of these, the half-edge opposite to that corner
  std::vector<Corners> after;  ///< of each of these, mm: the place comes first
  /// Between the triangles before and after, see fan_height(), mm; infinity: one of both folds over
  /// itself.
  double height = 0;

  /// The triangles that go.
  std::span<const Index> gone() const { return {beside.data(), at_rim ? 1u : 2u}; }
};

/// Describes a collapse.
/// @param h  a half-edge for which may_collapse() is true; if the kept point moves, that is an inner
///           point too.
void describe(const EditableSurface& surface, const std::vector<Vec3>& points, Index h,
              const Vec3& place, Collapse& collapse);

/// Describes a collapse of an edge at a rim.
/// @param h        a half-edge for which may_collapse_at_rim() is true.
/// @param removed  one of its ends.
void describe_at_rim(const EditableSurface& surface, const std::vector<Vec3>& points, Index h,
                     Index removed, const Vec3& place, Collapse& collapse);

/// Calls visit(half-edge, is first) for the sides of the triangles that go which remain at the kept
/// point: where it does not move, the first or the last triangle that changes comes to lie there.
template <class Visit>
void for_each_side_at_kept(const EditableSurface& surface, const Collapse& collapse,
                           Visit&& visit) {
  const Index h = collapse.half_edge, o = surface.opposite(h);
  if (surface.to(h) == collapse.kept) {
    visit(EditableSurface::next(h), true);
  } else {
    visit(EditableSurface::previous(h), false);
  }
  if (o != kNoIndex) visit(EditableSurface::previous(o), false);
}

/// Cosine of the angle, 75 degrees, by which a triangle that is no needle may turn.
inline constexpr double kMostTurned = 0.2588;
/// The least flatness() that changes may make.
inline constexpr double kFlattest = 0.01 * 0.01;

/// Squared height over longest side of a triangle, squared.
double flatness(const Corners& t);

/// The share of an edge in the creases of a surface: its length, mm, times by how much the cosine
/// between the triangles beside it, of these unit normals, is less than kCrease; at most as at
/// kSharpCrease.
double crease_at(const Vec3& from, const Vec3& to, const Vec3& left, const Vec3& right);

/// Whether creases have grown by more than a tenth.
bool creases_grow(double before, double after);

/// Whether a triangle that is no needle would turn by more than 75 degrees, or one become nearly
/// degenerate (height below 0.01 of its longest side, and below that of the flattest triangle before),
/// or the creases around grow by more than a tenth: the sum over edges of their length times the
/// cosine of kCrease less that of the edge, see crease_at().
/// @param normals   of each triangle, unit length or 0.
/// @param creases   whether these count.
bool spoils_shape(const EditableSurface& surface, const std::vector<Vec3>& points,
                  const std::vector<Vec3>& normals, const Collapse& collapse, bool creases);

}  // namespace mesamis::detail::decimate
