// SPDX-License-Identifier: Apache-2.0
#include "mesamis/volume_files/chunk_codec.h"

#include <blosc.h>
#include <zlib.h>
#include <zstd.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <utility>

#include "mesamis/files/bytes.h"
#include "mesamis/files/refuse.h"

namespace mesamis::detail::volume_files {
namespace {

namespace fs = std::filesystem;
using Kind = ChunkCodec::Kind;

constexpr std::size_t kSumBytes = 4;

bool compresses(const ChunkCodec& codec) {
  return codec.kind == Kind::kDeflate || codec.kind == Kind::kBlosc || codec.kind == Kind::kZstd;
}

bool is_sum(const ChunkCodec& codec) {
  return codec.kind == Kind::kCrc32c || codec.kind == Kind::kFletcher32;
}

[[noreturn]] void refuse_size(const fs::path& file, std::size_t expected, std::uint64_t found) {
  refuse(file, message("expected a chunk of ", expected, " bytes, found ", found));
}

[[noreturn]] void refuse_broken(const fs::path& file, const char* packing) {
  refuse(file, message("expected a chunk packed by ", packing, ", found one that is broken"));
}

/// Both ends of a stream in memory; zlib counts them in 32 bits.
class Inflation {
 public:
  Inflation(const fs::path& file, std::string& packed, std::string& out)
      : file_(file), packed_(packed), out_(out) {
    constexpr int kGzipOrZlib = 15 + 32;  // window bits of inflateInit2: detect the wrapper
    if (inflateInit2(&stream_, kGzipOrZlib) != Z_OK) refuse(file_, "zlib cannot be started");
  }
  ~Inflation() { inflateEnd(&stream_); }
  Inflation(const Inflation&) = delete;
  Inflation& operator=(const Inflation&) = delete;

  void run() {
    int status = Z_OK;
    while (status != Z_STREAM_END) {
      feed();
      status = inflate(&stream_, Z_NO_FLUSH);
      if (status == Z_STREAM_END) break;
      if (status == Z_BUF_ERROR && written() == out_.size()) {
        refuse(file_, message("expected a chunk of ", out_.size(), " bytes, found more"));
      }
      if (status != Z_OK) refuse_broken(file_, "zlib or gzip");
    }
    if (written() != out_.size()) refuse_size(file_, out_.size(), written());
  }

 private:
  void feed() {
    constexpr std::size_t kMost = std::size_t{1} << 30;
    if (stream_.avail_in == 0) {
      stream_.next_in = reinterpret_cast<Bytef*>(packed_.data()) + fed_;
      stream_.avail_in = static_cast<uInt>(std::min(kMost, packed_.size() - fed_));
      fed_ += stream_.avail_in;
    }
    if (stream_.avail_out == 0) {
      stream_.next_out = reinterpret_cast<Bytef*>(out_.data()) + offered_;
      stream_.avail_out = static_cast<uInt>(std::min(kMost, out_.size() - offered_));
      offered_ += stream_.avail_out;
    }
  }
  std::size_t written() const { return offered_ - stream_.avail_out; }

