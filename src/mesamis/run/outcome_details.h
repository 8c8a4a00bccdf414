// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "mesamis/method/label_surfaces.h"
#include "mesamis/method/mes_amis.h"
#include "mesamis/object/choose_object.h"
#include "mesamis/report/label_output.h"
#include "mesamis/report/verdict.h"
#include "mesamis/run/elements.h"
#include "mesamis/run/segment.h"
#include "mesamis/surface/tri_mesh.h"

namespace mesamis::detail::run {

/// Everything that a run has found and used, see Outcome. Surfaces and meshes are in the world
/// frame (LPS), mm.
struct OutcomeDetails {
  Settings asked;                      ///< the settings that the run was started with
  VoxelGrid grid;                      ///< of the whole scan; without one that of the labels
  std::optional<ChosenObject> object;  ///< the image; nothing: the labels alone
  std::span<const float> in_place;     ///< of the grid, where `object` has no samples
  ObjectRequest object_asked;          ///< as it was completed from the settings

  std::optional<Result> one;           ///< of a run for one object
  std::optional<LabelResult> several;  ///< of labels, or of the parts of several seeds
  std::vector<Segment> wanted;         ///< the objects that were looked for
  std::vector<SurfaceCheck> checks;    ///< of the surfaces of objects()
  /// Of the points of one surface, see surface_grey(), where they were found beforehand; may be
  /// empty.
  std::vector<double> grey;
  ElementResults elements;
  std::vector<std::string> warnings;  ///< beside those of `object`, one line each
  Verdict verdict;                    ///< of the surfaces and the body

  /// The objects that were found, which refer to this.
  std::vector<FoundObject> objects() const;
  /// The image that the run was made of, native units; empty without a scan.
  VolumeView image() const;
  /// Whether the surface encloses the values of a range, so that it lies at no level of the scan.
  bool is_of_range() const { return object && object->kind == TissueKind::kRange; }
  /// The adapted mesh with its fields; nullptr: none was made.
  const Result* mesh() const;
  /// What the run used.
  const Parameters& parameters() const { return one ? one->parameters : several->parameters; }
  /// The mean error to expect of each point of an object's surface, mm; empty: not known.
  const std::vector<double>& expected_error(std::size_t object) const;
};

/// Says lines to a listener, if it hears them.
void tell(const std::function<void(const std::string&)>& hear,
          const std::vector<std::string>& lines);

/// Chooses the object in the scan of a request: the first step of segment().
/// @param request  with a scan; a Volume is taken over.
/// @param outcome  learns grid, object, object_asked and in_place.
/// @throws InputError  as choose_object(). Cost as there.
void choose_image(Request& request, const Listener& listener, OutcomeDetails& outcome);

/// Counts the triangles that two of the objects share. O(n log n) for n triangles.
std::int64_t shared_triangles(std::span<const FoundObject> objects);

/// Says where the surfaces have more triangles than were asked for.
/// @return one line, or none.
std::vector<std::string> triangle_warnings(const OutcomeDetails& outcome);

/// Checks the surfaces of the objects that were found, and judges them and the body, if any.
void judge_surfaces(OutcomeDetails& outcome);

/// The segment of a run for one object.
Segment one_object();

}  // namespace mesamis::detail::run
