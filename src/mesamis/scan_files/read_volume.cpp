// SPDX-License-Identifier: Apache-2.0
#include "mesamis/scan_files/read_volume.h"

#include <algorithm>
#include <array>
#include <string_view>
#include <utility>

#include "mesamis/base/error.h"
#include "mesamis/files/file_list.h"
#include "mesamis/files/given_spacing.h"
#include "mesamis/files/in_one_line.h"
#include "mesamis/files/refuse.h"
#include "mesamis/scan_files/formats.h"
#include "mesamis/scan_files/sidecar.h"
#include "mesamis/scan_files/slice_stack.h"

namespace mesamis {
namespace {

namespace fs = std::filesystem;
using detail::in_one_line;
using detail::MemoryBudget;
using detail::Opening;
using detail::OpenSlices;
using detail::refuse;
using detail::refuse_unknown;
using detail::ScanFile;

/// A format of plain arrays and the ends of its files' names.
struct ArrayFormat {
  std::string_view extension;
  ScanFile (*open)(const fs::path&, const Opening&);
};

constexpr std::array<ArrayFormat, 7> kArrayFormats{{{".nii", detail::open_nifti},
                                                    {".nii.gz", detail::open_nifti},
                                                    {".nrrd", detail::open_nrrd},
                                                    {".nhdr", detail::open_nrrd},
                                                    {".mha", detail::open_meta},
                                                    {".mhd", detail::open_meta},
                                                    {".inv3", detail::open_inv3}}};

const ArrayFormat* array_format_of(const fs::path& file) {
  const std::string name = detail::lower(file.filename().string());
  for (const ArrayFormat& format : kArrayFormats) {
    if (name.ends_with(format.extension)) return &format;
  }
  return nullptr;
}

/// A format of pictures.
struct PictureFormat {
  std::string_view extension;
  ScanFile (*open)(const fs::path&, const Opening&);
  VolumeFile (*read)(const fs::path&, const Opening&);
  OpenSlices (*slices)(const fs::path&, const Opening&);
};

/// A picture that holds one slice.
OpenSlices open_one_slice(const fs::path& file, const Opening& opening) {
  return {detail::open_picture(file, opening), detail::read_pictures({file})};
}

constexpr std::array<PictureFormat, 4> kPictureFormats{
    {{".tif", detail::open_tiff_header, detail::read_tiff, detail::open_tiff_slices},
     {".tiff", detail::open_tiff_header, detail::read_tiff, detail::open_tiff_slices},
     {".png", detail::open_png, detail::read_png, open_one_slice},
     {".bmp", detail::open_bmp, detail::read_bmp, open_one_slice}}};

const PictureFormat* picture_format_of(const fs::path& file) {
  const std::string extension = detail::lower(file.extension().string());
  for (const PictureFormat& format : kPictureFormats) {
    if (extension == format.extension) return &format;
  }
  return nullptr;
}

bool has_known_extension(const fs::path& file) {
  return array_format_of(file) || detail::is_picture(file);
}

/// A path, and what it is read with.
struct Request {
  const fs::path& path;
  const ReadOptions& options;
  MemoryBudget& budget;

