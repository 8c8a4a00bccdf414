// SPDX-License-Identifier: Apache-2.0
#include "mesamis/label_files/seg_file.h"

#include <algorithm>
#include <set>
#include <utility>

#include "mesamis/files/dicom_text.h"
#include "mesamis/files/refuse.h"
#include "mesamis/label_files/cielab.h"

namespace mesamis::detail::label_files {
namespace {

constexpr const char* kSegmentation = "1.2.840.10008.5.1.4.1.1.66.4";
constexpr const char* kLabelMap = "1.2.840.10008.5.1.4.1.1.66.7";

void require_seg(const DicomFile& file) {
  if (!file.problem.empty()) refuse(file.path, "broken DICOM file: " + file.problem);
  if (is_seg(file)) return;
  refuse(file.path,
         message("expected a DICOM segmentation (SOP class ", kSegmentation, " or ", kLabelMap,
                 "), found ", in_quotes(text_of(file.elements, dicom::kSopClass))));
}

SegType type_of(const DicomFile& file) {
  const std::string name = text_of(file.elements, dicom::kSegmentationType);
  if (name == "BINARY") return SegType::kBinary;
  if (name == "FRACTIONAL") return SegType::kFractional;
  if (name == "LABELMAP") return SegType::kLabels;
  refuse(file.path,
         message("expected a Segmentation Type (0062,0001) BINARY, FRACTIONAL or LABELMAP, "
                 "found ",
                 in_quotes(name)));
}

void require_pixels(const SegFile& seg) {
  const DicomPixels& p = seg.pixels;
  const bool fits = seg.type == SegType::kBinary ? p.bits_allocated == 1
                    : seg.type == SegType::kFractional
                        ? p.bits_allocated == 8
                        : p.bits_allocated == 8 || p.bits_allocated == 16;
  if (!fits || p.is_signed) {
    const char* expected = seg.type == SegType::kBinary       ? "1 bit"
                           : seg.type == SegType::kFractional ? "8 bits"
                                                              : "8 or 16 bits";
    refuse(seg.file.path, message("expected unsigned pixels of ", expected, ", found ",
                                  p.is_signed ? "signed ones of " : "", p.bits_allocated));
  }
  const auto groups = seg.file.elements.find(dicom::kFrameGroups);
  const std::size_t found = groups == seg.file.elements.end() ? 0 : groups->second.items.size();
  if (found != static_cast<std::size_t>(p.frames)) {
    refuse(seg.file.path, message("expected Per-frame Functional Groups (5200,9230) of ", p.frames,
                                  " frames, found ", found));
  }
}

Segment segment_of(const DicomFile& file, const DicomSet& item) {
  const auto number = number_of(file, item, dicom::kSegmentNumber);
  if (!number) {
    refuse(file.path,
           "expected a Segment Number (0062,0004) in each item of the Segment Sequence, "
           "found none");
  }
  Segment segment{utf8_text(file, item, dicom::kSegmentLabel), *number, 0, default_colour(*number)};
  if (segment.name.empty()) segment.name = message("label ", *number);
  if (const auto lab = numbers_of(file, item, dicom::kCieLab, 3)) {
    segment.colour = srgb_from_cielab({(*lab)[0], (*lab)[1], (*lab)[2]});
  }
  return segment;
}

std::vector<Segment> segments_of(const DicomFile& file, SegType type) {
  const auto sequence = file.elements.find(dicom::kSegments);
  std::vector<Segment> segments;
  std::set<Index> seen;
  if (sequence != file.elements.end()) {
    for (const DicomSet& item : sequence->second.items) {
      Segment segment = segment_of(file, item);
      if (segment.label == 0 && type == SegType::kLabels) continue;  // the background
      if (segment.label == 0 || !seen.insert(segment.label).second) {
        refuse(file.path, message("expected each Segment Number from 1 once, found ", segment.label,
                                  segment.label == 0 ? "" : " again"));
      }
      segments.push_back(std::move(segment));
    }
  }
  if (segments.empty()) {
    refuse(file.path, "expected segments in the Segment Sequence (0062,0002), found none");
  }
  std::sort(segments.begin(), segments.end(),
            [](const Segment& a, const Segment& b) { return a.label < b.label; });
  return segments;
}

/// The Referenced Segment Number of a frame: its own, or that of all frames.
Index number_of_frame(const DicomFile& file, std::size_t frame) {
  const DicomSet& own = file.elements.at(dicom::kFrameGroups).items[frame];
  for (const DicomSet* groups : {&own, first_item(file.elements, dicom::kSharedGroups)}) {
    const DicomSet* item = groups ? first_item(*groups, dicom::kSegmentIdentification) : nullptr;
    const auto number = item ? number_of(file, *item, dicom::kReferencedSegment) : std::nullopt;
    if (number) return *number;
  }
  refuse(file.path, message("expected a Referenced Segment Number (0062,000b) of frame ", frame + 1,
                            ", found none"));
}

std::vector<Index> numbers_of_frames(const SegFile& seg) {
  std::set<Index> known;
  for (const Segment& segment : seg.segments) known.insert(segment.label);
  std::vector<Index> numbers(static_cast<std::size_t>(seg.pixels.frames));
  for (std::size_t frame = 0; frame < numbers.size(); ++frame) {
    numbers[frame] = number_of_frame(seg.file, frame);
    if (!known.count(numbers[frame])) {
      refuse(seg.file.path, message("expected frame ", frame + 1, " to refer to a segment of the ",
                                    "Segment Sequence, found the number ", numbers[frame]));
    }
  }
  return numbers;
}

void require_one_frame_each(const SegFile& seg) {
  std::set<std::pair<Index, Index>> seen;
  for (std::size_t frame = 0; frame < seg.grid.slice.size(); ++frame) {
    const Index number = seg.number.empty() ? 0 : seg.number[frame];
    if (seen.emplace(number, seg.grid.slice[frame]).second) continue;
    refuse(
        seg.file.path,
        message("expected one frame per segment and position, found frame ", frame + 1,
                seg.number.empty() ? "" : message(" of segment ", number), " at that of another"));
  }
}

}  // namespace

bool is_seg(const DicomFile& file) {
  const std::string sop_class = text_of(file.elements, dicom::kSopClass);
  return sop_class == kSegmentation || sop_class == kLabelMap;
}

SegFile open_seg(const std::filesystem::path& path, MemoryBudget& budget) {
  SegFile seg;
  seg.file = read_dicom_file(path, budget);
  require_seg(seg.file);
  seg.type = type_of(seg.file);
  seg.pixels = pixels_of(seg.file, PixelUse::kLabels);
  require_pixels(seg);
  // Places, numbers, and one frame of pixels.
  constexpr std::uint64_t kBytesPerFrame = 256;
  budget.claim(static_cast<std::uint64_t>(seg.pixels.frames), kBytesPerFrame, "frames");
  budget.claim(
      static_cast<std::uint64_t>(seg.pixels.rows) * static_cast<std::uint64_t>(seg.pixels.columns),
      sizeof(float), "pixels");
  seg.segments = segments_of(seg.file, seg.type);
  if (seg.type == SegType::kFractional) {
    seg.most = number_of(seg.file, seg.file.elements, dicom::kMostFraction).value_or(255);
    if (seg.most < 1 || seg.most > 255) {
      refuse(path, message("expected a Maximum Fractional Value of 1 to 255, found ", seg.most));
    }
  }
  if (seg.type != SegType::kLabels) seg.number = numbers_of_frames(seg);
  seg.grid = grid_of_frames(seg.file, seg.pixels);
  require_one_frame_each(seg);
  return seg;
}

void read_frame(const SegFile& seg, std::size_t frame, std::vector<float>& out,
                MemoryBudget& budget) {
  const ScopedClaim claim(budget, 1, decoding_bytes(seg.file, seg.pixels, static_cast<int>(frame)),
                          "a frame");
  out.clear();
  const FrameRescale as_stored{static_cast<int>(frame), 1, 0};
  if (!append_frame(seg.file, seg.pixels, as_stored, out)) {
    refuse(seg.file.path, message("the pixels of frame ", frame + 1, " are corrupt"));
  }
}

}  // namespace mesamis::detail::label_files
