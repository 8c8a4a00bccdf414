// SPDX-License-Identifier: Apache-2.0
#include <tiffio.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <limits>
#include <memory>
#include <optional>
#include <span>

#include "mesamis/files/bytes.h"
#include "mesamis/files/deflate.h"
#include "mesamis/files/file_list.h"
#include "mesamis/files/read_record.h"
#include "mesamis/files/refuse.h"
#include "mesamis/volume_files/formats.h"
#include "mesamis/volume_files/grey_pixels.h"
#include "mesamis/volume_files/tiff_layout.h"
#include "mesamis/volume_files/tiff_tags.h"

namespace mesamis::detail::volume_files {
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
  std::vector<std::array<std::uint8_t, 3>> palette{};  ///< its table of colours
  friend bool operator==(const Page&, const Page&) = default;

  /// Bytes of so many pixels of one line: samples of less than a byte are packed.
  std::size_t bytes_of_line(std::size_t pixels) const { return (pixels * bits + 7) / 8; }
  std::size_t bytes_of_all() const { return height * bytes_of_line(width); }
  bool is_half() const { return bits == 16 && format == SAMPLEFORMAT_IEEEFP; }
};

/// The table of colours of a page; empty if there is none.
std::vector<std::array<std::uint8_t, 3>> palette_of(TIFF* tiff, const Page& page) {
  constexpr std::uint16_t kMostBits = 16;
  std::uint16_t *red = nullptr, *green = nullptr, *blue = nullptr;
  if (page.photometric != PHOTOMETRIC_PALETTE || page.bits > kMostBits ||
      TIFFGetField(tiff, TIFFTAG_COLORMAP, &red, &green, &blue) != 1) {
    return {};
  }
  std::vector<std::array<std::uint8_t, 3>> palette(std::size_t{1} << page.bits);
  const auto share = [](std::uint16_t colour) { return static_cast<std::uint8_t>(colour >> 8); };
  for (std::size_t n = 0; n < palette.size(); ++n) {
    palette[n] = {share(red[n]), share(green[n]), share(blue[n])};
  }
  return palette;
}

Page page_of(TIFF* tiff) {
  Page page;
  TIFFGetField(tiff, TIFFTAG_IMAGEWIDTH, &page.width);
  TIFFGetField(tiff, TIFFTAG_IMAGELENGTH, &page.height);
  TIFFGetFieldDefaulted(tiff, TIFFTAG_BITSPERSAMPLE, &page.bits);
  TIFFGetFieldDefaulted(tiff, TIFFTAG_SAMPLESPERPIXEL, &page.channels);
  TIFFGetFieldDefaulted(tiff, TIFFTAG_SAMPLEFORMAT, &page.format);
  TIFFGetField(tiff, TIFFTAG_PHOTOMETRIC, &page.photometric);
  page.palette = palette_of(tiff, page);
  return page;
}

bool is_thumbnail(TIFF* tiff) {
  std::uint32_t kind = 0;
  TIFFGetField(tiff, TIFFTAG_SUBFILETYPE, &kind);
  return (kind & FILETYPE_REDUCEDIMAGE) != 0;
}

std::optional<NumberType> sample_type(const Page& page) {
  const bool real = page.format == SAMPLEFORMAT_IEEEFP, sign = page.format == SAMPLEFORMAT_INT;
  const bool open = page.format == SAMPLEFORMAT_VOID;  // taken as unsigned, as TIFF advises
  if (!real && !sign && !open && page.format != SAMPLEFORMAT_UINT) return std::nullopt;
  switch (page.bits) {
    case 1:
    case 2:
    case 4:
      if (real || sign) return std::nullopt;
      return NumberType::kUint8;  // once they are unpacked
    case 8:
      if (real) return std::nullopt;
      return sign ? NumberType::kInt8 : NumberType::kUint8;
    case 16:
      if (real) return NumberType::kFloat32;  // once they are widened
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
                                           page.photometric == PHOTOMETRIC_MINISWHITE ||
                                           page.photometric == PHOTOMETRIC_PALETTE);
  const auto type = sample_type(page);
  if (!grey || !type) {
    refuse(file, message("expected grey pages of 1, 2, 4, 8, 16, 32 or 64 bits, found ",
                         page.channels, " channels of ", page.bits, " bits, sample format ",
                         page.format, ", photometric ", page.photometric));
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
    if (!TIFFReadDirectory(tiff)) refuse(file, message("page ", next, " is broken or cut off"));
    if (!is_thumbnail(tiff)) visit();
  }
}

