// SPDX-License-Identifier: Apache-2.0
#include "mesamis/baseline/baseline_surface.h"

#include "mesamis/base/stopwatch.h"
#include "mesamis/restore/half_maximum_level.h"

namespace mesamis {
namespace {

/// Starts a contour at the level; sets contour and surface.
void follow_contour(const Volume& volume, const BaselineOptions& options, const Progress& progress,
                    BaselineSurface& made) {
  const GeodesicContour contour = geodesic_contour(volume, made.level, options.geodesic, progress);
  IsosurfaceOptions unsmoothed = options.isosurface;
  unsmoothed.smooth_voxels = 0;
  made.contour = contour.report;
  made.surface = isosurface(contour.level_set, 0, unsmoothed);
}

}  // namespace

BaselineSurface make_baseline(const Volume& volume, const BaselineOptions& options,
                              const Progress& progress) {
  Stopwatch watch;
  BaselineSurface made;
  made.level = options.level ? *options.level : find_half_maximum_level(volume).level;
  if (options.method == BaselineMethod::kGeodesic) {
    follow_contour(volume, options, progress, made);
  } else {
    made.surface = isosurface(volume, made.level, options.isosurface);
  }
  made.seconds = watch.lap();
  return made;
}

}  // namespace mesamis
