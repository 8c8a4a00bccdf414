// SPDX-License-Identifier: Apache-2.0
#include "mesamis/volume_files/skyscan_log.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <string>
#include <utility>

#include "mesamis/base/error.h"
#include "mesamis/files/file_list.h"
#include "mesamis/files/length_unit.h"
#include "mesamis/files/refuse.h"
#include "mesamis/volume_files/text_header.h"

namespace mesamis::detail::volume_files {
namespace {

namespace fs = std::filesystem;

/// In lower case.
using Section = std::map<std::string, std::string>;

/// The sections [Acquisition] and [Reconstruction].
struct Sections {
  Section acquisition, reconstruction;
};

Sections sections_in(const fs::path& file) {
  Sections sections;
  HeaderLines lines(file);
  Section* section = nullptr;
  for (std::string line; lines.next(line);) {
    const std::string_view text = trimmed(line);
    if (text.starts_with('[')) {
      const std::string name = lower(text);
      section = name == "[reconstruction]" ? &sections.reconstruction
                : name == "[acquisition]"  ? &sections.acquisition
                                           : nullptr;
    }
    const auto equals = text.find('=');
    if (section == nullptr || equals == std::string_view::npos) continue;
    section->emplace(lower(trimmed(text.substr(0, equals))),
                     std::string(trimmed(text.substr(equals + 1))));
  }
  return sections;
}

/// A positive number, with a point or a comma.
std::optional<double> length_of(std::string text) {
  std::replace(text.begin(), text.end(), ',', '.');
  double length = 0;
  const bool usable =
      parse_number(std::string_view(text), length) && length > 0 && std::isfinite(length);
  return usable ? std::optional(length) : std::nullopt;
}

/// mm, of "17.3" with the unit that the field names, or of "17.3 um"; none without a unit.
std::optional<double> mm_of(const std::string& value, std::string_view unit) {
  const auto end = std::min(value.find_first_not_of("0123456789.,+-eE"), value.size());
  const auto length = length_of(value.substr(0, end));
  const std::string_view behind = trimmed(std::string_view(value).substr(end));
  const auto mm = mm_per_unit(behind.empty() ? unit : behind);
  return length && mm ? std::optional(*length * *mm) : std::nullopt;
}

/// The length in mm of a field such as "pixel size (um)".
std::optional<double> size_in(const Section& section, std::string_view name) {
  for (const auto& [key, value] : section) {
    if (!key.starts_with(name)) continue;
    std::string_view unit = trimmed(std::string_view(key).substr(name.size()));
    if (!unit.empty() && (!unit.starts_with('(') || !unit.ends_with(')'))) continue;
    if (!unit.empty()) unit = unit.substr(1, unit.size() - 2);
    if (const auto mm = mm_of(value, unit)) return mm;
  }
  return std::nullopt;
}

std::optional<double> pixel_in(const Section& section) {
  for (const char* name : {"pixel size", "scaled image pixel size", "image pixel size"}) {
    if (const auto mm = size_in(section, name)) return mm;
  }
  return std::nullopt;
}

std::int64_t count_in(const Section& section, const char* key) {
  const auto found = section.find(key);
  std::int64_t count = 0;
  return found != section.end() && parse_number(found->second, count) && count > 0 ? count : 0;
}

std::optional<SkyscanLog> log_in(const fs::path& file) {
  const auto [acquisition, reconstruction] = sections_in(file);
  const auto of_slices = pixel_in(reconstruction), of_projections = pixel_in(acquisition);
  if (!of_slices && !of_projections) return std::nullopt;
  const double mm = of_slices ? *of_slices : *of_projections;
  const auto step = reconstruction.find("section to section step");
  const double steps = step == reconstruction.end() ? 1 : length_of(step->second).value_or(1);
  SkyscanLog log{file, {mm, mm, mm * steps}, !reconstruction.empty()};
  log.size = {count_in(reconstruction, "result image width (pixels)"),
              count_in(reconstruction, "result image height (pixels)")};
  if (!log.reconstructed) {
    log.size = {count_in(acquisition, "number of columns"),
                count_in(acquisition, "number of rows")};
  }
  if (!of_slices) {
    log.warnings.push_back(
        message("SkyScan's log ", shown(file.filename().string()),
                " states the pixels of projections alone: slices of another scale have others"));
  }
  return log;
}

/// How well a log fits a picture: how much of its name begins the picture's.
std::size_t fit_of(const SkyscanLog& log, std::string_view picture) {
  const std::string stem = log.file.stem().string();
  return (log.reconstructed ? 1 : 0) +
         (log.reconstructed && picture.starts_with(stem) ? stem.size() : 0);
}

/// Where another log of slices fits as well and states another spacing.
void warn_of_others(const std::vector<SkyscanLog>& logs, std::string_view picture,
                    SkyscanLog& taken) {
  for (const SkyscanLog& other : logs) {
    const bool same = other.file == taken.file || other.spacing == taken.spacing;
    if (same || fit_of(other, picture) != fit_of(taken, picture)) continue;
    taken.warnings.push_back(message("SkyScan's log ", shown(other.file.filename().string()),
                                     " states another spacing, ", other.spacing.x, " x ",
                                     other.spacing.z, " mm: it does not count"));
    return;
  }
}

}  // namespace

std::optional<SkyscanLog> find_skyscan_log(const fs::path& directory, std::string_view picture) {
  std::vector<SkyscanLog> logs;
  for (const fs::path& file : files_in(directory)) {
    if (lower_extension(file) != ".log") continue;
    try {
      if (auto log = log_in(file)) logs.push_back(std::move(*log));
    } catch (const InputError&) {
      continue;  // another program's log
    }
  }
  if (logs.empty()) return std::nullopt;
  SkyscanLog taken =
      *std::max_element(logs.begin(), logs.end(), [&](const SkyscanLog& a, const SkyscanLog& b) {
        return fit_of(a, picture) < fit_of(b, picture);
      });
  warn_of_others(logs, picture, taken);
  return taken;
}

bool is_scout(const fs::path& picture) { return lower(picture.stem().string()).ends_with("_spr"); }

}  // namespace mesamis::detail::volume_files
