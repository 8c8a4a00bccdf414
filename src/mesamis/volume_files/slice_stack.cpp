// SPDX-License-Identifier: Apache-2.0
#include "mesamis/volume_files/slice_stack.h"

#include <algorithm>
#include <optional>
#include <span>
#include <string_view>
#include <utility>

#include "mesamis/base/error.h"
#include "mesamis/files/file_list.h"
#include "mesamis/files/refuse.h"
#include "mesamis/volume_files/formats.h"
#include "mesamis/volume_files/skyscan_log.h"

namespace mesamis::detail::volume_files {
namespace {

namespace fs = std::filesystem;

bool is_digit(char c) { return c >= '0' && c <= '9'; }

/// The run of digits at the front, without zeros before it; taken off the text.
std::string_view take_number(std::string_view& text) {
  const auto end =
      static_cast<std::size_t>(std::find_if_not(text.begin(), text.end(), is_digit) - text.begin());
  std::string_view digits = text.substr(0, end);
  text.remove_prefix(end);
  while (digits.size() > 1 && digits[0] == '0') digits.remove_prefix(1);
  return digits;
}

/// -1, 0 or 1.
int compare_naturally(std::string_view a, std::string_view b) {
  while (!a.empty() && !b.empty()) {
    if (is_digit(a[0]) && is_digit(b[0])) {
      const std::string_view x = take_number(a), y = take_number(b);
      if (x.size() != y.size()) return x.size() < y.size() ? -1 : 1;
      if (x != y) return x < y ? -1 : 1;
    } else {
      if (a[0] != b[0]) return a[0] < b[0] ? -1 : 1;
      a.remove_prefix(1);
      b.remove_prefix(1);
    }
  }
  return int{!a.empty()} - int{!b.empty()};
}

/// The last number in the name of a file; none if there is none, or it is too long for one.
std::optional<std::int64_t> number_of(const fs::path& file) {
  std::string name = file.stem().string();
  while (!name.empty() && !is_digit(name.back())) name.pop_back();
  const auto begin = std::find_if_not(name.rbegin(), name.rend(), is_digit).base();
  std::int64_t number = 0;
  if (!parse_number(std::string_view(name).substr(static_cast<std::size_t>(begin - name.begin())),
                    number)) {
    return std::nullopt;
  }
  return number;
}

/// Warns where the numbers do not go up in equal steps.
void warn_of_gaps(const std::vector<fs::path>& files, std::vector<std::string>& warnings) {
  std::optional<std::int64_t> step;
  for (std::size_t n = 1; n < files.size(); ++n) {
    const auto before = number_of(files[n - 1]), here = number_of(files[n]);
    if (!before || !here) return;
    if (!step) step = *here - *before;
    if (*here - *before == *step) continue;
    warnings.push_back(message("the slices are numbered in steps of ", *step, ", but ",
                               shown(files[n].filename().string()), " follows ",
                               shown(files[n - 1].filename().string()), ": is one missing?"));
    return;
  }
}

void require_like(const ScanFile& first, const ScanFile& slice) {
  const auto& a = first.grid;
  const auto& b = slice.grid;
  const auto text = [](const ScanFile& scan) {
    const auto& g = scan.grid;
    return message(scan.format, " of ", g.size[0], " x ", g.size[1], " x ", g.size[2],
                   " pixels of ", 8 * byte_size(scan.source.type), " bits, ", g.spacing.x, " x ",
                   g.spacing.y, " mm");
  };
  const bool same_spacing = first.given_spacing || a.spacing == b.spacing;
  if (first.format == slice.format && a.size == b.size && same_spacing &&
      first.source.type == slice.source.type) {
    return;
  }
  refuse(slice.file, "expected a slice like the first, " + text(first) + ", found " + text(slice));
}

/// Indices of different tables of colours are no values of one scan.
void require_same_palette(const ScanFile& first, const ScanFile& slice) {
  if (first.palette == slice.palette) return;
  refuse(slice.file, message("expected the table of colours of the first slice, ",
                             shown(first.file.filename().string()),
                             ", found another one: values are "
                             "its indices"));
}

/// The spacing of SkyScan's log, if there is one; projections that lie beside theirs are no slices.
void take_log(ScanFile& scan, const std::string& picture) {
  const auto log = find_skyscan_log(scan.file, picture);
  if (!log) return;
  const std::string name = shown(log->file.filename().string());
  const auto& [width, height] = log->size;
  const bool same = width == scan.grid.size[0] && height == scan.grid.size[1];
  if (!log->reconstructed && same && width != height) {
    refuse(scan.file, message("expected slices, found the projections of a scan: of ", width, " x ",
                              height, " pixels, as SkyScan's log ", name, " says"));
  }
  if (scan.given_spacing) return;
  scan.grid.spacing = log->spacing;
  drop_spacing_warnings(scan.warnings);
  scan.warnings.push_back(message("the spacing is that of SkyScan's log ", name));
  scan.warnings.insert(scan.warnings.end(), log->warnings.begin(), log->warnings.end());
  if (width == 0 || height == 0 || same) return;
  scan.warnings.push_back(message(
      "SkyScan's log ", name, " tells of ", width, " x ", height, " pixels, the slices have ",
      scan.grid.size[0], " x ", scan.grid.size[1], ": if they were scaled, the spacing is wrong"));
}

/// The headers of all files, checked, as one volume without samples.
ScanFile open_headers(const fs::path& directory, const std::vector<fs::path>& files,
                      const Opening& opening) {
  ScanFile first = open_picture(files[0], opening);
  first.given_spacing = opening.spacing;
  if (first.grid.size[2] != 1) {
    refuse(files[0], message("expected one slice per file, found ", first.grid.size[2]));
  }
  for (std::size_t n = 1; n < files.size(); ++n) {
    const ScanFile slice = open_picture(files[n], opening);
    require_like(first, slice);
    require_same_palette(first, slice);
  }
  ScanFile scan = first;
  scan.file = directory;
  scan.format += " slices";
  take_log(scan, files[0].filename().string());
  set_size(scan, {first.grid.size[0], first.grid.size[1], std::ssize(files)});
  warn_of_gaps(files, scan.warnings);
  return scan;
}

/// Other systems leave files such as ._s1.png beside those that they copy.
bool is_hidden(const fs::path& file) { return file.filename().native().starts_with('.'); }

}  // namespace

bool natural_less(const std::string& a, const std::string& b) {
  const int order = compare_naturally(a, b);
  return order != 0 ? order < 0 : a < b;
}

std::vector<fs::path> slices_in(const fs::path& directory, MemoryBudget& budget) {
  std::vector<fs::path> files = files_in(directory);
  std::erase_if(files, [](const fs::path& file) { return !is_picture(file) || is_hidden(file); });
  if (find_skyscan_log(directory)) std::erase_if(files, is_scout);
  std::sort(files.begin(), files.end(), [](const fs::path& a, const fs::path& b) {
    return natural_less(a.filename().string(), b.filename().string());
  });
  if (files.size() < 2) return {};
  try {
    if (open_picture(files[0], {budget}).grid.size[2] != 1) return {};
  } catch (const InputError&) {
    return files;  // the reader says what is wrong with it
  }
  return files;
}

bool holds_dicom(const fs::path& directory) {
  const std::vector<fs::path> files = files_below(directory);
  return std::any_of(files.begin(), files.end(), looks_like_dicom);
}

std::vector<fs::path> slices_without_dicom(const fs::path& directory, MemoryBudget& budget) {
  std::vector<fs::path> slices = slices_in(directory, budget);
  return slices.empty() || holds_dicom(directory) ? std::vector<fs::path>{} : slices;
}

SliceReader read_pictures(std::vector<fs::path> files, const ValueChoice& choice) {
  return [files = std::move(files), choice](const SliceRange& slices, MemoryBudget& budget,
                                            std::vector<float>& out) {
    const auto asked = std::span(files).subspan(static_cast<std::size_t>(slices.first),
                                                static_cast<std::size_t>(slices.count));
    for (const fs::path& file : asked) {
      const ScopedFile scope(budget, file);
      Opening opening{budget};
      opening.choice = choice;
      const std::vector<float> slice = read_picture(file, opening).volume.samples;
      out.insert(out.end(), slice.begin(), slice.end());
    }
  };
}

OpenSlices open_stack(const fs::path& directory, const std::vector<fs::path>& files,
                      const Opening& opening) {
  return {open_headers(directory, files, opening), read_pictures(files, opening.choice)};
}

VolumeFile read_slices(const fs::path& directory, const std::vector<fs::path>& files,
                       const ReadOptions& options, MemoryBudget& budget) {
  const OpenSlices stack = open_stack(directory, files, opening_of(options, budget));
  const ScanFile& scan = stack.scan;
  announce(scan.grid, options);
  VolumeFile out{scan.grid, scan.format, scan.warnings};
  reserve_within(budget, out.volume.samples, out.volume.voxel_count(), "samples");
  stack.read({0, out.volume.size[2]}, budget, out.volume.samples);
  return out;
}

VolumeInfo describe_slices(const fs::path& directory, const std::vector<fs::path>& files,
                           const Opening& opening) {
  VolumeInfo info;
  info.description = (directory / "").parent_path().filename().string();
  info.format = "slices";
  try {
    const ScanFile scan = open_headers(directory, files, opening);
    info.format = scan.format;
    info.warnings = scan.warnings;
    set_grid(info, scan.grid);
  } catch (const InputError& error) {
    info.problem = error.what();
  }
  return info;
}

}  // namespace mesamis::detail::volume_files
