// SPDX-License-Identifier: Apache-2.0
#include "mesamis/files/deflate.h"

#include <zlib.h>

#include "mesamis/files/refuse.h"

namespace mesamis::detail::files {

struct Deflater::Stream {
  z_stream zlib{};

  /// Appends all that zlib hands out for its input.
  void run(int flush, std::string& packed) {
    std::string part(std::size_t{1} << 16, '\0');
    do {
      zlib.next_out = reinterpret_cast<Bytef*>(part.data());
      zlib.avail_out = static_cast<uInt>(part.size());
      deflate(&zlib, flush);
      packed.append(part, 0, part.size() - zlib.avail_out);
    } while (zlib.avail_out == 0);
  }
};

Deflater::Deflater(const std::filesystem::path& path, int level)
    : stream_(std::make_unique<Stream>()) {
  constexpr int kGzipWindow = 15 + 16, kMemory = 8;
  if (deflateInit2(&stream_->zlib, level, Z_DEFLATED, kGzipWindow, kMemory, Z_DEFAULT_STRATEGY) !=
      Z_OK) {
    refuse(path, "cannot be written: zlib could not be started");
  }
}

Deflater::~Deflater() { deflateEnd(&stream_->zlib); }

std::string Deflater::add(std::string_view bytes) {
  constexpr std::size_t kAtOnce = std::size_t{1} << 30;  // zlib counts in 32 bits
  std::string packed;
  for (std::size_t begin = 0; begin < bytes.size(); begin += kAtOnce) {
    const std::string_view part = bytes.substr(begin, kAtOnce);
    stream_->zlib.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(part.data()));
    stream_->zlib.avail_in = static_cast<uInt>(part.size());
    stream_->run(Z_NO_FLUSH, packed);
  }
  return packed;
}

std::string Deflater::finish() {
  std::string packed;
  stream_->run(Z_FINISH, packed);
  return packed;
}

std::string gzipped(const std::filesystem::path& path, std::string_view bytes, int level) {
  Deflater deflater(path, level);
  std::string packed = deflater.add(bytes);
  return packed + deflater.finish();
}

}  // namespace mesamis::detail::files
