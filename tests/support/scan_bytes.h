// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <zlib.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>
#include <sstream>
#include <string>
#include <vector>

/// Small scan files made by hand, so that tests of the readers do not lean on another library's
/// idea of a format, and can break them at will.
namespace mesamis {

/// The bytes of a number, least significant first, or last.
template <class Number>
std::string bytes_of(Number value, bool big_endian = false) {
  std::string bytes(sizeof(Number), '\0');
  std::memcpy(bytes.data(), &value, sizeof(Number));
  if (big_endian) std::reverse(bytes.begin(), bytes.end());
  return bytes;
}

template <class Number>
std::string bytes_of_all(const std::vector<Number>& values, bool big_endian = false) {
  std::string bytes;
  for (const Number value : values) bytes += bytes_of(value, big_endian);
  return bytes;
}

/// Deflates; window bits as zlib has them: 31 gzip, 15 zlib, -15 bare.
inline std::string packed(const std::string& bytes, int window_bits = 31) {
  z_stream stream{};
  deflateInit2(&stream, 6, Z_DEFLATED, window_bits, 8, Z_DEFAULT_STRATEGY);
  std::string out(deflateBound(&stream, static_cast<uLong>(bytes.size())) + 64, '\0');
  stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(bytes.data()));
  stream.avail_in = static_cast<uInt>(bytes.size());
  stream.next_out = reinterpret_cast<Bytef*>(out.data());
  stream.avail_out = static_cast<uInt>(out.size());
  deflate(&stream, Z_FINISH);
  out.resize(stream.total_out);
  deflateEnd(&stream);
  return out;
}

/// -40, -39, ...: `count` samples that differ.
template <class Number>
std::vector<Number> ramp(std::size_t count, int first = -40) {
  std::vector<Number> values(count);
  for (std::size_t n = 0; n < count; ++n)
    values[n] = static_cast<Number>(first + static_cast<int>(n));
  return values;
}

/// A NIfTI-1 header; fields are public so that tests may spoil them.
struct NiftiBytes {
  std::array<std::int16_t, 8> dim{3, 4, 3, 5, 1, 1, 1, 1};
  std::int16_t datatype = 4, bitpix = 16, qform_code = 0, sform_code = 1;
  std::array<float, 8> pixdim{1, 0.5f, 1.25f, 2, 1, 1, 1, 1};
  float vox_offset = 352, slope = 0, intercept = 0;
  char units = 2;
  std::array<float, 6> quatern{};
  std::array<float, 12> srow{0.5f, 0, 0, 10, 0, 1.25f, 0, 20, 0, 0, 2, 30};
  std::string magic = std::string("n+1\0", 4);
  bool big_endian = false;

  std::string header() const {
    std::string h(352, '\0');
    const auto put = [&](std::size_t at, auto value) {
      h.replace(at, sizeof(value), bytes_of(value, big_endian));
    };
    put(0, std::int32_t{348});
    for (std::size_t n = 0; n < 8; ++n) put(40 + 2 * n, dim[n]);
    put(70, datatype), put(72, bitpix);
    for (std::size_t n = 0; n < 8; ++n) put(76 + 4 * n, pixdim[n]);
    put(108, vox_offset), put(112, slope), put(116, intercept);
    h[123] = units;
    put(252, qform_code), put(254, sform_code);
    for (std::size_t n = 0; n < 6; ++n) put(256 + 4 * n, quatern[n]);
    for (std::size_t n = 0; n < 12; ++n) put(280 + 4 * n, srow[n]);
    return h.replace(344, 4, magic);
  }
};

/// A NRRD of 4 x 3 x 5 short integers: the header with more fields, then the data.
inline std::string nrrd_bytes(const std::string& fields, const std::string& data) {
  return "NRRD0004\n# made here\ntype: short\ndimension: 3\nsizes: 4 3 5\n"
         "space: left-posterior-superior\n"
         "space directions: (0.5,0,0) (0,1.25,0) (0,0,2)\nspace origin: (1,2,3)\n" +
         fields + "\n" + data;
}

/// A MetaImage header of as many; what is LOCAL follows it.
inline std::string meta_bytes(const std::string& fields, const std::string& data_file = "LOCAL") {
  return "ObjectType = Image\nNDims = 3\nDimSize = 4 3 5\nElementType = MET_SHORT\n"
         "ElementSpacing = 0.5 1.25 2\nOffset = 1 2 3\nModality = MET_MOD_CT\n" +
         fields + "ElementDataFile = " + data_file + "\n";
}

