// SPDX-License-Identifier: Apache-2.0
#include "mesamis/volume_files/spm_matrix.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <system_error>
#include <utility>

#include "mesamis/files/byte_source.h"
#include "mesamis/files/bytes.h"
#include "mesamis/files/number_type.h"
#include "mesamis/files/refuse.h"

namespace mesamis::detail::volume_files {
namespace {

namespace fs = std::filesystem;

constexpr int kMostVariables = 1000;
constexpr std::size_t kLevel5Header = 128, kMatrixSize = 16;

/// Bytes of a MATLAB file in turn.
class MatlabBytes {
 public:
  MatlabBytes(const fs::path& file, Packing packing, std::uint64_t offset, ByteOrder order)
      : file_(file), bytes_(file, packing, offset), order_(order) {}

  /// The next n bytes, or none at the end.
  std::string take_or_end(std::size_t n) {
    std::string taken(n, '\0');
    const std::size_t got = bytes_.read(taken.data(), n);
    if (got > 0 && got < n) refuse_cut();
    taken.resize(got);
    return taken;
  }
  std::string take(std::size_t n) {
    std::string taken = take_or_end(n);
    if (taken.size() < n) refuse_cut();
    return taken;
  }
  void skip(std::uint64_t n) {
    if (bytes_.skip(n) < n) refuse_cut();
  }
  template <class Number>
  Number number(const std::string& from, std::size_t at) const {
    return load<Number>(from.data() + at, order_);
  }
  const fs::path& file() const { return file_; }
  ByteOrder order() const { return order_; }

 private:
  [[noreturn]] void refuse_cut() const { refuse(file_, "the MATLAB file is cut off"); }

  const fs::path& file_;
  ByteSource bytes_;
  ByteOrder order_;
};

/// A variable whose numbers come next.
struct MatlabMatrix {
  std::string name;
  std::int64_t rows = 0, columns = 0, count = 1;
  bool real = true;
};

bool is_place(const std::string& name) { return name == "mat" || name == "M"; }

/// Columns of a matrix for voxels from 1.
SpmMatrix placed_by(const fs::path& file, const std::array<double, kMatrixSize>& m, double side) {
  const bool finite = std::all_of(m.begin(), m.end(), [](double v) { return std::isfinite(v); });
  if (!finite || m[3] != 0 || m[7] != 0 || m[11] != 0 || m[15] != 1) {
    refuse(file, "expected a finite matrix whose last row is 0 0 0 1");
  }
  const auto column = [&](std::size_t c) {
    return Vec3{side * m[4 * c], m[4 * c + 1], m[4 * c + 2]};
  };
  SpmMatrix placed{{column(0), column(1), column(2)}, column(3)};
  for (const Vec3& step : placed.steps) placed.origin = placed.origin + step;
  return placed;
}

SpmMatrix read_matrix(MatlabBytes& bytes, const MatlabMatrix& matrix, NumberType type,
                      std::int64_t volume) {
  if (matrix.rows != 4 || matrix.columns != 4 || matrix.count < 1 || !matrix.real) {
    refuse(bytes.file(),
           message("expected ", matrix.name, " to be a real matrix of 4 x 4, found ",
                   matrix.real ? "" : "a complex one of ", matrix.rows, " x ", matrix.columns));
  }
  const std::size_t width = byte_size(type);
  const auto chosen = static_cast<std::uint64_t>(volume < matrix.count ? volume : 0);
  bytes.skip(chosen * kMatrixSize * width);
  const std::string stored = bytes.take(kMatrixSize * width);
  std::array<double, kMatrixSize> values{};
  for (std::size_t n = 0; n < kMatrixSize; ++n) {
    values[n] = load_number(stored.data() + n * width, type, bytes.order());
  }
  SpmMatrix placed = placed_by(bytes.file(), values, matrix.name == "M" ? -1 : 1);
  placed.count = matrix.count;
  return placed;
}

/// What was found so far: `mat` counts before `M`.
struct FoundMatrix {
  std::optional<SpmMatrix> place;
  bool complete = false;

