// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <zlib.h>

#include <string>

#include "mesamis/picture/raster.h"

namespace mesamis {

/// Undoes gzip or, of a zlib stream, deflate.
inline std::string unpacked(const std::string& packed) {
  z_stream stream{};
  if (inflateInit2(&stream, 32 + MAX_WBITS) != Z_OK) return {};
  std::string bytes, in = packed;
  stream.next_in = reinterpret_cast<Bytef*>(in.data());
  stream.avail_in = static_cast<uInt>(in.size());
  std::string part(1 << 16, '\0');
  int status = Z_OK;
  while (status == Z_OK) {
    stream.next_out = reinterpret_cast<Bytef*>(part.data());
    stream.avail_out = static_cast<uInt>(part.size());
    status = inflate(&stream, Z_NO_FLUSH);
    bytes.append(part, 0, part.size() - stream.avail_out);
  }
  inflateEnd(&stream);
  return status == Z_STREAM_END ? bytes : std::string();
}

/// The colour of a pixel.
inline Colour pixel(const Raster& picture, int x, int y) {
  const std::uint8_t* at = picture.bytes.data() + picture.offset(x, y);
  return picture.grey ? Colour{*at, *at, *at} : Colour{at[0], at[1], at[2]};
}

}  // namespace mesamis
