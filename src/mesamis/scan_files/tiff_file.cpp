// SPDX-License-Identifier: Apache-2.0
#include <tiffio.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <optional>

#include "mesamis/files/deflate.h"
#include "mesamis/files/file_list.h"
#include "mesamis/files/read_record.h"
#include "mesamis/files/refuse.h"
#include "mesamis/scan_files/formats.h"

namespace mesamis::detail {
namespace {

struct CloseTiff {
  void operator()(TIFF* tiff) const { TIFFClose(tiff); }
};
using TiffHandle = std::unique_ptr<TIFF, CloseTiff>;

int stay_silent(TIFF*, void*, const char*, const char*, va_list) { return 1; }

/// The largest buffer that the file can fill.
double allocation_bound(const std::filesystem::path& file) {
  return 1.0 * kMostDeflateRatio * static_cast<double>(size_of(file)) + (1 << 20);
}

/// Opens with message handlers and a memory bound of this handle alone; libtiff's global handlers
/// are not touched.
TiffHandle open(const std::filesystem::path& file, const MemoryBudget& budget) {
  TIFFOpenOptions* options = TIFFOpenOptionsAlloc();
  TIFFOpenOptionsSetErrorHandlerExtR(options, stay_silent, nullptr);
  TIFFOpenOptionsSetWarningHandlerExtR(options, stay_silent, nullptr);
  const double most = std::min(allocation_bound(file), static_cast<double>(budget.left()));
  TIFFOpenOptionsSetMaxSingleMemAlloc(options, static_cast<tmsize_t>(most) + 1);  // 0: no limit
  const FileState before = state_of(file);
  TiffHandle tiff(TIFFOpenExt(file.c_str(), "rm", options));
  TIFFOpenOptionsFree(options);
  if (!tiff) refuse(file, "expected a TIFF file, found none that can be read");
  note_read(file, before);
  return tiff;
}

/// Properties that all pages must share.
struct Page {
  std::uint32_t width = 0, height = 0;
  std::uint16_t bits = 1, channels = 1, format = SAMPLEFORMAT_UINT, photometric = 0;
  friend bool operator==(const Page&, const Page&) = default;
};

Page page_of(TIFF* tiff) {
  Page page;
  TIFFGetField(tiff, TIFFTAG_IMAGEWIDTH, &page.width);
  TIFFGetField(tiff, TIFFTAG_IMAGELENGTH, &page.height);
  TIFFGetFieldDefaulted(tiff, TIFFTAG_BITSPERSAMPLE, &page.bits);
  TIFFGetFieldDefaulted(tiff, TIFFTAG_SAMPLESPERPIXEL, &page.channels);
  TIFFGetFieldDefaulted(tiff, TIFFTAG_SAMPLEFORMAT, &page.format);
  TIFFGetField(tiff, TIFFTAG_PHOTOMETRIC, &page.photometric);
  return page;
}

bool is_thumbnail(TIFF* tiff) {
  std::uint32_t kind = 0;
  TIFFGetField(tiff, TIFFTAG_SUBFILETYPE, &kind);
  return (kind & FILETYPE_REDUCEDIMAGE) != 0;
}

std::optional<NumberType> sample_type(const Page& page) {
  const bool real = page.format == SAMPLEFORMAT_IEEEFP, sign = page.format == SAMPLEFORMAT_INT;
  if (!real && !sign && page.format != SAMPLEFORMAT_UINT) return std::nullopt;
  switch (page.bits) {
    case 8:
      if (real) return std::nullopt;
      return sign ? NumberType::kInt8 : NumberType::kUint8;
    case 16:
      if (real) return std::nullopt;
      return sign ? NumberType::kInt16 : NumberType::kUint16;
    case 32:
      return real ? NumberType::kFloat32 : sign ? NumberType::kInt32 : NumberType::kUint32;
    case 64:
      return real ? NumberType::kFloat64 : sign ? NumberType::kInt64 : NumberType::kUint64;
    default:
      return std::nullopt;
  }
}

NumberType require_grey(const std::filesystem::path& file, const Page& page) {
  const bool grey = page.channels == 1 && (page.photometric == PHOTOMETRIC_MINISBLACK ||
                                           page.photometric == PHOTOMETRIC_MINISWHITE);
  const auto type = sample_type(page);
  if (!grey || !type) {
    refuse(file, say("expected grey pages of 8, 16, 32 or 64 bits, found ", page.channels,
                     " channels of ", page.bits, " bits, sample format ", page.format,
                     ", photometric ", page.photometric));
  }
  return *type;
}

/// Calls visit() on each page that is a slice, in file order.
template <class Visit>
void for_each_slice(const std::filesystem::path& file, TIFF* tiff, Visit&& visit) {
  if (!TIFFSetDirectory(tiff, 0)) refuse(file, "page 0 is broken");
  if (!is_thumbnail(tiff)) visit();
  while (!TIFFLastDirectory(tiff)) {
    const auto next = TIFFCurrentDirectory(tiff) + 1;
    if (!TIFFReadDirectory(tiff)) refuse(file, say("page ", next, " is broken or cut off"));
    if (!is_thumbnail(tiff)) visit();
  }
}

/// Counts the slices and makes sure that they are alike.
std::int64_t count_slices(const std::filesystem::path& file, TIFF* tiff, Page& common) {
  std::int64_t slices = 0;
  for_each_slice(file, tiff, [&] {
    const Page page = page_of(tiff);
    if (slices++ == 0) common = page;
    if (page == common) return;
    refuse(file, say("expected pages of one size and type (", common.width, " x ", common.height,
                     ", ", common.bits, " bits), found page ", TIFFCurrentDirectory(tiff), " of ",
                     page.width, " x ", page.height, ", ", page.bits, " bits"));
  });
  return slices;
}

/// The number behind "key=" at the start of a line of ImageJ's description.
std::optional<double> described(const std::string& text, const std::string& key) {
  const auto at = ('\n' + text).find('\n' + key + '=');
  if (at == std::string::npos) return std::nullopt;
  const auto begin = at + key.size() + 1;
  double value = 0;
  const std::string line = text.substr(begin, text.find('\n', begin) - begin);
  return parse_number(trimmed(line), value) ? std::optional(value) : std::nullopt;
}

std::string description_of(TIFF* tiff) {
  char* text = nullptr;
  TIFFGetField(tiff, TIFFTAG_IMAGEDESCRIPTION, &text);
  return text ? text : "";
}

/// mm per resolution unit: ImageJ's unit, else that of the tag; 0 if it is none.
double unit_in_mm(TIFF* tiff, const std::string& description) {
  const bool image_j = description.starts_with("ImageJ");
  const auto says = [&description](const std::string& unit) {
    return (description + '\n').find("\nunit=" + unit + '\n') != std::string::npos;
  };
  if (image_j && says("mm")) return 1;
  if (image_j && says("cm")) return 10;
  if (image_j && (says("micron") || says("um") || says("\\u00B5m"))) return 0.001;
  std::uint16_t unit = RESUNIT_INCH;
  TIFFGetFieldDefaulted(tiff, TIFFTAG_RESOLUTIONUNIT, &unit);
  return unit == RESUNIT_INCH ? 25.4 : unit == RESUNIT_CENTIMETER ? 10 : 0;
}

Vec3 spacing_of(TIFF* tiff, std::vector<std::string>& warnings) {
  const std::string description = description_of(tiff);
  const double unit = unit_in_mm(tiff, description);
  float x = 0, y = 0;
  TIFFGetField(tiff, TIFFTAG_XRESOLUTION, &x);
  TIFFGetField(tiff, TIFFTAG_YRESOLUTION, &y);
  Vec3 spacing{1, 1, 1};
  if (unit > 0 && x > 0 && y > 0 && std::isfinite(x) && std::isfinite(y)) {
    spacing = {unit / static_cast<double>(x), unit / static_cast<double>(y), 1};
  } else {
    warnings.push_back("the file gives no resolution: 1 mm taken along x and y");
  }
  const auto between = described(description, "spacing");
  if (unit > 0 && between && *between > 0) {
    spacing.z = unit * *between;
  } else {
    warnings.push_back("the file gives no distance between slices: 1 mm taken");
  }
  return spacing;
}

[[noreturn]] void refuse_page(const std::filesystem::path& file, TIFF* tiff) {
  refuse(file, say("page ", TIFFCurrentDirectory(tiff), " is broken or cut off"));
}

/// Width and height of the tiles, checked against what the file can hold.
std::array<std::size_t, 2> tile_size(const std::filesystem::path& file, TIFF* tiff,
                                     std::size_t pixel) {
  std::uint32_t width = 0, height = 0;
  TIFFGetField(tiff, TIFFTAG_TILEWIDTH, &width);
  TIFFGetField(tiff, TIFFTAG_TILELENGTH, &height);
  const double wanted = 1.0 * width * height * static_cast<double>(pixel);
  if (wanted == 0 || wanted > allocation_bound(file) ||
      static_cast<double>(TIFFTileSize64(tiff)) != wanted) {
    refuse(file, say("expected tiles of a size the file can hold, found ", width, " x ", height));
  }
  return {width, height};
}

struct OpenTiff {
  ScanFile scan;
  TiffHandle tiff;
  Page page;
};

void read_tiles(const OpenTiff& in, std::vector<unsigned char>& out, MemoryBudget& budget) {
  const std::filesystem::path& file = in.scan.file;
  const Page& page = in.page;
  TIFF* tiff = in.tiff.get();
  const std::size_t pixel = page.bits / 8u, line = page.width * pixel;
  const auto [tile_width, tile_height] = tile_size(file, tiff, pixel);
  const ScopedClaim claim(budget, 2 * tile_width * tile_height, pixel, "a tile");  // and libtiff's
  std::vector<unsigned char> tile(tile_width * tile_height * pixel);
  for (std::size_t y = 0; y < page.height; y += tile_height) {
    for (std::size_t x = 0; x < page.width; x += tile_width) {
      if (TIFFReadTile(tiff, tile.data(), static_cast<std::uint32_t>(x),
                       static_cast<std::uint32_t>(y), 0, 0) < 0) {
        refuse_page(file, tiff);
      }
      const std::size_t bytes = std::min(tile_width, page.width - x) * pixel;
      for (std::size_t row = 0; row < std::min(tile_height, page.height - y); ++row) {
        std::copy_n(tile.data() + row * tile_width * pixel, bytes,
                    out.data() + (y + row) * line + x * pixel);
      }
    }
  }
}

void read_strips(const OpenTiff& in, std::vector<unsigned char>& out, MemoryBudget&) {
  const std::filesystem::path& file = in.scan.file;
  const Page& page = in.page;
  TIFF* tiff = in.tiff.get();
  const std::size_t line = std::size_t{page.width} * (page.bits / 8u);
  if (static_cast<std::size_t>(TIFFScanlineSize64(tiff)) != line) {
    refuse(file, say("page ", TIFFCurrentDirectory(tiff), ": expected lines of ", line, " bytes"));
  }
  for (std::uint32_t y = 0; y < page.height; ++y) {
    if (TIFFReadScanline(tiff, out.data() + y * line, y, 0) < 0) refuse_page(file, tiff);
  }
}

OpenTiff open_tiff(const std::filesystem::path& file, const MemoryBudget& budget) {
  OpenTiff open_file;
  open_file.tiff = open(file, budget);
  ScanFile& scan = open_file.scan;
  scan.file = file;
  scan.format = "TIFF";
  TIFF* tiff = open_file.tiff.get();
  const Vec3 spacing = spacing_of(tiff, scan.warnings);
  const std::int64_t slices = count_slices(file, tiff, open_file.page);
  const Page& page = open_file.page;
  scan.source.type = require_grey(file, page);
  set_size(scan, {page.width, page.height, slices});
  set_axes(scan, {Vec3{spacing.x, 0, 0}, Vec3{0, spacing.y, 0}, Vec3{0, 0, spacing.z}});
  if (page.photometric == PHOTOMETRIC_MINISWHITE) {
    scan.warnings.push_back("small values are meant to be shown white; they are kept as stored");
  }
  const std::uint64_t needed = scan.grid.voxel_count() * byte_size(scan.source.type);
  if (static_cast<double>(needed) > allocation_bound(file)) {
    refuse(file, say("expected ", needed, " bytes of samples, found a file of ", size_of(file)));
  }
  return open_file;
}

}  // namespace

VolumeFile read_tiff(const std::filesystem::path& file, MemoryBudget& budget) {
  OpenTiff in = open_tiff(file, budget);
  VolumeFile out{std::move(in.scan.grid), in.scan.format, in.scan.warnings};
  const std::size_t pixels = std::size_t{in.page.width} * in.page.height;
  const ScopedClaim claim(budget, pixels, in.page.bits / 8u, "a page");
  std::vector<unsigned char> page(pixels * (in.page.bits / 8u));
  reserve_within(budget, out.volume.samples, out.volume.voxel_count(), "samples");
  for_each_slice(file, in.tiff.get(), [&] {
    const auto read = TIFFIsTiled(in.tiff.get()) ? read_tiles : read_strips;
    read(in, page, budget);
    append_samples(page, in.scan.source, out.volume.samples);
  });
  return out;
}

ScanFile open_tiff_header(const std::filesystem::path& file, MemoryBudget& budget) {
  return open_tiff(file, budget).scan;
}

}  // namespace mesamis::detail
