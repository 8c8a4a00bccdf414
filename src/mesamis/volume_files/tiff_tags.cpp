// SPDX-License-Identifier: Apache-2.0
#include "mesamis/volume_files/tiff_tags.h"

#include <tiffio.h>

#include <cmath>

#include "mesamis/base/message.h"
#include "mesamis/files/bytes.h"
#include "mesamis/files/length_unit.h"
#include "mesamis/files/refuse.h"
#include "mesamis/volume_files/grey_pixels.h"

namespace mesamis::detail::volume_files {
namespace {

/// mm per unit of the tag; 0 if it is none.
double unit_of_tag(TIFF* tiff, const TiffLayout& layout) {
  std::uint16_t unit = layout.unit_of_tag_alone ? RESUNIT_NONE : RESUNIT_INCH;
  TIFFGetField(tiff, TIFFTAG_RESOLUTIONUNIT, &unit);
  return unit == RESUNIT_INCH ? 25.4 : unit == RESUNIT_CENTIMETER ? 10 : 0;
}

/// mm per unit that the description names; 0 if it is no length, such as "pixel".
double unit_named(const std::string& name, std::vector<std::string>& warnings) {
  if (const auto mm = mm_per_unit(name)) return *mm;
  warnings.push_back(message("the unit ", in_quotes(name), " of the description is no length"));
  return 0;
}

/// The same along x, y and z: ImageJ may name a unit for each.
Vec3 units_in_mm(TIFF* tiff, const TiffLayout& layout, std::vector<std::string>& warnings) {
  const double x =
      layout.unit.empty() ? unit_of_tag(tiff, layout) : unit_named(layout.unit, warnings);
  const auto other = [&](const std::string& name) {
    return name.empty() || name == layout.unit ? x : unit_named(name, warnings);
  };
  return {x, other(layout.unit_y), other(layout.unit_z)};
}

/// mm along x, y and z; 0 where the file states no length.
Vec3 stated_spacing(TIFF* tiff, const TiffLayout& layout, const Vec3& unit) {
  float x = 0, y = 0;
  TIFFGetField(tiff, TIFFTAG_XRESOLUTION, &x);
  TIFFGetField(tiff, TIFFTAG_YRESOLUTION, &y);
  const auto per = [](double mm, float resolution) {
    return resolution > 0 && std::isfinite(resolution) ? mm / static_cast<double>(resolution) : 0;
  };
  Vec3 spacing{per(unit.x, x), per(unit.y, y), unit.z * layout.between};
  for (int a = 0; a < 3; ++a) {
    if (layout.spacing[a] > 0) spacing[a] = layout.spacing[a];
  }
  return spacing;
}

/// The slices of each time, of pages that no description orders.
void take_lsm_times(const char* bytes, ByteOrder order, TiffLayout& layout) {
  const std::int64_t slices = load<std::int32_t>(bytes + 16, order),
                     times = load<std::int32_t>(bytes + 24, order);
  if (times <= 1 || slices <= 1 || layout.axes.volumes * layout.axes.channels != 1) return;
  if (slices > layout.slices || times != layout.slices / slices || layout.slices % slices != 0) {
    layout.warnings.push_back(message("the tag of LSM states ", times, " times of ", slices,
                                      " slices, found ", layout.slices,
                                      " pages: all are taken as slices"));
    return;
  }
  layout.axes.volumes = times;  // one after the other
  layout.slices = slices;
}

}  // namespace

std::string description_of(TIFF* tiff) {
  char* text = nullptr;
  TIFFGetField(tiff, TIFFTAG_IMAGEDESCRIPTION, &text);
  return text ? text : "";
}

Vec3 spacing_of(TIFF* tiff, const TiffLayout& layout, std::vector<std::string>& warnings) {
  Vec3 spacing = stated_spacing(tiff, layout, units_in_mm(tiff, layout, warnings));
  const bool has_resolution = stated_spacing(tiff, layout, {1, 1, 1}).x > 0;
  if (!(spacing.x > 0 && spacing.y > 0)) {
    spacing.x = spacing.y = 1;
    warnings.push_back(has_resolution
                           ? "the file's resolution has no unit: 1 mm assumed along x and y"
                           : "the file gives no resolution: 1 mm assumed along x and y");
  }
  warn_of_screen_resolution(spacing.x, warnings);
  if (!(spacing.z > 0)) {
    spacing.z = 1;
    warnings.push_back(layout.between > 0
                           ? "the file's distance between slices has no unit: 1 mm assumed"
                           : "the file gives no distance between slices: 1 mm assumed");
  }
  return spacing;
}

void take_lsm(TIFF* tiff, TiffLayout& layout) {
  constexpr std::uint32_t kTag = 34412, kLeast = 64;
  constexpr double kMetre = 1000;
  std::uint32_t count = 0;
  const char* bytes = nullptr;
  if (TIFFGetField(tiff, kTag, &count, &bytes) != 1 || bytes == nullptr || count < kLeast) return;
  const ByteOrder order = TIFFIsBigEndian(tiff) ? ByteOrder::kBig : ByteOrder::kLittle;
  for (int a = 0; a < 3; ++a) {
    const double metres = load<double>(bytes + 40 + 8 * a, order);
    if (metres > 0 && std::isfinite(metres)) layout.spacing[a] = kMetre * metres;
  }
  take_lsm_times(bytes, order, layout);
}

void refuse_metamorph(const std::filesystem::path& file, TIFF* tiff) {
  constexpr std::uint32_t kTag = 33629;
  std::uint32_t count = 0;
  const void* values = nullptr;
  if (TIFFGetField(tiff, kTag, &count, &values) == 1 && count > 1) {
    refuse(file, message("expected a page per slice, found a MetaMorph stack (STK) of ", count,
                         " planes behind one page; save it as TIFF"));
  }
}

}  // namespace mesamis::detail::volume_files