/// One regular file of a tar.
inline std::string tar_entry(const std::string& name, const std::string& content) {
  std::string block(512, '\0');
  std::ostringstream size;
  size << std::oct << content.size();
  block.replace(0, name.size(), name);
  block.replace(124, size.str().size(), size.str());
  block[156] = '0';
  block.replace(257, 5, "ustar");
  return block + content + std::string((512 - content.size() % 512) % 512, '\0');
}

/// An InVesalius project of size nx, ny, nz; the matrix comes before the list that names it.
inline std::string inv3_bytes(int nx, int ny, int nz, const std::string& matrix,
                              const std::string& dtype = "int16") {
  std::ostringstream list;
  list << "<?xml version=\"1.0\"?>\n<plist version=\"1.0\">\n<dict>\n<key>matrix</key>\n<dict>"
       << "<key>dtype</key><string>" << dtype << "</string>"
       << "<key>filename</key><string>matrix.dat</string><key>shape</key><array>"
       << "<integer>" << nz << "</integer><integer>" << ny << "</integer><integer>" << nx
       << "</integer></array></dict>\n<key>modality</key><string>CT</string>\n"
       << "<key>spacing</key><array><real>0.5</real><real>1.25</real><real>2</real></array>\n"
       << "</dict></plist>\n";
  return tar_entry("x/matrix.dat", matrix) + tar_entry("x/main.plist", list.str()) +
         std::string(1024, '\0');
}

/// What one page of a TIFF is made of.
struct TiffPage {
  std::uint32_t width = 4, height = 3;
  std::uint16_t bits = 16, channels = 1, format = 2, photometric = 1;
  float pixels_per_cm = 20;  // 0: no resolution given
  std::string description{};
  std::string pixels{};  // as they are stored
  std::uint16_t compression = 1;
  bool thumbnail = false;
  std::vector<std::uint16_t> colours{};  // all reds, all greens, all blues
};

/// A little-endian TIFF with one strip per page.
inline std::string tiff_bytes(const std::vector<TiffPage>& pages) {
  std::string out = std::string("II*\0", 4) + bytes_of(std::uint32_t{0});
  std::size_t link = 4;  // where the offset of the next directory goes
  for (const TiffPage& page : pages) {
    const auto strip = static_cast<std::uint32_t>(out.size());
    out += page.pixels;
    const auto ratio = static_cast<std::uint32_t>(out.size());
    out += bytes_of(static_cast<std::uint32_t>(page.pixels_per_cm * 1000)) +
           bytes_of(std::uint32_t{1000});
    const auto text = static_cast<std::uint32_t>(out.size());
    out += page.description + std::string(8 - page.description.size() % 4, '\0');
    const auto colours = static_cast<std::uint32_t>(out.size());
    out += bytes_of_all(page.colours);
    out.replace(link, 4, bytes_of(static_cast<std::uint32_t>(out.size())));
    std::vector<std::string> tags;
    const auto tag = [&tags](int id, int type, std::uint32_t count, std::uint32_t value) {
      tags.push_back(bytes_of(static_cast<std::uint16_t>(id)) +
                     bytes_of(static_cast<std::uint16_t>(type)) + bytes_of(count) +
                     bytes_of(value));
    };
    if (page.thumbnail) tag(254, 4, 1, 1);
    tag(256, 4, 1, page.width), tag(257, 4, 1, page.height), tag(258, 3, 1, page.bits);
    tag(259, 3, 1, page.compression), tag(262, 3, 1, page.photometric);
    if (!page.description.empty()) {
      tag(270, 2, static_cast<std::uint32_t>(page.description.size() + 1), text);
    }
    tag(273, 4, 1, strip), tag(277, 3, 1, page.channels), tag(278, 4, 1, page.height);
    tag(279, 4, 1, static_cast<std::uint32_t>(page.pixels.size()));
    if (page.pixels_per_cm > 0) tag(282, 5, 1, ratio), tag(283, 5, 1, ratio), tag(296, 3, 1, 3);
    if (!page.colours.empty()) {
      tag(320, 3, static_cast<std::uint32_t>(page.colours.size()), colours);
    }
    tag(339, 3, 1, page.format);
    out += bytes_of(static_cast<std::uint16_t>(tags.size()));
    for (const std::string& bytes : tags) out += bytes;
    link = out.size();
    out += bytes_of(std::uint32_t{0});
  }
  return out;
}

}  // namespace mesamis
