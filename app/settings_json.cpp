// SPDX-License-Identifier: Apache-2.0
#include "settings_json.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <type_traits>
#include <vector>

#include "mesamis/base/error.h"

namespace mesamis {
namespace {

using nlohmann::json;
using nlohmann::ordered_json;

/// Whole numbers may be spelt as reals (1e6), but nothing is cut off.
template <class T>
T number(const json& value) {
  if constexpr (std::is_integral_v<T> && !std::is_same_v<T, bool>) {
    const auto real = value.get<double>();
    if (!(std::abs(real) < 1e15 && real == std::floor(real))) {
      throw InputError("expected a whole number, found " + value.dump());
    }
    if (real < static_cast<double>(std::numeric_limits<T>::min()) ||
        real > static_cast<double>(std::numeric_limits<T>::max())) {
      throw InputError("expected a smaller number, found " + value.dump());
    }
    return static_cast<T>(real);
  } else {
    return value.get<T>();
  }
}

/// A setting's name and its way from and to JSON.
struct Entry {
  std::string name;
  std::function<void(const json&, Settings&)> read;
  std::function<ordered_json(const Settings&)> write;
};

template <class T>
Entry setting(const char* name, T Settings::*member) {
  return {name, [member](const json& value, Settings& s) { s.*member = number<T>(value); },
          [member](const Settings& s) { return ordered_json(s.*member); }};
}

/// Without a value it is "auto".
template <class T>
Entry setting(const char* name, std::optional<T> Settings::*member) {
  return {name,
          [member](const json& value, Settings& s) {
            s.*member = value == "auto" ? std::nullopt : std::optional<T>(number<T>(value));
          },
          [member](const Settings& s) {
            return s.*member ? ordered_json(*(s.*member)) : ordered_json("auto");
          }};
}

template <class Enum>
Enum value_of(const json& name, const std::map<std::string, Enum>& names) {
  const auto found = names.find(name.get<std::string>());
  if (found != names.end()) return found->second;
  std::string known;
  for (const auto& [other, unused] : names) known += (known.empty() ? "" : ", ") + other;
  throw InputError("expected one of " + known + ", found " + name.dump());
}

template <class Enum>
std::string name_of(Enum value, const std::map<std::string, Enum>& names) {
  const auto is_it = [value](const auto& name) { return name.second == value; };
  return std::find_if(names.begin(), names.end(), is_it)->first;
}

/// @param names  of every value.
template <class Enum>
Entry setting(const char* name, Enum Settings::*member, const std::map<std::string, Enum>& names) {
  return {name, [=](const json& value, Settings& s) { s.*member = value_of<Enum>(value, names); },
          [=](const Settings& s) { return ordered_json(name_of<Enum>(s.*member, names)); }};
}

void read_crop(const json& value, Settings& s) {
  const auto ranges = value.get<std::array<std::array<Index, 2>, 3>>();
  for (std::size_t a = 0; a < 3; ++a) {
    s.crop.begin[a] = ranges[a][0];
    s.crop.end[a] = ranges[a][1];
  }
}

ordered_json write_crop(const Settings& s) {
  ordered_json ranges;
  for (std::size_t a = 0; a < 3; ++a) ranges.push_back({s.crop.begin[a], s.crop.end[a]});
  return ranges;
}

void read_window(const json& value, Settings& s) {
  s.window.reset();
  if (value == "auto") return;
  const auto bounds = value.get<std::array<double, 2>>();
  s.window = Window{bounds[0], bounds[1]};
}

ordered_json write_window(const Settings& s) {
  return s.window ? ordered_json{s.window->low, s.window->high} : ordered_json("auto");
}

void read_blur(const json& value, Settings& s) {
  s.blur.reset();
  if (value != "auto") s.blur = value.get<std::array<double, 3>>();
}

ordered_json write_blur(const Settings& s) {
  return s.blur ? ordered_json(*s.blur) : ordered_json("auto");
}

void read_threshold(const json& value, Settings& s) {
  if (value == "auto" || value == "none") {
    s.threshold_rule = value == "auto" ? ThresholdRule::kAuto : ThresholdRule::kNone;
    return;
  }
  s.threshold_rule = ThresholdRule::kValue;
  s.threshold = value.get<double>();
}

ordered_json write_threshold(const Settings& s) {
  if (s.threshold_rule == ThresholdRule::kAuto) return "auto";
  if (s.threshold_rule == ThresholdRule::kNone) return "none";
  return s.threshold;
}

/// Every setting, in the order in which they are written.
const std::vector<Entry>& entries() {
  static const std::vector<Entry> table{
      {"crop", read_crop, write_crop},
      setting("stride", &Settings::stride),
      {"window", read_window, write_window},
      {"threshold", read_threshold, write_threshold},
      setting("noise", &Settings::noise),
      {"blur", read_blur, write_blur},
      setting("length_unit", &Settings::length_unit,
              {{"voxel", LengthUnit::kVoxel}, {"mm", LengthUnit::kMm}}),
      setting("epsilon", &Settings::epsilon),
      setting("eta", &Settings::eta),
      setting("beta", &Settings::beta),
      setting("gamma", &Settings::gamma),
      setting("amis_iterations", &Settings::amis_iterations),
      setting("tol_v", &Settings::tol_v),
      setting("solver_tolerance", &Settings::solver_tolerance),
      setting("max_tets", &Settings::max_tets),
      setting("tau", &Settings::tau),
      setting("adaptations", &Settings::adaptations),
      setting("tol_mesh", &Settings::tol_mesh),
      setting("tol_energy", &Settings::tol_energy),
      setting("stop_at_first", &Settings::stop_at_first),
      setting("max_stretch", &Settings::max_stretch),
      setting("gradation", &Settings::gradation),
      setting("h_min", &Settings::h_min),
      setting("h_max", &Settings::h_max),
      setting("surface", &Settings::surface,
              {{"solid", SurfaceKind::kSolid}, {"band", SurfaceKind::kBand}}),
      setting("level", &Settings::level),
      setting("band_threshold", &Settings::band_threshold),
      setting("min_volume", &Settings::min_volume),
      setting("keep_largest", &Settings::keep_largest),
      setting("fill_cavities", &Settings::fill_cavities),
      setting("tolerance", &Settings::tolerance),
      setting("triangles", &Settings::triangles),
  };
  return table;
}

const Entry& entry_of(const std::string& name) {
  for (const Entry& entry : entries()) {
    if (entry.name == name) return entry;
  }
  throw InputError("there is no setting '" + name + "'");
}

}  // namespace

ordered_json to_json(const Settings& settings) {
  ordered_json object;
  for (const Entry& entry : entries()) object[entry.name] = entry.write(settings);
  return object;
}

void from_json(const json& object, Settings& settings) {
  if (!object.is_object()) throw InputError("expected a JSON object");
  for (const auto& [name, value] : object.items()) {
    const Entry& entry = entry_of(name);
    try {
      entry.read(value, settings);
    } catch (const json::exception&) {
      throw InputError(name + " cannot be " + value.dump());
    } catch (const InputError& error) {
      throw InputError(name + ": " + error.what());
    }
  }
}

}  // namespace mesamis
