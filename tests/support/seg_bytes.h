// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "support/dicom_bytes.h"

/// DICOM segmentations made by hand.
namespace mesamis {

struct SegFrame {
  int segment = 1;
  std::vector<double> position{0, 0, 0};
  std::vector<int> pixels;  ///< rows * columns; empty: all 0
};

struct SegSegment {
  int number = 1;
  std::string label = "bone";
  std::vector<std::uint16_t> cielab;
};

/// Public so that tests may spoil it. 3 x 5 pixels: frames of bits do not end at bytes.
struct SegBytes {
  DicomCoding coding = DicomCoding::kExplicit;
  std::string sop_class = "1.2.840.10008.5.1.4.1.1.66.4", type = "BINARY";
  std::string photometric = "MONOCHROME2", transfer_syntax, character_set;
  int columns = 3, rows = 5, bits = 1, most_fraction = 255;
  std::vector<double> orientation{1, 0, 0, 0, 1, 0}, spacing{1.25, 0.5};
  double slice_spacing = 0, slice_thickness = 0;  ///< 0: not stated
  std::vector<SegSegment> segments{{}};
  std::vector<SegFrame> frames;
  int frames_stated = -1;         ///< -1: as many as there are
  bool number_in_shared = false;  ///< the referenced segment, that of the first frame
  bool in_open_sequences = false;
  std::string pixel_data;  ///< empty: made from the frames

  std::string packed_pixels() const {
    std::vector<int> all;
    for (const SegFrame& frame : frames) {
      std::vector<int> pixels = frame.pixels;
      pixels.resize(static_cast<std::size_t>(rows * columns));
      all.insert(all.end(), pixels.begin(), pixels.end());
    }
    std::string bytes(bits == 1 ? (all.size() + 7) / 8 : 0, '\0');
    for (std::size_t n = 0; n < all.size(); ++n) {
      if (bits == 1) bytes[n / 8] = static_cast<char>(bytes[n / 8] | (all[n] & 1) << (n % 8));
      if (bits == 8) bytes += static_cast<char>(all[n]);
      if (bits == 16) bytes += bytes_of(static_cast<std::uint16_t>(all[n]));
    }
    return bytes;
  }

  std::string bytes() const {
    DicomWriter set(coding);
    if (!character_set.empty()) set.text(0x00080005, "CS", character_set);
    set.text(0x00080016, "UI", sop_class);
    set.text(0x00080060, "CS", "SEG");
    set.number(0x00280002, 1);
    set.text(0x00280004, "CS", photometric);
    const auto stated = frames_stated < 0 ? static_cast<int>(frames.size()) : frames_stated;
    set.text(0x00280008, "IS", std::to_string(stated));
    set.number(0x00280010, rows), set.number(0x00280011, columns);
    set.number(0x00280100, bits), set.number(0x00280101, bits);
    set.number(0x00280102, bits - 1), set.number(0x00280103, 0);
    set.text(0x00620001, "CS", type);
    set.sequence(0x00620002, segment_items(), in_open_sequences);
    if (type == "FRACTIONAL") set.number(0x0062000e, most_fraction);
    set.sequence(0x52009229, {shared_groups()}, in_open_sequences);
    set.sequence(0x52009230, frame_items(), in_open_sequences);
    set.raw(0x7fe00010, bits == 16 ? "OW" : "OB",
            pixel_data.empty() ? packed_pixels() : pixel_data);
    return transfer_syntax.empty() ? SliceBytes::file(set.bytes(), coding)
                                   : stated_file(set.bytes());
  }

 private:
  std::string stated_file(const std::string& set) const {
    DicomWriter meta;
    meta.text(0x00020010, "UI", transfer_syntax);
    return std::string(128, '\0') + "DICM" + meta.bytes() + set;
  }
  std::vector<std::string> segment_items() const {
    std::vector<std::string> items;
    for (const SegSegment& segment : segments) {
      DicomWriter item(coding);
      if (segment.number >= 0) item.number(0x00620004, segment.number);
      item.text(0x00620005, "LO", segment.label);
      if (!segment.cielab.empty()) item.raw(0x0062000d, "US", bytes_of_all(segment.cielab));
      items.push_back(item.bytes());
    }
    return items;
  }
  std::string in_sequence(std::uint32_t tag, const DicomWriter& content) const {
    DicomWriter group(coding);
    group.sequence(tag, {content.bytes()}, in_open_sequences);
    return group.bytes();
  }
  std::string reference(int segment) const {
    DicomWriter content(coding);
    content.number(0x0062000b, segment);
    return in_sequence(0x0062000a, content);
  }
  std::string shared_groups() const {
    DicomWriter measures(coding), plane(coding);
    if (slice_thickness > 0) measures.decimals(0x00180050, {slice_thickness});
    if (slice_spacing > 0) measures.decimals(0x00180088, {slice_spacing});
    measures.decimals(0x00280030, spacing);
    plane.decimals(0x00200037, orientation);
    const std::string number = number_in_shared ? reference(frames.at(0).segment) : "";
    return in_sequence(0x00209116, plane) + in_sequence(0x00289110, measures) + number;
  }
  std::vector<std::string> frame_items() const {
    std::vector<std::string> items;
    for (const SegFrame& frame : frames) {
      DicomWriter position(coding);
      if (!frame.position.empty()) position.decimals(0x00200032, frame.position);
      const bool own = !number_in_shared && frame.segment >= 0;
      items.push_back(in_sequence(0x00209113, position) + (own ? reference(frame.segment) : ""));
    }
    return items;
  }
};

/// Three slices, 2 mm apart, of random bits.
inline SegBytes small_seg() {
  SegBytes seg;
  for (int k = 0; k < 3; ++k) {
    SegFrame frame{1, {10, 20, 30 + 2.0 * k}, {}};
    for (int n = 0; n < 15; ++n) frame.pixels.push_back((n * 7 + k * 5) % 3 == 0);
    seg.frames.push_back(frame);
  }
  return seg;
}

}  // namespace mesamis