/// Where the directory of a page lies in the file, and which page that is.
struct PagePlace {
  std::uint64_t offset = 0;
  tdir_t number = 0;
};

/// The header of a file: what is read of it once.
struct TiffPages {
  ScanFile scan;
  Page page;
  std::vector<PagePlace> places;     ///< of the slices
  std::optional<tdir_t> cut_off;     ///< the first page that goes on behind the end of the file
  std::vector<std::int64_t> planes;  ///< of the slices, where all lie behind one directory
  std::uint64_t plane_bytes() const { return page.bytes_of_all(); }
};

void require_like(const std::filesystem::path& file, const Page& common, const Page& page,
                  tdir_t number) {
  if (page == common) return;
  Page other = page;
  other.palette = common.palette;
  if (other == common) {
    refuse(file,
           message("expected the table of colours of the first page, found another one on page ",
                   number, ": values are its indices"));
  }
  refuse(file, message("expected pages of one size and type (", common.width, " x ", common.height,
                       ", ", common.bits, " bits), found page ", number, " of ", page.width, " x ",
                       page.height, ", ", page.bits, " bits"));
}

[[noreturn]] void refuse_page(const std::filesystem::path& file, tdir_t number) {
  refuse(file, message("page ", number, " is broken or cut off"));
}

/// The bytes of a strip or a tile that are read: of a plain strip no more than its lines.
std::uint64_t bytes_of_part(TIFF* tiff, const Page& page, std::uint32_t part) {
  const std::uint64_t stored = TIFFGetStrileByteCount(tiff, part);
  std::uint16_t compression = COMPRESSION_NONE;
  std::uint32_t lines = page.height;
  TIFFGetFieldDefaulted(tiff, TIFFTAG_COMPRESSION, &compression);
  TIFFGetFieldDefaulted(tiff, TIFFTAG_ROWSPERSTRIP, &lines);
  if (TIFFIsTiled(tiff) || compression != COMPRESSION_NONE) return stored;
  const std::uint64_t before = std::uint64_t{part} * lines;
  const std::uint64_t left = page.height - std::min<std::uint64_t>(before, page.height);
  return std::min(stored, std::min<std::uint64_t>(lines, left) * TIFFScanlineSize64(tiff));
}

/// Whether the pixels of the page lie within the file.
bool is_complete(const std::filesystem::path& file, TIFF* tiff, const Page& page) {
  const std::uint64_t size = size_of(file);
  const std::uint32_t parts =
      TIFFIsTiled(tiff) ? TIFFNumberOfTiles(tiff) : TIFFNumberOfStrips(tiff);
  for (std::uint32_t part = 0; part < parts; ++part) {
    const std::uint64_t bytes = bytes_of_part(tiff, page, part);
    if (bytes > size || TIFFGetStrileOffset(tiff, part) > size - bytes) return false;
  }
  return true;
}

/// Finds the slices and makes sure that they are alike.
void find_slices(TiffPages& in, TIFF* tiff, MemoryBudget& budget) {
  const std::filesystem::path& file = in.scan.file;
  for_each_slice(file, tiff, [&] {
    const Page page = page_of(tiff);
    const tdir_t number = TIFFCurrentDirectory(tiff);
    if (in.places.empty()) in.page = page;
    require_like(file, in.page, page, number);
    if (!in.cut_off && !is_complete(file, tiff, page)) in.cut_off = number;
    append_within(budget, in.places, PagePlace{TIFFCurrentDirOffset(tiff), number}, "pages");
  });
}

