// SPDX-License-Identifier: Apache-2.0
#include "mesamis/scan_files/read_volume.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>
#include <utility>

#include "mesamis/base/error.h"
#include "mesamis/files/file_list.h"
#include "mesamis/files/in_one_line.h"
#include "mesamis/files/refuse.h"
#include "mesamis/scan_files/formats.h"
#include "mesamis/scan_files/slice_stack.h"

namespace mesamis {
namespace {

namespace fs = std::filesystem;
using detail::in_one_line;
using detail::refuse;
using detail::ScanFile;
using detail::Values;

/// A format of plain arrays and the ends of its files' names.
struct ArrayFormat {
  std::string_view extension;
  ScanFile (*open)(const fs::path&, Values);
};

ScanFile open_one_meta(const fs::path& file, Values) { return detail::open_meta(file); }
ScanFile open_one_inv3(const fs::path& file, Values) { return detail::open_inv3(file); }

constexpr std::array<ArrayFormat, 7> kArrayFormats{{{".nii", detail::open_nifti},
                                                    {".nii.gz", detail::open_nifti},
                                                    {".nrrd", detail::open_nrrd},
                                                    {".nhdr", detail::open_nrrd},
                                                    {".mha", open_one_meta},
                                                    {".mhd", open_one_meta},
                                                    {".inv3", open_one_inv3}}};

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
  ScanFile (*open)(const fs::path&);
  VolumeFile (*read)(const fs::path&);
};

constexpr std::array<PictureFormat, 4> kPictureFormats{
    {{".tif", detail::open_tiff_header, detail::read_tiff},
     {".tiff", detail::open_tiff_header, detail::read_tiff},
     {".png", detail::open_png, detail::read_png},
     {".bmp", detail::open_bmp, detail::read_bmp}}};

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

[[noreturn]] void refuse_unknown(const fs::path& file) {
  refuse(
      file,
      "expected .nii .nii.gz .nrrd .nhdr .mha .mhd .tif .png .bmp .inv3, DICOM, or --raw with the "
      "layout of a raw file, found none of them");
}

VolumeFile read_array(const ScanFile& scan) {
  VolumeFile out{scan.grid, scan.format, scan.warnings};
  out.volume.samples = detail::read_samples(scan);
  return out;
}

bool holds_dicom(const fs::path& directory) {
  const std::vector<fs::path> files = detail::files_below(directory);
  return std::any_of(files.begin(), files.end(), detail::looks_like_dicom);
}

/// The pictures of a directory that are its slices: none where there is DICOM.
std::vector<fs::path> slices_of(const fs::path& directory) {
  std::vector<fs::path> slices = detail::slices_in(directory);
  return slices.empty() || holds_dicom(directory) ? std::vector<fs::path>{} : slices;
}

VolumeFile read_directory(const fs::path& path, const ReadOptions& options) {
  const std::vector<fs::path> slices = slices_of(path);
  return slices.empty() ? detail::read_dicom(path, options) : detail::read_slices(path, slices);
}

VolumeFile read_file(const fs::path& path, const ReadOptions& options) {
  if (options.raw) return read_array(detail::open_raw(path, *options.raw));
  if (fs::is_directory(path)) return read_directory(path, options);
  if (const auto scan = detail::open_array(path)) return read_array(*scan);
  if (detail::is_picture(path)) return detail::read_picture(path);
  if (detail::looks_like_dicom(path)) return detail::read_dicom(path, options);
  refuse_unknown(path);
}

/// The header of a file with a known name, or of a raw one.
ScanFile open_header(const fs::path& file, const ReadOptions& options) {
  if (options.raw) return detail::open_raw(file, *options.raw);
  return detail::is_picture(file) ? detail::open_picture(file) : *detail::open_array(file);
}

VolumeInfo describe(const fs::path& file, const ReadOptions& options) {
  VolumeInfo info;
  info.description = file.filename().string();
  try {
    const ScanFile scan = open_header(file, options);
    info.format = scan.format;
    info.modality = scan.grid.modality;
    detail::set_grid(info, scan.grid);
  } catch (const InputError& error) {
    info.problem = error.what();
  }
  return info;
}

/// DICOM series, or slices, then the other volumes.
std::vector<VolumeInfo> list_directory(const fs::path& path, const ReadOptions& options) {
  const std::vector<fs::path> slices = slices_of(path);
  std::vector<VolumeInfo> all = slices.empty() ? detail::list_dicom(path, options)
                                               : std::vector{detail::describe_slices(path, slices)};
  for (const fs::path& file : detail::files_in(path)) {
    const bool slice = std::find(slices.begin(), slices.end(), file) != slices.end();
    if (has_known_extension(file) && !slice) all.push_back(describe(file, options));
  }
  if (all.empty()) refuse(path, "expected DICOM series, slices or volume files, found none");
  return all;
}

std::vector<VolumeInfo> list(const fs::path& path, const ReadOptions& options) {
  if (fs::is_directory(path) && !options.raw) return list_directory(path, options);
  if (options.raw || has_known_extension(path)) return {describe(path, options)};
  if (detail::looks_like_dicom(path)) return detail::list_dicom(path, options);
  refuse_unknown(path);
}

/// The spacing that was asked for takes the place of the file's, and of what was assumed.
void apply_spacing(const fs::path& path, const Vec3& spacing, VolumeFile& file) {
  for (int a = 0; a < 3; ++a) {
    if (spacing[a] > 0 && std::isfinite(spacing[a])) continue;
    refuse(path, detail::say("expected a positive spacing, found ", spacing[a], " mm"));
  }
  const auto assumed = std::erase_if(file.warnings, [](const std::string& warning) {
    return warning.find(": 1 mm taken") != std::string::npos;
  });
  const Vec3 stated = std::exchange(file.volume.spacing, spacing);
  if (assumed == 0 && stated != spacing) {
    file.warnings.push_back(detail::say("the file's spacing, ", stated.x, " x ", stated.y, " x ",
                                        stated.z, " mm, is replaced by the one given"));
  }
}

}  // namespace

std::optional<ScanFile> detail::open_array(const fs::path& file, Values values) {
  const ArrayFormat* format = array_format_of(file);
  return format ? std::optional(format->open(file, values)) : std::nullopt;
}

bool detail::is_picture(const fs::path& file) { return picture_format_of(file) != nullptr; }

VolumeFile detail::read_picture(const fs::path& file) {
  return picture_format_of(file)->read(file);
}

ScanFile detail::open_picture(const fs::path& file) { return picture_format_of(file)->open(file); }

void detail::set_grid(VolumeInfo& info, const VoxelGrid& grid) {
  info.size = grid.size;
  info.spacing = grid.spacing;
  info.origin = grid.origin;
  info.direction = grid.direction;
}

VolumeFile read_volume(const fs::path& path, const ReadOptions& options) {
  return in_one_line(path, [&] {
    VolumeFile file = read_file(path, options);
    if (options.spacing) apply_spacing(path, *options.spacing, file);
    return file;
  });
}

std::vector<VolumeInfo> list_volumes(const fs::path& path, const ReadOptions& options) {
  std::vector<VolumeInfo> all = in_one_line(path, [&] { return list(path, options); });
  for (VolumeInfo& info : all) info.spacing = options.spacing.value_or(info.spacing);
  return all;
}

}  // namespace mesamis
