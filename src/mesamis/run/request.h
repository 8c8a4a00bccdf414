// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "mesamis/base/progress.h"
#include "mesamis/delivery/body_request.h"
#include "mesamis/image/label_map.h"
#include "mesamis/image/volume.h"
#include "mesamis/method/mes_amis.h"
#include "mesamis/method/settings.h"
#include "mesamis/object/choose_object.h"

/// What a run is asked for.
namespace mesamis {

/// Labels that choose the objects.
struct LabelChoice {
  LabelMap map;                             ///< valid; on a grid of its own
  std::vector<Segment> chosen{};            ///< of the map; empty: all of them
  std::optional<double> margin{};           ///< mm, see LabelRequest
  std::optional<Probabilities> exact_by{};  ///< of which the map is most_probable()

  /// The objects that are looked for.
  const std::vector<Segment>& wanted() const { return chosen.empty() ? map.segments : chosen; }
};

/// Elements that fill the objects.
struct ElementRequest {
  BodyWishes wishes;
  bool body = false;     ///< a body for a solver
  bool skins = false;    ///< the surfaces become the skins of elements, which suit other meshers
  double memory_gb = 0;  ///< that the elements may take; 0: what is free

  /// Whether any are.
  bool wanted() const { return body || skins; }
};

/// Everything that decides the result of a run.
struct Request {
  /// Native units. A Volume is taken over; the samples of a VolumeView are read in place where
  /// nothing changes them, and must live as long as the outcome. Nothing: the labels alone.
  std::variant<std::monostate, Volume, VolumeView> scan{};
  /// Which object is meant. Its level, and its crop where none is given here, are those of the
  /// settings; labels keep the surroundings, unless these are to be removed.
  ObjectRequest object{};
  std::optional<LabelChoice> labels{};
  Settings settings{};
  bool mesh = true;  ///< of several objects: make a mesh around them; one object always has one
  ElementRequest elements{};
  HasEnough enough{};  ///< see mes_amis(); for one object only

  /// Whether there is one.
  bool has_scan() const { return scan.index() != 0; }
};

/// Hears of a run while it goes on. Each member may be empty.
struct Listener {
  Progress progress{};
  std::function<void(const std::string&)> note{};     ///< one line: what was done unasked
  std::function<void(const std::string&)> warning{};  ///< one line: what may not be what was meant
  /// The objects that are looked for, before the long work; it may throw.
  std::function<void(const std::vector<Segment>&)> objects{};
};

}  // namespace mesamis