  void add(const std::string& name, const SpmMatrix& matrix) {
    if (complete) return;
    place = matrix;
    complete = name == "mat";
  }
};

[[noreturn]] void refuse_variable(const fs::path& file) {
  refuse(file, "the MATLAB file has a variable that is broken");
}

NumberType level_4_type(const fs::path& file, int digit) {
  constexpr std::array kTypes{NumberType::kFloat64, NumberType::kFloat32, NumberType::kInt32,
                              NumberType::kInt16,   NumberType::kUint16,  NumberType::kUint8};
  if (digit >= static_cast<int>(kTypes.size())) refuse_variable(file);
  return kTypes[static_cast<std::size_t>(digit)];
}

/// The first number of a level 4 file, in either order, has the digits of order, 0, type and kind.
bool is_level_4(std::int32_t code) { return code >= 0 && code < 5000 && code % 1000 < 60; }

FoundMatrix read_level_4(const fs::path& file, ByteOrder order, std::int64_t volume) {
  constexpr std::size_t kHeader = 20;
  constexpr std::int32_t kLongestName = 1024;
  MatlabBytes bytes(file, Packing::kPlain, 0, order);
  FoundMatrix found;
  for (int n = 0; n < kMostVariables && !found.complete; ++n) {
    const std::string header = bytes.take_or_end(kHeader);
    if (header.empty()) break;
    const auto field = [&](std::size_t at) { return bytes.number<std::int32_t>(header, 4 * at); };
    const std::int32_t rows = field(1), columns = field(2), length = field(4);
    if (!is_level_4(field(0)) || rows < 0 || columns < 0 || length < 1 || length > kLongestName) {
      refuse_variable(file);
    }
    const std::string name(trimmed(bytes.take(static_cast<std::size_t>(length))));
    const NumberType type = level_4_type(file, field(0) % 100 / 10);
    const bool real = field(3) == 0;
    const auto numbers = static_cast<std::uint64_t>(rows) * static_cast<std::uint64_t>(columns);
    if (is_place(name) && field(0) % 10 == 0) {
      found.add(name, read_matrix(bytes, {name, rows, columns, 1, real}, type, volume));
    } else {
      bytes.skip(numbers * byte_size(type) * (real ? 1 : 2));
    }
  }
  return found;
}

/// The tag of an element; the data of a small one are in it.
struct MatlabTag {
  std::uint32_t type = 0, size = 0;
  std::optional<std::string> small;

