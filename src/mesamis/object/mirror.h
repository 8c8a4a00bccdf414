// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "mesamis/image/grey_values.h"
#include "mesamis/image/volume.h"
#include "mesamis/object/object_request.h"

/// Dark objects (airways in CT, bone in MR): in the mirrored image they are bright.
namespace mesamis::detail::object {

/// Turns the sign of all samples. A dark object becomes a bright one, with the same surface at the
/// mirrored level. Twice gives the volume back.
/// @param volume  native units; taken over, pass it with std::move() to save the copy.
/// @return native units, mirrored.
Volume mirrored(Volume volume);

/// From the native units of a scan to those of an object's image, and back: the same function both
/// ways. For a dark object all values change their sign, and the ends of a window change places; for
/// others nothing does.
class ImageUnits {
 public:
  /// Of the image of such a tissue.
  explicit ImageUnits(TissueKind kind = TissueKind::kBright) noexcept
      : mirrored_(kind == TissueKind::kDark) {}

  /// A value, or a difference of two.
  double turned(double value) const noexcept { return mirrored_ ? -value : value; }
  /// A range of values.
  Window turned(const Window& window) const noexcept {
    return mirrored_ ? Window{-window.high, -window.low} : window;
  }
  /// Window and threshold.
  GreyMap turned(const GreyMap& map) const noexcept;
  /// A tissue: a dark one is bright where all values have changed their sign.
  Tissue turned(Tissue tissue) const;

 private:
  bool mirrored_;
};

/// Makes an image in which all that lies between two values is bright: that many native units above
/// 0 by which a sample is within the range, and below 0 those outside. Its level is 0.
///
/// Where an object that is brighter than the range borders on one that is darker, the blur passes
/// through the range: the image then shows a skin about a voxel thick.
/// @param volume  taken over.
/// @param range   native units, low < high.
/// @return native units.
/// @throws InputError  unless low < high.
Volume within_range(Volume volume, const Window& range);

}  // namespace mesamis::detail::object
