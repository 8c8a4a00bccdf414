// SPDX-License-Identifier: Apache-2.0
#include "mesamis/volume_files/multiscales.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <string_view>
#include <utility>

#include "mesamis/base/error.h"
#include "mesamis/files/length_unit.h"
#include "mesamis/files/refuse.h"

namespace mesamis::detail::volume_files {
namespace {

struct Axis {
  std::string name, unit;
};

std::vector<Axis> read_axes(const JsonValue& image) {
  std::vector<Axis> axes;
  const auto stated = image.find("axes");
  if (!stated) return axes;
  for (const JsonValue& axis : stated->list()) {
    if (axis.is_text()) {  // NGFF 0.3
      axes.push_back({axis.text(), {}});
      continue;
    }
    const auto unit = axis.find("unit");
    axes.push_back({axis.at("name").text(), unit ? unit->text() : std::string()});
  }
  return axes;
}

void require_space_last(const JsonValue& image, const std::vector<Axis>& axes) {
  if (axes.empty()) return;
  constexpr std::array<std::string_view, 3> kSpace{"z", "y", "x"};
  std::string found;
  for (const Axis& axis : axes) found += (found.empty() ? "" : ", ") + shown(axis.name);
  bool fits = axes.size() >= kSpace.size();
  for (std::size_t a = 0; fits && a < kSpace.size(); ++a) {
    fits = lower(axes[axes.size() - 3 + a].name) == kSpace[a];
  }
  if (!fits) refuse(image.file(), "expected axes that end with z, y, x, found " + found);
}

/// scale * index + translation, along each axis.
struct Transform {
  bool stated = false;
  std::vector<double> scale, translation;
};

std::vector<double> vector_of(const JsonValue& list, std::size_t axes) {
  std::vector<double> values = list.numbers();
  if (values.size() != axes) list.refuse_as(message("a list of ", axes, " numbers"));
  return values;
}

/// What is done after what `transform` does already.
void append_transforms(const JsonValue& owner, Transform& transform) {
  const auto steps = owner.find("coordinateTransformations");
  if (!steps) return;
  const std::size_t axes = transform.scale.size();
  for (const JsonValue& step : steps->list()) {
    const std::string type = step.at("type").text();
    if (type == "identity") continue;
    if (type != "scale" && type != "translation") {
      step.at("type").refuse_as("scale or translation");
    }
    const auto values = vector_of(step.at(type.c_str()), axes);
    transform.stated |= type == "scale";
    for (std::size_t a = 0; a < axes; ++a) {
      if (type == "scale") {
        transform.scale[a] *= values[a];
        transform.translation[a] *= values[a];
      } else {
        transform.translation[a] += values[a];
      }
    }
  }
}

/// The number of axes that the transforms of a level have, where the axes are not told.
std::size_t axis_count(const std::vector<Axis>& axes, const JsonValue& level) {
  if (!axes.empty()) return axes.size();
  const auto steps = level.find("coordinateTransformations");
  if (!steps) return 3;
  for (const JsonValue& step : steps->list()) {
    for (const char* key : {"scale", "translation"}) {
      if (step.has(key)) return std::max<std::size_t>(3, step.at(key).list().size());
    }
  }
  return 3;
}

void set_lengths(const std::vector<Axis>& axes, const Transform& transform, ScaleLevel& level) {
  if (!transform.stated) return;
  const std::size_t count = transform.scale.size();
  level.spacing.emplace();
  for (std::size_t a = 0; a < 3; ++a) {
    const std::size_t axis = count - 1 - a;
    const std::string unit = axis < axes.size() ? axes[axis].unit : std::string();
    const auto mm = mm_per_unit(unit);
    if (!mm) {
      level.warnings.push_back(message("axis ", "xyz"[a], " has ",
                                       unit.empty() ? "no unit" : "the unit " + in_quotes(unit),
                                       ": its lengths are taken as mm"));
    }
    (*level.spacing)[static_cast<int>(a)] = transform.scale[axis] * mm.value_or(1);
    level.origin[static_cast<int>(a)] = transform.translation[axis] * mm.value_or(1);
  }
}

/// Labels while their names and colours are collected, in the order of the file.
class NamedNumbers {
 public:
  NamedNumber& at(const JsonValue& entry) {
    constexpr double kMost = 9007199254740992.0;  // 2^53
    const JsonValue value = entry.at("label-value");
    const double number = value.number();
    if (!(std::abs(number) < kMost) || number != std::floor(number)) {
      value.refuse_as("a whole number");
    }
    const auto [place, is_new] = places_.emplace(static_cast<std::int64_t>(number), all_.size());
    if (is_new) all_.push_back({place->first, {}});
    return all_[place->second];
  }
  std::vector<NamedNumber> take() { return std::move(all_); }

