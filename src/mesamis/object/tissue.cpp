// SPDX-License-Identifier: Apache-2.0
#include "mesamis/object/tissue.h"

#include <algorithm>
#include <array>
#include <limits>

#include "mesamis/base/error.h"
#include "mesamis/base/written_number.h"
#include "mesamis/image/grey_values.h"

namespace mesamis {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kBoneHu = 200;

/// A tissue of a CT scan; all in HU.
Tissue in_ct(TissueKind kind, const char* name, const Window& values, const Window& levels,
             double start) {
  return {.name = name, .kind = kind, .values = values, .levels = levels, .start = start};
}

Tissue with_help(Tissue tissue, const char* help) {
  tissue.help = help;
  return tissue;
}

const std::array<Tissue, 8>& table() {
  using enum TissueKind;
  static const std::array<Tissue, 8> kTable{
      with_help(in_ct(kBright, "bone", {200, 3000}, {100, 1000}, kBoneHu),
                "bone against soft tissue; its level is that of the whole scan, not of the crop"),
      with_help(in_ct(kBright, "teeth", {1200, 3500}, {900, 2200}, 1300),
                "enamel and dentine against bone and gums; metal comes along"),
      with_help(in_ct(kBright, "soft", {0, 200}, {-90, 30}, -30),
                "muscle and organs against fat; bone comes along"),
      with_help(in_ct(kBright, "skin", {-200, 3000}, {-800, -150}, -400),
                "the surface of the body against air"),
      with_help(in_ct(kDark, "lung", {-1000, -500}, {-700, -200}, -400),
                "the lungs with their airways, up to the chest wall"),
      with_help(in_ct(kDark, "airway", {-1100, -900}, {-950, -300}, -500),
                "air in nose, sinuses and windpipe; lungs come along"),
      with_help(in_ct(kBright, "vessel", {150, 500}, {90, 300}, 150),
                "vessels with contrast agent against soft tissue; bone comes along"),
      Tissue{.name = "dark",
             .kind = kDark,
             .values = {-kInfinity, kInfinity},
             .levels = {-kInfinity, kInfinity},
             .help = "whatever is darker than its surroundings, in any scan: bone in MR",
             .in_patient = false,
             .hounsfield = false}};
  return kTable;
}

std::string names_of_table() {
  std::string names;
  for (const Tissue& tissue : table()) names += tissue.name + ", ";
  return names;
}

[[noreturn]] void refuse(std::string_view text) {
  throw InputError("tissue: expected " + names_of_table() + "or LO:HI with LO below HI, found \"" +
                   quotable(text) + "\"");
}

Tissue parse_range(std::string_view text, std::size_t colon) {
  const std::string_view low_text = text.substr(0, colon), high_text = text.substr(colon + 1);
  const auto low = written_number(low_text), high = written_number(high_text);
  if ((!low && !low_text.empty()) || (!high && !high_text.empty())) refuse(text);
  if ((!low && !high) || (low && high && !(*low < *high))) refuse(text);
  Tissue tissue;
  tissue.name = text;
  tissue.values = {low.value_or(-kInfinity), high.value_or(kInfinity)};
  tissue.kind = low && high ? TissueKind::kRange : low ? TissueKind::kBright : TissueKind::kDark;
  const double level = low ? *low : *high;
  tissue.levels = {level, level};
  tissue.start = level;
  tissue.in_patient = false;
  tissue.hounsfield = false;
  tissue.help = "samples from " + std::string(text);
  return tissue;
}

}  // namespace

std::span<const Tissue> detail::object::tissue_table() noexcept { return table(); }

Tissue parse_tissue(std::string_view text) {
  for (const Tissue& tissue : table()) {
    if (tissue.name == text) return tissue;
  }
  const std::size_t colon = text.find(':');
  if (colon == std::string_view::npos) refuse(text);
  return parse_range(text, colon);
}

std::optional<Tissue> detail::object::suggested_tissue(const VolumeView& volume) {
  if (!is_hounsfield(volume)) return std::nullopt;
  const bool has_bone = quantiles(volume.samples, {0.999})[0] > kBoneHu;
  return parse_tissue(has_bone ? "bone" : "skin");
}

std::string detail::object::surface_at_level(const VolumeView& volume, double level) {
  struct Row {
    double below;  // HU
    const char* name;
  };
  constexpr std::array<Row, 5> kRows{{{-150, "skin"},
                                      {70, "soft tissue"},
                                      {130, "vessels or spongy bone"},
                                      {2200, "bone"},
                                      {kInfinity, "metal"}}};
  const auto [least, most] = sample_range(volume.samples);
  if (!(least <= level && most > level) || !is_hounsfield(volume)) return "";
  return std::find_if(kRows.begin(), kRows.end(),
                      [level](const Row& row) { return level < row.below; })
      ->name;
}

}  // namespace mesamis