/// Refuses what libtiff does not decode, and lossy labels; other lossy pages are a warning.
void check_compression(ScanFile& scan, TIFF* tiff, bool labels) {
  std::uint16_t compression = COMPRESSION_NONE;
  TIFFGetFieldDefaulted(tiff, TIFFTAG_COMPRESSION, &compression);
  if (!TIFFIsCODECConfigured(compression)) {
    refuse(scan.file, message("expected pages that libtiff decodes, found compression ",
                              compression, "; save them uncompressed"));
  }
  if (compression != COMPRESSION_JPEG && compression != COMPRESSION_OJPEG) return;
  if (labels) refuse(scan.file, "expected labels, found pages coded as JPEG, which is lossy");
  scan.warnings.emplace_back("JPEG is lossy: edges may be off by some pixels");
}

void warn_of_page_place(TIFF* tiff, std::vector<std::string>& warnings) {
  std::uint16_t orientation = ORIENTATION_TOPLEFT;
  TIFFGetFieldDefaulted(tiff, TIFFTAG_ORIENTATION, &orientation);
  if (orientation != ORIENTATION_TOPLEFT) {
    warnings.push_back(message("the pages are meant to be shown turned or mirrored (Orientation ",
                               orientation, "): rows and columns are kept as stored"));
  }
}

/// Width and height of the tiles, checked against what the file can hold.
std::array<std::size_t, 2> tile_size(const std::filesystem::path& file, TIFF* tiff,
                                     const Page& page) {
  std::uint32_t width = 0, height = 0;
  TIFFGetField(tiff, TIFFTAG_TILEWIDTH, &width);
  TIFFGetField(tiff, TIFFTAG_TILELENGTH, &height);
  const double wanted = 1.0 * static_cast<double>(page.bytes_of_line(width)) * height;
  const bool whole_bytes = std::uint64_t{width} * page.bits % 8 == 0;
  if (wanted == 0 || !whole_bytes || wanted > allocation_bound(file) ||
      static_cast<double>(TIFFTileSize64(tiff)) != wanted) {
    refuse(file,
           message("expected tiles of a size the file can hold, found ", width, " x ", height));
  }
  return {width, height};
}

/// A page that is read.
struct PageRead {
  const TiffPages& in;
  TIFF* tiff;
  MemoryBudget& budget;
  tdir_t number = 0;
};

void read_tiles(const PageRead& read, std::vector<unsigned char>& out) {
  const auto& [in, tiff, budget, number] = read;
  const std::filesystem::path& file = in.scan.file;
  const Page& page = in.page;
  const std::size_t line = page.bytes_of_line(page.width);
  const auto [tile_width, tile_height] = tile_size(file, tiff, page);
  const std::size_t tile_line = page.bytes_of_line(tile_width);
  const ScopedClaim claim(budget, 2 * tile_height, tile_line, "a tile");  // and libtiff's
  std::vector<unsigned char> tile(tile_height * tile_line);
  for (std::size_t y = 0; y < page.height; y += tile_height) {
    for (std::size_t x = 0; x < page.width; x += tile_width) {
      if (TIFFReadTile(tiff, tile.data(), static_cast<std::uint32_t>(x),
                       static_cast<std::uint32_t>(y), 0, 0) < 0) {
        refuse_page(file, number);
      }
      const std::size_t bytes = page.bytes_of_line(std::min(tile_width, page.width - x));
      for (std::size_t row = 0; row < std::min(tile_height, page.height - y); ++row) {
        std::copy_n(tile.data() + row * tile_line, bytes,
                    out.data() + (y + row) * line + page.bytes_of_line(x));
      }
    }
  }
}

void read_strips(const PageRead& read, std::vector<unsigned char>& out) {
  const std::filesystem::path& file = read.in.scan.file;
  const Page& page = read.in.page;
  TIFF* tiff = read.tiff;
  const std::size_t line = page.bytes_of_line(page.width);
  if (static_cast<std::size_t>(TIFFScanlineSize64(tiff)) != line) {
    refuse(file, message("page ", read.number, ": expected lines of ", line, " bytes"));
  }
  for (std::uint32_t y = 0; y < page.height; ++y) {
    if (TIFFReadScanline(tiff, out.data() + y * line, y, 0) < 0) refuse_page(file, read.number);
  }
}

