// SPDX-License-Identifier: Apache-2.0
#include "mesamis/volume_files/open_slices.h"

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "mesamis/files/in_one_line.h"
#include "mesamis/files/memory_budget.h"
#include "mesamis/files/read_record.h"
#include "mesamis/files/refuse.h"
#include "mesamis/volume_files/formats.h"
#include "mesamis/volume_files/slice_stack.h"

namespace mesamis::detail::volume_files {
namespace {

namespace fs = std::filesystem;

OpenSlices open_plain(ScanFile scan) {
  if (scan.sheared) {
    refuse(scan.file,
           "expected orthogonal axes, which can be read a slice at a time, found sheared ones; run "
           "without --slabs");
  }
  const std::uint64_t begin = find_plain_samples(scan);
  return {scan, [scan, begin](const SliceRange& slices, MemoryBudget&, std::vector<float>& out) {
            append_slices(scan, begin, slices, out);
          }};
}

[[noreturn]] void refuse_dicom(const fs::path& path) {
  refuse(path,
         "expected a scan that can be read a slice at a time, such as .nii or a folder of .tif, "
         "found DICOM; convert it, or run without --slabs");
}

OpenSlices open_directory(const fs::path& directory, const Opening& opening) {
  const std::vector<fs::path> slices = slices_without_dicom(directory, opening.budget);
  if (!slices.empty()) return open_stack(directory, slices, opening);
  const std::vector<fs::path> files = files_below(directory);
  if (std::any_of(files.begin(), files.end(), looks_like_dicom)) refuse_dicom(directory);
  refuse(directory, "expected slices as .tif, .png or .bmp, one per file, found none");
}

OpenSlices open_any(const fs::path& path, const ReadOptions& options, MemoryBudget& budget) {
  if (options.raw) return open_plain(open_raw(path, *options.raw));
  const Opening opening = opening_of(options, budget);
  if (fs::is_directory(path)) return open_directory(path, opening);
  if (auto scan = open_array(path, opening)) {
    return open_plain(std::move(*scan));
  }
  if (is_picture(path)) return open_picture_slices(path, opening);
  if (looks_like_dicom(path)) refuse_dicom(path);
  refuse_unknown(path);
}

class OpenedSlices final : public FileSlices {
 public:
  OpenedSlices(fs::path path, const ReadLimits& limits, VolumeFile head, SliceReader reader)
      : path_(std::move(path)),
        limits_(limits),
        head_(std::move(head)),
        reader_(std::move(reader)) {}

  const VoxelGrid& grid() const override { return head_.volume; }
  const VolumeFile& head() const override { return head_; }
  std::vector<float> read(Index first, Index count) const override {
    return in_one_line(path_, [&] { return read_checked({first, count}); });
  }

 private:
  std::vector<float> read_checked(const SliceRange& slices) const;
  void require_same(const ReadFile& opened) const;

  fs::path path_;
  ReadLimits limits_;
  VolumeFile head_;
  SliceReader reader_;
};

std::vector<float> OpenedSlices::read_checked(const SliceRange& slices) const {
  const Index all = grid().size[2];
  if (slices.first < 0 || slices.count < 1 || slices.count > all - slices.first) {
    refuse(path_, message("expected slices within ", all, ", found ", slices.count, " from ",
                          slices.first, " on"));
  }
  MemoryBudget budget(path_, limits_);
  const ReadRecord record;
  std::vector<float> samples;
  reserve_within(budget, samples, grid().offset(0, 0, slices.count), "samples");
  reader_(slices, budget, samples);
  for (const ReadFile& file : record.files()) require_same(file);
  return samples;
}

/// A file whose slices were read is the one whose header was read, and still is.
void OpenedSlices::require_same(const ReadFile& opened) const {
  const auto known =
      std::lower_bound(head_.files.begin(), head_.files.end(), opened.path,
                       [](const ReadFile& file, const fs::path& path) { return file.path < path; });
  if (known != head_.files.end() && known->path == opened.path) require_unchanged(*known);
}

}  // namespace

std::unique_ptr<FileSlices> open_slices(const fs::path& path, const ReadOptions& options) {
  MemoryBudget budget(path, options.limits);
  const ReadRecord record;
  return in_one_line(path, [&] {
    require_options(path, options);
    OpenSlices slices = open_any(path, options, budget);
    announce(slices.scan.grid, options);
    VolumeFile head{slices.scan.grid, slices.scan.format, slices.scan.warnings};
    apply_options(options, head);
    head.files = record.files();
    return std::make_unique<OpenedSlices>(path, options.limits, std::move(head),
                                          std::move(slices.read));
  });
}

}  // namespace mesamis::detail::volume_files
