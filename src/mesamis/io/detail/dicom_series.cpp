// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <map>

#include "mesamis/base/error.h"
#include "mesamis/io/detail/dicom_slice.h"
#include "mesamis/io/detail/files.h"
#include "mesamis/io/detail/formats.h"
#include "mesamis/io/detail/refuse.h"

namespace mesamis::detail {
namespace {

namespace fs = std::filesystem;

constexpr double kStepTolerance = 0.02;      // of the slice distance, between neighbours
constexpr double kDriftTolerance = 0.25;     // of the smallest voxel edge, over the stack
constexpr double kSameOrientation = 1e-3;    // largest difference of direction cosines
constexpr double kSameSpacing = 1e-3;        // relative
constexpr double kDuplicateDistance = 1e-4;  // mm
constexpr std::size_t kLocalizerShare = 4;   // a side stack has at most 1/4 of the main one

constexpr std::size_t kLongestUid = 64;

/// Slices of one orientation, size and pixel spacing.
using Stack = std::vector<DicomSlice>;

struct Series {
  std::string uid, description, modality;
  std::vector<Stack> stacks;  // the largest first
  std::size_t frames = 0;
  std::string problem;  // of a file, or of the stacks
  std::vector<std::string> warnings;
};

bool close(const Vec3& a, const Vec3& b) {
  const Vec3 d = a - b;
  return std::max({std::abs(d.x), std::abs(d.y), std::abs(d.z)}) <= kSameOrientation;
}

bool close(double a, double b) { return std::abs(a - b) <= kSameSpacing * std::max(a, b); }

bool belong_together(const DicomSlice& a, const DicomSlice& b) {
  return a.columns == b.columns && a.rows == b.rows && close(a.column_step, b.column_step) &&
         close(a.row_step, b.row_step) && close(a.along_row, b.along_row) &&
         close(a.along_column, b.along_column);
}

void add_slice(Series& series, const DicomSlice& slice) {
  ++series.frames;
  for (Stack& stack : series.stacks) {
    if (belong_together(stack.front(), slice)) {
      stack.push_back(slice);
      return;
    }
  }
  series.stacks.push_back({slice});
}

void add_image(Series& series, const DicomImage& image) {
  series.description = series.description.empty() ? image.description : series.description;
  series.modality = series.modality.empty() ? image.modality : series.modality;
  if (!image.problem.empty()) {
    ++series.frames;
    if (series.problem.empty()) series.problem = image.problem;
  }
  if (!image.warning.empty() && series.warnings.empty()) series.warnings.push_back(image.warning);
  for (const DicomSlice& slice : image.slices) add_slice(series, slice);
}

std::string name_of(const DicomSlice& slice) {
  const std::string name = slice.file.filename().string();
  return slice.frame > 0 ? say(name, " frame ", slice.frame) : name;
}

/// Takes away what lies across the main stack and is small: localizers, by their own word or by
/// geometry. Two stacks of like size cannot be told apart: a problem.
void drop_localizers(Series& series) {
  auto& stacks = series.stacks;
  const bool any_slices = std::any_of(stacks.begin(), stacks.end(),
                                      [](const Stack& s) { return !s.front().localizer; });
  if (any_slices) {
    std::erase_if(stacks, [](const Stack& s) { return s.front().localizer; });
  }
  std::stable_sort(stacks.begin(), stacks.end(),
                   [](const Stack& a, const Stack& b) { return a.size() > b.size(); });
  if (stacks.size() < 2 || !series.problem.empty()) return;
  const Stack& main = stacks[0];
  const Stack& other = stacks[1];
  if (main.size() < 2 || (other.size() > 1 && other.size() * kLocalizerShare > main.size())) {
    const bool turned = !close(main[0].along_row, other[0].along_row) ||
                        !close(main[0].along_column, other[0].along_column);
    series.problem =
        say(main[0].file.parent_path().string(), ": expected one stack of slices, ", "found ",
            main.size(), " slices like ", name_of(main[0]), " and ", other.size(), " like ",
            name_of(other[0]), " of another ", turned ? "orientation" : "size or pixel spacing");
    return;
  }
  series.warnings.push_back(say(series.frames - main.size(), " slices left out that do not lie ",
                                "along the stack (localizers)"));
  stacks.resize(1);
}

std::vector<Series> group(const std::vector<DicomImage>& images) {
  std::vector<Series> all;
  std::map<std::string, std::size_t> index;
  for (const DicomImage& image : images) {
    if (!image.has_pixels) continue;
    const auto [entry, is_new] = index.emplace(image.series, all.size());
    if (is_new) all.push_back({image.series, "", "", {}, 0, "", {}});
    add_image(all[entry->second], image);
  }
  for (Series& series : all) drop_localizers(series);
  return all;
}

std::vector<DicomImage> read_images(const fs::path& path) {
  const bool directory = fs::is_directory(path);
  const fs::path parent = path.has_parent_path() ? path.parent_path() : fs::path(".");
  std::vector<DicomImage> images;
  for (const fs::path& file : directory ? files_below(path) : files_in(parent)) {
    if (looks_like_dicom(file)) images.push_back(describe_image(read_dicom_file(file)));
  }
  return images;
}

bool is_volume(const Series& series) {
  return series.frames >= 2 && !series.stacks.empty() && series.stacks[0].size() >= 2;
}

std::string title(const Series& s) {
  return say(in_quotes(s.uid, kLongestUid), " (", s.modality.empty() ? "?" : s.modality, ", ",
             s.description.empty() ? "no description" : s.description, ", ", s.frames, " slices)");
}

std::string titles(const std::vector<Series>& all, bool volumes_only) {
  constexpr std::size_t kMostListed = 20;
  std::string list;
  std::size_t listed = 0;
  for (const Series& series : all) {
    if (volumes_only && !is_volume(series)) continue;
    if (++listed > kMostListed) return list + "; and more";
    list += (list.empty() ? "" : "; ") + title(series);
  }
  return list;
}

const Series& pick(const fs::path& path, const std::vector<Series>& all, const std::string& uid) {
  if (all.empty()) refuse(path, "expected DICOM images, found none");
  if (!uid.empty()) {
    const auto named =
        std::find_if(all.begin(), all.end(), [&uid](const Series& s) { return s.uid == uid; });
    if (named != all.end()) return *named;
    refuse(path,
           "expected the series " + in_quotes(uid, kLongestUid) + ", found " + titles(all, false));
  }
  if (all.size() == 1) return all[0];
  const auto volumes = std::count_if(all.begin(), all.end(), is_volume);
  if (volumes == 1) return *std::find_if(all.begin(), all.end(), is_volume);
  refuse(path,
         say("expected one series of slices, found ", volumes, ": ", titles(all, volumes > 1)));
}

/// The slices in the order of the third axis, their normal.
struct SortedStack {
  Stack slices;
  Vec3 normal;
  std::vector<double> height;  // along the normal, mm
};

SortedStack sort_along_normal(const Stack& stack) {
  SortedStack sorted{stack, cross(stack[0].along_row, stack[0].along_column), {}};
  sorted.normal = (1 / norm(sorted.normal)) * sorted.normal;
  const Vec3 n = sorted.normal;
  std::stable_sort(sorted.slices.begin(), sorted.slices.end(),
                   [&n](const DicomSlice& a, const DicomSlice& b) {
                     return dot(a.position, n) < dot(b.position, n);
                   });
  for (const DicomSlice& slice : sorted.slices) sorted.height.push_back(dot(slice.position, n));
  return sorted;
}

/// The distance most neighbours have: the lower median.
double usual_gap(const std::vector<double>& height) {
  std::vector<double> gaps;
  for (std::size_t n = 1; n < height.size(); ++n) gaps.push_back(height[n] - height[n - 1]);
  const auto middle = gaps.begin() + static_cast<std::ptrdiff_t>((gaps.size() - 1) / 2);
  std::nth_element(gaps.begin(), middle, gaps.end());
  return *middle;
}

void require_even_gaps(const fs::path& path, const SortedStack& stack) {
  const double usual = usual_gap(stack.height);
  for (std::size_t n = 1; n < stack.height.size(); ++n) {
    const double gap = stack.height[n] - stack.height[n - 1];
    const std::string between = name_of(stack.slices[n - 1]) + " and " + name_of(stack.slices[n]);
    if (gap <= kDuplicateDistance) {
      refuse(path, say("expected one slice per position, found two at the same: ", between, " (",
                       gap, " mm apart)"));
    }
    if (std::abs(gap - usual) <= kStepTolerance * usual) continue;
    const double steps = gap / usual;
    const bool missing = steps > 1.5 && std::abs(steps - std::round(steps)) < 0.1;
    refuse(path, say(missing ? "slices are missing" : "the slices are unevenly spaced", " between ",
                     between, ": expected ", usual, " mm, found ", gap, " mm"));
  }
}

void require_upright(const fs::path& path, const SortedStack& stack) {
  const DicomSlice& first = stack.slices.front();
  const double usual = usual_gap(stack.height);
  const double drift = kDriftTolerance * std::min({usual, first.column_step, first.row_step});
  const auto lateral = [&stack](const DicomSlice& a, const DicomSlice& b) {
    const Vec3 d = b.position - a.position;
    return norm(d - dot(d, stack.normal) * stack.normal);
  };
  for (std::size_t n = 1; n < stack.slices.size(); ++n) {
    const DicomSlice& below = stack.slices[n - 1];
    const DicomSlice& slice = stack.slices[n];
    const double shift = lateral(below, slice), total = lateral(first, slice);
    if (shift <= kStepTolerance * usual && total <= drift) continue;
    const bool jump = shift > kStepTolerance * usual;
    const DicomSlice& from = jump ? below : first;
    const double rise = dot(slice.position - from.position, stack.normal);
    const double angle_deg = std::atan2(jump ? shift : total, rise) * 45 / std::atan(1);
    refuse(path, say("expected slices straight above one another, found a tilt of ", angle_deg,
                     " degrees (gantry tilt): ", name_of(slice), " is shifted by ",
                     jump ? shift : total, " mm against ", name_of(from), " over ", rise, " mm"));
  }
}

ScanFile grid_of(const fs::path& path, const Series& series, const SortedStack& stack) {
  ScanFile scan{path, "DICOM", {}, {}, series.warnings};
  const DicomSlice& first = stack.slices.front();
  set_size(scan, {first.columns, first.rows, static_cast<std::int64_t>(stack.slices.size())});
  const double rise =
      (stack.height.back() - stack.height.front()) / static_cast<double>(stack.height.size() - 1);
  const auto unit = [](const Vec3& v) { return (1 / norm(v)) * v; };
  set_axes(scan, {first.column_step * unit(first.along_row),
                  first.row_step * unit(first.along_column), rise * stack.normal});
  set_origin(scan, first.position);
  scan.grid.modality = series.modality;
  return scan;
}

/// Everything but the samples. @throws InputError with the series' problem.
ScanFile plan(const fs::path& path, const Series& series, SortedStack& stack) {
  if (!series.problem.empty()) throw InputError(series.problem);
  if (series.stacks[0].size() < 2) {
    const DicomSlice& only = series.stacks[0][0];
    refuse(only.file,
           "one slice is not a volume: expected at least 2 slices in the series, "
           "found 1");
  }
  stack = sort_along_normal(series.stacks[0]);
  require_even_gaps(path, stack);
  require_upright(path, stack);
  return grid_of(path, series, stack);
}

/// Decodes file by file, in the order of the slices; an enhanced file is opened once as long as
/// its frames follow one another.
std::vector<float> decode(const SortedStack& stack, std::size_t voxels) {
  std::vector<float> samples;
  samples.reserve(voxels);
  DicomFile file;
  DicomPixels pixels;
  for (const DicomSlice& slice : stack.slices) {
    if (file.path != slice.file) {
      file = {};
      file = read_dicom_file(slice.file);
      pixels = pixels_of(file);
    }
    append_frame(file, pixels, slice, samples);
  }
  return samples;
}

VolumeInfo info_of(const fs::path& path, const Series& series) {
  VolumeInfo info{series.uid, series.description, "DICOM", series.modality, {}, {}, ""};
  try {
    SortedStack stack;
    const ScanFile scan = plan(path, series, stack);
    info.size = scan.grid.size;
    info.spacing = scan.grid.spacing;
  } catch (const InputError& error) {
    info.problem = error.what();
  }
  return info;
}

}  // namespace

bool looks_like_dicom(const fs::path& file) {
  std::array<unsigned char, 132> begin{};
  std::error_code error;
  if (fs::file_size(file, error) < 8 || error) return false;
  const std::size_t got = ByteSource(file, Packing::kPlain).read(begin.data(), begin.size());
  return begins_like_dicom(Bytes(begin).first(got));
}

VolumeFile read_dicom(const fs::path& path, const std::string& series_uid) {
  std::string wanted = series_uid;
  const bool directory = fs::is_directory(path);
  if (!directory) {
    const DicomImage named = describe_image(read_dicom_file(path));
    if (!named.has_pixels)
      refuse(path, "expected a DICOM image, found " + in_quotes(named.modality));
    if (!named.problem.empty()) throw InputError(named.problem);
    if (wanted.empty()) wanted = named.series;
  }
  const std::vector<Series> all = group(read_images(path));
  const Series& series = pick(path, all, wanted);
  SortedStack stack;
  ScanFile scan = plan(path, series, stack);
  if (wanted.empty() && all.size() > 1) {
    scan.warnings.push_back("taken as the only volume among the series " + titles(all, false));
  }
  VolumeFile out{std::move(scan.grid), "DICOM", scan.warnings};
  out.volume.samples = decode(stack, out.volume.voxel_count());
  return out;
}

std::vector<VolumeInfo> list_dicom(const fs::path& path) {
  std::vector<VolumeInfo> infos;
  for (const Series& series : group(read_images(path))) infos.push_back(info_of(path, series));
  return infos;
}

}  // namespace mesamis::detail