/// All planes of the layout behind the only directory, as ImageJ writes files above 4 GB.
void take_planes_behind(TiffPages& in, TIFF* tiff, const std::vector<std::int64_t>& planes) {
  std::uint16_t compression = COMPRESSION_NONE;
  TIFFGetFieldDefaulted(tiff, TIFFTAG_COMPRESSION, &compression);
  const std::filesystem::path& file = in.scan.file;
  if (compression != COMPRESSION_NONE || TIFFIsTiled(tiff)) {
    refuse(file, "expected a page per image, found one page of compressed or tiled pixels");
  }
  in.planes = planes;
  in.scan.source.file = file;
  in.scan.source.offset = TIFFGetStrileOffset(tiff, 0);
  in.scan.source.big_endian = TIFFIsBigEndian(tiff) != 0;
  const std::int64_t last = *std::max_element(planes.begin(), planes.end());
  const std::uint64_t needed =
      in.scan.source.offset + (static_cast<std::uint64_t>(last) + 1) * in.plane_bytes();
  const std::uint64_t directory = TIFFCurrentDirOffset(tiff), begin = in.scan.source.offset;
  const std::uint64_t end = directory > begin ? directory : size_of(file);
  if (begin > end || needed > end) {
    refuse(file, message("expected ", needed, " bytes for ", last + 1, " images, found ", end));
  }
}

/// The pages of the planes that are read.
void take_pages(TiffPages& in, const std::vector<std::int64_t>& planes, bool with_thumbnails) {
  std::vector<PagePlace> places;
  for (const std::int64_t plane : planes) {
    const auto found = with_thumbnails
                           ? std::find_if(in.places.begin(), in.places.end(),
                                          [plane](const PagePlace& p) { return p.number == plane; })
                       : plane < std::ssize(in.places) ? in.places.begin() + plane
                                                       : in.places.end();
    if (plane < 0 || found == in.places.end()) {
      refuse(in.scan.file, message("expected slice ", places.size(), " in this file, found none ",
                                   plane < 0 ? "(it lies in another one)" : "of its pages"));
    }
    places.push_back(*found);
  }
  in.places = std::move(places);
}

/// Which planes are read, in the order of the slices.
void choose_planes(TiffPages& in, TIFF* tiff, const TiffLayout& layout, const ValueChoice& choice) {
  if (layout.slices == 1 && layout.axes.channels > 1 && !choice.volume && !choice.channel) {
    refuse(in.scan.file,
           message("expected slices, found ", layout.axes.channels,
                   " channels of one slice each: save them as slices if they are (of a folder of "
                   "such files --channel 0 to ",
                   layout.axes.channels - 1, " takes one)"));
  }
  const TakenValue taken = take_value(in.scan.file, layout.axes, choice);
  const auto begin =
      layout.planes.begin() + (taken.channel * layout.axes.volumes + taken.volume) * layout.slices;
  const std::vector<std::int64_t> planes(begin, begin + layout.slices);
  if (layout.one_directory && in.places.size() == 1 && layout.planes.size() > 1) {
    take_planes_behind(in, tiff, planes);
  } else {
    take_pages(in, planes, layout.with_thumbnails);
  }
}

TiffLayout layout_of(const TiffPages& in, TIFF* tiff, MemoryBudget& budget) {
  const std::uint64_t most = size_of(in.scan.file) / std::max<std::uint64_t>(in.plane_bytes(), 1);
  TiffLayout layout = read_tiff_layout(in.scan.file, description_of(tiff), std::ssize(in.places),
                                       static_cast<std::int64_t>(most), budget);
  refuse_metamorph(in.scan.file, tiff);
  take_lsm(tiff, layout);
  return layout;
}

void place(ScanFile& scan, TIFF* tiff, const TiffLayout& layout) {
  const Vec3 s = spacing_of(tiff, layout, scan.warnings);
  set_axes(scan, {Vec3{s.x, 0, 0}, Vec3{0, s.y, 0}, Vec3{0, 0, s.z}});
  const Vec3 zero = layout.zero_pixel;
  set_origin(scan, {-zero.x * s.x, -zero.y * s.y, -zero.z * s.z});
}

