// SPDX-License-Identifier: Apache-2.0
#include "mesamis/scan_files/read_volume.h"

#include <array>
#include <new>
#include <string_view>
#include <system_error>

#include "mesamis/base/error.h"
#include "mesamis/files/file_list.h"
#include "mesamis/files/refuse.h"
#include "mesamis/scan_files/formats.h"

namespace mesamis {
namespace {

namespace fs = std::filesystem;
using detail::refuse;
using detail::ScanFile;

/// A format of plain arrays and the ends of its files' names.
struct ArrayFormat {
  std::string_view extension;
  ScanFile (*open)(const fs::path&);
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

bool is_tiff(const fs::path& file) {
  const std::string extension = detail::lower(file.extension().string());
  return extension == ".tif" || extension == ".tiff";
}

bool has_known_extension(const fs::path& file) { return array_format_of(file) || is_tiff(file); }

void require_there(const fs::path& path) {
  std::error_code error;
  const auto status = fs::status(path, error);
  if (!fs::exists(status)) refuse(path, "no such file or directory");
  if (!fs::is_directory(status) && !fs::is_regular_file(status)) {
    refuse(path, "expected a file or a directory, found neither");
  }
}

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
  if (const ArrayFormat* format = array_format_of(path)) return read_array(format->open(path));
  if (is_tiff(path)) return detail::read_tiff(path);
  if (detail::looks_like_dicom(path)) return detail::read_dicom(path, options.series);
  refuse_unknown(path);
}

VolumeInfo describe(const fs::path& file) {
  VolumeInfo info;
  info.description = file.filename().string();
  try {
    if (is_tiff(file)) return detail::describe_tiff(file);
    const ScanFile scan = array_format_of(file)->open(file);
    info.format = scan.format;
    info.modality = scan.grid.modality;
    info.size = scan.grid.size;
    info.spacing = scan.grid.spacing;
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

/// Runs `work`. Every failure becomes an InputError of one line that begins with the path and names
/// the broken file, where that is another file of the series.
template <class Work>
auto in_one_line(const fs::path& path, Work&& work) {
  try {
    require_there(path);
    return work();
  } catch (const InputError& error) {
    if (std::string_view(error.what()).starts_with(path.string())) throw;
    refuse(path, error.what());
  } catch (const std::bad_alloc&) {
    refuse(path, "not enough memory to read it");
  } catch (const std::exception& error) {
    refuse(path, std::string("cannot be read: ") + error.what());
  }
}

}  // namespace

VolumeFile read_volume(const fs::path& path, const ReadOptions& options) {
  return in_one_line(path, [&] { return read_file(path, options); });
}

std::vector<VolumeInfo> list_volumes(const fs::path& path) {
  return in_one_line(path, [&] { return list(path); });
}

}  // namespace mesamis