  Opening opening() const { return detail::opening_of(options, budget); }
};

VolumeFile read_array(const Request& request, const ScanFile& scan) {
  detail::announce(scan.grid, request.options);
  VolumeFile out{scan.grid, scan.format, scan.warnings};
  out.volume.samples = detail::read_samples(scan, request.budget);
  return out;
}

VolumeFile read_one_picture(const Request& request) {
  detail::announce(detail::open_picture(request.path, request.opening()).grid, request.options);
  return detail::read_picture(request.path, request.opening());
}

VolumeFile read_directory(const Request& request) {
  const auto& [path, options, budget] = request;
  const std::vector<fs::path> slices = detail::slices_without_dicom(path, budget);
  return slices.empty() ? detail::read_dicom(path, options, budget)
                        : detail::read_slices(path, slices, options, budget);
}

VolumeFile read_file(const Request& request) {
  const auto& [path, options, budget] = request;
  if (options.raw) return read_array(request, detail::open_raw(path, *options.raw));
  if (fs::is_directory(path)) return read_directory(request);
  if (const auto scan = detail::open_array(path, request.opening())) {
    return read_array(request, *scan);
  }
  if (detail::is_picture(path)) return read_one_picture(request);
  if (detail::looks_like_dicom(path)) return detail::read_dicom(path, options, budget);
  refuse_unknown(path);
}

/// The header of a file with a known name, or of a raw one.
ScanFile open_header(const Request& request) {
  const fs::path& file = request.path;
  if (request.options.raw) return detail::open_raw(file, *request.options.raw);
  return detail::is_picture(file) ? detail::open_picture(file, request.opening())
                                  : *detail::open_array(file, request.opening());
}

VolumeInfo describe(const Request& request) {
  const detail::ScopedFile scope(request.budget, request.path);
  VolumeInfo info;
  info.description = request.path.filename().string();
  try {
    const ScanFile scan = open_header(request);
    info.format = scan.format;
    info.modality = scan.grid.modality;
    detail::set_grid(info, scan.grid);
  } catch (const InputError& error) {
    info.problem = error.what();
  }
  return info;
}

/// DICOM series, or slices, then the other volumes.
std::vector<VolumeInfo> list_directory(const Request& request) {
  const auto& [path, options, budget] = request;
  const std::vector<fs::path> slices = detail::slices_without_dicom(path, budget);
  std::vector<VolumeInfo> all =
      slices.empty() ? detail::list_dicom(path, options, budget)
                     : std::vector{detail::describe_slices(path, slices, request.opening())};
  for (const fs::path& file : detail::files_in(path)) {
    const bool slice = std::find(slices.begin(), slices.end(), file) != slices.end();
    if (has_known_extension(file) && !slice) all.push_back(describe({file, options, budget}));
  }
  if (all.empty()) refuse(path, "expected DICOM series, slices or volume files, found none");
  return all;
}

std::vector<VolumeInfo> list(const Request& request) {
  const auto& [path, options, budget] = request;
  if (fs::is_directory(path) && !options.raw) return list_directory(request);
  if (options.raw || has_known_extension(path)) return {describe(request)};
  if (detail::looks_like_dicom(path)) return detail::list_dicom(path, options, budget);
  refuse_unknown(path);
}

/// Thrown through a reader that has told the grid: the samples are not wanted.
struct GridFound {
  VoxelGrid grid;
};

}  // namespace

std::optional<ScanFile> detail::open_array(const fs::path& file, const Opening& opening) {
  const ArrayFormat* format = array_format_of(file);
  if (format == nullptr) return std::nullopt;
  ScanFile scan = format->open(file, opening);
  if (scan.grid.modality.empty()) {
    scan.grid.modality = modality_in_sidecar(file, opening.budget, scan.warnings);
  }
  return scan;
}

detail::Opening detail::opening_of(const ReadOptions& options, MemoryBudget& budget) {
  return {budget,
          options.limits.allow_outside,
          Values::kOne,
          options.spacing,
          {options.volume, options.channel}};
}

void detail::announce(VoxelGrid grid, const ReadOptions& options) {
  grid.spacing = options.spacing.value_or(grid.spacing);
  if (!options.modality.empty()) grid.modality = options.modality;
  if (options.on_grid) options.on_grid(grid);
}

void detail::refuse_unknown(const fs::path& file) {
  refuse(
      file,
      "expected .nii .nii.gz .nrrd .nhdr .mha .mhd .tif .png .bmp .inv3, DICOM, or --raw with the "
      "layout of a raw file, found none of them");
}

void detail::require_options(const fs::path& path, const ReadOptions& options) {
  if (options.spacing) require_positive_spacing(path, *options.spacing);
  const std::string& modality = options.modality;
  if (modality.empty() || modality == "CT" || modality == "MR" || modality == "other") return;
  refuse(path, "expected the modality CT, MR or other, found " + in_quotes(modality));
}

void detail::apply_options(const ReadOptions& options, VolumeFile& file) {
  if (!options.modality.empty()) file.volume.modality = options.modality;
  if (!options.spacing) return;
  const auto assumed = std::erase_if(file.warnings, [](const std::string& warning) {
    return warning.find(": 1 mm taken") != std::string::npos;
  });
  const Vec3 stated = std::exchange(file.volume.spacing, *options.spacing);
  if (assumed == 0 && stated != *options.spacing) {
    file.warnings.push_back(spacing_is_replaced(stated));
  }
}

bool detail::is_picture(const fs::path& file) { return picture_format_of(file) != nullptr; }

VolumeFile detail::read_picture(const fs::path& file, const Opening& opening) {
  return picture_format_of(file)->read(file, opening);
}

ScanFile detail::open_picture(const fs::path& file, const Opening& opening) {
  const ScopedFile scope(opening.budget, file);
  return picture_format_of(file)->open(file, opening);
}

detail::OpenSlices detail::open_picture_slices(const fs::path& file, const Opening& opening) {
  const ScopedFile scope(opening.budget, file);
  return picture_format_of(file)->slices(file, opening);
}

void detail::set_grid(VolumeInfo& info, const VoxelGrid& grid) {
  info.size = grid.size;
  info.spacing = grid.spacing;
  info.origin = grid.origin;
  info.direction = grid.direction;
}

VolumeFile read_volume(const fs::path& path, const ReadOptions& options) {
  MemoryBudget budget(path, options.limits);
  const ReadRecord record;
  return in_one_line(path, [&] {
    detail::require_options(path, options);
    VolumeFile file = read_file({path, options, budget});
    detail::apply_options(options, file);
    file.files = record.files();
    return file;
  });
}

VoxelGrid read_grid(const fs::path& path, const ReadOptions& options) {
  ReadOptions headers = options;
  headers.on_grid = [](const VoxelGrid& grid) { throw GridFound{grid}; };
  try {
    return read_volume(path, headers).volume;
  } catch (const GridFound& found) {
    return found.grid;
  }
}

std::vector<VolumeInfo> list_volumes(const fs::path& path, const ReadOptions& options) {
  MemoryBudget budget(path, options.limits);
  std::vector<VolumeInfo> all = in_one_line(path, [&] { return list({path, options, budget}); });
  for (VolumeInfo& info : all) {
    info.spacing = options.spacing.value_or(info.spacing);
    if (!options.modality.empty()) info.modality = options.modality;
  }
  return all;
}

}  // namespace mesamis
