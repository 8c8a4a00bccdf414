// SPDX-License-Identifier: Apache-2.0
#include "scan.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <limits>
#include <string>

#include "arguments.h"
#include "log.h"
#include "mesamis/base/error.h"
#include "mesamis/files/read_record.h"
#include "mesamis/image/not_numbers.h"
#include "mesamis/volume_files/chunked_scan.h"
#include "mesamis/volume_files/rounding_record.h"
#include "ranges.h"

namespace mesamis {
namespace {

/// A scan in chunks, as scans in other files are told of.
class ChunkSlices : public FileSlices {
 public:
  ChunkSlices(std::unique_ptr<ChunkedScan> scan, std::vector<ReadFile> files,
              const std::string& modality)
      : scan_(std::move(scan)) {
    static_cast<VoxelGrid&>(head_.volume) = scan_->grid();
    head_.volume.modality = modality;
    head_.format = scan_->format();
    head_.warnings = scan_->warnings();
    head_.files = std::move(files);
  }
  const VoxelGrid& grid() const override { return head_.volume; }
  const VolumeFile& head() const override { return head_; }
  std::vector<float> read(Index first, Index count) const override {
    return scan_->read(first, count);
  }

 private:
  std::unique_ptr<ChunkedScan> scan_;
  VolumeFile head_;
};

/// A scan in chunks; none if it is another one.
std::unique_ptr<FileSlices> open_chunks(const std::filesystem::path& path,
                                        const ReadOptions& options) {
  if (options.raw || !(is_zarr(path) || is_hdf5(path))) return nullptr;
  const ReadRecord record;
  const ChunkOptions chunks{.limits = options.limits,
                            .spacing = options.spacing,
                            .volume = options.volume,
                            .channel = options.channel};
  auto scan = is_zarr(path) ? open_zarr(path, chunks) : open_hdf5(path, chunks);
  auto slices = std::make_unique<ChunkSlices>(std::move(scan), record.files(), options.modality);
  if (options.on_grid) options.on_grid(slices->grid());
  return slices;
}

}  // namespace

std::unique_ptr<FileSlices> open_any_slices(const std::filesystem::path& path,
                                            const ReadOptions& options) {
  auto scan = open_chunks(path, options);
  return scan ? std::move(scan) : open_slices(path, options);
}

VolumeFile read_any_volume(const std::filesystem::path& path, const ReadOptions& options) {
  const ReadRecord record;
  const RoundingRecord rounded;
  const auto scan = open_chunks(path, options);
  if (!scan) return read_volume(path, options);
  VolumeFile file = scan->head();
  file.volume.samples = scan->read(0, file.volume.size[2]);
  rounded.warn(path, file.warnings);
  const std::vector<ReadFile> chunks = record.files();
  file.files.insert(file.files.end(), chunks.begin(), chunks.end());
  std::sort(file.files.begin(), file.files.end(),
            [](const ReadFile& a, const ReadFile& b) { return a.path < b.path; });
  return file;
}

VoxelGrid read_any_grid(const std::filesystem::path& path, const ReadOptions& options) {
  const auto scan = open_chunks(path, options);
  return scan ? scan->grid() : read_grid(path, options);
}

std::vector<VolumeInfo> list_any_volumes(const std::filesystem::path& path,
                                         const ReadOptions& options) {
  if (options.raw || !(is_zarr(path) || is_hdf5(path))) return list_volumes(path, options);
  VolumeInfo info;
  info.description = path.filename().string();
  info.format = is_zarr(path) ? "Zarr" : "HDF5";
  try {
    const auto scan = open_chunks(path, options);
    const VoxelGrid& grid = scan->grid();
    info.format = scan->head().format;
    info.size = grid.size;
    info.spacing = grid.spacing;
    info.origin = grid.origin;
    info.direction = grid.direction;
    info.warnings = scan->head().warnings;
  } catch (const InputError& error) {
    info.problem = error.what();
  }
  return {info};
}

void add_modality_option(CLI::App& command, ReadOptions& options) {
  command
      .add_option("--modality", options.modality,
                  "Modality, if the file states none or a wrong one: CT, MR, other")
      ->check(CLI::IsMember(kModalities, CLI::ignore_case));
}

void add_read_options(CLI::App& command, ReadOptions& options) {
  command.add_option("--series", options.series, "DICOM series UID")->type_name("UID");
  command
      .add_option_function<std::string>(
          "--raw",
          [&options](const std::string& text) {
            options.raw = parsed("--raw", [&] { return parse_raw_layout(text); });
          },
          "NX,NY,NZ,TYPE[,HEADERBYTES]: the input is a raw file; TYPE uint8 int16 uint16 int32 "
          "float32 "
          "float64, followed by be if big endian")
      ->type_name("LAYOUT");
  command
      .add_option_function<std::string>(
          "--spacing",
          [&options](const std::string& text) {
            const auto mm = parse_numbers(text, 3, "--spacing");
            if (std::any_of(mm.begin(), mm.end(), [](double x) { return !(x > 0); })) {
              throw CLI::ValidationError("--spacing",
                                         "expected numbers above 0, found '" + text + "'");
            }
            options.spacing = Vec3{mm[0], mm[1], mm[2]};
          },
          "X,Y,Z: distance of voxels, mm, for raw files, slices and files that state none or a "
          "wrong one")
      ->type_name("X,Y,Z");
  command.add_flag(
      "--resample", options.resample,
      "Interpolate DICOM slices of a tilted gantry or at uneven distances, and sheared "
      "grids of NIfTI, NRRD and MetaImage, onto a regular grid, instead of refusing "
      "them");
  const CLI::Validator whole = from_to(0, std::numeric_limits<Index>::max());
  command
      .add_option("--volume", options.volume,
                  "N, from 0: which volume of a 4-D file, time of a hyperstack or phase of a DICOM "
                  "series; info lists them")
      ->check(whole);
  command.add_option("--channel", options.channel, "N, from 0: which of several values per voxel")
      ->check(whole);
  add_modality_option(command, options);
}

void require_no_read_options(const std::filesystem::path& path, const ReadOptions& options) {
  if (!options.spacing && !options.resample && !options.volume && !options.channel &&
      options.series.empty() && options.modality.empty()) {
    return;
  }
  throw InputError(path.string() +
                   ": --series, --spacing, --resample, --volume, --channel and --modality are for "
                   "volumes");
}

VolumeFile read_scan(const std::filesystem::path& path, const ReadOptions& options) {
  VolumeFile file = read_any_volume(path, options);
  if (const NotNumbers nan = fill_not_numbers(file.volume.samples); nan.voxels > 0) {
    file.warnings.push_back(
        fmt::format("{} voxels are NaN and count as background, {}", nan.voxels, nan.filled));
  }
  for (const std::string& warning : file.warnings) log_warning(warning);
  try {
    require_usable(file.volume);
  } catch (const InputError& error) {
    throw InputError(path.string() + ": " + error.what());
  }
  return file;
}

}  // namespace mesamis