TiffPages open_pages(const std::filesystem::path& file, TIFF* tiff, const Opening& opening) {
  TiffPages in;
  ScanFile& scan = in.scan;
  scan.file = file;
  scan.format = "TIFF";
  scan.given_spacing = opening.spacing;
  find_slices(in, tiff, opening.budget);
  const Page page = in.page;
  scan.source.type = require_grey(file, page);
  if (!TIFFSetDirectory(tiff, in.places.front().number)) refuse_page(file, in.places[0].number);
  check_compression(scan, tiff, opening.labels);
  const TiffLayout layout = layout_of(in, tiff, opening.budget);
  choose_planes(in, tiff, layout, opening.choice);
  scan.warnings.insert(scan.warnings.end(), layout.warnings.begin(), layout.warnings.end());
  scan.source.slope = layout.slope;
  scan.source.intercept = layout.intercept;
  set_size(scan, {page.width, page.height, layout.slices});
  place(scan, tiff, layout);
  warn_of_page_place(tiff, scan.warnings);
  scan.palette = page.palette;
  if (page.photometric == PHOTOMETRIC_PALETTE) {
    scan.warnings.push_back("the pages have a table of colours: the values are its indices");
  }
  if (page.format == SAMPLEFORMAT_VOID) {
    scan.warnings.push_back("the file leaves open what its samples are: taken as whole numbers");
  }
  if (page.photometric == PHOTOMETRIC_MINISWHITE) {
    scan.warnings.push_back("small values are meant to be shown white; they are kept as stored");
  }
  const std::uint64_t needed = scan.grid.voxel_count() * byte_size(scan.source.type);
  if (static_cast<double>(needed) > allocation_bound(file)) {
    refuse(file,
           message("expected ", needed, " bytes of samples, found a file of ", size_of(file)));
  }
  if (in.cut_off) refuse_page(file, *in.cut_off);
  return in;
}

/// Samples of less than a byte, a byte each; lines begin with a byte.
std::vector<unsigned char> unpacked(std::span<const unsigned char> bytes, const Page& page) {
  std::vector<unsigned char> samples;
  samples.reserve(std::size_t{page.width} * page.height);
  const std::size_t line = page.bytes_of_line(page.width);
  for (std::size_t y = 0; y < page.height; ++y) {
    for (std::size_t x = 0; x < page.width; ++x) {
      const unsigned byte = bytes[y * line + x * page.bits / 8];
      const std::size_t shift = 8u - page.bits - x * page.bits % 8;
      samples.push_back(static_cast<unsigned char>(byte >> shift & ((1u << page.bits) - 1)));
    }
  }
  return samples;
}

/// A number of half precision: a sign, five bits of exponent, ten of fraction. Exact.
float widened(std::uint16_t half) {
  constexpr int kExponentBias = 15, kFractionBits = 10, kMostExponent = 31;
  const int exponent = half >> kFractionBits & kMostExponent;
  const int fraction = half & ((1 << kFractionBits) - 1);
  float size = std::ldexp(static_cast<float>(fraction + (exponent > 0 ? 1 << kFractionBits : 0)),
                          std::max(exponent, 1) - kExponentBias - kFractionBits);
  if (exponent == kMostExponent) {
    using Limits = std::numeric_limits<float>;
    size = fraction == 0 ? Limits::infinity() : Limits::quiet_NaN();
  }
  return half >> 15 != 0 ? -size : size;
}

/// Samples of half precision in single precision, in this machine's byte order.
std::vector<unsigned char> widened(std::span<const unsigned char> bytes, bool big_endian) {
  const ByteOrder order = big_endian ? ByteOrder::kBig : ByteOrder::kLittle;
  std::vector<unsigned char> samples(2 * bytes.size());
  for (std::size_t n = 0; n + 1 < bytes.size(); n += 2) {
    const float value =
        widened(load<std::uint16_t>(reinterpret_cast<const char*>(bytes.data() + n), order));
    std::memcpy(samples.data() + 2 * n, &value, sizeof value);
  }
  return samples;
}

