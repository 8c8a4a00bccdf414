// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "mesamis/base/progress.h"
#include "mesamis/image/label_map.h"
#include "mesamis/image/volume.h"
#include "mesamis/method/settings.h"
#include "mesamis/object/object_request.h"
#include "mesamis/report/body_wishes.h"
#include "mesamis/run/outcome.h"

/// From a scan, labels, or both to surfaces, meshes and bodies: what the program does.
namespace mesamis {

/// Labels that choose the objects.
struct LabelChoice {
  LabelMap map;                             ///< valid; on a grid of its own
  std::vector<Segment> chosen{};            ///< of the map; empty: all of them
  std::optional<double> margin{};           ///< mm, > 0: how far the labels may be wrong; none:
                                            ///< two and a half voxels
  std::optional<Probabilities> exact_by{};  ///< of which the map is most_probable()

  /// The objects that are looked for.
  const std::vector<Segment>& wanted() const { return chosen.empty() ? map.segments : chosen; }
};

/// Elements that fill the objects.
struct ElementRequest {
  BodyWishes wishes;
  bool body = false;     ///< a body for a solver
  bool skins = false;    ///< the surfaces become the skins of elements, which suit other meshers
  double memory_gb = 0;  ///< limit for the elements, GB (10^9 bytes); 0: the available memory

  /// Whether elements are requested.
  bool wanted() const { return body || skins; }
};

/// Everything that decides the result of a run.
struct Request {
  /// Native units. A Volume is taken over; the samples of a VolumeView are read in place where
  /// nothing changes them, and must live as long as the outcome. Nothing: the labels alone.
  std::variant<std::monostate, Volume, VolumeView> scan{};
  /// The object. Its level, and its crop unless given here, are those of the settings; with labels
  /// the surroundings stay, unless they are to be removed.
  ObjectRequest object{};
  std::optional<LabelChoice> labels{};
  Settings settings{};
  /// For several objects: make a mesh around them; a single object always has one.
  bool mesh = true;
  ElementRequest elements{};
  HasEnough enough{};  ///< for one object only

  /// Whether a scan is given.
  bool has_scan() const { return scan.index() != 0; }
};

/// The callbacks of a run. Each may be empty.
struct Listener {
  Progress progress{};
  std::function<void(const std::string&)> note{};  ///< one line: a step that was not requested
  /// One line: a result that may not be intended.
  std::function<void(const std::string&)> warning{};
  /// The requested objects, before the long computation; it may throw.
  std::function<void(const std::vector<Segment>&)> objects{};
};

/// Does all that the program does between reading and writing: chooses the object, runs the method,
/// fills the objects with elements on request, and judges the result.
///
/// 1. Chooses the object: fills padding, removes the table, finds the level, crops. The samples of
///    a VolumeView never change.
/// 2. Minimises on adapted meshes until the surface has settled, extracts the surface, moves it on
///    to the image and removes triangles within the tolerance; with labels or several seeds, of
///    each object.
/// 3. Fills the objects with elements.
/// 4. Checks the surfaces: closed, 2-manifold, within the tolerance.
/// @param request   a scan of three axes, labels, or both; what the settings leave open is measured.
/// @param listener  optional. The stages of its progress are "preparation", "adaptation k of n",
///                  "final minimisation", "surface", "decimation", "elements"; see
///                  stage_shares() for those of other runs.
/// @throws InputError  one line that says what was expected and found: if neither a scan nor labels
///                     are given, a request that needs a scan has labels alone, several objects are to be bands, or a
///                     scan, a label map or a setting is unusable.
/// @throws Cancelled   if progress returns false.
///
/// Time and memory are those of the steps. The same bits for any number of threads, except for a
/// run that `enough` ends.
Outcome segment(Request request, const Listener& listener = {});

}  // namespace mesamis
