// SPDX-License-Identifier: Apache-2.0
#include "mesamis/label_files/nifti_labels.h"

#include <algorithm>
#include <cmath>
#include <set>

#include "mesamis/base/types.h"
#include "mesamis/files/bytes.h"
#include "mesamis/files/refuse.h"
#include "mesamis/files/xml.h"
#include "mesamis/files/xml_text.h"
#include "mesamis/label_files/label_values.h"

namespace mesamis::detail::label_files {
namespace {

constexpr std::string_view kRoot = "CaretExtension";

/// The elements called Label, wherever they are below.
void collect_labels(const XmlElement& element, std::vector<const XmlElement*>& labels) {
  for (const XmlElement& child : element.children) {
    if (child.name == "Label") labels.push_back(&child);
    collect_labels(child, labels);
  }
}

Segment segment_of(const std::filesystem::path& file, const XmlElement& element) {
  const std::string key = element.attribute("Key");
  Segment segment;
  if (!set_number(segment, key)) {
    refuse(file, message("expected a whole number from 0 as a label's Key in the header extension, "
                         "found ",
                         in_quotes(key)));
  }
  const std::string red = element.attribute("Red"), green = element.attribute("Green"),
                    blue = element.attribute("Blue");
  const auto colour = colour_in({red, green, blue});
  segment.name = trimmed(element.text);
  segment.colour = colour.value_or(default_colour(segment.label));
  return segment;
}

/// The rotation of a quaternion's imaginary part b, c, d; its real part is not negative.
Vec3 quaternion_of(const std::array<Vec3, 3>& columns) {
  const Mat3 r = transpose(Mat3{columns});
  const auto& m = r.rows;
  const double xx = m[0].x, yy = m[1].y, zz = m[2].z;
  // Each square is four times that of a component; the largest is safe to divide by.
  const std::array<double, 4> squares{1 + xx + yy + zz, 1 + xx - yy - zz, 1 - xx + yy - zz,
                                      1 - xx - yy + zz};
  const auto largest = std::max_element(squares.begin(), squares.end()) - squares.begin();
  const Vec3 odd{m[2].y - m[1].z, m[0].z - m[2].x, m[1].x - m[0].y};   // 4a (b, c, d)
  const Vec3 even{m[2].y + m[1].z, m[0].z + m[2].x, m[1].x + m[0].y};  // 4 (cd, bd, bc)
  const double twice = 2 * std::sqrt(squares[static_cast<std::size_t>(largest)]);
  if (largest == 0) return (1 / twice) * odd;
  const std::array<Vec3, 3> imaginary{Vec3{twice * twice / 4, even.z, even.y},
                                      Vec3{even.z, twice * twice / 4, even.x},
                                      Vec3{even.y, even.x, twice * twice / 4}};
  const auto axis = static_cast<std::size_t>(largest - 1);
  const double sign = odd[static_cast<int>(axis)] < 0 ? -1 : 1;
  return (sign / twice) * imaginary[axis];
}

/// Numbers at byte positions of a header.
class HeaderBytes {
 public:
  explicit HeaderBytes(std::size_t size) : bytes_(size, '\0') {}
  template <class Number>
  void put(std::size_t at, Number value) {
    std::string number;
    append(number, value);
    bytes_.replace(at, number.size(), number);
  }
  void put_float(std::size_t at, double value) { put(at, static_cast<float>(value)); }
  void put_text(std::size_t at, std::string_view text) { bytes_.replace(at, text.size(), text); }
  const std::string& bytes() const { return bytes_; }

