// SPDX-License-Identifier: Apache-2.0
#include "mesamis/shape_files/surface_pair.h"

#include <algorithm>
#include <map>
#include <sstream>
#include <string_view>

#include "mesamis/base/error.h"
#include "mesamis/files/refuse.h"
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
         frame_name(*pair.reference_frame) + ", as both state";
}

/// The objects whose name no other one of the file has.
std::map<std::string_view, const NamedSurface*> by_name(const PairedFile& file) {
  std::map<std::string_view, const NamedSurface*> found;
  for (const NamedSurface& object : file.objects) {
    const auto [at, is_first] = found.try_emplace(object.name, &object);
    if (!is_first) at->second = nullptr;
  }
  std::erase_if(found, [](const auto& entry) { return entry.second == nullptr; });
  return found;
}

/// What no distance of its own is measured of; empty: nothing.
std::string unpaired_warning(const PairedFile& file, const std::vector<ObjectPair>& pairs) {
  if (file.objects.size() < 2) return "";
  if (pairs.empty()) {
    return file.name + ": " + std::to_string(file.objects.size()) +
           " objects, measured together as one surface";
  }
  std::string names;
  for (const NamedSurface& object : file.objects) {
    const auto is_it = [&object](const ObjectPair& pair) { return pair.name == object.name; };
    if (std::any_of(pairs.begin(), pairs.end(), is_it)) continue;
    names.append(names.empty() ? "" : ", ").append(in_quotes(object.name));
  }
  if (names.empty()) return "";
  return file.name + ": objects that no name pairs, measured as part of the whole alone: " + names;
}

std::optional<std::vector<DirectedDistances>> find_both(const TriMesh& reference,
                                                        const TriMesh& surface,
                                                        const std::optional<Box>& part) {
  auto there = find_distances("surface_to_reference", surface, reference, part);
  if (!there) return std::nullopt;
  auto back = find_distances("reference_to_surface", reference, surface, part);
  if (!back) return std::nullopt;
  return std::vector{*std::move(there), *std::move(back)};
}

/// A surface of one object is read once.
SurfaceFile whole_of(const fs::path& path, ObjectFile& file, const ReadLimits& limits) {
  if (file.objects.size() > 1) return read_surface_file(path, limits);
  SurfaceFile whole{std::move(file.objects[0].surface), file.frame};
  file.objects.clear();
  return whole;
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

void pair_objects(SurfacePair& pair, const PairedFile& reference, const PairedFile& surface) {
  if (reference.objects.size() > 1 && surface.objects.size() > 1) {
    const auto references = by_name(reference), surfaces = by_name(surface);
    for (const NamedSurface& object : reference.objects) {
      const auto other = surfaces.find(object.name);
      if (!references.contains(object.name) || other == surfaces.end()) continue;
      TriMesh judged = without_unused_points(other->second->surface);
      if (pair.surface_turned) judged = turned(std::move(judged));
      pair.objects.push_back(
          {object.name, without_unused_points(object.surface), std::move(judged)});
    }
  }
  for (const PairedFile* file : {&reference, &surface}) {
    std::string line = unpaired_warning(*file, pair.objects);
    if (!line.empty()) pair.warnings.push_back(std::move(line));
  }
}

std::vector<DirectedDistances> measure_both(const SurfacePair& pair,
                                            const std::optional<Box>& part) {
  return {measure_distances("surface_to_reference", pair.surface, pair.reference, part),
          measure_distances("reference_to_surface", pair.reference, pair.surface, part)};
}

std::vector<ObjectDistances> measure_objects(const SurfacePair& pair,
                                             const std::optional<Box>& part) {
  std::vector<ObjectDistances> found;
  for (const ObjectPair& object : pair.objects) {
    auto both = find_both(object.reference, object.surface, part);
    if (both) found.push_back({object.name, *std::move(both)});
  }
  return found;
}

SurfacePair read_pair(const fs::path& reference, const fs::path& surface, FrameRule rule,
                      const ReadLimits& limits) {
  ObjectFile first = read_object_file(reference, limits),
             second = read_object_file(surface, limits);
  SurfacePair pair = pair_up(whole_of(reference, first, limits), whole_of(surface, second, limits),
                             rule, surface.string());
  pair_objects(pair, {reference.string(), std::move(first.objects)},
               {surface.string(), std::move(second.objects)});
  return pair;
}

}  // namespace mesamis::detail::shape_files
