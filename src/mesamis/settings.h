// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "mesamis/base/types.h"
#include "mesamis/image/grey_values.h"
#include "mesamis/image/volume.h"

namespace mesamis {

enum class LengthUnit {
  kVoxel,  ///< the geometric mean of the input's spacing: the parameters fit any resolution
  kMm      ///< 1 mm, as in the paper
};
enum class SurfaceKind {
  kSolid,  ///< level set of u, closed
  kBand    ///< the paper's Sigma_h: boundary of the cells where v is small
};
enum class ThresholdRule { kAuto, kNone, kValue };

/// Of the geometric mean of the voxels' spacing.
inline constexpr double kDefaultTolerance = 0.1;
/// Voxels: what is smaller cannot be told from noise.
inline constexpr double kDefaultMinVolume = 4;

/// Everything a run depends on, with its default, unit and range. Empty optionals are chosen from
/// the volume; the result tells the values used.
struct Settings {
  // The image.
  CropRange crop;                                       ///< voxels
  std::array<Index, 3> stride{1, 1, 1};                 ///< voxels per node of the first grid, >= 1
  std::optional<Window> window;                         ///< native units; default: default_window()
  ThresholdRule threshold_rule = ThresholdRule::kAuto;  ///< (13)
  double threshold = 0;  ///< T, native units, for ThresholdRule::kValue
  /// Standard deviation of the noise, native units, >= 0; default: measure_noise().
  std::optional<double> noise;
  /// Standard deviations of the blur to undo along the axes, voxels, 0 (leave it) to kLargestBlur;
  /// default: measure_blur().
  std::optional<std::array<double, 3>> blur;

  // The functional (2); lengths in length units.
  LengthUnit length_unit = LengthUnit::kVoxel;
  double epsilon = 1e-3;           ///< > 0
  std::optional<double> eta;       ///< > 0; default: epsilon^2
  double beta = 2;                 ///< > 0
  std::optional<double> gamma;     ///< > 0; default: default_gamma()
  int amis_iterations = 10;        ///< Jmax of Algorithm 1, 1 to 1000
  double tol_v = 1e-2;             ///< Fxv, 0 to 1
  double solver_tolerance = 1e-6;  ///< relative residual of each solve, 1e-14 to 1e-2

  // The mesh.
  std::optional<std::int64_t> max_tets;  ///< NMAX, 100 to 2e8; default: default_max_tets()
  double tau = 1e-2;                     ///< tolerance on the estimator, > 0
  int adaptations = 10;                  ///< at most, 1 to 100
  double tol_mesh = 1e-2;                ///< relative change of the cell count, >= 0
  double tol_energy = 1e-2;              ///< relative change of the energy, >= 0
  bool stop_at_first = false;            ///< true: the printed rule, stop when one stagnates
  double max_stretch = 10;               ///< longest to shortest size of a cell, 1.1 to 1e6
  double gradation = 0;  ///< growth of sizes from edge to edge, see limit_gradation(), 1.01 to
                         ///< 1000; 0: any
  double h_min = 0.5;    ///< smallest edge, length units, > 0
  std::optional<double> h_max;  ///< largest edge, length units; default: a quarter
                                ///< of the box's longest side

  // The surface.
  SurfaceKind surface = SurfaceKind::kSolid;
  /// Native units; default: that of find_object(), measured once more along the surface itself.
  std::optional<double> level;
  double band_threshold = 0.1;  ///< TOLth, 0 to 1
  // The solid's parts, see PartSelection.
  /// mm^3, >= 0: smaller islands go, smaller cavities are filled; default: kDefaultMinVolume
  /// voxels.
  std::optional<double> min_volume;
  std::int64_t keep_largest = 0;  ///< islands to keep; 0: all
  bool fill_cavities = false;     ///< every cavity
  /// How far decimation may take the solid surface, mm, in both directions; 0: as extracted;
  /// default: kDefaultTolerance voxels, or no bound where `triangles` is given.
  std::optional<double> tolerance;
  std::optional<std::int64_t> triangles;  ///< where decimation stops, 4 to 2e9; default: nowhere
};

/// @throws InputError  for the first value out of range, naming the setting, range and value.
void require_valid(const Settings& settings);

/// The bounds of what is chosen for max_tets.
inline constexpr std::int64_t kFewestTets = 20'000, kMostTets = 2'000'000;

/// The default of max_tets: four and a half cells for every square on the object's surface whose
/// side is the voxel's shortest (half as many again as marching cubes would make triangles in cubic
/// voxels), between kFewestTets and kMostTets. It grows with the extent of the edges, not with the
/// empty space around them, and thick slices do not lessen it: the mesh has to hold the shape
/// between them. Only where they are thicker than eight such sides an eighth of that counts.
/// @param area     of the object's surface, mm^2, see ObjectEdges.
/// @param spacing  of the voxels, mm.
std::int64_t default_max_tets(double area, const Vec3& spacing);

/// The default of gamma: 4 epsilon beta (s c)^2 makes v fall below one half where u changes by more
/// than s c over a length unit, c being the object's contrast; s grows with the noise, so that it
/// is no edge. The paper's 0.1 is right for one window and one contrast; this is for any.
/// @param contrast  of the object, grey values, > 0.
/// @param noise     left in the image, grey values, >= 0.
double default_gamma(double epsilon, double beta, double contrast, double noise);

}  // namespace mesamis
