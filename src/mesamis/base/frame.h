// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "mesamis/base/types.h"

namespace mesamis {

/// The frame in which coordinates of a patient are given. LPS (DICOM, ITK): x to the left, y to the
/// back, z to the head. RAS (NIfTI, 3D Slicer): x to the right, y to the front, z to the head.
enum class Frame { kLps, kRas };

/// @return  "LPS" or "RAS".
constexpr const char* frame_name(Frame frame) { return frame == Frame::kRas ? "RAS" : "LPS"; }

/// Converts a point or a direction from LPS to a frame, or from that frame to LPS: half a turn
/// about z for RAS, nothing for LPS.
/// @param p  of any unit.
/// @return in the same unit.
inline Vec3 in_frame(const Vec3& p, Frame frame) noexcept {
  return frame == Frame::kRas ? Vec3{-p.x, -p.y, p.z} : p;
}

}  // namespace mesamis
