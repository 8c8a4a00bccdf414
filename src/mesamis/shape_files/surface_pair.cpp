// SPDX-License-Identifier: Apache-2.0
#include "mesamis/shape_files/surface_pair.h"

#include <sstream>

#include "mesamis/base/error.h"
#include "mesamis/surface/unused_points.h"

namespace mesamis::detail::shape_files {
namespace {

namespace fs = std::filesystem;

std::ostream& operator<<(std::ostream& out, const Box& box) {
  const auto write = [&out](const Vec3& p) {
    out << p.x + 0.0 << "," << p.y + 0.0 << "," << p.z + 0.0;  // no -0
  };
  write(box.lo);
  out << " to ";
  write(box.hi);
  return out << " mm";
}

/// How far apart the surfaces are as they are and flipped, in words.
std::string nearness(const FlipFound& found) {
  std::ostringstream text;
  text.precision(4);
  text << (found.flip == kLpsRas ? "turned from LPS to RAS or back, " : "with its axes as ")
       << to_string(found.flip) << ", it is " << found.flipped_distance_mm
       << " mm from the reference in the mean instead of " << found.distance_mm << " mm";
  return text.str();
}

[[noreturn]] void refuse_flipped(const std::string& name, const SurfacePair& pair,
                                 const FlipFound& found) {
  std::ostringstream text;
  text.precision(5);
  text << name << ": lies off the reference"
       << (pair.surface_turned ? " in the frames that the files state" : "") << "; "
       << nearness(found) << "; expected about the box " << found.reference << ", found "
       << found.surface << "; --frames as-is compares them "
       << (pair.surface_turned ? "unturned" : "all the same");
  if (found.flip == kLpsRas && !pair.surface_turned) text << ", --frames turned after the turn";
  throw InputError(text.str());
}

std::string turn_warning(const std::string& name, const SurfacePair& pair) {
  return name + ": turned from " + frame_name(*pair.surface_frame) + " to " +
         frame_name(*pair.reference_frame) + ", as the files state";
}

}  // namespace

std::optional<Frame> SurfacePair::frame() const {
  if (surface_frame && !surface_turned) return surface_frame;
  if (surface_frame) return *surface_frame == Frame::kRas ? Frame::kLps : Frame::kRas;
  return reference_frame;
}

bool must_turn(const std::optional<Frame>& reference, const std::optional<Frame>& surface,
               FrameRule rule) {
  const bool states_differ = reference && surface && reference != surface;
  return rule == FrameRule::kTurned || (rule == FrameRule::kAuto && states_differ);
}

SurfacePair pair_up(const SurfaceFile& reference, const SurfaceFile& surface, FrameRule rule,
                    const std::string& name) {
  SurfacePair pair{without_unused_points(reference.surface),
                   without_unused_points(surface.surface),
                   reference.frame,
                   surface.frame,
                   must_turn(reference.frame, surface.frame, rule),
                   {},
                   {}};
  if (pair.surface_turned) pair.surface = turned(std::move(pair.surface));
  if (rule != FrameRule::kAuto) return pair;
  pair.flip = find_axis_flip(pair.reference, pair.surface);
  if (pair.flip && pair.flip->plain) refuse_flipped(name, pair, *pair.flip);
  if (pair.surface_turned) pair.warnings.push_back(turn_warning(name, pair));
  if (pair.flip) {
    pair.warnings.push_back(name + ": is it in the reference's frame? " + nearness(*pair.flip));
  }
  return pair;
}

SurfacePair read_pair(const fs::path& reference, const fs::path& surface, FrameRule rule,
                      const ReadLimits& limits) {
  return pair_up(read_surface_file(reference, limits), read_surface_file(surface, limits), rule,
                 surface.string());
}

}  // namespace mesamis::detail::shape_files
