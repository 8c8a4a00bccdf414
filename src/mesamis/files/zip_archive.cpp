// SPDX-License-Identifier: Apache-2.0
#include "mesamis/files/zip_archive.h"

#include <zlib.h>

#include <algorithm>
#include <utility>

#include "mesamis/files/bytes.h"
#include "mesamis/files/deflate.h"
#include "mesamis/files/refuse.h"

namespace mesamis::detail::files {
namespace {

/// Records of the format (APPNOTE 4.3) by their first four bytes, and their sizes without names.
constexpr std::uint64_t kLocalMark = 0x04034b50, kDirectoryMark = 0x02014b50, kEndMark = 0x06054b50;
constexpr std::uint64_t kEnd64Mark = 0x06064b50, kLocator64Mark = 0x07064b50;
constexpr std::uint64_t kLocalSize = 30, kDirectorySize = 46, kEndSize = 22, kLocator64Size = 20;
constexpr std::uint64_t kField64 = 1, kIn64 = 0xffffffff;  // a number that stands in this field
constexpr std::uint64_t kLongestComment = 65535, kMostParts = 10'000;
constexpr std::uint64_t kStored = 0, kDeflated = 8, kEncrypted = 1;

}  // namespace

/// A number of 2, 4 or 8 bytes.
std::uint64_t ZipArchive::number(std::uint64_t at, std::size_t size) const {
  if (at > bytes_.size() || size > bytes_.size() - at) refuse(file_, "the ZIP archive is cut off");
  const char* from = bytes_.data() + at;
  if (size == 8) return load<std::uint64_t>(from);
  return size == 2 ? load<std::uint16_t>(from) : load<std::uint32_t>(from);
}

/// The last record tells where it begins; behind that record only a comment may stand. Where it has
/// no room for the numbers, a record of ZIP64 does, and one before the last names its place.
ZipArchive::Directory ZipArchive::find_directory() const {
  const std::uint64_t size = bytes_.size();
  for (std::uint64_t back = kEndSize; back <= std::min(size, kEndSize + kLongestComment); ++back) {
    const std::uint64_t end = size - back;
    if (number(end, 4) != kEndMark) continue;
    if (end < kLocator64Size || number(end - kLocator64Size, 4) != kLocator64Mark) {
      return {number(end + 16, 4), number(end + 10, 2)};
    }
    const std::uint64_t end64 = number(end - kLocator64Size + 8, 8);
    if (number(end64, 4) != kEnd64Mark) break;
    return {number(end64 + 48, 8), number(end64 + 32, 8)};
  }
  refuse(file_, "is not a ZIP archive, or it is cut off");
}

ZipArchive::Part ZipArchive::part_at(std::uint64_t at) const {
  if (number(at, 4) != kDirectoryMark) refuse(file_, "the directory of the ZIP archive is broken");
  const std::uint64_t name_size = number(at + 28, 2), extra_size = number(at + 30, 2);
  Part part{{},
            number(at + 8, 2),
            number(at + 10, 2),
            number(at + 16, 4),
            number(at + 20, 4),
            number(at + 24, 4),
            number(at + 42, 4)};
  std::uint64_t extra = at + kDirectorySize + name_size;
  const std::uint64_t end = extra + extra_size;
  if (end > bytes_.size()) refuse(file_, "the ZIP archive is cut off");
  part.name = lower(bytes_.substr(at + kDirectorySize, name_size));
  // What does not fit into four bytes stands in a field of ZIP64, in this order.
  for (; extra + 4 <= end; extra += 4 + number(extra + 2, 2)) {
    if (number(extra, 2) != kField64) continue;
    std::uint64_t next = extra + 4;
    for (std::uint64_t* value : {&part.plain_size, &part.stored_size, &part.begin}) {
      if (*value != kIn64) continue;
      *value = number(next, 8);
      next += 8;
    }
    break;
  }
  return part;
}

ZipArchive::ZipArchive(std::filesystem::path file, std::string_view bytes, MemoryBudget& budget)
    : file_(std::move(file)), bytes_(bytes), budget_(budget) {
  const auto [begin, count] = find_directory();
  if (count > kMostParts) {
    refuse(file_,
           message("expected at most ", kMostParts, " parts in the ZIP archive, found ", count));
  }
  std::uint64_t at = begin;
  for (std::uint64_t n = 0; n < count; ++n) {
    Part part = part_at(at);
    const std::uint64_t name_size = part.name.size();
    budget_.claim(1, name_size, "parts of the archive");
    append_within(budget_, parts_, std::move(part), "parts of the archive");
    at += kDirectorySize + name_size + number(at + 30, 2) + number(at + 32, 2);
  }
}

/// The bytes of a part as they lie in the archive.
std::string_view ZipArchive::stored(const Part& part) const {
  if (number(part.begin, 4) != kLocalMark) refuse(file_, "a part of the ZIP archive is missing");
  const std::uint64_t begin =
      part.begin + kLocalSize + number(part.begin + 26, 2) + number(part.begin + 28, 2);
  if (begin > bytes_.size() || part.stored_size > bytes_.size() - begin) {
    refuse(file_, "a part of the ZIP archive is cut off");
  }
  return bytes_.substr(begin, part.stored_size);
}

std::string ZipArchive::inflated(const Part& part, std::string_view stored) const {
  constexpr int kRawDeflate = -15;  // window bits: neither gzip nor zlib around it
  std::string plain(part.plain_size, '\0');
  z_stream stream{};
  if (inflateInit2(&stream, kRawDeflate) != Z_OK) refuse(file_, "zlib could not be started");
  constexpr std::size_t kAtOnce = std::size_t{1} << 30;  // zlib counts in 32 bits
  std::size_t in = 0, out = 0;
  int status = Z_OK;
  while (status == Z_OK) {
    stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(stored.data() + in));
    stream.avail_in = static_cast<uInt>(std::min(kAtOnce, stored.size() - in));
    stream.next_out = reinterpret_cast<Bytef*>(plain.data() + out);
    stream.avail_out = static_cast<uInt>(std::min(kAtOnce, plain.size() - out));
    const std::size_t fed = stream.avail_in, room = stream.avail_out;
    status = inflate(&stream, Z_NO_FLUSH);
    in += fed - stream.avail_in;
    out += room - stream.avail_out;
  }
  const bool whole = status == Z_STREAM_END && out == plain.size();
  inflateEnd(&stream);
  if (!whole) refuse(file_, message("the packed part ", in_quotes(part.name), " is broken"));
  return plain;
}