 private:
  std::string bytes_;
};

/// Directions and origin in RAS; the third direction turned so that the three are right-handed.
void put_forms(HeaderBytes& h, const VoxelGrid& grid) {
  const Mat3 axes = transpose(grid.direction);
  const Vec3 origin = in_frame(grid.origin, Frame::kRas);
  const double handed = determinant(grid.direction) < 0 ? -1 : 1;
  std::array<Vec3, 3> columns;
  for (std::size_t a = 0; a < 3; ++a) {
    const int axis = static_cast<int>(a);
    columns[a] = in_frame(axes.rows[a], Frame::kRas);
    for (int row = 0; row < 3; ++row) {
      h.put_float(280 + 16 * static_cast<std::size_t>(row) + 4 * a,
                  grid.spacing[axis] * columns[a][row]);
    }
    h.put_float(80 + 4 * a, grid.spacing[axis]);
    h.put_float(268 + 4 * a, origin[axis]);
    h.put_float(292 + 16 * a, origin[axis]);
  }
  columns[2] = handed * columns[2];
  const Vec3 q = quaternion_of(columns);
  for (int a = 0; a < 3; ++a) h.put_float(256 + 4 * static_cast<std::size_t>(a), q[a]);
  h.put_float(76, handed);
}

}  // namespace

std::vector<Segment> segments_in_extensions(const std::filesystem::path& file,
                                            const std::vector<std::string>& extensions,
                                            MemoryBudget& budget) {
  const auto caret = std::find_if(extensions.begin(), extensions.end(), [](const std::string& e) {
    return e.find(message("<", kRoot)) != std::string::npos;
  });
  if (caret == extensions.end()) return {};
  const XmlDocument document = parse_xml(file, trimmed(*caret), budget);
  if (document.root.name != kRoot) return {};
  std::vector<const XmlElement*> elements;
  collect_labels(document.root, elements);
  std::vector<Segment> segments;
  std::set<std::int64_t> seen;
  for (const XmlElement* element : elements) {
    Segment segment = segment_of(file, *element);
    const std::int64_t number = number_of(segment);
    if (number == 0 || segment.name.empty() || !seen.insert(number).second) continue;
    segments.push_back(std::move(segment));
  }
  return segments;
}

std::string caret_extension(std::span<const Segment> segments) {
  std::string xml = message("<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<", kRoot,
                            "><VolumeInformation Index=\"0\"><LabelTable>\n");
  for (const Segment& s : segments) {
    xml += message("<Label Key=\"", s.label, "\" Red=\"", colour_share(s.colour[0]), "\" Green=\"",
                   colour_share(s.colour[1]), "\" Blue=\"", colour_share(s.colour[2]),
                   "\" Alpha=\"1\">", xml_escaped(s.name), "</Label>\n");
  }
  return xml +
         message("</LabelTable><VolumeType>Label</VolumeType></VolumeInformation></", kRoot, ">\n");
}

std::string nifti_header(const VoxelGrid& grid, std::size_t sample_bytes,
                         std::string_view extension) {
  constexpr std::size_t kHeader = 348, kFlag = 4, kSizeAndCode = 8;
  const std::size_t padded = (kSizeAndCode + extension.size() + 15) / 16 * 16;
  HeaderBytes h(kHeader + kFlag + padded);
  h.put(0, std::int32_t{kHeader});
  h.put(40, std::int16_t{3});
  for (std::size_t d = 0; d < 7; ++d) {
    h.put(42 + 2 * d, static_cast<std::int16_t>(d < 3 ? grid.size[d] : 1));
    h.put_float(80 + 4 * d, 1);
  }
  h.put(68, std::int16_t{1002});  // the intent: labels
  h.put(70, static_cast<std::int16_t>(sample_bytes == 1 ? 2 : 512));
  h.put(72, static_cast<std::int16_t>(8 * sample_bytes));
  h.put_float(108, static_cast<double>(kHeader + kFlag + padded));
  h.put_float(112, 1);
  h.put(123, std::int8_t{2});  // mm
  h.put(252, std::int16_t{1});
  h.put(254, std::int16_t{1});
  put_forms(h, grid);
  h.put_text(344, "n+1");
  h.put(kHeader, std::int8_t{1});  // an extension follows, of unknown code
  h.put(kHeader + kFlag, static_cast<std::int32_t>(padded));
  h.put_text(kHeader + kFlag + kSizeAndCode, extension);
  return h.bytes();
}

}  // namespace mesamis::detail::label_files
