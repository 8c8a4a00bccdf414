// SPDX-License-Identifier: Apache-2.0
#include "mesamis/volume_files/dicom_series.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>
#include <utility>

#include "mesamis/files/refuse.h"
#include "mesamis/volume_files/dicom_phases.h"
#include "mesamis/volume_files/dicom_spacing.h"

namespace mesamis::detail::volume_files {
namespace {

constexpr double kSameOrientation = 1e-3;   // largest difference of direction cosines
constexpr double kSameSpacing = 1e-3;       // relative
constexpr std::size_t kLocalizerShare = 4;  // a localizer stack has at most 1/4 of the main one
constexpr std::size_t kLongestUid = 64;

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

void add_slice(DicomSeries& series, const DicomSlice& slice) {
  ++series.frames;
  for (DicomStack& stack : series.stacks) {
    if (belong_together(stack.front(), slice)) {
      stack.push_back(slice);
      return;
    }
  }
  series.stacks.push_back({slice});
}

bool same_frames(const DicomImage& a, const DicomImage& b) {
  const auto same = [](const DicomSlice& x, const DicomSlice& y) {
    return norm(x.position - y.position) <= kDuplicateDistance && x.slope == y.slope &&
           x.intercept == y.intercept && x.columns == y.columns && x.rows == y.rows;
  };
  return std::equal(a.slices.begin(), a.slices.end(), b.slices.begin(), b.slices.end(), same);
}

/// Files that are there twice: one is enough.
class Copies {
 public:
  explicit Copies(const std::vector<DicomImage>& images) {
    for (const DicomImage& image : images) {
      if (image.has_pixels && image.problem.empty()) add(image);
    }
  }
  bool left_out(const DicomImage& image) const { return left_out_.count(&image) > 0; }
  void warn(DicomSeries& series) const {
    warn_of(same_, "copies with the same SOP Instance UID", series);
    warn_of(recoded_, "the same slices in another encoding", series);
  }

 private:
  /// Those of a series: how many, and the first one.
  using Found = std::map<std::string, std::pair<std::size_t, const DicomImage*>>;
  using Keys = std::array<std::string, 2>;

  /// What copies have in common; empty if an image lacks it.
  static Keys keys_of(const DicomImage& image) {
    Keys keys;
    if (!image.instance.empty()) keys[0] = image.series + '\n' + image.instance;
    const DicomSlice& first = image.slices.front();
    if (!has_instance_number(first.phase)) return keys;
    const Vec3& p = first.position;
    keys[1] = message(image.series, '\n', first.phase, '\n', p.x, ' ', p.y, ' ', p.z);
    return keys;
  }

  void add(const DicomImage& image) {
    if (image.slices.empty()) return;
    const Keys keys = keys_of(image);
    for (std::size_t k = 0; k < keys.size(); ++k) {
      const auto found = first_.find(keys[k]);
      if (found == first_.end()) continue;
      const DicomImage& other = *found->second;
      if (!same_frames(other, image)) continue;
      const bool recoded = other.transfer_syntax != image.transfer_syntax;
      if (!recoded && (k > 0 || other.content != image.content)) continue;
      const bool better = other.lossy && !image.lossy;
      leave_out(better ? other : image, recoded ? recoded_ : same_);
      if (better) keep(image, keys_of(other)), keep(image, keys);
      return;
    }
    for (const std::string& key : keys) {
      if (!key.empty()) first_.emplace(key, &image);
    }
  }
  void keep(const DicomImage& image, const Keys& keys) {
    for (const std::string& key : keys) {
      if (!key.empty()) first_[key] = &image;
    }
  }
  void leave_out(const DicomImage& image, Found& found) {
    left_out_.insert(&image);
    auto& [count, copy] = found[image.series];
    if (count++ == 0) copy = &image;
  }
  static void warn_of(const Found& all, const char* what, DicomSeries& series) {
    const auto found = all.find(series.uid);
    if (found == all.end()) return;
    const auto& [count, copy] = found->second;
    series.warnings.push_back(message(count, count == 1 ? " file" : " files", " left out: ", what,
                                      ", the first ", shown(copy->file.filename().string())));
  }

