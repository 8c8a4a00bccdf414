// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "mesamis/base/types.h"
#include "support/scan_bytes.h"

/// DICOM files made by hand.
namespace mesamis {

enum class DicomCoding { kImplicit, kExplicit, kBigEndian, kDeflated, kWithoutMeta };

inline std::string transfer_syntax_of(DicomCoding coding) {
  switch (coding) {
    case DicomCoding::kImplicit:
      return "1.2.840.10008.1.2";
    case DicomCoding::kBigEndian:
      return "1.2.840.10008.1.2.2";
    case DicomCoding::kDeflated:
      return "1.2.840.10008.1.2.1.99";
    default:
      return "1.2.840.10008.1.2.1";
  }
}

/// Writes data elements one after another.
class DicomWriter {
 public:
  explicit DicomWriter(DicomCoding coding = DicomCoding::kExplicit)
      : explicit_(coding != DicomCoding::kImplicit), big_(coding == DicomCoding::kBigEndian) {}

  void raw(std::uint32_t tag, const std::string& vr, std::string value) {
    if (value.size() % 2) value += vr == "UI" || vr == "OB" ? '\0' : ' ';
    begin(tag, vr, static_cast<std::uint32_t>(value.size()));
    bytes_ += value;
  }
  void text(std::uint32_t tag, const std::string& vr, const std::string& value) {
    raw(tag, vr, value);
  }
  void number(std::uint32_t tag, int value) {
    raw(tag, "US", bytes_of(static_cast<std::uint16_t>(value), big_));
  }
  void decimals(std::uint32_t tag, const std::vector<double>& values) {
    std::ostringstream out;
    out.precision(12);
    for (std::size_t n = 0; n < values.size(); ++n) out << (n ? "\\" : "") << values[n];
    raw(tag, "DS", out.str());
  }
  /// A sequence of items, each the bytes of another writer; open: without lengths.
  void sequence(std::uint32_t tag, const std::vector<std::string>& items, bool open = false) {
    std::string content;
    for (const std::string& item : items) {
      const auto size = static_cast<std::uint32_t>(item.size());
      content += tag_bytes(0xfffee000) + bytes_of(open ? 0xffffffffu : size, big_) + item;
      if (open) content += tag_bytes(0xfffee00d) + bytes_of(0u, big_);
    }
    if (open) content += tag_bytes(0xfffee0dd) + bytes_of(0u, big_);
    begin(tag, "SQ", open ? 0xffffffffu : static_cast<std::uint32_t>(content.size()));
    bytes_ += content;
  }
  const std::string& bytes() const { return bytes_; }

 private:
  std::string tag_bytes(std::uint32_t tag) const {
    return bytes_of(static_cast<std::uint16_t>(tag >> 16), big_) +
           bytes_of(static_cast<std::uint16_t>(tag & 0xffff), big_);
  }
  void begin(std::uint32_t tag, const std::string& vr, std::uint32_t length) {
    bytes_ += tag_bytes(tag);
    const bool long_form = vr == "OW" || vr == "OB" || vr == "SQ" || vr == "UN";
    if (explicit_) bytes_ += vr + (long_form ? std::string(2, '\0') : "");
    bytes_ += explicit_ && !long_form ? bytes_of(static_cast<std::uint16_t>(length), big_)
                                      : bytes_of(length, big_);
  }

  bool explicit_, big_;
  std::string bytes_;
};

/// One classic slice; public so that tests may spoil it.
struct SliceBytes {
  DicomCoding coding = DicomCoding::kExplicit;
  std::string series = "1.2.3", modality = "CT", photometric = "MONOCHROME2";
  std::string image_type = "ORIGINAL\\PRIMARY\\AXIAL", description = "made here";
  int columns = 4, rows = 3, allocated = 16, stored = 16, high_bit = 15, is_signed = 1;
  std::vector<double> position{0, 0, 0}, orientation{1, 0, 0, 0, 1, 0}, spacing{1.25, 0.5};
  double slope = 1, intercept = 0;
  std::vector<std::int16_t> pixels = ramp<std::int16_t>(12);
  std::string patient{};  ///< name and number, where there is one
  /// Elements beside those above: value representation and text.
  std::map<std::uint32_t, std::pair<std::string, std::string>> more{};

