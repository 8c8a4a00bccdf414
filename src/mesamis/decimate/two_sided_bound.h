// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include "mesamis/decimate/collapse.h"
#include "mesamis/decimate/cover.h"
#include "mesamis/decimate/covering.h"
#include "mesamis/decimate/flip.h"
#include "mesamis/decimate/rim_walk.h"

namespace mesamis::detail::decimate {

/// What the triangles of a surface stand for while it changes, and the proof that both are near each
/// other: each triangle is near the originals, and each original is near triangles that are listed to
/// stand for it. It stays true with each collapse allowed here, so that nothing is left to check.
///
/// Where a collapse lifts the surface by so little that what was near stays near, nothing else is
/// looked at. Else distances are found anew: by a walk along the rim of each triangle, or, where that
/// fails, by cutting it to pieces.
class TwoSidedBound {
 public:
  /// @param original   mm; what cover.originals number.
  /// @param cover      over points as they are; read where it is, also later.
  /// @param held       of each point 1 if it stays: triangles between such points stay too.
  /// @param tolerance  mm, > 0, finite.
  TwoSidedBound(const TriMesh& original, const Cover& cover, const std::vector<char>& held,
                double tolerance);

  /// Whether the proof holds after a collapse.
  bool allows(const EditableSurface& surface, const std::vector<Vec3>& points,
              const Collapse& collapse);
  /// Takes over the last collapse that was allowed.
  void apply(const Collapse& collapse);
  /// The same for a flip that has been made.
  bool allows(const EditableSurface& surface, const Flip& flip);
  void apply(const Flip& flip) { replace(flip.faces); }

  /// Whether a triangle stays.
  bool stays(Index triangle) const { return stays_[triangle] != 0; }
  /// The originals that a triangle stands for, increasing.
  std::vector<Index> originals_of(Index triangle) const;
  /// From which none of its points is farther from the originals, mm.
  double to_originals_of(Index triangle) const { return bounds_[triangle].to_originals; }
  /// From which no original that it stands for is farther from the surface, mm.
  double from_originals_of(Index triangle) const { return bounds_[triangle].from_originals; }

 private:
  /// Of a triangle, mm.
  struct Bounds {
    double to_originals = 0;    ///< from any of its points to an original
    double from_originals = 0;  ///< from any point that it stands for to the surface
  };
  struct Affected {
    Index original;
    Index guess;      ///< a triangle that its centre may be near
    double distance;  ///< of its centre, mm^2
  };
  struct Use {
    Index original, triangle;
    double distance;  ///< from the original to the surface, mm
  };

  void start(std::span<const Index> faces);
  void gather(Index triangle, Index guess);
  void gather(const Collapse& collapse);
  void see_after(const Collapse& collapse);
  void swap_after(std::span<const Index> faces);
  void replace(std::span<const Index> faces);
  void look_around(const WalkedSurface& on);
  bool ends_are_near(const std::vector<Vec3>& points, const Collapse& collapse) const;
  Bounds bounds_after(double height, std::initializer_list<std::span<const Index>> triangles) const;
  bool lift(const Bounds& bounds, std::span<const Index> faces);
  bool centers_are_near(const WalkedSurface& on);
  bool old_are_near(const WalkedSurface& on, std::span<const Index> faces);
  bool is_near(const Affected& a, const WalkedSurface& on);
  double distance_of_new(Index face, const TrianglePlanes& after);
  bool new_are_near(std::span<const Index> faces);

  const Cover& cover_;  // as it was
  double tolerance_;
  RimWalk walk_;
  Covering covering_;
  std::vector<char> stays_;     // of each triangle 1 if it does
  std::vector<Index> numbers_;  // of the originals of triangles that may change, and of those at
                                // their corners, increasing
  std::vector<TrianglePlanes> originals_;  // in this order
  EditableSurface original_surface_;       // of these
  std::vector<std::vector<Index>> lists_;  // of each triangle, places in this order; of those that
                                           // stay only what they have come to stand for
  std::vector<TrianglePlanes> triangles_;  // as they are
  std::vector<Bounds> bounds_;             // of each triangle
  // Of the collapse that is looked at.
  std::vector<Affected> affected_;
  std::vector<TrianglePlanes> after_;          // it
  std::vector<const TrianglePlanes*> around_;  // triangles after it, then those near by that stay
  std::vector<Index> around_number_;           // of each of these
  std::vector<Use> uses_;
  std::vector<Bounds> next_;  // of the triangles that change
  std::vector<const TrianglePlanes*> near_;
  std::vector<Index> seen_;         // of each original, the last collapse that affected it
  std::vector<Index> seen_points_;  // of their corners the same
  Index collapse_count_ = 0;
};

}  // namespace mesamis::detail::decimate
