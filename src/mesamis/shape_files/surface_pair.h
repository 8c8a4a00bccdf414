// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "mesamis/shape_files/object_files.h"
#include "mesamis/shape_files/surface_files.h"
#include "mesamis/surface/axis_flip.h"
#include "mesamis/surface/comparison.h"

namespace mesamis::detail::shape_files {

/// What decides how two surfaces lie to each other.
enum class FrameRule {
  kAuto,    ///< the frames their files state; what fits only after a flip is refused
  kAsIs,    ///< coordinates as they are, unchecked
  kTurned,  ///< the surface's x and y are negated, unchecked
};

/// Objects of two files that have the same name.
struct ObjectPair {
  std::string name;
  TriMesh reference, surface;  ///< mm, in the frame of the whole surfaces
};

/// Two surfaces to compare, in one frame as far as is known, without points that no triangle uses.
struct SurfacePair {
  TriMesh reference, surface;                           ///< mm
  std::optional<Frame> reference_frame, surface_frame;  ///< as their files state
  bool surface_turned = false;                          ///< x and y negated to fit the reference
  std::optional<FlipFound> flip;      ///< the surface fits as it is, and better after this
  std::vector<ObjectPair> objects;    ///< see pair_objects(), in the order of the reference
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

/// The objects of one of the surfaces.
struct PairedFile {
  std::string name;  ///< what messages call the surface
  std::vector<NamedSurface> objects;
};

/// Pairs up the objects of both surfaces whose name only one object of each has. Warns of the
/// others, and where no two objects are paired up of surfaces that are not one object each.
/// @param pair                of pair_up(); learns of them.
/// @param reference, surface  mm, in the frames that their files state.
///
/// O(n log n) for n objects, and their points and triangles, copied.
void pair_objects(SurfacePair& pair, const PairedFile& reference, const PairedFile& surface);

/// The distances between the objects of one name.
struct ObjectDistances {
  std::string name;
  std::vector<DirectedDistances> directions;  ///< as measure_both()
};

/// Measures the distances between two surfaces: surface_to_reference, then reference_to_surface.
/// @param part  as for measure_distances().
/// @throws InputError  as measure_distances(). Cost as there.
std::vector<DirectedDistances> measure_both(const SurfacePair& pair,
                                            const std::optional<Box>& part = std::nullopt);

/// Measures the distances between the objects of one name, as measure_both() between the whole
/// surfaces.
/// @return without objects of which no point counts.  Cost as measure_distances() for each.
std::vector<ObjectDistances> measure_objects(const SurfacePair& pair,
                                             const std::optional<Box>& part = std::nullopt);

/// Reads both and pairs them up, and their objects.
/// @param limits  as read_surface(), for each of both.
/// @throws InputError  if a file cannot be read, and as pair_up().
SurfacePair read_pair(const std::filesystem::path& reference, const std::filesystem::path& surface,
                      FrameRule rule, const ReadLimits& limits = {});

}  // namespace mesamis::detail::shape_files