  std::string bytes() const {
    DicomWriter set(coding);
    set.text(0x00080008, "CS", image_type);
    set.text(0x00080060, "CS", modality);
    set.text(0x0008103e, "LO", description);
    if (!patient.empty()) {
      set.text(0x00100010, "PN", patient);
      set.text(0x00100020, "LO", patient);
    }
    set.text(0x0020000e, "UI", series);
    if (!position.empty()) set.decimals(0x00200032, position);
    if (!orientation.empty()) set.decimals(0x00200037, orientation);
    set.number(0x00280002, 1);
    set.text(0x00280004, "CS", photometric);
    set.number(0x00280010, rows), set.number(0x00280011, columns);
    if (!spacing.empty()) set.decimals(0x00280030, spacing);
    set.number(0x00280100, allocated), set.number(0x00280101, stored);
    set.number(0x00280102, high_bit), set.number(0x00280103, is_signed);
    set.decimals(0x00281052, {intercept}), set.decimals(0x00281053, {slope});
    for (const auto& [tag, element] : more) set.text(tag, element.first, element.second);
    set.raw(0x7fe00010, "OW", bytes_of_all(pixels, coding == DicomCoding::kBigEndian));
    return file(set.bytes(), coding);
  }

  /// Preamble and meta group around a data set.
  static std::string file(const std::string& set, DicomCoding coding) {
    if (coding == DicomCoding::kWithoutMeta) return set;
    DicomWriter meta;
    meta.text(0x00020010, "UI", transfer_syntax_of(coding));
    std::string bytes(128, '\0');
    bytes += "DICM" + meta.bytes();
    return bytes + (coding == DicomCoding::kDeflated ? packed(set, -15) : set);
  }
};

/// An enhanced file: frame geometry in functional groups, the frames in the order given.
inline std::string enhanced_bytes(const std::vector<int>& order, bool open, DicomCoding coding) {
  const auto set = [&] { return DicomWriter(coding); };
  const auto group = [&](std::uint32_t tag, const std::string& content) {
    DicomWriter writer = set();
    writer.sequence(tag, {content}, open);
    return writer.bytes();
  };
  DicomWriter orientation = set(), measures = set(), file = set();
  orientation.decimals(0x00200037, {1, 0, 0, 0, 1, 0});
  measures.decimals(0x00280030, {1.25, 0.5});
  std::vector<std::string> frames;
  std::string pixels;
  for (const int k : order) {
    DicomWriter position = set(), transform = set();
    position.decimals(0x00200032, {10, 20, 30 + 2.0 * k});
    transform.decimals(0x00281052, {-100.0 * k});
    transform.decimals(0x00281053, {1});
    frames.push_back(group(0x00209113, position.bytes()) + group(0x00289145, transform.bytes()));
    pixels +=
        bytes_of_all(ramp<std::int16_t>(12, -40 + 112 * k), coding == DicomCoding::kBigEndian);
  }
  file.text(0x00080060, "CS", "MR");
  file.text(0x0020000e, "UI", "1.2.3");
  file.number(0x00280002, 1);
  file.text(0x00280004, "CS", "MONOCHROME2");
  file.text(0x00280008, "IS", std::to_string(order.size()));
  file.number(0x00280010, 3), file.number(0x00280011, 4);
  file.number(0x00280100, 16), file.number(0x00280101, 16), file.number(0x00280102, 15);
  file.number(0x00280103, 1);
  file.sequence(0x52009229,
                {group(0x00209116, orientation.bytes()) + group(0x00289110, measures.bytes())},
                open);
  file.sequence(0x52009230, frames, open);
  file.raw(0x7fe00010, "OW", pixels);
  return SliceBytes::file(file.bytes(), coding);
}

}  // namespace mesamis
