// SPDX-License-Identifier: Apache-2.0
#include "surface_pair.h"

#include <sstream>

#include "log.h"
#include "mesamis/base/error.h"
#include "mesamis/surface/unused_points.h"

namespace mesamis {
namespace {

namespace fs = std::filesystem;

nlohmann::ordered_json frame_json(const std::optional<Frame>& frame) {
  return frame ? nlohmann::ordered_json(frame_name(*frame)) : nlohmann::ordered_json(nullptr);
}

bool states_differ(const SurfacePair& pair) {
  return pair.reference_frame && pair.surface_frame && pair.reference_frame != pair.surface_frame;
}

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

[[noreturn]] void refuse_flipped(const fs::path& path, const SurfacePair& pair,
                                 const FlipFound& found) {
  std::ostringstream text;
  text.precision(5);
  text << path.string() << ": lies off the reference"
       << (pair.surface_turned ? " in the frames that the files state" : "") << "; "
       << nearness(found) << "; expected about the box " << found.reference << ", found "
       << found.surface << "; --frames as-is compares them "
       << (pair.surface_turned ? "unturned" : "all the same");
  if (found.flip == kLpsRas && !pair.surface_turned) text << ", --frames turned after the turn";
  throw InputError(text.str());
}

void warn_of_turn(const fs::path& path, const SurfacePair& pair) {
  log_warning(path.string() + ": turned from " + frame_name(*pair.surface_frame) + " to " +
              frame_name(*pair.reference_frame) + ", as the files state");
}

}  // namespace

std::optional<Frame> SurfacePair::frame() const {
  if (surface_frame && !surface_turned) return surface_frame;
  if (surface_frame) return *surface_frame == Frame::kRas ? Frame::kLps : Frame::kRas;
  return reference_frame;
}

SurfacePair read_pair(const fs::path& reference, const fs::path& surface, FrameRule rule) {
  const SurfaceFile a = read_surface_file(reference), b = read_surface_file(surface);
  SurfacePair pair{without_unused_points(a.surface),
                   without_unused_points(b.surface),
                   a.frame,
                   b.frame,
                   false,
                   {}};
  pair.surface_turned =
      rule == FrameRule::kTurned || (rule == FrameRule::kAuto && states_differ(pair));
  if (pair.surface_turned) pair.surface = turned(std::move(pair.surface));
  if (rule != FrameRule::kAuto) return pair;
  pair.flip = find_axis_flip(pair.reference, pair.surface);
  if (pair.flip && pair.flip->plain) refuse_flipped(surface, pair, *pair.flip);
  if (pair.surface_turned) warn_of_turn(surface, pair);
  if (pair.flip) {
    log_warning(surface.string() + ": is it in the reference's frame? " + nearness(*pair.flip));
  }
  return pair;
}

nlohmann::ordered_json frames_json(const SurfacePair& pair) {
  nlohmann::ordered_json flip;
  if (pair.flip) {
    flip = {{"axes", to_string(pair.flip->flip)},
            {"mean_distance", pair.flip->distance_mm},
            {"mean_distance_flipped", pair.flip->flipped_distance_mm}};
  }
  return {{"reference", frame_json(pair.reference_frame)},
          {"surface", frame_json(pair.surface_frame)},
          {"surface_turned", pair.surface_turned},
          {"fits_better_flipped", flip}};
}

}  // namespace mesamis
