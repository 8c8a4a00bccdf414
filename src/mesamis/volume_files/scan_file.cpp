// SPDX-License-Identifier: Apache-2.0
#include "mesamis/volume_files/scan_file.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <concepts>
#include <cstring>
#include <limits>
#include <system_error>

#include "mesamis/base/error.h"
#include "mesamis/files/refuse.h"
#include "mesamis/volume_files/rounding_record.h"

namespace mesamis::detail::volume_files {
namespace {

constexpr std::size_t kSamplesAtOnce = 1 << 16;
constexpr double kRoundingSkew = 1e-5;  // rounding of orthogonal axes to single precision
static_assert(std::endian::native == std::endian::little, "samples are swapped for little endian");

constexpr std::int64_t kMostSamples = std::int64_t{1} << 40;
constexpr std::int64_t kMostValues = 65535;  // per voxel

/// Of all values.
std::uint64_t sample_count(const ScanFile& scan) {
  return std::uint64_t{scan.grid.voxel_count()} * static_cast<std::uint64_t>(scan.inner) *
         static_cast<std::uint64_t>(scan.outer);
}

std::string size_text(const ScanFile& scan) {
  const auto& n = scan.grid.size;
  const std::string voxels = message(n[0], " x ", n[1], " x ", n[2]);
  const Index values = scan.inner * scan.outer;
  return values == 1 ? voxels : message(voxels, " x ", values);
}

template <class Stored>
Exact exact_value(Stored stored, const SampleSource& source, bool plain) {
  const auto exact = static_cast<Exact>(stored);
  return plain ? exact : source.slope * exact + source.intercept;
}

template <class Stored, class Number>
void convert(std::span<const unsigned char> bytes, const SampleSource& source, Number* out) {
  const bool plain = source.slope == 1 && source.intercept == 0;
  const bool rounds =
      std::same_as<Number, float> && may_be_rounded<Stored>(source.slope, source.intercept);
  RoundedSamples rounded;
  std::array<unsigned char, sizeof(Stored)> raw;
  for (std::size_t n = 0; n * sizeof(Stored) < bytes.size(); ++n) {
    std::memcpy(raw.data(), bytes.data() + n * sizeof(Stored), sizeof(Stored));
    if (source.big_endian) std::reverse(raw.begin(), raw.end());
    Stored stored;
    std::memcpy(&stored, raw.data(), sizeof(Stored));
    out[n] =
        plain ? static_cast<Number>(stored)
              : static_cast<Number>(source.slope * static_cast<double>(stored) + source.intercept);
    if (rounds) rounded.note(exact_value(stored, source, plain), static_cast<float>(out[n]));
  }
  if (rounds) note_rounded(rounded);
}

template <class Number>
void convert_any(std::span<const unsigned char> bytes, const SampleSource& source, Number* out) {
  with_number_type(source.type, [&](auto zero) { convert<decltype(zero)>(bytes, source, out); });
}

template <class Found>
[[noreturn]] void refuse_short(const ScanFile& scan, std::uint64_t expected, const Found& found,
                               const char* unit) {
  refuse(scan.source.file, message("expected ", expected, " ", unit, " for ", size_text(scan),
                                   " samples, found ", found));
}

/// How many samples lie together of which one is kept.
std::size_t group_size(const ScanFile& scan) {
  return static_cast<std::size_t>(scan.picked ? scan.inner : 1);
}

/// Of the bytes of whole groups those of the samples that are picked, moved to the front.
std::span<const unsigned char> picked_of(const ScanFile& scan, std::span<unsigned char> bytes) {
  const std::size_t group = group_size(scan);
  if (group == 1) return bytes;
  const std::size_t width = byte_size(scan.source.type);
  std::size_t kept = 0;
  const std::size_t first = static_cast<std::size_t>(scan.picked->inner) * width;
  for (std::size_t at = first; at < bytes.size(); at += group * width, kept += width) {
    std::memmove(&bytes[kept], &bytes[at], width);
  }
  return bytes.first(kept);
}

/// Calls visit(bytes) for the samples that are kept of the next `count` groups, block by block.
template <class Visit>
void read_binary(const ScanFile& scan, ByteSource& bytes, std::size_t count, const Visit& visit) {
  const std::size_t group = group_size(scan);
  const auto width = byte_size(scan.source.type) * group;
  std::vector<unsigned char> block(
      std::min(std::max<std::size_t>(kSamplesAtOnce / group, 1), count) * width);
  for (std::size_t done = 0; done < count;) {
    const std::size_t groups = std::min(block.size() / width, count - done);
    const std::size_t got = bytes.read(block.data(), groups * width);
    if (got < groups * width) {
      refuse_short(scan, std::uint64_t{count} * width, done * width + got, "bytes");
    }
    done += groups;
    visit(picked_of(scan, {block.data(), got}));
  }
}

double number_of(const ScanFile& scan, std::string_view word, std::size_t sample) {
  double value = 0;
  if (!parse_number(word, value)) {
    refuse(scan.source.file,
           message("expected a number as sample ", sample, ", found ", in_quotes(word)));
  }
  return scan.source.slope * value + scan.source.intercept;
}

/// Which numbers of a text are read.
class TextPick {
 public:
  explicit TextPick(const ScanFile& scan)
      : all_(!scan.picked),
        picked_(scan.picked.value_or(PickedValue{})),
        inner_(static_cast<std::size_t>(scan.inner)),
        volume_(scan.grid.voxel_count() * inner_) {}

