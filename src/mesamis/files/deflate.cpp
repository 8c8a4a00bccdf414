// SPDX-License-Identifier: Apache-2.0
#include "mesamis/files/deflate.h"

#include <zlib.h>

#include <algorithm>

#include "mesamis/files/refuse.h"

namespace mesamis::detail {

std::string gzipped(const std::filesystem::path& path, std::string_view bytes) {
  constexpr int kGzipWindow = 15 + 16, kFast = 1, kMemory = 8;
  constexpr std::size_t kAtOnce = std::size_t{1} << 30;  // zlib counts in 32 bits
  z_stream stream{};
  if (deflateInit2(&stream, kFast, Z_DEFLATED, kGzipWindow, kMemory, Z_DEFAULT_STRATEGY) != Z_OK) {
    refuse(path, "cannot be written: zlib could not be started");
  }
  std::string packed, part(std::size_t{1} << 20, '\0');
  std::size_t begin = 0;
  int status = Z_OK;
  do {
    if (stream.avail_in == 0) {
      const std::size_t count = std::min(kAtOnce, bytes.size() - begin);
      stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(bytes.data()) + begin);
      stream.avail_in = static_cast<uInt>(count);
      begin += count;
    }
    stream.next_out = reinterpret_cast<Bytef*>(part.data());
    stream.avail_out = static_cast<uInt>(part.size());
    status = deflate(&stream, begin == bytes.size() ? Z_FINISH : Z_NO_FLUSH);
    packed.append(part, 0, part.size() - stream.avail_out);
  } while (status == Z_OK);
  deflateEnd(&stream);
  return packed;
}

}  // namespace mesamis::detail