  const fs::path& file_;
  std::string &packed_, &out_;
  std::size_t fed_ = 0, offered_ = 0;
  z_stream stream_{};
};

std::string unpack_deflate(const fs::path& file, std::string& packed, std::size_t size) {
  std::string out(size, '\0');
  Inflation(file, packed, out).run();
  return out;
}

std::string unpack_blosc(const fs::path& file, const std::string& packed, std::size_t size) {
  std::size_t found = 0;
  if (blosc_cbuffer_validate(packed.data(), packed.size(), &found) != 0) {
    refuse_broken(file, "Blosc");
  }
  if (found != size) refuse_size(file, size, found);
  std::string out(size, '\0');
  const int got = blosc_decompress_ctx(packed.data(), out.data(), size, 1);
  if (got < 0 || static_cast<std::size_t>(got) != size) refuse_broken(file, "Blosc");
  return out;
}

std::string unpack_zstd(const fs::path& file, const std::string& packed, std::size_t size) {
  const unsigned long long found = ZSTD_getFrameContentSize(packed.data(), packed.size());
  if (found == ZSTD_CONTENTSIZE_ERROR) refuse_broken(file, "Zstandard");
  if (found != ZSTD_CONTENTSIZE_UNKNOWN && found != size) refuse_size(file, size, found);
  std::string out(size, '\0');
  const std::size_t got = ZSTD_decompress(out.data(), size, packed.data(), packed.size());
  if (ZSTD_isError(got)) refuse_broken(file, "Zstandard");
  if (got != size) refuse_size(file, size, got);
  return out;
}

/// What is left over behind the last whole element stays where it is.
std::string unshuffled(const std::string& bytes, std::size_t element) {
  if (element < 2 || element > bytes.size()) return bytes;
  std::string out = bytes;
  const std::size_t count = bytes.size() / element;
  for (std::size_t b = 0; b < element; ++b) {
    for (std::size_t n = 0; n < count; ++n) out[n * element + b] = bytes[b * count + n];
  }
  return out;
}

std::uint32_t crc32c(const std::string& bytes, std::size_t size) {
  constexpr std::uint32_t kPolynomial = 0x82f63b78;  // Castagnoli, reflected
  static const auto table = [] {
    std::array<std::uint32_t, 256> entries{};
    for (std::uint32_t n = 0; n < 256; ++n) {
      std::uint32_t value = n;
      for (int bit = 0; bit < 8; ++bit) value = value >> 1 ^ (value & 1 ? kPolynomial : 0);
      entries[n] = value;
    }
    return entries;
  }();
  std::uint32_t sum = ~std::uint32_t{0};
  for (std::size_t n = 0; n < size; ++n) {
    sum = sum >> 8 ^ table[(sum ^ static_cast<unsigned char>(bytes[n])) & 0xff];
  }
  return ~sum;
}

/// Over words of 16 bits, most significant byte first; a last byte alone is the upper one.
std::uint32_t fletcher32(const std::string& bytes, std::size_t size) {
  std::uint64_t low = 0, high = 0;
  const auto byte = [&](std::size_t n) {
    return n < size ? std::uint64_t{static_cast<unsigned char>(bytes[n])} : 0;
  };
  for (std::size_t n = 0; n < size; n += 2) {
    low = (low + (byte(n) << 8 | byte(n + 1))) % 65535;
    high = (high + low) % 65535;
  }
  return static_cast<std::uint32_t>(high << 16 | low);
}

/// Whether two sums are equal; 0 and 65535 are the same remainder in a half of Fletcher's.
bool same_sum(Kind kind, std::uint32_t a, std::uint32_t b) {
  if (kind == Kind::kCrc32c) return a == b;
  return (a & 0xffff) % 65535 == (b & 0xffff) % 65535 && (a >> 16) % 65535 == (b >> 16) % 65535;
}

std::string without_sum(const fs::path& file, std::string bytes, Kind kind) {
  if (bytes.size() < kSumBytes) refuse(file, "expected a chunk with a checksum, found it cut off");
  const std::size_t size = bytes.size() - kSumBytes;
  const auto stated = load<std::uint32_t>(bytes.data() + size);
  const std::uint32_t found = kind == Kind::kCrc32c ? crc32c(bytes, size) : fletcher32(bytes, size);
  if (!same_sum(kind, stated, found)) {
    refuse(file, "expected a chunk that agrees with its checksum, found a damaged one");
  }
  bytes.resize(size);
  return bytes;
}

std::string unpack_step(const fs::path& file, std::string bytes, const ChunkCodec& codec,
                        std::size_t size) {
  switch (codec.kind) {
    case Kind::kDeflate:
      return unpack_deflate(file, bytes, size);
    case Kind::kBlosc:
      return unpack_blosc(file, bytes, size);
    case Kind::kZstd:
      return unpack_zstd(file, bytes, size);
    case Kind::kShuffle:
      return unshuffled(bytes, codec.element);
    default:
      return without_sum(file, std::move(bytes), codec.kind);
  }
}

}  // namespace

void require_chain(const fs::path& file, const std::vector<ChunkCodec>& codecs) {
  const auto first = std::find_if(codecs.begin(), codecs.end(), compresses);
  if (first == codecs.end() || std::all_of(first + 1, codecs.end(), is_sum)) return;
  refuse(file, "expected chunks that are compressed once, and nothing but a checksum after it");
}

std::string unpack_chunk(const fs::path& file, std::string packed,
                         const std::vector<ChunkCodec>& codecs, std::size_t size) {
  for (std::size_t n = codecs.size(); n-- > 0;) {
    const auto sums =
        std::count_if(codecs.begin(), codecs.begin() + static_cast<std::ptrdiff_t>(n), is_sum);
    packed = unpack_step(file, std::move(packed), codecs[n],
                         size + kSumBytes * static_cast<std::size_t>(sums));
  }
  if (packed.size() != size) refuse_size(file, size, packed.size());
  return packed;
}

}  // namespace mesamis::detail::volume_files
