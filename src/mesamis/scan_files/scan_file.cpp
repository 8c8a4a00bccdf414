// SPDX-License-Identifier: Apache-2.0
#include "mesamis/scan_files/scan_file.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <limits>

#include "mesamis/base/error.h"
#include "mesamis/files/refuse.h"

namespace mesamis::detail {
namespace {

constexpr std::size_t kSamplesAtOnce = 1 << 16;
constexpr double kRoundingSkew = 1e-5;  // rounding of orthogonal axes to single precision
static_assert(std::endian::native == std::endian::little, "samples are swapped for little endian");

constexpr std::int64_t kMostSamples = std::int64_t{1} << 40;
constexpr std::int64_t kMostValues = 65535;  // per voxel

std::uint64_t sample_count(const ScanFile& scan) {
  return std::uint64_t{scan.grid.voxel_count()} * static_cast<std::uint64_t>(scan.inner) *
         static_cast<std::uint64_t>(scan.outer);
}

std::string size_text(const ScanFile& scan) {
  const auto& n = scan.grid.size;
  const std::string voxels = say(n[0], " x ", n[1], " x ", n[2]);
  const Index values = scan.inner * scan.outer;
  return values == 1 ? voxels : say(voxels, " x ", values);
}

template <class Stored, class Number>
void convert(std::span<const unsigned char> bytes, const SampleSource& source, Number* out) {
  const bool plain = source.slope == 1 && source.intercept == 0;
  std::array<unsigned char, sizeof(Stored)> raw;
  for (std::size_t n = 0; n * sizeof(Stored) < bytes.size(); ++n) {
    std::memcpy(raw.data(), bytes.data() + n * sizeof(Stored), sizeof(Stored));
    if (source.big_endian) std::reverse(raw.begin(), raw.end());
    Stored stored;
    std::memcpy(&stored, raw.data(), sizeof(Stored));
    out[n] =
        plain ? static_cast<Number>(stored)
              : static_cast<Number>(source.slope * static_cast<double>(stored) + source.intercept);
  }
}

template <class Number>
void convert_any(std::span<const unsigned char> bytes, const SampleSource& source, Number* out) {
  with_number_type(source.type, [&](auto zero) { convert<decltype(zero)>(bytes, source, out); });
}

template <class Found>
[[noreturn]] void refuse_short(const ScanFile& scan, std::uint64_t expected, const Found& found,
                               const char* unit) {
  refuse(scan.source.file, say("expected ", expected, " ", unit, " for ", size_text(scan),
                               " samples, found ", found));
}

/// Calls visit(bytes) for the next `count` samples, block by block.
template <class Visit>
void read_binary(const ScanFile& scan, ByteSource& bytes, std::size_t count, Visit visit) {
  const auto width = byte_size(scan.source.type);
  std::vector<unsigned char> block(std::min(kSamplesAtOnce, count) * width);
  for (std::size_t done = 0; done < count;) {
    const std::size_t samples = std::min(kSamplesAtOnce, count - done);
    const std::size_t got = bytes.read(block.data(), samples * width);
    if (got < samples * width) {
      refuse_short(scan, std::uint64_t{count} * width, done * width + got, "bytes");
    }
    done += samples;
    visit(std::span<const unsigned char>(block.data(), got));
  }
}

double number_of(const ScanFile& scan, std::string_view word, std::size_t sample) {
  double value = 0;
  if (!parse_number(word, value)) {
    refuse(scan.source.file,
           say("expected a number as sample ", sample, ", found ", in_quotes(word)));
  }
  return scan.source.slope * value + scan.source.intercept;
}

/// Calls visit(number) for each sample.
template <class Visit>
void read_text(const ScanFile& scan, ByteSource& bytes, Visit visit) {
  constexpr std::size_t kLongestNumber = 64;
  const std::size_t count = sample_count(scan);
  std::size_t done = 0;
  std::vector<char> block(kSamplesAtOnce);
  std::string word;
  for (bool more = true; more && done < count;) {
    const std::size_t got = bytes.read(block.data(), block.size());
    more = got == block.size();
    if (!more) block[got] = ' ';  // the end of the data ends the last number
    for (std::size_t n = 0; n < (more ? got : got + 1) && done < count; ++n) {
      const bool blank = block[n] == ' ' || (block[n] >= '\t' && block[n] <= '\r');
      if (!blank && word.size() < kLongestNumber) word += block[n];
      if (!blank || word.empty()) continue;
      visit(number_of(scan, word, done++));
      word.clear();
    }
  }
  if (done < count) refuse_short(scan, count, done, "numbers");
}

/// Fewest bytes (unpacked) that the samples take; a number in text needs one and a blank.
std::uint64_t fewest_bytes(const ScanFile& scan) {
  const std::uint64_t count = sample_count(scan);
  return scan.source.text ? 2 * count - 1 : count * byte_size(scan.source.type);
}

[[noreturn]] void refuse_long(const ScanFile& scan) {
  refuse(scan.source.file, say("expected the data to end after ", fewest_bytes(scan), " bytes for ",
                               size_text(scan), " samples, but they go on"));
}

[[noreturn]] void refuse_unplain(const ScanFile& scan, std::string_view found) {
  refuse(scan.file, say("expected uncompressed voxels, which can be read a slice at a time, found ",
                        found, "; unpack it, or run without --slabs"));
}

std::uint64_t bytes_before_last_samples(const ScanFile& scan) {
  ByteSource all(scan.source.file, scan.source.packing, scan.source.offset);
  const std::uint64_t total = all.skip(std::numeric_limits<std::uint64_t>::max());
  const std::uint64_t needed = fewest_bytes(scan);
  if (total < needed) refuse_short(scan, needed, total, "bytes");
  return total - needed;
}

}  // namespace

void set_size(ScanFile& scan, const std::array<std::int64_t, 3>& counts) {
  std::int64_t left = kMostSamples;
  for (std::size_t a = 0; a < 3; ++a) {
    if (counts[a] < 1 || counts[a] > std::numeric_limits<Index>::max()) {
      refuse(scan.file,
             say("expected 1 to 2147483647 voxels along axis ", a, ", found ", counts[a]));
    }
    left /= counts[a];
    scan.grid.size[a] = static_cast<Index>(counts[a]);
  }
  if (left < 1) refuse(scan.file, say("more voxels than can be read: ", size_text(scan)));
}

void set_values(ScanFile& scan, std::int64_t inner, std::int64_t outer) {
  const std::int64_t values = std::max(inner, outer);
  const auto most = kMostSamples / static_cast<std::int64_t>(scan.grid.voxel_count());
  if (std::min(inner, outer) < 1 || values > std::min<std::int64_t>(most, kMostValues)) {
    refuse(scan.file, say("expected 1 to ", std::min<std::int64_t>(most, kMostValues),
                          " values per voxel, found ", inner == 1 ? outer : inner));
  }
  scan.inner = static_cast<Index>(inner);
  scan.outer = static_cast<Index>(outer);
}

void set_axes(ScanFile& scan, const std::array<Vec3, 3>& steps) {
  GridAxes axes;
  try {
    axes = grid_axes(steps);
  } catch (const InputError& error) {
    refuse(scan.file, error.what());
  }
  if (axes.skew > kRoundingSkew) {
    scan.warnings.push_back(
        say("the voxel axes are not orthogonal (cosine ", axes.skew, "): made orthonormal"));
  }
  scan.grid.spacing = axes.spacing;
  scan.grid.direction = axes.direction;
}

void set_origin(ScanFile& scan, const Vec3& origin) {
  for (int a = 0; a < 3; ++a) {
    if (!std::isfinite(origin[a])) {
      refuse(scan.file, say("expected a finite origin, found ", origin[a], " along axis ", a));
    }
  }
  scan.grid.origin = origin + Vec3{};  // -0 becomes 0
}

void append_samples(std::span<const unsigned char> bytes, const SampleSource& source,
                    std::vector<float>& out) {
  const std::size_t begin = out.size();
  out.resize(begin + bytes.size() / byte_size(source.type));
  convert_any(bytes, source, out.data() + begin);
}

namespace {

/// Skips what lies before the samples.
void go_to_samples(const ScanFile& scan, ByteSource& bytes) {
  const SampleSource& source = scan.source;
  const std::uint64_t skip = source.at_end ? bytes_before_last_samples(scan) : source.skip;
  const std::uint64_t needed = fewest_bytes(scan);
  if (needed > bytes.most_bytes()) {
    refuse_short(scan, needed,
                 say(source.packing == Packing::kPlain ? "" : "at most ", bytes.most_bytes()),
                 "bytes");
  }
  bytes.skip(skip);
}

void require_end(const ScanFile& scan, ByteSource& bytes) {
  char beyond = 0;
  if (scan.source.exact && !scan.source.text && bytes.read(&beyond, 1) > 0) refuse_long(scan);
}

}  // namespace

std::vector<float> read_samples(const ScanFile& scan, MemoryBudget& budget) {
  ByteSource bytes(scan.source.file, scan.source.packing, scan.source.offset);
  go_to_samples(scan, bytes);
  std::vector<float> samples;
  reserve_within(budget, samples, sample_count(scan), "samples");
  if (scan.source.text) {
    read_text(scan, bytes, [&](double value) { samples.push_back(static_cast<float>(value)); });
  } else {
    read_binary(scan, bytes, sample_count(scan), [&](std::span<const unsigned char> block) {
      append_samples(block, scan.source, samples);
    });
  }
  require_end(scan, bytes);
  return samples;
}

void visit_samples(const ScanFile& scan,
                   const std::function<void(std::span<const double>)>& visit) {
  ByteSource bytes(scan.source.file, scan.source.packing, scan.source.offset);
  go_to_samples(scan, bytes);
  std::vector<double> numbers;
  if (scan.source.text) {
    read_text(scan, bytes, [&](double value) { visit({&value, 1}); });
  } else {
    read_binary(scan, bytes, sample_count(scan), [&](std::span<const unsigned char> block) {
      numbers.resize(block.size() / byte_size(scan.source.type));
      convert_any(block, scan.source, numbers.data());
      visit(numbers);
    });
  }
  require_end(scan, bytes);
}

std::uint64_t find_plain_samples(const ScanFile& scan) {
  const SampleSource& source = scan.source;
  if (source.text) refuse_unplain(scan, "numbers in text");
  const ByteSource bytes(source.file, source.packing, source.offset);
  if (bytes.is_packed()) {
    refuse_unplain(scan, source.packing == Packing::kSniffed ? "gzip" : "gzip or zlib");
  }
  const std::uint64_t there = bytes.most_bytes(), needed = fewest_bytes(scan);
  const std::uint64_t skip = std::min(source.skip, there);
  if (there - skip < needed) refuse_short(scan, needed, there - skip, "bytes");
  if (source.at_end) return source.offset + there - needed;
  if (source.exact && there - skip > needed) refuse_long(scan);
  return source.offset + skip;
}

void append_slices(const ScanFile& scan, std::uint64_t begin, const SliceRange& slices,
                   std::vector<float>& out) {
  const std::uint64_t before = scan.grid.offset(0, 0, slices.first);
  ByteSource bytes(scan.source.file, Packing::kPlain, begin + before * byte_size(scan.source.type));
  read_binary(scan, bytes, scan.grid.offset(0, 0, slices.count),
              [&](std::span<const unsigned char> block) {
                append_samples(block, scan.source, out);
              });
}

}  // namespace mesamis::detail
