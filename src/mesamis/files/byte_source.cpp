// SPDX-License-Identifier: Apache-2.0
#include "mesamis/files/byte_source.h"

#include <zlib.h>

#include <algorithm>
#include <cerrno>
#include <fstream>
#include <vector>

#include "mesamis/files/deflate.h"
#include "mesamis/files/file_list.h"
#include "mesamis/files/read_record.h"
#include "mesamis/files/refuse.h"

namespace mesamis::detail::files {
namespace {

constexpr std::size_t kChunk = 1 << 16;
constexpr int kGzipOrZlib = 15 + 32;  // window bits of inflateInit2: detect the wrapper

}  // namespace

struct ByteSource::State {
  std::filesystem::path file;
  std::ifstream in;
  std::uint64_t stored = 0;  // bytes of the file after the offset
  std::uint64_t passed = 0;  // of them, where they are plain: read or skipped
  bool deflated = false, started = false, finished = false;
  z_stream stream{};
  std::vector<unsigned char> chunk = std::vector<unsigned char>(kChunk);

  ~State() {
    if (started) inflateEnd(&stream);
  }
  void refill();
  bool looks_like_gzip();
  void end_of_member();
  std::size_t inflate_into(unsigned char* out, std::size_t n);
  std::size_t read_plain(unsigned char* out, std::size_t n);
  std::uint64_t skip_plain(std::uint64_t n);
};

void ByteSource::State::refill() {
  stream.next_in = chunk.data();
  stream.avail_in = static_cast<uInt>(read_plain(chunk.data(), chunk.size()));
}

std::size_t ByteSource::State::read_plain(unsigned char* out, std::size_t n) {
  in.read(reinterpret_cast<char*>(out), static_cast<std::streamsize>(n));
  if (in.bad()) refuse(file, "reading failed");
  return static_cast<std::size_t>(in.gcount());
}

std::uint64_t ByteSource::State::skip_plain(std::uint64_t n) {
  const std::uint64_t step = std::min(n, stored - std::min(passed, stored));
  in.seekg(static_cast<std::streamoff>(step), std::ios::cur);
  passed += step;
  return step;
}

bool ByteSource::State::looks_like_gzip() {
  const auto start = in.tellg();
  unsigned char magic[2] = {0, 0};
  read_plain(magic, 2);
  in.clear();
  in.seekg(start);
  return magic[0] == 0x1f && magic[1] == 0x8b;
}

// gzip files may be joined; anything else after the end is padding.
void ByteSource::State::end_of_member() {
  if (stream.avail_in == 0) refill();
  if (stream.avail_in > 0 && stream.next_in[0] == 0x1f) {
    inflateReset(&stream);
  } else {
    finished = true;
  }
}

std::size_t ByteSource::State::inflate_into(unsigned char* out, std::size_t n) {
  stream.next_out = out;
  stream.avail_out = static_cast<uInt>(n);
  while (stream.avail_out > 0 && !finished) {
    if (stream.avail_in == 0) refill();
    if (stream.avail_in == 0) refuse(file, "the compressed data are cut off");
    const int status = inflate(&stream, Z_NO_FLUSH);
    if (status == Z_STREAM_END) {
      end_of_member();
    } else if (status != Z_OK && status != Z_BUF_ERROR) {
      refuse(file,
             message("the compressed data are broken (", stream.msg ? stream.msg : "zlib error",
                     ") after ", stream.total_out, " bytes unpacked"));
    }
  }
  return n - stream.avail_out;
}

ByteSource::ByteSource(const std::filesystem::path& file, Packing packing, std::uint64_t offset)
    : state_(std::make_unique<State>()) {
  const std::uint64_t size = size_of(file);
  const FileState before = state_of(file);
  state_->file = file;
  if (offset > size) {
    refuse(file, message("the samples should begin at byte ", offset, ", but the file has ", size));
  }
  state_->stored = size - offset;
  errno = 0;
  state_->in.open(file, std::ios::binary);
  if (!state_->in) refuse(file, "cannot be read: " + reason_of(errno));
  note_read(file, before);
  state_->in.seekg(static_cast<std::streamoff>(offset));
  if (!state_->in) refuse(file, "cannot be read");
  state_->deflated =
      packing == Packing::kDeflated || (packing == Packing::kSniffed && state_->looks_like_gzip());
  if (!state_->deflated) return;
  state_->started = inflateInit2(&state_->stream, kGzipOrZlib) == Z_OK;
  if (!state_->started) refuse(file, "zlib could not be started");
}

ByteSource::~ByteSource() = default;

std::size_t ByteSource::read(void* out, std::size_t n) {
  auto* bytes = static_cast<unsigned char*>(out);
  if (!state_->deflated) {
    const std::size_t got = state_->read_plain(bytes, n);
    state_->passed += got;
    return got;
  }
  std::size_t done = 0;
  while (done < n) {
    const std::size_t step = std::min<std::size_t>(n - done, 1u << 30);
    const std::size_t got = state_->inflate_into(bytes + done, step);
    done += got;
    if (got < step) break;
  }
  return done;
}

std::uint64_t ByteSource::skip(std::uint64_t n) {
  if (!state_->deflated) return state_->skip_plain(n);
  std::vector<unsigned char> scratch(kChunk);
  std::uint64_t done = 0;
  while (done < n) {
    const auto step = static_cast<std::size_t>(std::min<std::uint64_t>(n - done, kChunk));
    const std::size_t got = read(scratch.data(), step);
    done += got;
    if (got < step) break;
  }
  return done;
}

std::uint64_t ByteSource::most_bytes() const {
  return state_->deflated ? state_->stored * kMostDeflateRatio : state_->stored;
}

bool ByteSource::is_packed() const noexcept { return state_->deflated; }

std::string read_all(const std::filesystem::path& file, MemoryBudget& budget, MostBytes most) {
  constexpr std::size_t kStep = std::size_t{1} << 22;
  ByteSource source(file, Packing::kSniffed);
  std::uint64_t left = source.most_bytes();
  std::string bytes;
  const auto read_part = [&](std::uint64_t wanted) {
    const auto size = static_cast<std::size_t>(std::min(wanted, left));
    const std::size_t before = bytes.size(), end = before + size;
    if (end > bytes.capacity()) {
      const std::uint64_t room = std::max<std::uint64_t>(end, 2 * before);
      reserve_within(budget, bytes, std::min(room, before + left), "bytes of the file");
    }
    bytes.resize(end);
    bytes.resize(before + source.read(bytes.data() + before, size));
    left -= size;
    return bytes.size() == end && left > 0;
  };
  bool more = read_part(kFirstBytes);
  const std::uint64_t justified = most == nullptr ? 0 : most(bytes);
  if (justified > 0) left = std::min(left, justified - std::min(justified, bytes.size()));
  while (more && left > 0) more = read_part(kStep);
  return bytes;
}

}  // namespace mesamis::detail::files
