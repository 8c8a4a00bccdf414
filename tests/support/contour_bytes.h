// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "support/dicom_bytes.h"

/// DICOM structure sets of radiotherapy made by hand.
namespace mesamis {

struct RegionContour {
  std::vector<Vec3> points;
  std::string type = "CLOSED_PLANAR";
  std::string data{};  ///< instead of the points, if it is not empty
};

struct RegionBytes {
  int number = 1;
  std::string name = "bone", colour = "255\\128\\0", frame = "1.2.9";
  std::vector<RegionContour> contours;
};

/// Public so that tests may spoil it.
struct StructureBytes {
  DicomCoding coding = DicomCoding::kExplicit;
  std::string sop_class = "1.2.840.10008.5.1.4.1.1.481.3", character_set, frame = "1.2.9";
  std::vector<RegionBytes> regions;
  bool open = false;  ///< sequences without lengths

  std::string bytes() const {
    DicomWriter set(coding);
    if (!character_set.empty()) set.text(0x00080005, "CS", character_set);
    set.text(0x00080016, "UI", sop_class);
    set.text(0x00080060, "CS", "RTSTRUCT");
    DicomWriter common(coding);
    common.text(0x00200052, "UI", frame);
    set.sequence(0x30060010, {common.bytes()}, open);
    std::vector<std::string> described, drawn;
    for (const RegionBytes& region : regions) {
      described.push_back(described_region(region));
      drawn.push_back(drawn_region(region));
    }
    set.sequence(0x30060020, described, open);
    set.sequence(0x30060039, drawn, open);
    return SliceBytes::file(set.bytes(), coding);
  }

 private:
  std::string described_region(const RegionBytes& region) const {
    DicomWriter item(coding);
    item.text(0x30060022, "IS", std::to_string(region.number));
    if (!region.frame.empty()) item.text(0x30060024, "UI", region.frame);
    item.text(0x30060026, "LO", region.name);
    return item.bytes();
  }
  std::string drawn_region(const RegionBytes& region) const {
    DicomWriter item(coding);
    if (!region.colour.empty()) item.text(0x3006002a, "IS", region.colour);
    std::vector<std::string> contours;
    for (const RegionContour& contour : region.contours) {
      DicomWriter one(coding);
      one.text(0x30060042, "CS", contour.type);
      one.text(0x30060046, "IS", std::to_string(contour.points.size()));
      if (contour.data.empty()) {
        std::vector<double> numbers;
        for (const Vec3& p : contour.points) numbers.insert(numbers.end(), {p.x, p.y, p.z});
        one.decimals(0x30060050, numbers);
      } else {
        one.text(0x30060050, "DS", contour.data);
      }
      contours.push_back(one.bytes());
    }
    item.sequence(0x30060040, contours, open);
    item.text(0x30060084, "IS", std::to_string(region.number));
    return item.bytes();
  }
};

/// A circle across z, as a polygon that is as large.
inline RegionContour circle_contour(const Vec3& centre, double radius, bool backwards = false) {
  constexpr int kCorners = 64;
  constexpr double kStep = 2 * std::numbers::pi / kCorners;
  const double r = radius * std::sqrt(kStep / std::sin(kStep));
  RegionContour contour;
  for (int n = 0; n < kCorners; ++n) {
    const double a = (backwards ? -n : n) * kStep;
    contour.points.push_back(centre + Vec3{r * std::cos(a), r * std::sin(a), 0});
  }
  return contour;
}

/// A rectangle across z.
inline RegionContour rectangle_contour(const Vec3& corner, double width, double height) {
  return {{corner, corner + Vec3{width, 0, 0}, corner + Vec3{width, height, 0},
           corner + Vec3{0, height, 0}}};
}

/// One region of circles in planes 2 mm apart.
inline StructureBytes small_structure_set() {
  StructureBytes set;
  set.regions.resize(1);
  for (int k = 0; k < 3; ++k) {
    set.regions[0].contours.push_back(circle_contour({1, 2, 3 + 2.0 * k}, 5));
  }
  return set;
}

}  // namespace mesamis