  bool takes(std::size_t n) const {
    return all_ || (n / volume_ == static_cast<std::size_t>(picked_.outer) &&
                    n % inner_ == static_cast<std::size_t>(picked_.inner));
  }

 private:
  bool all_;
  PickedValue picked_;
  std::size_t inner_, volume_;
};

/// Calls visit(number) for each sample that is kept.
template <class Visit>
void read_text(const ScanFile& scan, ByteSource& bytes, const Visit& visit) {
  constexpr std::size_t kLongestNumber = 64;
  const std::size_t count = sample_count(scan);
  const TextPick pick(scan);
  std::size_t seen = 0;
  std::vector<char> block(kSamplesAtOnce);
  std::string word;
  for (bool more = true; more && seen < count;) {
    const std::size_t got = bytes.read(block.data(), block.size());
    more = got == block.size();
    if (!more) block[got] = ' ';  // the end of the data ends the last number
    for (std::size_t n = 0; n < (more ? got : got + 1) && seen < count; ++n) {
      const bool blank = block[n] == ' ' || (block[n] >= '\t' && block[n] <= '\r');
      if (!blank && word.size() < kLongestNumber) word += block[n];
      if (!blank || word.empty()) continue;
      if (pick.takes(seen)) visit(number_of(scan, word, seen));
      ++seen;
      word.clear();
    }
  }
  if (seen < count) refuse_short(scan, count, seen, "numbers");
}

/// Fewest bytes (unpacked) that the samples take; a number in text needs one and a blank.
std::uint64_t fewest_bytes(const ScanFile& scan) {
  const std::uint64_t count = sample_count(scan);
  return scan.source.text ? 2 * count - 1 : count * byte_size(scan.source.type);
}

[[noreturn]] void refuse_long(const ScanFile& scan) {
  refuse(scan.source.file, message("expected the data to end after ", fewest_bytes(scan),
                                   " bytes for ", size_text(scan), " samples, but they go on"));
}

[[noreturn]] void refuse_unplain(const ScanFile& scan, std::string_view found) {
  refuse(scan.file,
         message("expected uncompressed voxels, which can be read a slice at a time, found ", found,
                 "; unpack it, or run without --slabs"));
}

bool is_usable(double length) { return length > 0 && std::isfinite(length); }

/// The direction of an axis that a file leaves open: across the others, else along the world's.
Vec3 direction_across(const std::array<Vec3, 3>& all, std::size_t axis) {
  const Vec3 across = unit_or_zero(cross(all[(axis + 1) % 3], all[(axis + 2) % 3]));
  if (is_usable(norm(across))) return across;
  Vec3 along;
  along[static_cast<int>(axis)] = 1;
  return along;
}

/// What a file lacks, from the spacing that is given.
StatedAxes completed(ScanFile& scan, StatedAxes axes) {
  for (std::size_t a = 0; a < 3; ++a) {
    double& length = axes.spacing[static_cast<int>(a)];
    if (!is_usable(length)) {
      scan.warnings.push_back(message("the file's spacing along axis ", a, ", ", length,
                                      " mm, cannot be used: the one given is taken"));
      length = (*scan.given_spacing)[static_cast<int>(a)];
    }
    if (is_usable(norm(axes.direction[a]))) continue;
    axes.direction[a] = direction_across(axes.direction, a);
    scan.warnings.push_back(message("the file gives axis ", a, " no direction: across the others"));
  }
  return axes;
}

/// The samples that are kept.
std::uint64_t kept_count(const ScanFile& scan) {
  return scan.picked ? std::uint64_t{scan.grid.voxel_count()} : sample_count(scan);
}

/// Bytes from the first sample to that of the volume that is picked.
std::uint64_t bytes_before_picked(const ScanFile& scan) {
  if (!scan.picked) return 0;
  return std::uint64_t{scan.grid.voxel_count()} * static_cast<std::uint64_t>(scan.inner) *
         static_cast<std::uint64_t>(scan.picked->outer) * byte_size(scan.source.type);
}

/// Calls visit(bytes) for the groups that are kept, and skips what lies around them.
template <class Visit>
void read_picked(const ScanFile& scan, ByteSource& bytes, const Visit& visit) {
  const std::uint64_t before = bytes_before_picked(scan);
  if (const std::uint64_t there = bytes.skip(before); there < before) {
    refuse_short(scan, fewest_bytes(scan), there, "bytes");
  }
  read_binary(scan, bytes, kept_count(scan), visit);
  if (!scan.source.exact) return;
  const std::uint64_t read =
      before + kept_count(scan) * byte_size(scan.source.type) * group_size(scan);
  const std::uint64_t left = fewest_bytes(scan) - read;
  char beyond = 0;
  if (const std::uint64_t there = bytes.skip(left); there < left) {
    refuse_short(scan, fewest_bytes(scan), read + there, "bytes");
  }
  if (bytes.read(&beyond, 1) > 0) refuse_long(scan);
}

std::uint64_t bytes_before_last_samples(const ScanFile& scan) {
  ByteSource all(scan.source.file, scan.source.packing, scan.source.offset);
  const std::uint64_t total = all.skip(std::numeric_limits<std::uint64_t>::max());
  const std::uint64_t needed = fewest_bytes(scan);
  if (total < needed) refuse_short(scan, needed, total, "bytes");
  return total - needed;
}

/// The scan of one file of a list: some slices, or one of several volumes.
ScanFile scan_of_part(const ScanFile& scan, const std::filesystem::path& file) {
  const auto count = static_cast<Index>(std::min<std::size_t>(scan.parts.size(), kMostValues));
  ScanFile part = scan;
  part.parts.clear();
  part.source.file = part.file = file;
  part.outer = 1;
  if (part.picked) part.picked->outer = 0;
  if (scan.outer == 1 && scan.grid.size[2] % count == 0) {
    part.grid.size[2] /= count;
  } else if (scan.outer != count) {
    refuse(scan.file,
           message("expected files with equal numbers of slices, or one per volume, found ",
                   scan.parts.size(), " files for ", size_text(scan), " samples"));
  }
  return part;
}

std::vector<float> read_parts(const ScanFile& scan, MemoryBudget& budget) {
  const bool volumes = scan.outer > 1;
  std::vector<float> samples;
  reserve_within(budget, samples, kept_count(scan), "samples");
  for (std::size_t n = 0; n < scan.parts.size(); ++n) {
    if (volumes && scan.picked && n != static_cast<std::size_t>(scan.picked->outer)) continue;
    const ScopedFile scope(budget, scan.parts[n]);
    const std::vector<float> part = read_samples(scan_of_part(scan, scan.parts[n]), budget);
    samples.insert(samples.end(), part.begin(), part.end());
  }
  return samples;
}

}  // namespace

ScanFile begin_scan(const std::filesystem::path& file, const std::string& format,
                    const Opening& opening) {
  ScanFile scan{file, format, {}, {}, {}};
  scan.given_spacing = opening.spacing;
  scan.resample = opening.resample;
  return scan;
}

void set_size(ScanFile& scan, const std::array<std::int64_t, 3>& counts) {
  std::int64_t left = kMostSamples;
  for (std::size_t a = 0; a < 3; ++a) {
    if (counts[a] < 1 || counts[a] > std::numeric_limits<Index>::max()) {
      refuse(scan.file,
             message("expected 1 to 2147483647 voxels along axis ", a, ", found ", counts[a]));
    }
    left /= counts[a];
    scan.grid.size[a] = static_cast<Index>(counts[a]);
  }
  if (left < 1) refuse(scan.file, message("more voxels than can be read: ", size_text(scan)));
}

void set_values(ScanFile& scan, const ValueAxes& axes, ValueOrder order, const Opening& opening) {
  const auto [volumes, channels] = axes;
  const auto most =
      std::min(kMostSamples / static_cast<std::int64_t>(scan.grid.voxel_count()), kMostValues);
  if (std::min(volumes, channels) < 1 || volumes > most || channels > most / volumes) {
    refuse(scan.file, message("expected 1 to ", most, " values per voxel, found ",
                              volumes == 1 ? channels : volumes,
                              volumes == 1 || channels == 1 ? "" : message(" x ", channels)));
  }
  if (opening.values == Values::kMany && volumes > 1 && channels > 1) {
    refuse(scan.file, message("expected one axis of values beside space, found ", volumes,
                              " volumes of ", channels, " channels"));
  }
  const bool interleaved = order == ValueOrder::kChannelsFirst;
  scan.inner = static_cast<Index>(interleaved ? channels : 1);
  scan.outer = static_cast<Index>(interleaved ? volumes : volumes * channels);
  if (opening.values == Values::kMany) return;
  const TakenValue taken = take_value(scan.file, axes, opening.choice);
  const std::int64_t outer = interleaved ? taken.volume : taken.channel * volumes + taken.volume;
  scan.picked =
      PickedValue{static_cast<Index>(interleaved ? taken.channel : 0), static_cast<Index>(outer)};
}

StatedAxes StatedAxes::of_steps(const std::array<Vec3, 3>& steps) noexcept {
  return {steps, {norm(steps[0]), norm(steps[1]), norm(steps[2])}};
}

void set_stated_axes(ScanFile& scan, const StatedAxes& stated) {
  const StatedAxes usable = scan.given_spacing ? completed(scan, stated) : stated;
  for (std::size_t a = 0; a < 3; ++a) {
    const double length = usable.spacing[static_cast<int>(a)];
    if (!is_usable(length) || !is_usable(norm(usable.direction[a]))) {
      refuse(scan.file,
             message("expected a positive voxel spacing along axis ", a, ", found ",
                     is_usable(length) ? 0 : length, " mm (--spacing X,Y,Z replaces it)"));
    }
  }
  GridAxes axes;
  try {
    axes = grid_axes(usable.direction);
  } catch (const InputError& error) {
    if (!scan.resample)
      refuse(scan.file, message(error.what(), " (--resample interpolates such grids)"));
    scan.sheared.emplace();
    for (std::size_t a = 0; a < 3; ++a) {
      (*scan.sheared)[a] = usable.spacing[static_cast<int>(a)] * unit_or_zero(usable.direction[a]);
    }
  }
  if (!scan.sheared && axes.skew > kRoundingSkew) {
    scan.warnings.push_back(
        message("the voxel axes are not orthogonal (cosine ", axes.skew, "): made orthonormal"));
  }
  scan.grid.spacing = usable.spacing;
  scan.grid.direction = axes.direction;
}

void warn_of_bytes_behind(ScanFile& scan) {
  const SampleSource& source = scan.source;
  if (source.text || source.at_end || source.exact || !scan.parts.empty()) return;
  if (source.packing == Packing::kDeflated) return;
  const std::uint64_t samples = fewest_bytes(scan), begin = source.offset + source.skip;
  const std::uint64_t slice = samples / static_cast<std::uint64_t>(scan.grid.size[2]);
  std::error_code error;
  const std::uint64_t size = std::filesystem::file_size(source.file, error);
  if (error || size < begin || size - begin < samples + slice) return;
  scan.warnings.push_back(message("the file goes on for ", size - begin - samples,
                                  " bytes behind the samples that the header states"));
}

void set_axes(ScanFile& scan, const std::array<Vec3, 3>& steps) {
  set_stated_axes(scan, StatedAxes::of_steps(steps));
}

void set_origin(ScanFile& scan, const Vec3& origin) {
  for (int a = 0; a < 3; ++a) {
    if (!std::isfinite(origin[a])) {
      refuse(scan.file, message("expected a finite origin, found ", origin[a], " along axis ", a));
    }
  }
  scan.grid.origin = origin + Vec3{};  // -0 becomes 0
}

namespace {

template <class Number>
void append_any(std::span<const unsigned char> bytes, const SampleSource& source,
                std::vector<Number>& out) {
  const std::size_t begin = out.size();
  out.resize(begin + bytes.size() / byte_size(source.type));
  convert_any(bytes, source, out.data() + begin);
}

}  // namespace

void append_samples(std::span<const unsigned char> bytes, const SampleSource& source,
                    std::vector<float>& out) {
  append_any(bytes, source, out);
}

void append_samples(std::span<const unsigned char> bytes, const SampleSource& source,
                    std::vector<double>& out) {
  append_any(bytes, source, out);
}

namespace {

/// Skips what lies before the samples.
void go_to_samples(const ScanFile& scan, ByteSource& bytes) {
  const SampleSource& source = scan.source;
  const std::uint64_t skip = source.at_end ? bytes_before_last_samples(scan) : source.skip;
  const std::uint64_t needed = fewest_bytes(scan);
  if (needed > bytes.most_bytes()) {
    refuse_short(scan, needed,
                 message(source.packing == Packing::kPlain ? "" : "at most ", bytes.most_bytes()),
                 "bytes");
  }
  bytes.skip(skip);
}

}  // namespace

std::vector<float> read_samples(const ScanFile& scan, MemoryBudget& budget) {
  if (!scan.parts.empty()) return read_parts(scan, budget);
  ByteSource bytes(scan.source.file, scan.source.packing, scan.source.offset);
  go_to_samples(scan, bytes);
  std::vector<float> samples;
  reserve_within(budget, samples, kept_count(scan), "samples");
  if (scan.source.text) {
    RoundedSamples rounded;
    read_text(scan, bytes, [&](double value) {
      samples.push_back(static_cast<float>(value));
      rounded.note(value, samples.back());
    });
    note_rounded(rounded);
  } else {
    read_picked(scan, bytes, [&](auto block) { append_samples(block, scan.source, samples); });
  }
  return samples;
}

void visit_samples(const ScanFile& scan,
                   const std::function<void(std::span<const double>)>& visit) {
  for (const auto& part : scan.parts) visit_samples(scan_of_part(scan, part), visit);
  if (!scan.parts.empty()) return;
  ByteSource bytes(scan.source.file, scan.source.packing, scan.source.offset);
  go_to_samples(scan, bytes);
  std::vector<double> numbers;
  if (scan.source.text) {
    read_text(scan, bytes, [&](double value) { visit({&value, 1}); });
  } else {
    read_picked(scan, bytes, [&](std::span<const unsigned char> block) {
      numbers.resize(block.size() / byte_size(scan.source.type));
      convert_any(block, scan.source, numbers.data());
      visit(numbers);
    });
  }
}

std::uint64_t find_plain_samples(const ScanFile& scan) {
  const SampleSource& source = scan.source;
  if (source.text) refuse_unplain(scan, "numbers in text");
  if (!scan.parts.empty()) refuse_unplain(scan, "a list of files");
  const ByteSource bytes(source.file, source.packing, source.offset);
  if (bytes.is_packed()) {
    refuse_unplain(scan, source.packing == Packing::kSniffed ? "gzip" : "gzip or zlib");
  }
  const std::uint64_t there = bytes.most_bytes(), needed = fewest_bytes(scan);
  const std::uint64_t skip = std::min(source.skip, there);
  if (there - skip < needed) refuse_short(scan, needed, there - skip, "bytes");
  const std::uint64_t before = bytes_before_picked(scan);
  if (source.at_end) return source.offset + there - needed + before;
  if (source.exact && there - skip > needed) refuse_long(scan);
  return source.offset + skip + before;
}

void append_slices(const ScanFile& scan, std::uint64_t begin, const SliceRange& slices,
                   std::vector<float>& out) {
  const std::uint64_t before = scan.grid.offset(0, 0, slices.first);
  const std::uint64_t group = byte_size(scan.source.type) * static_cast<std::uint64_t>(scan.inner);
  ByteSource bytes(scan.source.file, Packing::kPlain, begin + before * group);
  read_binary(scan, bytes, scan.grid.offset(0, 0, slices.count),
              [&](auto block) { append_samples(block, scan.source, out); });
}

}  // namespace mesamis::detail::volume_files
