// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <limits>
#include <vector>

#include "mesamis/image/volume.h"

/// From native units (HU, counts) to the grey values in [0, 255] the method works on.
namespace mesamis {

/// f = 255 clamp((I - low) / (high - low), 0, 1), then (13): f_t = max(f, T).
struct GreyMap {
  double low = 0, high = 255;  ///< native units, low < high
  double threshold = 0;        ///< T in native units; low or less: no threshold

  double to_grey(double native) const { return 255 * (native - low) / (high - low); }
  double to_native(double grey) const { return low + grey / 255 * (high - low); }
};

/// @throws InputError  if low < high does not hold.
Volume apply(const GreyMap& map, Volume volume);

/// The values below which the given fractions of the samples lie, to a 4096th of their range.
std::vector<double> quantiles(const Volume& volume, const std::vector<double>& fractions);

/// Two classes of least variance (Otsu 1979).
struct OtsuSplit {
  double threshold;               ///< between them
  double mean_below, mean_above;  ///< of the classes; both the threshold if there is but one
};
/// @param below  only samples below this count.
OtsuSplit otsu_split(const Volume& volume, double below = std::numeric_limits<double>::infinity());

/// True if the samples are Hounsfield units: modality CT, or values from air (-1000) upwards.
bool is_hounsfield(const Volume& volume);

struct Window {
  double low, high;
};
/// CT: -200 HU to the 99.9 percentile, but at least to 800 and at most to 2000 HU, so that bone
/// gets nearly all the contrast; where the object's outside is darker than that (a phantom in
/// air), from the 0.1 percentile, so that no edge is cut. Else the 0.1 and 99.9 percentiles.
/// @param outside  what lies around the object, native units (see find_object()).
Window default_window(const Volume& volume, double outside);

/// Every sample replaced by the binomial mean 1 2 1 of its line, in all three directions: a
/// Gaussian of 0.7 voxels. Lines end by repeating their last sample. A direction in which voxels
/// are more than twice as long as in the shortest is left alone: slices that far apart show
/// another part of the object, not the same once more.
Volume smoothed(const Volume& volume);

}  // namespace mesamis