/// Appends the samples of a page. Number is float or double.
template <class Number>
void append_page(const TiffPages& in, std::span<const unsigned char> bytes,
                 std::vector<Number>& out, MemoryBudget& budget) {
  const Page& page = in.page;
  const bool half = page.is_half();
  if (page.bits >= 8 && !half) return append_samples(bytes, in.scan.source, out);
  const ScopedClaim claim(budget, std::uint64_t{page.width} * page.height,
                          byte_size(in.scan.source.type), "a page");
  SampleSource source = in.scan.source;
  source.big_endian = false;
  append_samples(half ? widened(bytes, in.scan.source.big_endian) : unpacked(bytes, page), source,
                 out);
}

/// Appends planes that lie behind one directory.
template <class Number>
void append_planes(const TiffPages& in, const SliceRange& slices, std::vector<Number>& out,
                   MemoryBudget& budget) {
  const ScopedClaim claim(budget, in.plane_bytes(), 1, "a page");
  std::vector<unsigned char> bytes(in.plane_bytes());
  for (Index k = slices.first; k < slices.first + slices.count; ++k) {
    const auto plane = static_cast<std::uint64_t>(in.planes[static_cast<std::size_t>(k)]);
    ByteSource source(in.scan.file, Packing::kPlain,
                      in.scan.source.offset + plane * in.plane_bytes());
    if (source.read(bytes.data(), bytes.size()) < bytes.size()) {
      refuse(in.scan.file, message("image ", plane, " is cut off"));
    }
    append_page(in, bytes, out, budget);
  }
}

/// Appends the samples of some slices.
template <class Number>
void append_pages(PageRead read, const SliceRange& slices, std::vector<Number>& out) {
  const TiffPages& in = read.in;
  if (!in.planes.empty()) return append_planes(in, slices, out, read.budget);
  const ScopedClaim claim(read.budget, in.page.bytes_of_all(), 1, "a page");
  std::vector<unsigned char> page(in.page.bytes_of_all());
  const auto asked = std::span(in.places).subspan(static_cast<std::size_t>(slices.first),
                                                  static_cast<std::size_t>(slices.count));
  for (const PagePlace& place : asked) {
    read.number = place.number;
    if (!TIFFSetSubDirectory(read.tiff, place.offset)) refuse_page(in.scan.file, place.number);
    TIFFIsTiled(read.tiff) ? read_tiles(read, page) : read_strips(read, page);
    append_page(in, page, out, read.budget);
  }
}

}  // namespace

void visit_tiff(const std::filesystem::path& file, const Opening& opening,
                const VisitSamples& visit) {
  MemoryBudget& budget = opening.budget;
  const TiffHandle tiff = open(file, budget);
  const TiffPages in = open_pages(file, tiff.get(), opening);
  std::vector<double> slice;
  reserve_within(budget, slice, std::size_t{in.page.width} * in.page.height, "a slice");
  for (Index k = 0; k < in.scan.grid.size[2]; ++k) {
    slice.clear();
    append_pages({in, tiff.get(), budget}, {k, 1}, slice);
    visit(slice);
  }
}

VolumeFile read_tiff(const std::filesystem::path& file, const Opening& opening) {
  MemoryBudget& budget = opening.budget;
  const TiffHandle tiff = open(file, budget);
  const TiffPages in = open_pages(file, tiff.get(), opening);
  VolumeFile out{in.scan.grid, in.scan.format, in.scan.warnings};
  reserve_within(budget, out.volume.samples, out.volume.voxel_count(), "samples");
  append_pages({in, tiff.get(), budget}, {0, out.volume.size[2]}, out.volume.samples);
  return out;
}

ScanFile open_tiff_header(const std::filesystem::path& file, const Opening& opening) {
  return open_pages(file, open(file, opening.budget).get(), opening).scan;
}

OpenSlices open_tiff_slices(const std::filesystem::path& file, const Opening& opening) {
  const TiffHandle header = open(file, opening.budget);
  const auto in = std::make_shared<const TiffPages>(open_pages(file, header.get(), opening));
  return {in->scan, [in](const SliceRange& slices, MemoryBudget& of_read, std::vector<float>& out) {
            const TiffHandle tiff = open(in->scan.file, of_read);
            append_pages({*in, tiff.get(), of_read}, slices, out);
          }};
}

}  // namespace mesamis::detail::volume_files
