// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "mesamis/base/types.h"
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
enum class StopRule {
  kSurface,  ///< a further mesh would move the surface by less than its expected error
  kEnergy,   ///< mesh and energy have settled
  kEither    ///< mesh or energy has settled, as the paper prints it
};
enum class ThresholdRule {
  kAuto,   ///< from the histogram, see find_tissue_threshold()
  kNone,   ///< no threshold
  kPaper,  ///< 140 of the 255 grey values, the paper's (13)
  kValue   ///< Settings::threshold
};

/// The requested settings. A run does not change them; Parameters hold the values it uses.
///
/// A member without a value is chosen from the volume. Unit, range, help text and the rule behind
/// each choice are in setting_table(), which the command line, JSON files, require_valid() and
/// docs/settings.md follow. The defaults of a run are those written here.
struct Settings {
  // The image.
  CropRange crop;
  std::optional<std::array<Index, 3>> stride;
  std::optional<Window> window;
  ThresholdRule threshold_rule = ThresholdRule::kAuto;
  double threshold = 0;
  bool restore = true;
  std::optional<double> noise;
  std::optional<std::array<double, 3>> blur;

  // The functional (2).
  LengthUnit length_unit = LengthUnit::kVoxel;
  double epsilon = 1e-3;
  std::optional<double> eta;
  double beta = 2;
  std::optional<double> gamma;
  int amis_iterations = 10;
  double tol_v = 1e-2;
  double solver_tolerance = 1e-6;

  // The mesh.
  std::optional<std::int64_t> max_tets;
  double tau = 1e-2;
  int adaptations = 10;
  double tol_mesh = 1e-2;
  double tol_energy = 1e-2;
  StopRule until = StopRule::kSurface;
  bool drafts = true;
  double max_stretch = 10;
  double gradation = 0;
  double h_min = 0.5;
  std::optional<double> h_max;

  // The surface.
  SurfaceKind surface = SurfaceKind::kSolid;
  std::optional<double> level;
  /// Without a `level`: one for each place of a CT scan, where these differ, see LocalLevel.
  bool local_level = true;
  bool follow = true;
  bool fit = true;
  bool keep_topology = false;
  double band_threshold = 0.1;
  std::optional<double> min_volume;
  std::int64_t keep_largest = 0;
  bool fill_cavities = false;
  std::optional<double> accuracy;
  std::optional<double> tolerance;
  std::optional<std::int64_t> triangles;

  bool preview = false;

  /// Whether each place may have a level of its own.
  bool has_local_level() const { return local_level && !level && surface == SurfaceKind::kSolid; }
};

}  // namespace mesamis
