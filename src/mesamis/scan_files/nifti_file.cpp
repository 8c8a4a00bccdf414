// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <map>

#include "mesamis/files/refuse.h"
#include "mesamis/scan_files/formats.h"

namespace mesamis::detail {
namespace {

/// The fields of both header versions that matter here.
struct NiftiHeader {
  bool big_endian = false;
  std::size_t size = 0;  // in bytes
  std::array<std::int64_t, 8> dim{};
  std::array<double, 8> pixdim{};
  std::int64_t datatype = 0, units = 0, qform_code = 0, sform_code = 0;
  double vox_offset = 0, slope = 0, intercept = 0;
  std::array<double, 6> quatern{};  // b c d, then the offsets x y z
  std::array<double, 12> srow{};
};

/// Fields at byte positions, in the file's byte order.
class Fields {
 public:
  Fields(const std::vector<unsigned char>& bytes, bool big_endian)
      : bytes_(bytes), big_endian_(big_endian) {}
  template <class Stored>
  Stored at(std::size_t position) const {
    std::array<unsigned char, sizeof(Stored)> raw;
    std::memcpy(raw.data(), bytes_.data() + position, sizeof(Stored));
    if (big_endian_) std::reverse(raw.begin(), raw.end());
    Stored value;
    std::memcpy(&value, raw.data(), sizeof(Stored));
    return value;
  }
  template <class Stored, class Values>
  void fill(std::size_t position, Values& values) const {
    for (std::size_t n = 0; n < values.size(); ++n) {
      values[n] =
          static_cast<typename Values::value_type>(at<Stored>(position + n * sizeof(Stored)));
    }
  }

