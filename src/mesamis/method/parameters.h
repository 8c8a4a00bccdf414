// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "mesamis/fem/functional.h"
#include "mesamis/image/grey_values.h"
#include "mesamis/method/settings.h"

namespace mesamis::detail::method {

/// What a run uses, see choose.h. origin_of() tells of each setting whether it was given, is the
/// default, or was measured.
struct Parameters {
  // The image.
  CropRange crop;                 ///< voxels
  std::array<Index, 3> stride{};  ///< voxels per node of the first grid
  GreyMap grey;                   ///< native units to grey values: window and T
  bool restore = false;           ///< impulses removed, blur undone
  double noise = 0;               ///< standard deviation, native units
  std::array<double, 3> blur{};   ///< standard deviation along each axis, voxels

  // The functional (2); lengths in length units.
  LengthUnit length_unit = LengthUnit::kVoxel;
  double unit_mm = 1;           ///< the length unit, mm
  AtParameters functional;      ///< epsilon, eta, beta, gamma
  int amis_iterations = 0;      ///< Jmax of Algorithm 1
  double tol_v = 0;             ///< Fxv of Algorithm 1
  double solver_tolerance = 0;  ///< relative residual of each solve

  // The mesh.
  std::int64_t max_tets = 0;            ///< NMAX; 0: open, or no mesh is made
  double tau = 0;                       ///< tolerance on the estimator
  int adaptations = 0;                  ///< at most
  double tol_mesh = 0, tol_energy = 0;  ///< relative changes that count as settled
  StopRule until = StopRule::kSurface;  ///< what ends the loop
  bool drafts = false;                  ///< meshes are cheaper, those before the last most
  double max_stretch = 0;               ///< longest to shortest size of a cell
  double gradation = 0;                 ///< growth of sizes from edge to edge; 0: any
  double h_min = 0, h_max = 0;          ///< edge lengths, length units

  // The surface.
  SurfaceKind surface = SurfaceKind::kSolid;
  double level = 0;               ///< of the solid, native units
  bool local_level = false;       ///< the level is that of the object as a whole, see LocalLevel
  bool follow = false;            ///< the solid is moved on to the image's level set
  bool fit = false;               ///< boundaries of labels are fitted to the image
  bool keep_topology = false;     ///< no tunnels or gaps are closed, no contacts opened
  double band_threshold = 0;      ///< TOLth
  double min_volume = 0;          ///< of islands and cavities that stay, mm^3
  std::int64_t keep_largest = 0;  ///< islands; 0: all
  bool fill_cavities = false;     ///< every cavity
  double accuracy = 0;            ///< asked for, mm; 0: none was
  /// Of decimation, mm, both ways; 0: none done; infinite: no bound; nothing: open until there is a
  /// surface, see choose_tolerance().
  std::optional<double> tolerance{};
  std::int64_t triangles = 0;  ///< where decimation stops; 0: nowhere

  bool preview = false;  ///< the solid of the first grid; no mesh is made
};

/// Takes over what the settings give, and nothing else.
Parameters parameters_asked(const Settings& settings);

/// Makes the settings that repeat a run with these parameters: none of them is "auto" but level and
/// tolerance of a band, which has neither, the number of cells of a preview, which makes none, and a
/// number of triangles and an accuracy that the user did not ask for.
Settings settings_of(const Parameters& parameters);

/// Bounds of what "auto" chooses for max_tets.
inline constexpr std::int64_t kFewestTets = 20'000, kMostTets = 2'000'000;

/// The cells that the surface of an object asks for: four and a half for every square whose side is
/// the voxel's shortest. Marching cubes make about three triangles there in cubic voxels. Surfaces
/// of parts of a scan add up to that of the whole.
///
/// The count grows with the extent of the edges, not with the empty space around them. Thick slices
/// do not lower it, because the mesh has to hold the shape between them; only where slices are
/// thicker than eight of the shortest sides, an eighth of the thickness counts instead.
///
/// A wall or a gap thinner than two voxels has both its faces within a cell or two: there it takes
/// four times as many, or the mesh closes the gap and tears the wall. Between thick slices that is
/// more than it needs.
///
/// A cell of size h leaves a bend by h^2: the number goes with the inverse of the distance that is
/// asked for, from a quarter of the usual to four times it.
/// @param area        of the object's surface, mm^2, >= 0, see measure_extent().
/// @param thin_share  of the area: walls and gaps thinner than two voxels, 0 to 1.
/// @param spacing     of the voxels, mm, > 0.
/// @param accuracy    mean distance to the truth that is asked for, mm, >= 0; 0: the usual.
/// @return a number, no unit.
double cells_for_surface(double area, double thin_share, const Vec3& spacing, double accuracy = 0);

/// The default of stride: every voxel is a node of the first grid, but in more than a million
/// voxels every second one, along each axis where two voxels are no longer than twice the geometric
/// mean of the spacing. The first grid leads to the first mesh alone, and its nodes take the mean
/// of the voxels around them.
/// @param voxels   of the volume along each axis.
/// @param spacing  of the voxels, mm, > 0.
/// @return voxels per node, 1 or 2.
std::array<Index, 3> default_stride(const std::array<Index, 3>& voxels, const Vec3& spacing);

/// The default of stride for a preview: along the axes where the steps are shortest every second
/// voxel, or fewer, until the grid has no more than three million nodes.
/// @param voxels, spacing  as for default_stride().
/// @return voxels per node, at least 1.
std::array<Index, 3> preview_stride(const std::array<Index, 3>& voxels, const Vec3& spacing);

/// The stride of a run: the given one, or the default, that of a preview for a preview.
/// @param voxels, spacing  as for default_stride().
/// @return voxels per node, at least 1.
std::array<Index, 3> stride_of(const Settings& settings, const std::array<Index, 3>& voxels,
                               const Vec3& spacing);

/// The default of gamma, 4 epsilon beta (0.07 c + 0.25 n)^2.
///
/// v falls below one half where beta |grad u|^2 exceeds gamma / (4 epsilon), that is where u
/// changes by more than 0.07 c + 0.25 n over a length unit: the more noise there is, the steeper an
/// edge must be. The paper's 0.1 is right for one window and one contrast.
/// @param epsilon   thickness of the edge indicator, length units, > 0.
/// @param beta      weight of smoothness, length units squared, > 0.
/// @param contrast  c of the object, grey values, > 0.
/// @param noise     n left in the image, grey values, >= 0.
/// @return gamma, grey values squared times length units.
double default_gamma(double epsilon, double beta, double contrast, double noise);

}  // namespace mesamis::detail::method
