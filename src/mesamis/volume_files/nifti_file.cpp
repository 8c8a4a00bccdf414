// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <map>
#include <system_error>

#include "mesamis/files/length_unit.h"
#include "mesamis/files/refuse.h"
#include "mesamis/volume_files/formats.h"
#include "mesamis/volume_files/spm_matrix.h"

namespace mesamis::detail::volume_files {
namespace {

/// What Analyze 7.5 has where NIfTI has other fields.
struct AnalyzeHeader {
  std::string unit;                      // of length
  std::array<double, 2> shown{};         // cal_max and cal_min: values of ...
  std::array<std::int64_t, 2> stored{};  // ... glmax and glmin
  int orient = 0;                        // 0: axial slices, as SPM and others write
  std::array<std::int64_t, 3> origin{};  // SPM's: the voxel at 0, counted from 1; or zeros
};

/// The fields of both header versions that matter here.
struct NiftiHeader {
  bool big_endian = false;
  std::size_t size = 0;  // in bytes
  std::array<std::int64_t, 8> dim{};
  std::array<double, 8> pixdim{};
  std::int64_t datatype = 0, bitpix = 0, units = 0, qform_code = 0, sform_code = 0;
  double vox_offset = 0, slope = 0, intercept = 0;
  std::array<double, 6> quatern{};  // b c d, then the offsets x y z
  std::array<double, 12> srow{};
  std::optional<AnalyzeHeader> analyze;  // 7.5: no magic, and no forms
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
  h.bitpix = f.at<std::int16_t>(72);
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

AnalyzeHeader parse_analyze(const Fields& f) {
  AnalyzeHeader h;
  for (std::size_t n = 0; n < 4; ++n) h.unit += static_cast<char>(f.at<std::uint8_t>(56 + n));
  h.unit = std::string(trimmed(h.unit.substr(0, h.unit.find('\0'))));
  f.fill<float>(124, h.shown);
  f.fill<std::int32_t>(140, h.stored);
  h.orient = f.at<std::uint8_t>(252);
  f.fill<std::int16_t>(253, h.origin);
  return h;
}

NiftiHeader parse_version_2(const Fields& f) {
  NiftiHeader h;
  h.datatype = f.at<std::int16_t>(12);
  h.bitpix = f.at<std::int16_t>(14);
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

/// What a header says that it is: "n+1" and "n+2" in one file with the samples, "ni1" and "ni2"
/// beside them, anything else beside them Analyze.
std::string magic_of(const std::vector<unsigned char>& header, bool first_version) {
  return std::string(reinterpret_cast<const char*>(header.data()) + (first_version ? 344 : 4), 3);
}

/// Finds version and byte order by the header's own size, its first field.
/// @param pair  whether the samples lie in a file beside it.
NiftiHeader read_header(const std::filesystem::path& file, bool pair) {
  ByteSource bytes(file, Packing::kSniffed);
  std::vector<unsigned char> header(kSize2);
  header.resize(bytes.read(header.data(), header.size()));
  if (header.size() < kSize1) {
    refuse(file, message("expected a NIfTI header of ", kSize1, " bytes, found ", header.size()));
  }
  for (const bool big_endian : {false, true}) {
    const Fields fields(header, big_endian);
    const auto declared = fields.at<std::int32_t>(0);
    const bool first = declared == kSize1;
    if (!first && (declared != kSize2 || header.size() < kSize2)) continue;
    const std::string found = magic_of(header, first), wanted = pair ? "ni" : "n+";
    const bool analyze = pair && first && !found.starts_with("n");
    if (!analyze && found != wanted + (first ? "1" : "2")) {
      refuse(file, message("expected the NIfTI magic ", wanted, first ? "1" : "2", ", found ",
                           in_quotes(found)));
    }
    NiftiHeader h = first ? parse_version_1(fields) : parse_version_2(fields);
    h.big_endian = big_endian;
    if (analyze) h.analyze = parse_analyze(fields);
    h.size = static_cast<std::size_t>(declared);
    if (h.vox_offset == 0 && !pair) h.vox_offset = first ? 352 : 544;
    return h;
  }
  refuse(file, "expected a NIfTI header (first field 348 or 540), found neither");
}

/// Where header and samples lie.
struct NiftiFiles {
  std::filesystem::path header, samples;
  bool pair() const { return header != samples; }
};

/// The name with another extension in place of .hdr, .img, .hdr.gz or .img.gz; gzip'd if that alone
/// is there.
std::filesystem::path beside(std::filesystem::path file, const char* extension) {
  if (lower_extension(file) == ".gz") file.replace_extension();
  file.replace_extension(extension);
  std::filesystem::path packed = file;
  packed += ".gz";
  std::error_code ignored;
  return !std::filesystem::exists(file, ignored) && std::filesystem::exists(packed, ignored)
             ? packed
             : file;
}

NiftiFiles files_of(const std::filesystem::path& file) {
  std::filesystem::path plain = file;
  if (lower_extension(plain) == ".gz") plain.replace_extension();
  const std::string extension = lower_extension(plain);
  if (extension == ".hdr") return {file, beside(file, ".img")};
  if (extension == ".img") return {beside(file, ".hdr"), file};
  return {file, file};
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
  refuse(file, message("expected one real number per voxel, found NIfTI data type ", code,
                       known == kRefused.end() ? "" : message(" (", known->second, ")")));
}

/// Volumes lie along the fourth axis, the components of a voxel along the fifth.
void set_dimensions(ScanFile& scan, const NiftiHeader& h, const Opening& opening) {
  if (h.dim[0] < 3 || h.dim[0] > 7) {
    refuse(scan.file, message("expected a 3-D image, found ", h.dim[0], " dimensions"));
  }
  const auto dimensions = static_cast<std::size_t>(h.dim[0]);
  // 0 along an axis that is no more than named counts as 1, as in other readers.
  const auto count = [&](std::size_t axis) {
    return axis > dimensions || h.dim[axis] == 0 ? 1 : h.dim[axis];
  };
  for (std::size_t axis = 6; axis <= dimensions; ++axis) {
    if (count(axis) == 1) continue;
    refuse(scan.file, message("expected a 3-D image, found ", h.dim[0], "-D with ", h.dim[axis],
                              " values along dimension ", axis));
  }
  set_size(scan, {h.dim[1], h.dim[2], h.dim[3]});
  set_values(scan, {count(4), count(5)}, ValueOrder::kVolumesFirst, opening);
}

/// Lengths of a unit that is not stated are mm, as other readers take them.
double unit_in_mm(ScanFile& scan, std::int64_t units) {
  const auto length = units & 7;
  if (length > 3) {
    scan.warnings.push_back(message("the unit of length ", length, " is unknown: mm assumed"));
  }
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

/// Axes and origin, in the file's frame (RAS) and unit.
struct Placement {
  StatedAxes axes;
  Vec3 origin;
};

Placement from_sform(const NiftiHeader& h) {
  const auto column = [&h](std::size_t c) { return Vec3{h.srow[c], h.srow[4 + c], h.srow[8 + c]}; };
  return {StatedAxes::of_steps({column(0), column(1), column(2)}), column(3)};
}

Vec3 stated_spacing(const NiftiHeader& h) {
  return {std::abs(h.pixdim[1]), std::abs(h.pixdim[2]), std::abs(h.pixdim[3])};
}

Placement from_qform(const NiftiHeader& h) {
  auto columns = quaternion_columns(h.quatern[0], h.quatern[1], h.quatern[2]);
  if (h.pixdim[0] < 0) columns[2] = -1 * columns[2];
  return {{columns, stated_spacing(h)}, {h.quatern[3], h.quatern[4], h.quatern[5]}};
}

constexpr std::array<Vec3, 3> kRas{Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}},
    kLas{Vec3{-1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}};

Placement without_form(const NiftiHeader& h) { return {{kRas, stated_spacing(h)}, {}}; }

bool is_length(double length) { return length > 0 && std::isfinite(length); }

bool has_axes(const Placement& p) {
  return is_length(p.axes.spacing.x) && is_length(p.axes.spacing.y) && is_length(p.axes.spacing.z);
}

/// The largest angle between an axis and the same one of the other placement.
double angle_between_deg(const Placement& a, const Placement& b) {
  double angle = 0;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const Vec3 &u = a.axes.direction[axis], &v = b.axes.direction[axis];
    angle = std::max(angle, std::atan2(norm(cross(u, v)), dot(u, v)));
  }
  return angle * 45 / std::atan(1);
}

/// The step from voxel to voxel along an axis.
Vec3 step_along(const Placement& p, std::size_t axis) {
  return p.axes.spacing[static_cast<int>(axis)] * unit_or_zero(p.axes.direction[axis]);
}

/// The greatest distance between the places of a voxel.
double farthest(const ScanFile& scan, const Placement& a, const SpmMatrix& b) {
  double most = 0;
  for (unsigned corner = 0; corner < 8; ++corner) {
    Vec3 apart = b.origin - a.origin;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      if ((corner >> axis & 1) == 0) continue;
      apart = apart +
              static_cast<double>(scan.grid.size[axis] - 1) * (b.steps[axis] - step_along(a, axis));
    }
    most = std::max(most, norm(apart));
  }
  return most;
}

double least_spacing(const Placement& p) {
  return std::min({p.axes.spacing.x, p.axes.spacing.y, p.axes.spacing.z});
}

/// Where the forms turn the axes alike but put voxels elsewhere, or do not.
void warn_of_forms(ScanFile& scan, const Placement& sform, const Placement& qform) {
  constexpr double kSameDeg = 0.1, kSame = 0.01;  // of the smallest spacing
  const double angle = angle_between_deg(sform, qform);
  if (angle > kSameDeg) {
    scan.warnings.push_back(message("qform and sform turn the axes differently, by ", angle,
                                    " degrees: the sform is used"));
    return;
  }
  const double apart =
      farthest(scan, sform,
               {{step_along(qform, 0), step_along(qform, 1), step_along(qform, 2)}, qform.origin});
  if (!has_axes(qform) || apart <= kSame * least_spacing(sform)) return;
  scan.warnings.push_back(
      message("the qform puts voxels up to ", apart, " mm elsewhere: the sform is used"));
}

/// The matrix of SPM beside an image.
std::filesystem::path matrix_beside(std::filesystem::path file) {
  if (lower_extension(file) == ".gz") file.replace_extension();
  return file.replace_extension(".mat");
}

std::optional<SpmMatrix> matrix_of(const ScanFile& scan) {
  return read_spm_matrix(matrix_beside(scan.file), scan.picked ? scan.picked->outer : 0);
}

/// The voxel at 0 where Analyze states no place: the one that SPM has noted, else the middle.
Vec3 zero_voxel(const NiftiHeader& h) {
  const auto& noted = h.analyze->origin;
  bool any = false, near = true;
  Vec3 middle, voxel;
  for (std::size_t a = 0; a < 3; ++a) {
    const std::int64_t n = h.dim[a + 1];
    any = any || noted[a] != 0;
    near = near && noted[a] > -n && noted[a] < 2 * n;
    middle[static_cast<int>(a)] = static_cast<double>(n - 1) / 2;
    voxel[static_cast<int>(a)] = static_cast<double>(noted[a] - 1);
  }
  return any && near ? voxel : middle;
}

Placement without_matrix(ScanFile& scan, const NiftiHeader& h) {
  scan.warnings.push_back(
      "Analyze 7.5 states no orientation: axes taken as LAS; sides may be exchanged");
  if (h.analyze->orient != 0) {
    scan.warnings.push_back(message("the slices have orientation ", h.analyze->orient,
                                    " of Analyze 7.5, which is not axial: they are not turned"));
  }
  const Vec3 zero = zero_voxel(h), spacing = stated_spacing(h);
  Placement placed{{kLas, spacing}, {}};
  for (int a = 0; a < 3; ++a) {
    const double step = spacing[a] * kLas[static_cast<std::size_t>(a)][a];
    if (std::isfinite(step)) placed.origin[a] = -zero[a] * step;
  }
  return placed;
}

/// Analyze 7.5, which states no orientation: the matrix of SPM beside it, if there is one.
Placement place_analyze(ScanFile& scan, const NiftiHeader& h) {
  try {
    const auto matrix = matrix_of(scan);
    if (matrix) return {StatedAxes::of_steps(matrix->steps), matrix->origin};
  } catch (const InputError& error) {
    scan.warnings.push_back(message("no position from ", error.what()));
  }
  return without_matrix(scan, h);
}

/// The sform where its code is above 0 and it has axes, else the qform. Neither where the user gives
/// the spacing that both lack.
Placement choose_placement(ScanFile& scan, const NiftiHeader& h) {
  const bool has_sform = h.sform_code > 0, has_qform = h.qform_code > 0;
  if (!has_sform && !has_qform) {
    scan.warnings.push_back("no orientation (sform and qform codes are 0): axes taken as RAS");
    return without_form(h);
  }
  if (!has_sform) return from_qform(h);
  const Placement sform = from_sform(h), qform = from_qform(h);
  if (!has_axes(sform) && (has_qform || scan.given_spacing)) {
    scan.warnings.push_back(message("the sform has an axis of length 0 or none: ",
                                    has_qform ? "the qform is used" : "axes taken as RAS"));
    return has_qform ? qform : without_form(h);
  }
  if (!has_qform) return sform;
  warn_of_forms(scan, sform, qform);
  return sform;
}

/// Where the axes are not those of pixdim.
void warn_of_spacing(ScanFile& scan, const Vec3& declared, const char* used_in_place) {
  for (int a = 0; a < 3; ++a) {
    const double used = scan.grid.spacing[a];
    if (!is_length(declared[a]) || std::abs(used - declared[a]) <= 0.01 * used) continue;
    scan.warnings.push_back(message("pixdim states ", declared[a], " mm along axis ", a, ", ",
                                    used_in_place, " ", used, ": ", used_in_place, " is used"));
  }
}

/// SPM takes the matrix beside a NIfTI file for its place; the header counts for other programs.
void warn_of_matrix(ScanFile& scan, const Placement& placed) {
  constexpr double kSame = 1e-3;  // of the smallest spacing
  try {
    const auto matrix = matrix_of(scan);
    if (!matrix) return;
    const double apart = farthest(scan, placed, *matrix);
    if (apart <= kSame * least_spacing(placed)) return;
    scan.warnings.push_back(
        message("the matrix of SPM in ", in_quotes(matrix_beside(scan.file).filename().string()),
                " puts voxels up to ", apart, " mm elsewhere: the place in the header is used"));
  } catch (const InputError&) {  // a file of another kind, which is no part of this one
  }
}

/// The unit of Analyze, a word.
double analyze_unit_in_mm(ScanFile& scan, const std::string& unit) {
  if (unit.empty()) return 1;
  const auto mm = mm_per_unit(unit);
  if (!mm)
    scan.warnings.push_back(
        message("the unit ", in_quotes(unit), " is no unit of length: mm assumed"));
  return mm.value_or(1);
}

/// RAS, mm.
Placement placement_of(ScanFile& scan, NiftiHeader& h) {
  const double mm =
      h.analyze ? analyze_unit_in_mm(scan, h.analyze->unit) : unit_in_mm(scan, h.units);
  for (std::size_t axis = 1; axis <= 3; ++axis) h.pixdim[axis] *= mm;
  if (h.analyze) return place_analyze(scan, h);
  for (double& length : h.srow) length *= mm;
  for (std::size_t n = 3; n < 6; ++n) h.quatern[n] *= mm;
  const Placement placed = choose_placement(scan, h);
  warn_of_matrix(scan, placed);
  return placed;
}

void place(ScanFile& scan, NiftiHeader h) {
  Placement p = placement_of(scan, h);
  const auto to_lps = [](const Vec3& v) { return Vec3{-v.x, -v.y, v.z}; };
  for (Vec3& direction : p.axes.direction) direction = to_lps(direction);
  set_stated_axes(scan, p.axes);
  set_origin(scan, to_lps(p.origin));
  if (!scan.sheared) {
    warn_of_spacing(scan, stated_spacing(h), h.analyze ? "the matrix of SPM" : "the sform");
  }
}

/// Analyze 7.5 has a range of values for the range that is stored; SPM's scale counts before it.
void warn_of_range(ScanFile& scan, const AnalyzeHeader& h) {
  const double stored = static_cast<double>(h.stored[0]) - static_cast<double>(h.stored[1]);
  const double shown = h.shown[0] - h.shown[1];
  if (stored == 0 || shown == 0 || !std::isfinite(shown)) return;
  const double slope = shown / stored,
               intercept = h.shown[0] - slope * static_cast<double>(h.stored[0]);
  if (std::abs(slope - 1) < 1e-6 && std::abs(intercept) < 1e-6) return;
  scan.warnings.push_back(
      message("the header's ranges of values (cal_max, glmax) imply a slope of ", slope,
              " and an intercept of ", intercept, ": the values are kept as stored"));
}

/// Native values; a slope of 0 says that there is none.
void set_scale(ScanFile& scan, const NiftiHeader& h) {
  if (h.slope == 0) {
    if (h.analyze) warn_of_range(scan, *h.analyze);
    return;
  }
  if (!std::isfinite(h.slope) || !std::isfinite(h.intercept)) {
    scan.warnings.push_back(message("the scale of the values cannot be used (slope ", h.slope,
                                    ", intercept ", h.intercept, "): they are kept as stored"));
    return;
  }
  scan.source.slope = h.slope;
  scan.source.intercept = h.intercept;
}

/// Where the header contradicts itself or the file.
void warn_of_samples(ScanFile& scan, const NiftiHeader& h, bool pair) {
  const auto bytes = static_cast<std::uint64_t>(byte_size(scan.source.type));
  if (h.bitpix != 0 && h.bitpix != static_cast<std::int64_t>(8 * bytes)) {
    scan.warnings.push_back(message("bitpix states ", h.bitpix, " bits, the data type ", 8 * bytes,
                                    ": the data type is used"));
  }
  if (!pair && h.vox_offset < static_cast<double>(h.size + 4)) {
    scan.warnings.push_back(message("vox_offset ", h.vox_offset,
                                    " lies before the end of the header: the samples begin there"));
  }
  warn_of_bytes_behind(scan);
}

}  // namespace

ScanFile open_nifti(const std::filesystem::path& file, const Opening& opening) {
  const NiftiFiles files = files_of(file);
  const NiftiHeader h = read_header(files.header, files.pair());
  ScanFile scan = begin_scan(file, h.analyze ? "Analyze" : "NIfTI", opening);
  set_dimensions(scan, h, opening);
  const double least = files.pair() ? 0 : static_cast<double>(kSize1);
  if (!(h.vox_offset >= least) || h.vox_offset > 1e15) {
    refuse(file,
           message("expected the samples behind the header, found vox_offset ", h.vox_offset));
  }
  place(scan, h);
  scan.source.file = files.samples;
  scan.source.type = sample_type(file, h.datatype);
  scan.source.big_endian = h.big_endian;
  scan.source.packing = Packing::kSniffed;
  scan.source.skip = static_cast<std::uint64_t>(h.vox_offset);
  set_scale(scan, h);
  warn_of_samples(scan, h, files.pair());
  return scan;
}

std::vector<std::string> nifti_extensions(const std::filesystem::path& file, MemoryBudget& budget) {
  constexpr std::uint64_t kMostBytes = 1 << 24;
  if (files_of(file).pair()) return {};
  const NiftiHeader h = read_header(file, false);
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
      refuse(file, message("expected a header extension of 8 to ", kMostBytes,
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

}  // namespace mesamis::detail::volume_files