std::vector<std::string> ZipArchive::names() const {
  std::vector<std::string> names;
  names.reserve(parts_.size());
  for (const Part& part : parts_) names.push_back(part.name);
  return names;
}

std::optional<std::string> ZipArchive::part(std::string_view name) {
  const auto found = std::find_if(parts_.begin(), parts_.end(),
                                  [key = lower(name)](const Part& p) { return p.name == key; });
  if (found == parts_.end()) return std::nullopt;
  const Part& part = *found;
  if ((part.method != kStored && part.method != kDeflated) || (part.flags & kEncrypted) != 0) {
    refuse(file_, message("expected the part ", in_quotes(part.name), " stored or deflated, found ",
                          (part.flags & kEncrypted) != 0 ? "an encrypted one" : "another method"));
  }
  const std::string_view bytes = stored(part);
  const std::uint64_t most =
      part.method == kStored ? bytes.size() : kMostDeflateRatio * bytes.size();
  if (part.plain_size > most || (part.method == kStored && part.plain_size < most)) {
    refuse(file_, message("the part ", in_quotes(part.name), " claims ", part.plain_size,
                          " bytes, found ", bytes.size(), " packed"));
  }
  budget_.claim(1, part.plain_size, "a part of the archive");
  std::string plain = part.method == kStored ? std::string(bytes) : inflated(part, bytes);
  const auto sum = crc32_z(0, reinterpret_cast<const Bytef*>(plain.data()), plain.size());
  if (sum != part.checksum) {
    refuse(file_, message("the part ", in_quotes(part.name), " has a wrong checksum"));
  }
  return plain;
}

}  // namespace mesamis::detail::files
