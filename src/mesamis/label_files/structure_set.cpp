// SPDX-License-Identifier: Apache-2.0
#include "mesamis/label_files/structure_set.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <set>
#include <string_view>
#include <utility>

#include "mesamis/files/dicom_text.h"
#include "mesamis/files/refuse.h"
#include "mesamis/image/label_map.h"

namespace mesamis::detail::label_files {
namespace {

constexpr const char* kStructureSet = "1.2.840.10008.5.1.4.1.1.481.3";

std::optional<std::int64_t> whole_number(const DicomSet& set, DicomTag tag) {
  std::int64_t number = 0;
  const std::string text = text_of(set, tag);
  return parse_number(trimmed(text), number) ? std::optional(number) : std::nullopt;
}

const std::vector<DicomSet>& items_of(const DicomSet& set, DicomTag tag) {
  static const std::vector<DicomSet> kNone;
  const auto sequence = set.find(tag);
  return sequence == set.end() ? kNone : sequence->second.items;
}

/// Reads the decimals of contours, which may be longer than the texts of other elements.
class PointReader {
 public:
  PointReader(const DicomFile& file, const std::string& region, MemoryBudget& budget)
      : file_(file), region_(region), budget_(budget) {}

  /// @throws InputError  if they are no points.
  std::vector<Vec3> read(const DicomSet& contour) {
    const auto data = contour.find(dicom::kContourPoints);
    if (data == contour.end()) return {};
    const Bytes value = data->second.value;
    std::string_view rest(reinterpret_cast<const char*>(value.data()), value.size());
    rest = trimmed(rest);
    if (rest.empty()) return {};
    const auto numbers = static_cast<std::size_t>(std::count(rest.begin(), rest.end(), '\\')) + 1;
    if (numbers % 3 != 0) refuse_data(message(numbers, " numbers"));
    budget_.claim(numbers / 3, sizeof(Vec3), "points of contours");
    std::vector<Vec3> points(numbers / 3);
    for (std::size_t n = 0; n < numbers; ++n) {
      const std::size_t end = std::min(rest.find('\\'), rest.size());
      points[n / 3][static_cast<int>(n % 3)] = coordinate(trimmed(rest.substr(0, end)));
      rest.remove_prefix(std::min(end + 1, rest.size()));
    }
    return points;
  }

 private:
  double coordinate(std::string_view text) const {
    constexpr double kFarthest = 1e7;  // mm
    double value = 0;
    if (!parse_number(text, value) || !(std::abs(value) <= kFarthest)) refuse_data(in_quotes(text));
    return value;
  }
  [[noreturn]] void refuse_data(const std::string& found) const {
    refuse(file_.path,
           message("expected x, y, z of points in mm as Contour Data (3006,0050) of the "
                   "region ",
                   in_quotes(region_), ", found ", found));
  }

  const DicomFile& file_;
  const std::string& region_;
  MemoryBudget& budget_;
};

/// What is left out of a structure set.
struct LeftOut {
  std::map<std::string, std::size_t> types;  // contours that are neither closed nor planar
  std::size_t short_ones = 0;                // contours of fewer than three points
  std::vector<std::string> regions;