 private:
  const std::vector<unsigned char>& bytes_;
  bool big_endian_;
};

constexpr std::size_t kSize1 = 348, kSize2 = 540;

NiftiHeader parse_version_1(const Fields& f) {
  NiftiHeader h;
  f.fill<std::int16_t>(40, h.dim);
  h.datatype = f.at<std::int16_t>(70);
  f.fill<float>(76, h.pixdim);
  h.vox_offset = f.at<float>(108);
  h.slope = f.at<float>(112);
  h.intercept = f.at<float>(116);
  h.units = f.at<std::uint8_t>(123);
  h.qform_code = f.at<std::int16_t>(252);
  h.sform_code = f.at<std::int16_t>(254);
  f.fill<float>(256, h.quatern);
  f.fill<float>(280, h.srow);
  return h;
}

NiftiHeader parse_version_2(const Fields& f) {
  NiftiHeader h;
  h.datatype = f.at<std::int16_t>(12);
  f.fill<std::int64_t>(16, h.dim);
  f.fill<double>(104, h.pixdim);
  h.vox_offset = static_cast<double>(f.at<std::int64_t>(168));
  h.slope = f.at<double>(176);
  h.intercept = f.at<double>(184);
  h.qform_code = f.at<std::int32_t>(344);
  h.sform_code = f.at<std::int32_t>(348);
  f.fill<double>(352, h.quatern);
  f.fill<double>(400, h.srow);
  h.units = f.at<std::int32_t>(500) & 0xff;
  return h;
}

/// Finds version and byte order by the header's own size, its first field.
NiftiHeader read_header(const std::filesystem::path& file) {
  ByteSource bytes(file, Packing::kSniffed);
  std::vector<unsigned char> header(kSize2);
  header.resize(bytes.read(header.data(), header.size()));
  if (header.size() < kSize1) {
    refuse(file, say("expected a NIfTI header of ", kSize1, " bytes, found ", header.size()));
  }
  for (const bool big_endian : {false, true}) {
    const Fields fields(header, big_endian);
    const auto declared = fields.at<std::int32_t>(0);
    const std::size_t magic = declared == kSize1 ? 344 : 4;
    if (declared != kSize1 && (declared != kSize2 || header.size() < kSize2)) continue;
    const std::string found(reinterpret_cast<const char*>(header.data()) + magic, 3);
    if (found != (declared == kSize1 ? "n+1" : "n+2")) {
      refuse(file, say("expected the NIfTI magic n+1 or n+2, found ", in_quotes(found)));
    }
    NiftiHeader h = declared == kSize1 ? parse_version_1(fields) : parse_version_2(fields);
    h.big_endian = big_endian;
    h.size = static_cast<std::size_t>(declared);
    h.vox_offset = h.vox_offset == 0 ? (declared == kSize1 ? 352 : 544) : h.vox_offset;
    return h;
  }
  refuse(file, "expected a NIfTI header (first field 348 or 540), found neither");
}

NumberType sample_type(const std::filesystem::path& file, std::int64_t code) {
  static const std::map<std::int64_t, NumberType> kTypes{
      {2, NumberType::kUint8},    {4, NumberType::kInt16},    {8, NumberType::kInt32},
      {16, NumberType::kFloat32}, {64, NumberType::kFloat64}, {256, NumberType::kInt8},
      {512, NumberType::kUint16}, {768, NumberType::kUint32}, {1024, NumberType::kInt64},
      {1280, NumberType::kUint64}};
  static const std::map<std::int64_t, const char*> kRefused{
      {1, "1-bit"},      {32, "complex"},   {128, "RGB"},  {1536, "128-bit"},
      {1792, "complex"}, {2048, "complex"}, {2304, "RGBA"}};
  const auto type = kTypes.find(code);
  if (type != kTypes.end()) return type->second;
  const auto known = kRefused.find(code);
  refuse(file, say("expected one real number per voxel, found NIfTI data type ", code,
                   known == kRefused.end() ? "" : say(" (", known->second, ")")));
}

void set_dimensions(ScanFile& scan, const NiftiHeader& h, Values values) {
  const std::filesystem::path& file = scan.file;
  if (h.dim[0] < 3 || h.dim[0] > 7) {
    refuse(file, say("expected a 3-D image, found ", h.dim[0], " dimensions"));
  }
  const auto dimensions = static_cast<std::size_t>(h.dim[0]);
  // Probabilities lie along the fourth axis, or along the fifth, the standard's for vectors.
  std::int64_t volumes = 1;
  for (std::size_t d = 4; d <= dimensions; ++d) {
    if (values == Values::kMany && volumes == 1 && d <= 5) {
      volumes = h.dim[d];
    } else if (h.dim[d] != 1) {
      refuse(file, say("expected a 3-D image, found ", h.dim[0], "-D with ", h.dim[d],
                       " values along dimension ", d));
    }
  }
  set_size(scan, {h.dim[1], h.dim[2], h.dim[3]});
  set_values(scan, 1, volumes);
}

double unit_in_mm(std::int64_t units) {
  const auto length = units & 7;
  return length == 1 ? 1000 : length == 3 ? 0.001 : 1;
}

/// The rotation of the quaternion (b, c, d), by columns; the standard's formulas.
std::array<Vec3, 3> quaternion_columns(double b, double c, double d) {
  double a = 1 - (b * b + c * c + d * d);
  if (a < 1e-7) {  // a half turn, up to rounding
    const double scale = 1 / std::sqrt(b * b + c * c + d * d);
    b *= scale, c *= scale, d *= scale, a = 0;
  }
  a = std::sqrt(a);
  return {Vec3{a * a + b * b - c * c - d * d, 2 * (b * c + a * d), 2 * (b * d - a * c)},
          Vec3{2 * (b * c - a * d), a * a + c * c - b * b - d * d, 2 * (c * d + a * b)},
          Vec3{2 * (b * d + a * c), 2 * (c * d - a * b), a * a + d * d - b * b - c * c}};
}

/// Steps along the axes and origin, in the file's frame (RAS) and unit.
struct Placement {
  std::array<Vec3, 3> steps;
  Vec3 origin;
};

Placement from_sform(const NiftiHeader& h) {
  const auto column = [&h](std::size_t c) { return Vec3{h.srow[c], h.srow[4 + c], h.srow[8 + c]}; };
  return {{column(0), column(1), column(2)}, column(3)};
}

Placement from_qform(const NiftiHeader& h) {
  auto steps = quaternion_columns(h.quatern[0], h.quatern[1], h.quatern[2]);
  const double qfac = h.pixdim[0] < 0 ? -1 : 1;
  for (std::size_t a = 0; a < 3; ++a) {
    steps[a] = (std::abs(h.pixdim[a + 1]) * (a == 2 ? qfac : 1)) * steps[a];
  }
  return {steps, {h.quatern[3], h.quatern[4], h.quatern[5]}};
}

Placement without_form(const NiftiHeader& h) {
  return {{Vec3{std::abs(h.pixdim[1]), 0, 0}, Vec3{0, std::abs(h.pixdim[2]), 0},
           Vec3{0, 0, std::abs(h.pixdim[3])}},
          {}};
}

void place(ScanFile& scan, const NiftiHeader& h) {
  const bool placed = h.sform_code > 0 || h.qform_code > 0;
  Placement p = h.sform_code > 0 ? from_sform(h) : placed ? from_qform(h) : without_form(h);
  if (!placed) {
    scan.warnings.push_back("no orientation (sform and qform codes are 0): axes taken as RAS");
  }
  const double mm = unit_in_mm(h.units);
  const auto to_lps = [mm](const Vec3& v) { return Vec3{-mm * v.x, -mm * v.y, mm * v.z}; };
  for (Vec3& step : p.steps) step = to_lps(step);
  set_axes(scan, p.steps);
  set_origin(scan, to_lps(p.origin));
  for (int a = 0; a < 3; ++a) {
    const double declared = mm * std::abs(h.pixdim[static_cast<std::size_t>(a) + 1]);
    if (std::abs(scan.grid.spacing[a] - declared) > 0.01 * scan.grid.spacing[a]) {
      scan.warnings.push_back(say("pixdim says ", declared, " mm along axis ", a, ", the sform ",
                                  scan.grid.spacing[a], ": the sform is used"));
    }
  }
}

}  // namespace

ScanFile open_nifti(const std::filesystem::path& file, const Opening& opening) {
  const NiftiHeader h = read_header(file);
  ScanFile scan{file, "NIfTI", {}, {}, {}};
  set_dimensions(scan, h, opening.values);
  if (!(h.vox_offset >= static_cast<double>(kSize1)) || h.vox_offset > 1e15) {
    refuse(file, say("expected the samples behind the header, found vox_offset ", h.vox_offset));
  }
  place(scan, h);
  scan.source.file = file;
  scan.source.type = sample_type(file, h.datatype);
  scan.source.big_endian = h.big_endian;
  scan.source.packing = Packing::kSniffed;
  scan.source.skip = static_cast<std::uint64_t>(h.vox_offset);
  if (h.slope != 0 && std::isfinite(h.slope)) {
    scan.source.slope = h.slope;
    scan.source.intercept = std::isfinite(h.intercept) ? h.intercept : 0;
  }
  return scan;
}

std::vector<std::string> nifti_extensions(const std::filesystem::path& file, MemoryBudget& budget) {
  constexpr std::uint64_t kMostBytes = 1 << 24;
  const NiftiHeader h = read_header(file);
  ByteSource bytes(file, Packing::kSniffed);
  std::array<char, 8> begin{};  // first the flag of four bytes, then size and code of each
  bytes.skip(h.size);
  if (bytes.read(begin.data(), 4) < 4 || begin[0] == 0) return {};
  std::vector<std::string> extensions;
  const ByteOrder order = h.big_endian ? ByteOrder::kBig : ByteOrder::kLittle;
  for (double at = static_cast<double>(h.size) + 4; at + 8 <= h.vox_offset;) {
    if (bytes.read(begin.data(), 8) < 8) break;
    const auto size = load<std::int32_t>(begin.data(), order);
    if (size < 8 || at + size > h.vox_offset || size > static_cast<std::int64_t>(kMostBytes)) {
      refuse(file, say("expected a header extension of 8 to ", kMostBytes,
                       " bytes before the samples, found ", size));
    }
    budget.claim(1, static_cast<std::uint64_t>(size), "header extensions");
    std::string content(static_cast<std::size_t>(size) - 8, '\0');
    content.resize(bytes.read(content.data(), content.size()));
    append_within(budget, extensions, std::move(content), "header extensions");
    at += size;
  }
  return extensions;
}

}  // namespace mesamis::detail
