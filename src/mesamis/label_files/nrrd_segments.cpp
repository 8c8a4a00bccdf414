// SPDX-License-Identifier: Apache-2.0
#include "mesamis/label_files/nrrd_segments.h"

#include <optional>
#include <set>
#include <string_view>

#include "mesamis/files/refuse.h"
#include "mesamis/files/text_scan.h"
#include "mesamis/label_files/label_values.h"

namespace mesamis::detail::label_files {
namespace {

/// The fields of one segment by name: "Name", "LabelValue", ...
using Fields = std::map<std::string, std::string, std::less<>>;

/// "Segment12_Name" as 12 and "Name"; none for other keys.
std::optional<std::pair<std::int64_t, std::string>> parts_of(std::string_view key) {
  constexpr std::string_view kPrefix = "Segment";
  if (!key.starts_with(kPrefix)) return std::nullopt;
  key.remove_prefix(kPrefix.size());
  const std::size_t end = key.find('_');
  std::int64_t number = 0;
  if (end == std::string_view::npos || !parse_number(key.substr(0, end), number)) {
    return std::nullopt;
  }
  return std::pair(number, std::string(key.substr(end + 1)));
}

std::string field(const Fields& fields, std::string_view name) {
  const auto found = fields.find(name);
  return found == fields.end() ? "" : std::string(trimmed(found->second));
}

std::optional<std::array<std::uint8_t, 3>> colour_of(const Fields& fields) {
  std::string text = field(fields, "Color");
  if (text.empty()) text = field(fields, "DefaultColor");  // files before 2017
  std::string_view rest = text;
  std::array<std::string_view, 3> words;
  for (std::string_view& word : words) word = take_word(rest);
  return colour_in(words);
}

Index label_of(const std::filesystem::path& file, const std::string& text) {
  if (text.empty()) return 1;
  const auto label = label_in(text);
  if (!label || *label == 0) {
    refuse(file, message("expected a segment's LabelValue of 1 to ", kMaxLabel, ", found ",
                         in_quotes(text)));
  }
  return *label;
}

/// @param order  of the segment among those of the file.
Index layer_of(const std::filesystem::path& file, const Fields& fields, std::size_t order,
               std::size_t layers) {
  const std::string text = field(fields, "Layer");
  const bool one_each = text.empty() && field(fields, "LabelValue").empty() && layers > 1;
  std::int64_t layer = one_each ? static_cast<std::int64_t>(order) : 0;
  if ((!text.empty() && !parse_number(std::string_view(text), layer)) || layer < 0 ||
      static_cast<std::uint64_t>(layer) >= layers) {
    refuse(file, message("expected the layer of segment ", order, " among ", layers, ", found ",
                         text.empty() ? message(layer) : in_quotes(text)));
  }
  return static_cast<Index>(layer);
}

std::string name_of(const Fields& fields, Index label) {
  for (const std::string_view key : {"Name", "ID"}) {
    const auto found = fields.find(key);
    if (found != fields.end() && !trimmed(found->second).empty()) return found->second;
  }
  return message("label ", label);
}

std::string extent_text(const std::optional<CropRange>& range) {
  if (!range) return "0 -1 0 -1 0 -1";
  std::string text;
  for (std::size_t a = 0; a < 3; ++a) {
    text += message(a > 0 ? " " : "", range->begin[a], " ", range->end[a] - 1);
  }
  return text;
}

}  // namespace

std::vector<Segment> segments_in_keys(const std::filesystem::path& file,
                                      const std::map<std::string, std::string>& keys,
                                      std::size_t layers) {
  std::map<std::int64_t, Fields> all;
  for (const auto& [key, value] : keys) {
    if (const auto parts = parts_of(key)) all[parts->first].emplace(parts->second, value);
  }
  std::vector<Segment> segments;
  std::set<std::pair<Index, Index>> seen;
  for (const auto& [number, fields] : all) {
    Segment segment;
    segment.label = label_of(file, field(fields, "LabelValue"));
    segment.layer = layer_of(file, fields, segments.size(), layers);
    segment.name = name_of(fields, segment.label);
    segment.colour = colour_of(fields).value_or(default_colour(segment.label));
    if (!seen.emplace(segment.layer, segment.label).second) {
      refuse(file, message("expected one segment per layer and label, found two for label ",
                           segment.label, " of layer ", segment.layer));
    }
    segments.push_back(std::move(segment));
  }
  return segments;
}

std::vector<std::pair<std::string, std::string>> segment_keys(const LabelMap& map) {
  std::vector<std::pair<std::string, std::string>> keys{
      {"Segmentation_MasterRepresentation", "Binary labelmap"},
      {"Segmentation_ContainedRepresentationNames", "Binary labelmap|"},
      {"Segmentation_ReferenceImageExtentOffset", "0 0 0"}};
  const auto ranges = ranges_of(map);
  for (std::size_t n = 0; n < map.segments.size(); ++n) {
    const Segment& segment = map.segments[n];
    const std::string prefix = message("Segment", n, "_");
    const auto add = [&](const char* name, const std::string& value) {
      keys.emplace_back(prefix + name, value);
    };
    std::string colour = colour_share(segment.colour[0]);
    for (const std::size_t c : {1, 2}) colour += " " + colour_share(segment.colour[c]);
    add("ID", message("Segment_", n + 1));
    add("Name", segment.name);
    add("NameAutoGenerated", "0");
    add("Color", colour);
    add("ColorAutoGenerated", "0");
    add("Extent", extent_text(ranges[n]));
    add("LabelValue", message(segment.label));
    add("Layer", message(segment.layer));
    add("Tags", "|");
  }
  return keys;
}

}  // namespace mesamis::detail::label_files
