// SPDX-License-Identifier: Apache-2.0
#include "mesamis/scan_files/read_volume.h"

#include <array>
#include <string_view>

#include "mesamis/base/error.h"
#include "mesamis/files/file_list.h"
#include "mesamis/files/in_one_line.h"
#include "mesamis/files/refuse.h"
#include "mesamis/scan_files/formats.h"

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

bool is_tiff(const fs::path& file) {
  const std::string extension = detail::lower(file.extension().string());
  return extension == ".tif" || extension == ".tiff";
}

bool has_known_extension(const fs::path& file) { return array_format_of(file) || is_tiff(file); }

[[noreturn]] void refuse_unknown(const fs::path& file) {
  refuse(file,
         "expected .nii .nii.gz .nrrd .nhdr .mha .mhd .tif .inv3 or DICOM, found none of "
         "them");
}

VolumeFile read_array(const ScanFile& scan) {
  VolumeFile out{scan.grid, scan.format, scan.warnings};
  out.volume.samples = detail::read_samples(scan);
  return out;
}

VolumeFile read_file(const fs::path& path, const ReadOptions& options) {
  if (fs::is_directory(path)) return detail::read_dicom(path, options.series);
  if (const auto scan = detail::open_array(path)) return read_array(*scan);
  if (is_tiff(path)) return detail::read_tiff(path);
  if (detail::looks_like_dicom(path)) return detail::read_dicom(path, options.series);
  refuse_unknown(path);
}

VolumeInfo describe(const fs::path& file) {
  VolumeInfo info;
  info.description = file.filename().string();
  try {
    if (is_tiff(file)) return detail::describe_tiff(file);
    const ScanFile scan = *detail::open_array(file);
    info.format = scan.format;
    info.modality = scan.grid.modality;
    info.size = scan.grid.size;
    info.spacing = scan.grid.spacing;
    info.origin = scan.grid.origin;
    info.direction = scan.grid.direction;
  } catch (const InputError& error) {
    info.problem = error.what();
  }
  return info;
}

std::vector<VolumeInfo> list(const fs::path& path) {
  if (!fs::is_directory(path)) {
    if (has_known_extension(path)) return {describe(path)};
    if (detail::looks_like_dicom(path)) return detail::list_dicom(path);
    refuse_unknown(path);
  }
  std::vector<VolumeInfo> all = detail::list_dicom(path);
  for (const fs::path& file : detail::files_in(path)) {
    if (has_known_extension(file)) all.push_back(describe(file));
  }
  if (all.empty()) refuse(path, "expected DICOM series or volume files, found none");
  return all;
}

}  // namespace

std::optional<ScanFile> detail::open_array(const fs::path& file, Values values) {
  const ArrayFormat* format = array_format_of(file);
  return format ? std::optional(format->open(file, values)) : std::nullopt;
}

VolumeFile read_volume(const fs::path& path, const ReadOptions& options) {
  return in_one_line(path, [&] { return read_file(path, options); });
}

std::vector<VolumeInfo> list_volumes(const fs::path& path) {
  return in_one_line(path, [&] { return list(path); });
}

}  // namespace mesamis
