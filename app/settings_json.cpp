// SPDX-License-Identifier: Apache-2.0
#include "settings_json.h"

#include <cmath>
#include <functional>
#include <limits>
#include <map>
#include <string>
#include <type_traits>

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

template <class T>
ordered_json or_auto(const std::optional<T>& value) {
  return value ? ordered_json(*value) : ordered_json("auto");
}

template <class T>
std::optional<T> read_or_auto(const json& value) {
  if (value == "auto") return std::nullopt;
  return number<T>(value);
}

ordered_json threshold_to_json(const Settings& s) {
  if (s.threshold_rule == ThresholdRule::kAuto) return "auto";
  if (s.threshold_rule == ThresholdRule::kNone) return "none";
  return s.threshold;
}

void read_threshold(const json& value, Settings& s) {
  if (value == "auto" || value == "none") {
    s.threshold_rule = value == "auto" ? ThresholdRule::kAuto : ThresholdRule::kNone;
    return;
  }
  s.threshold_rule = ThresholdRule::kValue;
  s.threshold = value.get<double>();
}

void read_window(const json& value, Settings& s) {
  s.window.reset();
  if (value == "auto") return;
  const auto bounds = value.get<std::array<double, 2>>();
  s.window = Window{bounds[0], bounds[1]};
}

template <class Enum>
Enum read_name(const json& value, const std::map<std::string, Enum>& names) {
  const auto found = names.find(value.get<std::string>());
  if (found != names.end()) return found->second;
  std::string known;
  for (const auto& [name, unused] : names) known += (known.empty() ? "" : ", ") + name;
  throw InputError("expected one of " + known + ", found " + value.dump());
}

using Reader = std::function<void(const json&, Settings&)>;

template <class T>
Reader reads(T Settings::*member) {
  return [member](const json& value, Settings& s) { s.*member = number<T>(value); };
}
template <class T>
Reader reads(std::optional<T> Settings::*member) {
  return [member](const json& value, Settings& s) { s.*member = read_or_auto<T>(value); };
}

const std::map<std::string, Reader>& readers() {
  static const std::map<std::string, Reader> table{
      {"crop",
       [](const json& value, Settings& s) {
         const auto ranges = value.get<std::array<std::array<Index, 2>, 3>>();
         for (std::size_t a = 0; a < 3; ++a) {
           s.crop.begin[a] = ranges[a][0];
           s.crop.end[a] = ranges[a][1];
         }
       }},
      {"stride", reads(&Settings::stride)},
      {"window", read_window},
      {"threshold", read_threshold},
      {"length_unit",
       [](const json& value, Settings& s) {
         s.length_unit =
             read_name<LengthUnit>(value, {{"voxel", LengthUnit::kVoxel}, {"mm", LengthUnit::kMm}});
       }},
      {"epsilon", reads(&Settings::epsilon)},
      {"eta", reads(&Settings::eta)},
      {"beta", reads(&Settings::beta)},
      {"gamma", reads(&Settings::gamma)},
      {"amis_iterations", reads(&Settings::amis_iterations)},
      {"tol_v", reads(&Settings::tol_v)},
      {"solver_tolerance", reads(&Settings::solver_tolerance)},
      {"max_tets", reads(&Settings::max_tets)},
      {"tau", reads(&Settings::tau)},
      {"adaptations", reads(&Settings::adaptations)},
      {"tol_mesh", reads(&Settings::tol_mesh)},
      {"tol_energy", reads(&Settings::tol_energy)},
      {"stop_at_first", reads(&Settings::stop_at_first)},
      {"max_stretch", reads(&Settings::max_stretch)},
      {"h_min", reads(&Settings::h_min)},
      {"h_max", reads(&Settings::h_max)},
      {"surface",
       [](const json& value, Settings& s) {
         s.surface = read_name<SurfaceKind>(
             value, {{"solid", SurfaceKind::kSolid}, {"band", SurfaceKind::kBand}});
       }},
      {"level", reads(&Settings::level)},
      {"band_threshold", reads(&Settings::band_threshold)},
  };
  return table;
}

}  // namespace

ordered_json to_json(const Settings& s) {
  ordered_json j;
  for (std::size_t a = 0; a < 3; ++a) j["crop"].push_back({s.crop.begin[a], s.crop.end[a]});
  j["stride"] = s.stride;
  j["window"] = s.window ? ordered_json{s.window->low, s.window->high} : ordered_json("auto");
  j["threshold"] = threshold_to_json(s);
  j["length_unit"] = s.length_unit == LengthUnit::kVoxel ? "voxel" : "mm";
  j["epsilon"] = s.epsilon;
  j["eta"] = or_auto(s.eta);
  j["beta"] = s.beta;
  j["gamma"] = s.gamma;
  j["amis_iterations"] = s.amis_iterations;
  j["tol_v"] = s.tol_v;
  j["solver_tolerance"] = s.solver_tolerance;
  j["max_tets"] = or_auto(s.max_tets);
  j["tau"] = s.tau;
  j["adaptations"] = s.adaptations;
  j["tol_mesh"] = s.tol_mesh;
  j["tol_energy"] = s.tol_energy;
  j["stop_at_first"] = s.stop_at_first;
  j["max_stretch"] = s.max_stretch;
  j["h_min"] = s.h_min;
  j["h_max"] = or_auto(s.h_max);
  j["surface"] = s.surface == SurfaceKind::kSolid ? "solid" : "band";
  j["level"] = or_auto(s.level);
  j["band_threshold"] = s.band_threshold;
  return j;
}

void from_json(const json& object, Settings& settings) {
  if (!object.is_object()) throw InputError("expected a JSON object");
  for (const auto& [name, value] : object.items()) {
    const auto reader = readers().find(name);
    if (reader == readers().end()) throw InputError("there is no setting '" + name + "'");
    try {
      reader->second(value, settings);
    } catch (const json::exception&) {
      throw InputError(name + " cannot be " + value.dump());
    } catch (const InputError& error) {
      throw InputError(name + ": " + error.what());
    }
  }
}

}  // namespace mesamis