 private:
  std::map<std::int64_t, std::size_t> places_;
  std::vector<NamedNumber> all_;
};

std::array<std::uint8_t, 3> colour_of(const JsonValue& rgba) {
  const std::vector<std::uint64_t> shares = rgba.counts();
  std::array<std::uint8_t, 3> colour{};
  for (std::size_t c = 0; c < colour.size(); ++c) {
    if (c >= shares.size() || shares[c] > 255) rgba.refuse_as("four numbers of 0 to 255");
    colour[c] = static_cast<std::uint8_t>(shares[c]);
  }
  return colour;
}

/// NGFF leaves the keys of properties to the writer: the first text that is a usual one.
std::string name_in(const JsonValue& properties) {
  for (const char* key : {"name", "label", "class", "label-name", "text"}) {
    const auto value = properties.find(key);
    if (value && value->is_text() && !value->text().empty()) return value->text();
  }
  return {};
}

void read_label_entries(const JsonValue& labels, NamedNumbers& all) {
  if (const auto colours = labels.find("colors")) {
    for (const JsonValue& entry : colours->list()) {
      NamedNumber& named = all.at(entry);
      if (const auto rgba = entry.find("rgba")) named.colour = colour_of(*rgba);
    }
  }
  if (const auto properties = labels.find("properties")) {
    for (const JsonValue& entry : properties->list()) all.at(entry).name = name_in(entry);
  }
}

/// What the group says about its labels, in all its levels.
void add_labels(const JsonValue& owner, std::vector<ScaleLevel>& levels) {
  const auto labels = owner.find("image-label");
  if (!labels) return;
  NamedNumbers all;
  try {
    read_label_entries(*labels, all);
  } catch (const InputError& error) {
    levels.front().warnings.push_back(message("not all names of labels are read: ", error.what()));
  }
  const auto shared = std::make_shared<const std::vector<NamedNumber>>(all.take());
  for (ScaleLevel& level : levels) level.labels = shared;
}

}  // namespace

std::vector<ScaleLevel> read_multiscales(const JsonValue& attributes) {
  const auto ome = attributes.find("ome");  // NGFF 0.5
  const JsonValue& owner = ome ? *ome : attributes;
  const auto images = owner.find("multiscales");
  if (!images || images->list().empty()) return {};
  const JsonValue image = images->list().front();
  const std::vector<Axis> axes = read_axes(image);
  require_space_last(image, axes);
  std::vector<ScaleLevel> levels;
  for (const JsonValue& dataset : image.at("datasets").list()) {
    ScaleLevel level;
    level.path = dataset.at("path").text();
    for (const Axis& axis : axes) level.axes.push_back(axis.name);
    const std::size_t count = axis_count(axes, dataset);
    Transform transform{false, std::vector<double>(count, 1), std::vector<double>(count, 0)};
    append_transforms(dataset, transform);
    append_transforms(image, transform);
    set_lengths(axes, transform, level);
    levels.push_back(std::move(level));
  }
  if (levels.empty()) image.at("datasets").refuse_as("a list with a dataset");
  add_labels(owner, levels);
  return levels;
}

}  // namespace mesamis::detail::volume_files