  std::map<std::string, const DicomImage*> first_;
  std::set<const DicomImage*> left_out_;
  Found same_, recoded_;
};

/// Slices that are placed in different ways do not lie in one frame.
void check_places(DicomSeries& series) {
  std::map<PlacedBy, const DicomSlice*> ways;
  for (const DicomStack& stack : series.stacks) {
    for (const DicomSlice& slice : stack) ways.emplace(slice.placed_by, &slice);
  }
  if (ways.empty() || !series.problem.empty()) return;
  const auto& [way, slice] = *ways.rbegin();
  if (ways.size() > 1) {
    series.problem =
        message(slice->file.string(), ": expected Image Position (0020,0032) as in other slices ",
                "of the series, found none");
  } else if (way != PlacedBy::kPosition) {
    series.warnings.push_back(message(
        "the slices have no Image Position: placed by ",
        way == PlacedBy::kLocation ? "Slice Location" : "Instance Number",
        slice->oriented ? ", one straight above another; whether they are mirrored is not known"
                        : ", axes taken as LPS; whether sides are exchanged is not known"));
  }
}

/// Values of some slices alone may be in other units.
void check_rescale(DicomSeries& series) {
  if (series.stacks.empty()) return;
  const DicomStack& stack = series.stacks.front();
  const auto plain = [](const DicomSlice& slice) { return !slice.rescaled; };
  const auto count = std::count_if(stack.begin(), stack.end(), plain);
  if (count == 0 || count == std::ssize(stack)) return;
  series.warnings.push_back(message(
      count, count == 1 ? " slice" : " slices", ", the first ",
      name_of(*std::find_if(stack.begin(), stack.end(), plain)),
      ", without Rescale Slope and Intercept among others: the values there are as stored"));
}

void add_image(DicomSeries& series, const DicomImage& image) {
  series.description = series.description.empty() ? image.description : series.description;
  series.modality = series.modality.empty() ? image.modality : series.modality;
  if (series.frame_of_reference.empty()) series.frame_of_reference = image.frame_of_reference;
  if (!image.problem.empty()) {
    ++series.frames;
    if (series.problem.empty()) series.problem = image.problem;
  }
  if (!image.warning.empty() && series.warnings.empty()) series.warnings.push_back(image.warning);
  for (const DicomSlice& slice : image.slices) add_slice(series, slice);
}

/// Removes localizers: stacks that call themselves so, and small stacks across the main one. Two
/// stacks of similar size are a problem.
void drop_localizers(DicomSeries& series) {
  auto& stacks = series.stacks;
  const bool any_slices = std::any_of(stacks.begin(), stacks.end(),
                                      [](const DicomStack& s) { return !s.front().localizer; });
  if (any_slices) {
    std::erase_if(stacks, [](const DicomStack& s) { return s.front().localizer; });
  }
  std::stable_sort(stacks.begin(), stacks.end(),
                   [](const DicomStack& a, const DicomStack& b) { return a.size() > b.size(); });
  if (stacks.size() < 2 || !series.problem.empty()) return;
  const DicomStack& main = stacks[0];
  const DicomStack& other = stacks[1];
  if (main.size() < 2 || (other.size() > 1 && other.size() * kLocalizerShare > main.size())) {
    const bool turned = !close(main[0].along_row, other[0].along_row) ||
                        !close(main[0].along_column, other[0].along_column);
    series.problem = message(
        main[0].file.parent_path().string(), ": expected one stack of slices, ", "found ",
        main.size(), " slices like ", name_of(main[0]), " and ", other.size(), " like ",
        name_of(other[0]), " of another ", turned ? "orientation" : "size or pixel spacing");
    return;
  }
  series.warnings.push_back(message(series.frames - main.size(),
                                    " slices left out that do not lie ",
                                    "along the stack (localizers)"));
  stacks.resize(1);
}

bool is_volume(const DicomSeries& series) {
  return series.frames >= 2 && !series.stacks.empty() && series.stacks[0].size() >= 2;
}

std::string title(const DicomSeries& s) {
  return message(in_quotes(s.uid, kLongestUid), " (", s.modality.empty() ? "?" : s.modality, ", ",
                 s.description.empty() ? "no description" : s.description, ", ", s.frames,
                 " slices)");
}

std::string titles(const std::vector<DicomSeries>& all, bool volumes_only) {
  constexpr std::size_t kMostListed = 20;
  std::string list;
  std::size_t listed = 0;
  for (const DicomSeries& series : all) {
    if (volumes_only && !is_volume(series)) continue;
    if (++listed > kMostListed) return list + "; and more";
    list += (list.empty() ? "" : "; ") + title(series);
  }
  return list;
}

}  // namespace

std::vector<DicomSeries> group_by_series(const std::vector<DicomImage>& images) {
  std::vector<DicomSeries> all;
  std::map<std::string, std::size_t> index;
  const Copies copies(images);
  for (const DicomImage& image : images) {
    if (!image.has_pixels || copies.left_out(image)) continue;
    const auto [entry, is_new] = index.emplace(image.series, all.size());
    if (is_new) all.push_back({image.series, "", "", "", {}, 0, "", {}});
    add_image(all[entry->second], image);
  }
  for (DicomSeries& series : all) {
    copies.warn(series);
    drop_localizers(series);
    check_places(series);
    check_rescale(series);
  }
  return all;
}

std::string titles_of(const std::vector<DicomSeries>& all) { return titles(all, false); }

const DicomSeries& choose_series(const std::filesystem::path& path,
                                 const std::vector<DicomSeries>& all, const std::string& uid) {
  if (all.empty()) refuse(path, "expected DICOM images, found none");
  if (!uid.empty()) {
    const auto named =
        std::find_if(all.begin(), all.end(), [&uid](const DicomSeries& s) { return s.uid == uid; });
    if (named != all.end()) return *named;
    refuse(path,
           "expected the series " + in_quotes(uid, kLongestUid) + ", found " + titles_of(all));
  }
  if (all.size() == 1) return all[0];
  const auto volumes = std::count_if(all.begin(), all.end(), is_volume);
  if (volumes == 1) return *std::find_if(all.begin(), all.end(), is_volume);
  refuse(path,
         message("expected one series of slices, found ", volumes, ": ", titles(all, volumes > 1)));
}

}  // namespace mesamis::detail::volume_files