  std::uint64_t padded() const { return (std::uint64_t{size} + 7) / 8 * 8; }
};

MatlabTag take_tag(MatlabBytes& bytes, const std::string& raw) {
  const auto first = bytes.number<std::uint32_t>(raw, 0);
  const std::uint32_t small = first >> 16;
  if (small == 0) return {first, bytes.number<std::uint32_t>(raw, 4), {}};
  if (small > 4) refuse_variable(bytes.file());
  return {first & 0xffff, small, raw.substr(4, small)};
}

/// The data of an element within a variable.
std::string take_element(MatlabBytes& bytes) {
  constexpr std::uint64_t kMostBytes = 1024;  // of flags, sizes and a name
  const MatlabTag tag = take_tag(bytes, bytes.take(8));
  if (tag.small) return *tag.small;
  if (tag.size > kMostBytes) refuse_variable(bytes.file());
  return bytes.take(static_cast<std::size_t>(tag.padded())).substr(0, tag.size);
}

NumberType level_5_type(const fs::path& file, std::uint32_t code) {
  constexpr std::array kTypes{
      std::pair{1, NumberType::kInt8},    std::pair{2, NumberType::kUint8},
      std::pair{3, NumberType::kInt16},   std::pair{4, NumberType::kUint16},
      std::pair{5, NumberType::kInt32},   std::pair{6, NumberType::kUint32},
      std::pair{7, NumberType::kFloat32}, std::pair{9, NumberType::kFloat64},
      std::pair{12, NumberType::kInt64},  std::pair{13, NumberType::kUint64}};
  for (const auto& [known, type] : kTypes) {
    if (code == static_cast<std::uint32_t>(known)) return type;
  }
  refuse_variable(file);
}

/// A variable of level 5 from its flags on; what is no place is left where it is.
void read_variable(MatlabBytes& bytes, std::int64_t volume, FoundMatrix& found) {
  constexpr std::uint32_t kComplex = 0x800, kClass = 0xff, kFirstNumeric = 6;
  const std::string flags = take_element(bytes), sizes = take_element(bytes),
                    name = take_element(bytes);
  if (!is_place(name) || flags.size() < 8) return;
  const auto flag = bytes.number<std::uint32_t>(flags, 0);
  if ((flag & kClass) < kFirstNumeric) return;
  if (sizes.size() < 8) refuse_variable(bytes.file());
  MatlabMatrix matrix{name, 0, 0, 1, (flag & kComplex) == 0};
  matrix.rows = bytes.number<std::int32_t>(sizes, 0);
  matrix.columns = bytes.number<std::int32_t>(sizes, 4);
  if (sizes.size() >= 12) matrix.count = bytes.number<std::int32_t>(sizes, 8);
  const MatlabTag tag = take_tag(bytes, bytes.take(8));
  const NumberType type = level_5_type(bytes.file(), tag.type);
  const std::uint64_t width = kMatrixSize * byte_size(type);
  if (tag.small || matrix.count < 1 ||
      tag.size / width < static_cast<std::uint64_t>(matrix.count)) {
    refuse(bytes.file(),
           message("expected ", name, " to be a real matrix of 4 x 4, found ", tag.size, " bytes"));
  }
  found.add(name, read_matrix(bytes, matrix, type, volume));
}

FoundMatrix read_level_5(const fs::path& file, ByteOrder order, std::int64_t volume) {
  constexpr std::uint32_t kMatrix = 14, kCompressed = 15;
  FoundMatrix found;
  std::uint64_t at = kLevel5Header;
  for (int n = 0; n < kMostVariables && !found.complete; ++n) {
    MatlabBytes bytes(file, Packing::kPlain, at, order);
    const std::string raw = bytes.take_or_end(8);
    if (raw.empty()) break;
    const MatlabTag tag = take_tag(bytes, raw);
    at += 8;
    if (tag.type == kCompressed) {
      MatlabBytes packed(file, Packing::kDeflated, at, order);
      if (take_tag(packed, packed.take(8)).type == kMatrix) read_variable(packed, volume, found);
    } else if (tag.type == kMatrix) {
      read_variable(bytes, volume, found);
    }
    if (tag.small) continue;
    at += tag.type == kCompressed ? tag.size : tag.padded();
    std::error_code ignored;
    if (at >= fs::file_size(file, ignored)) break;
  }
  return found;
}

FoundMatrix read_any_level(const fs::path& file, std::int64_t volume) {
  const auto size = static_cast<std::size_t>(
      std::min<std::uint64_t>(fs::file_size(file), std::uint64_t{kLevel5Header}));
  const std::string begin = MatlabBytes(file, Packing::kPlain, 0, ByteOrder::kLittle).take(size);
  if (begin.starts_with("MATLAB 7.3")) {
    refuse(file, "a MATLAB file of version 7.3 (HDF5); versions 4 to 7 are read");
  }
  if (begin.starts_with("MATLAB") && size == kLevel5Header) {
    const bool big = begin.ends_with("MI");
    if (big || begin.ends_with("IM")) {
      return read_level_5(file, big ? ByteOrder::kBig : ByteOrder::kLittle, volume);
    }
  }
  for (const ByteOrder order : {ByteOrder::kLittle, ByteOrder::kBig}) {
    if (begin.size() >= 20 && is_level_4(load<std::int32_t>(begin.data(), order))) {
      return read_level_4(file, order, volume);
    }
  }
  refuse(file, "expected a MATLAB file of version 4 to 7, found another one");
}

}  // namespace

std::optional<SpmMatrix> read_spm_matrix(const fs::path& file, std::int64_t volume) {
  std::error_code ignored;
  if (!fs::is_regular_file(file, ignored) || fs::file_size(file) == 0) return {};
  const FoundMatrix found = read_any_level(file, volume);
  if (!found.place) refuse(file, "expected a matrix `mat` or `M`, found neither");
  return found.place;
}

}  // namespace mesamis::detail::volume_files
