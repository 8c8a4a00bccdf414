// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "mesamis/base/types.h"
#include "mesamis/rooms.h"

namespace mesamis::detail::base {

/// A number in single precision, as files hold it, with -0 as +0. The addition makes it so, and keeps
/// GCC 12 from leaving out the rounding of neighbours that it computes at once.
inline double rounded(double x) { return static_cast<float>(x) + 0.0f; }
/// A point in single precision, mm.
inline Vec3 rounded(const Vec3& p) { return {rounded(p.x), rounded(p.y), rounded(p.z)}; }

}  // namespace mesamis::detail::base
