// SPDX-License-Identifier: Apache-2.0
#include "mesamis/volume_files/dicom_phases.h"

#include <algorithm>
#include <array>
#include <map>
#include <optional>
#include <utility>

#include "mesamis/base/error.h"
#include "mesamis/base/written_number.h"
#include "mesamis/files/bytes.h"
#include "mesamis/files/refuse.h"
#include "mesamis/volume_files/dicom_spacing.h"

namespace mesamis::detail::volume_files {
namespace {

enum class Form { kText, kWhole, kReal };

struct PhaseTag {
  const char* name;
  MacroTag tag;
  Form form = Form::kText;
};

constexpr std::array<PhaseTag, 11> kTags{
    {{"Temporal Position Index", {dicom::kFrameContent, 0x00209128}, Form::kWhole},
     {"Temporal Position Identifier", {dicom::kFrameContent, 0x00200100}},
     {"Nominal Percentage of Cardiac Phase", {0x00189118, 0x00209241}, Form::kReal},
     {"Trigger Time", {0x00189118, 0x00181060}},
     {"Effective Echo Time", {0x00189114, 0x00189082}, Form::kReal},
     {"Echo Time", {0x00189114, 0x00180081}},
     {"Diffusion b-value", {0x00189117, 0x00189087}, Form::kReal},
     {"Acquisition Number", {dicom::kFrameContent, 0x00200012}},
     {"Acquisition Time", {dicom::kFrameContent, 0x00080032}},
     {"Image Type", {0, dicom::kImageType}},
     {"Instance Number", {0, dicom::kInstanceNumber}}}};
constexpr std::size_t kInstance = kTags.size() - 1;
constexpr char kSeparator = '\x1f';

/// The values of a slice, one per tag.
std::vector<std::string> marks_of(const DicomSlice& slice) {
  std::vector<std::string> marks;
  std::string_view text = slice.phase;
  while (marks.size() < kTags.size()) {
    const std::size_t end = std::min(text.find(kSeparator), text.size());
    marks.emplace_back(text.substr(0, end));
    text.remove_prefix(std::min(end + 1, text.size()));
  }
  return marks;
}

/// Numbers by their size, before other texts.
bool less_mark(const std::string& a, const std::string& b) {
  double x = 0, y = 0;
  const bool is_x = parse_number(std::string_view(a), x),
             is_y = parse_number(std::string_view(b), y);
  if (is_x && is_y && x != y) return x < y;
  return is_x != is_y ? is_x : a < b;
}

bool same_place(const DicomSlice& a, const DicomSlice& b) {
  return norm(a.position - b.position) <= kDuplicateDistance;
}

/// The slices at each place, by their number in the stack.
using Places = std::vector<std::vector<std::size_t>>;

Places places_of(const DicomStack& stack) {
  const SortedSlices sorted = [&] {
    DicomStack numbered = stack;
    for (std::size_t n = 0; n < numbered.size(); ++n) numbered[n].frame = static_cast<int>(n);
    return sort_along_normal(std::move(numbered));
  }();
  Places places;
  for (std::size_t n = 0; n < sorted.slices.size(); ++n) {
    if (n == 0 || !same_place(sorted.slices[n - 1], sorted.slices[n])) places.emplace_back();
    places.back().push_back(static_cast<std::size_t>(sorted.slices[n].frame));
  }
  return places;
}

/// The phases of a stack: their slices, what tells them and its values.
struct Phases {
  std::vector<DicomStack> stacks;
  std::string told_by;
  std::vector<std::string> values;
};

struct MarkLess {
  bool operator()(const std::string& a, const std::string& b) const { return less_mark(a, b); }
};

/// The phases that a value of each slice tells; none if it does not tell them.
std::optional<Phases> phases_by(const DicomStack& stack, const Places& places,
                                const std::vector<std::string>& values) {
  std::map<std::string, DicomStack, MarkLess> found;
  for (const auto& place : places) {
    for (const std::size_t n : place) {
      DicomStack& phase = found[values[n]];
      if (!phase.empty() && same_place(phase.back(), stack[n])) return std::nullopt;
      phase.push_back(stack[n]);
    }
    if (found.size() > places[0].size()) return std::nullopt;
  }
  if (found.size() != places[0].size()) return std::nullopt;
  Phases phases;
  for (auto& [value, slices] : found) {
    phases.values.push_back(value);
    phases.stacks.push_back(std::move(slices));
  }
  return phases;
}

/// By one tag, or by two.
std::optional<Phases> phases_by_tags(const DicomStack& stack, const Places& places) {
  std::vector<std::vector<std::string>> marks;
  for (const DicomSlice& slice : stack) marks.push_back(marks_of(slice));
  std::vector<std::string> values(stack.size());
  for (std::size_t a = 0; a < kInstance; ++a) {
    for (std::size_t n = 0; n < stack.size(); ++n) values[n] = marks[n][a];
    if (auto phases = phases_by(stack, places, values)) {
      phases->told_by = kTags[a].name;
      return phases;
    }
  }
  for (std::size_t a = 0; a < kInstance; ++a) {
    for (std::size_t b = a + 1; b < kInstance; ++b) {
      for (std::size_t n = 0; n < stack.size(); ++n) values[n] = marks[n][a] + ", " + marks[n][b];
      if (auto phases = phases_by(stack, places, values)) {
        phases->told_by = message(kTags[a].name, " and ", kTags[b].name);
        return phases;
      }
    }
  }
  return std::nullopt;
}

Phases phases_by_order(const DicomStack& stack, const Places& places) {
  Phases phases{std::vector<DicomStack>(places[0].size()), "the order of Instance Numbers", {}};
  for (auto place : places) {
    std::stable_sort(place.begin(), place.end(), [&](std::size_t a, std::size_t b) {
      return less_mark(marks_of(stack[a])[kInstance], marks_of(stack[b])[kInstance]);
    });
    for (std::size_t n = 0; n < place.size(); ++n) phases.stacks[n].push_back(stack[place[n]]);
  }
  return phases;
}

/// "Trigger Time 0; 80; 160; and more"
std::string values_of(const Phases& phases) {
  constexpr std::size_t kMostListed = 12;
  std::string text = phases.told_by;
  for (std::size_t n = 0; n < phases.values.size(); ++n) {
    if (n == kMostListed) return text + "; and more";
    text += (n == 0 ? " " : "; ") + shown(phases.values[n]);
  }
  return text;
}

/// The value of a tag as text, whatever it is stored as.
std::string mark_of(const DicomFile& file, std::size_t frame, const PhaseTag& tag) {
  const Bytes bytes = frame_bytes(file, frame, tag.tag);
  const auto* data = reinterpret_cast<const char*>(bytes.data());
  const ByteOrder order = file.big_endian ? ByteOrder::kBig : ByteOrder::kLittle;
  if (tag.form == Form::kWhole && bytes.size() == sizeof(std::uint32_t)) {
    return std::to_string(load<std::uint32_t>(data, order));
  }
  if (tag.form == Form::kReal && bytes.size() == sizeof(float)) {
    return number_text(static_cast<double>(load<float>(data, order)));
  }
  if (tag.form == Form::kReal && bytes.size() == sizeof(double)) {
    return number_text(load<double>(data, order));
  }
  return frame_text(file, frame, tag.tag);
}

}  // namespace

std::string phase_marks(const DicomFile& file, std::size_t frame) {
  constexpr std::size_t kLongest = 24;
  std::string marks;
  for (const PhaseTag& tag : kTags) {
    if (&tag != kTags.data()) marks += kSeparator;
    marks += mark_of(file, frame, tag).substr(0, kLongest);
  }
  return marks;
}

bool has_instance_number(const std::string& marks) {
  return !marks.empty() && marks.back() != kSeparator;
}

PhaseChoice choose_phase(const std::filesystem::path& path, const DicomStack& stack,
                         const ValueChoice& choice) {
  const Places places = places_of(stack);
  const std::size_t count = places[0].size();
  const bool even = std::all_of(places.begin(), places.end(),
                                [count](const auto& place) { return place.size() == count; });
  if (count < 2 || !even) {
    if (even) take_value(path, {}, choice);
    return {stack, ""};
  }
  auto told = phases_by_tags(stack, places);
  Phases phases = told ? std::move(*told) : phases_by_order(stack, places);
  const auto number = [&] {
    try {
      return take_value(path, {static_cast<std::int64_t>(count), 1}, choice).volume;
    } catch (const InputError& error) {
      throw InputError(
          message(error.what(), ": every place ", count, " times, by ", values_of(phases)));
    }
  }();
  const auto n = static_cast<std::size_t>(number);
  const std::string value = phases.values.empty() ? "" : " " + shown(phases.values[n]);
  return {std::move(phases.stacks[n]),
          message("volume ", n, " of ", count, " is taken, by ", phases.told_by, value)};
}

}  // namespace mesamis::detail::volume_files