  void warn(std::vector<std::string>& warnings) const {
    for (const auto& [type, count] : types) {
      warnings.push_back(message(count, count == 1 ? " contour" : " contours", " of the type ",
                                 in_quotes(type),
                                 " left out: only CLOSED_PLANAR ones have an inside"));
    }
    if (short_ones > 0) {
      warnings.push_back(message(short_ones, " closed contours of fewer than 3 points left out"));
    }
    constexpr std::size_t kMostNamed = 5;
    for (std::size_t n = 0; n < std::min(regions.size(), kMostNamed); ++n) {
      warnings.push_back("the region " + in_quotes(regions[n]) +
                         " has no contour with an inside: left out");
    }
    if (regions.size() > kMostNamed) {
      warnings.push_back(message(regions.size() - kMostNamed, " more regions left out likewise"));
    }
  }
};

/// The frame of reference that the whole set states.
std::string common_frame(const DicomFile& file) {
  const DicomSet* item = first_item(file.elements, dicom::kReferencedFrames);
  const std::string own = item ? text_of(*item, dicom::kFrameOfReference) : "";
  return own.empty() ? text_of(file.elements, dicom::kFrameOfReference) : own;
}

/// The regions by their number in the file, without contours.
std::map<std::int64_t, Region> described_regions(const DicomFile& file, MemoryBudget& budget) {
  std::map<std::int64_t, Region> regions;
  for (const DicomSet& item : items_of(file.elements, dicom::kRegions)) {
    const auto number = whole_number(item, dicom::kRegionNumber);
    if (!number) {
      refuse(file.path, "expected a ROI Number (3006,0022) of each region, found none");
    }
    budget.claim(1, sizeof(Region) + 64, "regions");
    Region region{utf8_text(file, item, dicom::kRegionName), 0, {}, {}, {}};
    if (region.name.empty()) region.name = message("region ", *number);
    region.frame = text_of(item, dicom::kRegionFrame);
    if (region.frame.empty()) region.frame = common_frame(file);
    if (!regions.emplace(*number, std::move(region)).second) {
      refuse(file.path, message("expected each ROI Number once, found ", *number, " again"));
    }
  }
  return regions;
}

std::optional<std::array<std::uint8_t, 3>> colour_of(const DicomSet& item) {
  const auto numbers = decimals_of(item, dicom::kRegionColour, 3);
  std::array<std::uint8_t, 3> colour{};
  for (std::size_t c = 0; numbers && c < 3; ++c) {
    if (!((*numbers)[c] >= 0 && (*numbers)[c] <= 255)) return std::nullopt;
    colour[c] = static_cast<std::uint8_t>(std::lround((*numbers)[c]));
  }
  return numbers ? std::optional(colour) : std::nullopt;
}

void add_contours(const DicomFile& file, const DicomSet& item, Region& region, LeftOut& left_out,
                  MemoryBudget& budget) {
  PointReader reader(file, region.name, budget);
  for (const DicomSet& contour : items_of(item, dicom::kContours)) {
    const std::string type = text_of(contour, dicom::kContourType);
    const bool exclusive = type == "CLOSEDPLANAR_XOR";
    if (type != "CLOSED_PLANAR" && !exclusive) {
      ++left_out.types[type.substr(0, 32)];
      continue;
    }
    std::vector<Vec3> points = reader.read(contour);
    if (points.size() < 3) {
      ++left_out.short_ones;
      continue;
    }
    append_within(budget, region.contours, Contour{std::move(points), exclusive}, "contours");
  }
}

/// Numbers of the file are labels if all of them can be.
void number_regions(std::map<std::int64_t, Region>& regions) {
  const bool fit = regions.empty() || (regions.begin()->first >= 1 &&
                                       regions.rbegin()->first <= std::int64_t{kMaxLabel});
  Index next = 0;
  for (auto& [number, region] : regions) {
    region.number = fit ? static_cast<Index>(number) : ++next;
    region.colour = default_colour(region.number);
  }
}

}  // namespace

bool is_structure_set(const DicomFile& file) {
  return text_of(file.elements, dicom::kSopClass) == kStructureSet;
}

StructureSet read_structure_set(const DicomFile& file, MemoryBudget& budget) {
  if (!file.problem.empty()) refuse(file.path, "broken DICOM file: " + file.problem);
  std::map<std::int64_t, Region> regions = described_regions(file, budget);
  if (regions.size() > static_cast<std::size_t>(kMaxLabel)) {
    refuse(file.path, message("expected at most ", kMaxLabel, " regions, found ", regions.size()));
  }
  number_regions(regions);
  LeftOut left_out;
  for (const DicomSet& item : items_of(file.elements, dicom::kRegionContours)) {
    const auto number = whole_number(item, dicom::kReferencedRegion);
    const auto region = number ? regions.find(*number) : regions.end();
    if (region == regions.end()) {
      refuse(file.path,
             message("expected contours of regions of the Structure Set ROI Sequence, found ",
                     number ? message("the number ", *number) : "no number"));
    }
    if (const auto colour = colour_of(item)) region->second.colour = *colour;
    add_contours(file, item, region->second, left_out, budget);
  }
  StructureSet set;
  for (auto& [number, region] : regions) {
    if (region.contours.empty()) {
      left_out.regions.push_back(region.name);
    } else {
      set.regions.push_back(std::move(region));
    }
  }
  if (set.regions.empty()) {
    refuse(file.path, message("expected regions with closed planar contours, found ",
                              regions.size(), " regions without any"));
  }
  left_out.warn(set.warnings);
  return set;
}

}  // namespace mesamis::detail::label_files
