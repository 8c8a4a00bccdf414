// SPDX-License-Identifier: Apache-2.0
#include "mesamis/volume_files/skyscan_log.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <string>

#include "mesamis/base/error.h"
#include "mesamis/files/file_list.h"
#include "mesamis/files/refuse.h"
#include "mesamis/volume_files/text_header.h"

namespace mesamis::detail::volume_files {
namespace {

namespace fs = std::filesystem;

/// The fields of the section [Reconstruction], in lower case.
std::map<std::string, std::string> reconstruction_in(const fs::path& file) {
  std::map<std::string, std::string> fields;
  HeaderLines lines(file);
  bool inside = false;
  for (std::string line; lines.next(line);) {
    const std::string_view text = trimmed(line);
    if (text.starts_with('[')) inside = lower(text) == "[reconstruction]";
    const auto equals = text.find('=');
    if (!inside || equals == std::string_view::npos) continue;
    fields.emplace(lower(trimmed(text.substr(0, equals))),
                   std::string(trimmed(text.substr(equals + 1))));
  }
  return fields;
}

/// A positive number, with a point or a comma.
std::optional<double> length_of(std::string text) {
  std::replace(text.begin(), text.end(), ',', '.');
  double length = 0;
  const bool usable =
      parse_number(std::string_view(text), length) && length > 0 && std::isfinite(length);
  return usable ? std::optional(length) : std::nullopt;
}

std::optional<SkyscanLog> log_in(const fs::path& file) {
  constexpr double kMmPerUm = 1e-3;
  auto fields = reconstruction_in(file);
  const auto pixel = length_of(fields["pixel size (um)"]);
  if (!pixel) return std::nullopt;
  const double step = length_of(fields["section to section step"]).value_or(1);
  const double mm = kMmPerUm * *pixel;
  return SkyscanLog{file, {mm, mm, mm * step}};
}

}  // namespace

std::optional<SkyscanLog> find_skyscan_log(const fs::path& directory) {
  for (const fs::path& file : files_in(directory)) {
    if (lower_extension(file) != ".log") continue;
    try {
      if (auto log = log_in(file)) return log;
    } catch (const InputError&) {
      continue;  // another program's log
    }
  }
  return std::nullopt;
}

bool is_scout(const fs::path& picture) { return lower(picture.stem().string()).ends_with("_spr"); }

}  // namespace mesamis::detail::volume_files
