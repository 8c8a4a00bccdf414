// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <limits>
#include <span>
#include <utility>
#include <vector>

#include "mesamis/image/volume.h"
#include "mesamis/rooms.h"

/// From native units (HU, counts) to the grey values in [0, 255] the method works on.
namespace mesamis::detail::image {

/// f = 255 clamp((I - low) / (high - low), 0, 1), then (13): f_t = max(f, T).
struct GreyMap {
  double low = 0, high = 255;  ///< native units, low < high
  double threshold = 0;        ///< T in native units; low or less: no threshold

  /// The grey value of a native value, not clamped.
  double to_grey(double native) const noexcept { return 255 * (native - low) / (high - low); }
  /// The native value of a grey value.
  double to_native(double grey) const noexcept { return low + grey / 255 * (high - low); }
  /// Grey values per native unit: what noise and contrasts are multiplied by.
  double grey_per_native() const noexcept { return to_grey(1) - to_grey(0); }
  /// Whether T acts.
  bool has_threshold() const noexcept { return threshold > low; }
};

/// Maps all samples to grey values, clamped to [max(0, f(T)), 255].
/// @param volume  native values; taken over, pass it with std::move() to save the copy.
/// @throws InputError  unless low < high.
Volume apply(const GreyMap& map, Volume volume);

/// Finds the least and the largest of the samples.
/// @param samples  at least one, all finite, any unit.
/// @return in that unit, the least first.
///
/// O(samples), in threads.
std::pair<float, float> sample_range(std::span<const float> samples);

/// Finds the values below which the given fractions of the samples lie, to a 4096th of their range.
/// @param samples    at least one, all finite, any unit.
/// @param fractions  0 to 1.
/// @return in that unit, one per fraction.
std::vector<double> quantiles(std::span<const float> samples, const std::vector<double>& fractions);

/// Two classes of samples, in their unit.
struct OtsuSplit {
  double threshold;               ///< between the classes
  double mean_below, mean_above;  ///< of the classes; both the threshold if there is only one
};

/// Splits the samples into the two classes of least variance, on a histogram of 4096 bins. Source:
/// Otsu, A threshold selection method from gray-level histograms, IEEE SMC 9, 1979.
/// @param samples  at least one, all finite, any unit.
/// @param below    in that unit: only samples below this value count.
OtsuSplit otsu_split(std::span<const float> samples,
                     double below = std::numeric_limits<double>::infinity());

/// Whether the samples are Hounsfield units: the modality is CT or, where it is unknown, the
/// samples look like it.
///
/// Air tells it: at least one sample in 200 of -1100 to -840, at most half as many below that down
/// to -1500, and something above 0. So do tissues, where a part of a scan has no air: a quarter of
/// all samples lie in -200 to 300, one in 200 in -140 to -20 (fat; one in 4000 below -60, where
/// noise around 0 has none), one in 2000 above 200; the most frequent value, in bins of 20, lies in
/// -140 to 140, or the least samples are those of air; one in 1000 at most is darker than air, and
/// one in 20 is 0. Neither asks how bright metal is.
/// @param volume  at least one sample, all finite.
///
/// O(voxels) where the modality is unknown.
bool is_hounsfield(const VolumeView& volume);

/// Nothing is darker than air (-1000 HU): Hounsfield units of this and less are padding.
inline constexpr float kPaddingHu = -1500;

/// Chooses the range of values that is mapped to grey values.
///
/// CT: -200 HU to the 99.9 percentile, which is bounded to 800 to 2000 HU, so that bone gets nearly
/// all the contrast; if the background of the object is darker than -200 HU (a phantom in air),
/// from the 0.1 percentile, so that no edge is cut. Other images: the 0.1 to the 99.9 percentile.
/// @param volume      at least one sample, all finite.
/// @param background  value around the object, native units, see ObjectContrast.
/// @return native units; low < high unless all samples are equal.
Window default_window(const VolumeView& volume, double background);

/// Bounds all samples by a window: what lies beyond takes the value of its end.
/// @param window  native units; low at most high.
/// @return native units.
///
/// O(voxels), in threads; a copy of the samples.
Volume clamped(const VolumeView& volume, const Window& window);

/// Smooths an image by the binomial filter 1 2 1 along each axis: a Gaussian of standard deviation
/// 0.7 voxels. Beyond the border the last sample is repeated. An axis along which voxels are more
/// than twice as long as along the shortest is not smoothed: slices that far apart show different
/// parts of the object.
/// @param volume  as many samples as voxels.
///
/// O(voxels), a copy of the samples. The same bits for any number of threads.
Volume smoothed(const VolumeView& volume);

}  // namespace mesamis::detail::image
