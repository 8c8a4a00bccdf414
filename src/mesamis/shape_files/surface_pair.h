// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "mesamis/shape_files/surface_files.h"
#include "mesamis/surface/axis_flip.h"

namespace mesamis::detail::shape_files {

/// What decides how two surfaces lie to each other.
enum class FrameRule {
  kAuto,    ///< the frames their files state; what fits only after a flip is refused
  kAsIs,    ///< coordinates as they are, unchecked
  kTurned,  ///< the surface's x and y are negated, unchecked
};

/// Two surfaces to compare, in one frame as far as is known, without points that no triangle uses.
struct SurfacePair {
  TriMesh reference, surface;                           ///< mm
  std::optional<Frame> reference_frame, surface_frame;  ///< as their files state
  bool surface_turned = false;                          ///< x and y negated to fit the reference
  std::optional<FlipFound> flip;      ///< the surface fits as it is, and better after this
  std::vector<std::string> warnings;  ///< one line each: the surface was turned, a flip fits better

  /// The frame of the surface as it lies here, if it is known.
  std::optional<Frame> frame() const;
};

/// Whether the surface's x and y must be negated, so that it lies in the reference's frame.
/// @param reference, surface  frames that the files state, if they do.
bool must_turn(const std::optional<Frame>& reference, const std::optional<Frame>& surface,
               FrameRule rule);

/// Brings both into one frame.
/// @param name  what messages call the surface.
/// @throws InputError  with kAuto if the surface lies off the reference unless its axes are
///                     flipped; the message says how, and both boxes.
SurfacePair pair_up(const SurfaceFile& reference, const SurfaceFile& surface, FrameRule rule,
                    const std::string& name);

/// Reads both and pairs them up.
/// @param limits  as read_surface(), for each of both.
/// @throws InputError  if a file cannot be read, and as pair_up().
SurfacePair read_pair(const std::filesystem::path& reference, const std::filesystem::path& surface,
                      FrameRule rule, const ReadLimits& limits = {});

}  // namespace mesamis::detail::shape_files
