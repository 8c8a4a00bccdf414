// SPDX-License-Identifier: Apache-2.0
#include "mesamis/label_files/dicom_seg.h"

#include <algorithm>
#include <map>
#include <set>

#include "mesamis/files/refuse.h"
#include "mesamis/label_files/layer_stack.h"
#include "mesamis/label_files/seg_file.h"

namespace mesamis::detail::label_files {
namespace {

std::size_t frame_begin(const SegFile& seg, std::size_t frame) {
  return seg.grid.grid.offset(0, 0, seg.grid.slice[frame]);
}

/// The frames of each segment.
std::map<Index, std::vector<std::size_t>> frames_by_segment(const SegFile& seg) {
  std::map<Index, std::vector<std::size_t>> frames;
  for (std::size_t frame = 0; frame < seg.number.size(); ++frame) {
    frames[seg.number[frame]].push_back(frame);
  }
  return frames;
}

/// Puts one segment after another into layers.
class LayerBuilder {
 public:
  LayerBuilder(const SegFile& seg, LabelMap& map, MemoryBudget& budget)
      : seg_(seg),
        budget_(budget),
        stack_(map, budget, [&](std::size_t layers) { require_voxels(seg.file, map, layers); }) {}

  /// Sets the segment's layer.
  void add(Segment& segment, const std::vector<std::size_t>& frames) {
    decode(frames);
    stack_.add(segment, [&](const auto& visit) { for_each_marked(frames, visit); });
  }
  void add_layer() { stack_.add_layer(); }

 private:
  /// Marks which pixels of the frames belong to their segment.
  void decode(const std::vector<std::size_t>& frames) {
    const double least = seg_.type == SegType::kFractional ? seg_.most / 2 : 1;
    const std::uint64_t marked = std::uint64_t{frames.size()} *
                                 static_cast<std::uint64_t>(seg_.pixels.rows) *
                                 static_cast<std::uint64_t>(seg_.pixels.columns);
    const ScopedClaim claim(budget_, marked / 4 + 1, 1, "marks");  // bits that double their room
    marks_ = {};
    for (const std::size_t frame : frames) {
      read_frame(seg_, frame, pixels_, budget_);
      for (const float pixel : pixels_) marks_.push_back(pixel >= least);
    }
  }

  /// Calls visit(offset) for each marked voxel of the frames that were decoded.
  template <class Visit>
  void for_each_marked(const std::vector<std::size_t>& frames, Visit visit) {
    auto mark = marks_.begin();
    for (const std::size_t frame : frames) {
      const std::size_t begin = frame_begin(seg_, frame);
      for (std::size_t n = 0; n < pixels_.size(); ++n, ++mark) {
        if (*mark) visit(begin + n);
      }
    }
  }

  const SegFile& seg_;
  MemoryBudget& budget_;
  LayerStack stack_;
  std::vector<float> pixels_;  // of one frame
  std::vector<bool> marks_;    // frame by frame
};

void fill_layers(const SegFile& seg, LabelMap& map, MemoryBudget& budget) {
  LayerBuilder builder(seg, map, budget);
  const auto frames = frames_by_segment(seg);
  for (Segment& segment : map.segments) {
    const auto found = frames.find(segment.label);
    if (found != frames.end()) builder.add(segment, found->second);
  }
  if (map.layers.empty()) builder.add_layer();
}

void fill_labels(const SegFile& seg, LabelMap& map, MemoryBudget& budget) {
  std::set<Index> known{0};
  for (const Segment& segment : map.segments) known.insert(segment.label);
  LayerStack(map, budget).add_layer();
  std::vector<float> pixels;
  for (std::size_t frame = 0; frame < seg.grid.slice.size(); ++frame) {
    read_frame(seg, frame, pixels, budget);
    const std::size_t begin = frame_begin(seg, frame);
    Index last = 0;  // neighbours mostly have one label
    for (std::size_t n = 0; n < pixels.size(); ++n) {
      const auto label = static_cast<Index>(pixels[n]);
      if (label != last && !known.count(label)) {
        refuse(seg.file.path, message("expected labels of the Segment Sequence, found ", label,
                                      " in frame ", frame + 1));
      }
      last = label;
      map.layers[0][begin + n] = static_cast<std::uint16_t>(label);
    }
  }
}

}  // namespace

LabelFile read_dicom_labels(const std::filesystem::path& path, MemoryBudget& budget) {
  const SegFile seg = open_seg(path, budget);
  LabelFile out{{seg.grid.grid, {}, seg.segments}, "DICOM", {}};
  seg.type == SegType::kLabels ? fill_labels(seg, out.map, budget)
                               : fill_layers(seg, out.map, budget);
  return out;
}

ProbabilityFile read_dicom_probabilities(const std::filesystem::path& path, MemoryBudget& budget) {
  const SegFile seg = open_seg(path, budget);
  if (seg.type == SegType::kLabels) {
    refuse(path, "expected a fractional or binary segmentation, found one of segment numbers");
  }
  require_voxels(seg.file, seg.grid.grid, seg.segments.size());
  ProbabilityFile out{{seg.grid.grid, {}, seg.segments}, {}};
  Probabilities& all = out.probabilities;
  std::map<Index, std::size_t> layer_of;
  for (std::size_t n = 0; n < all.segments.size(); ++n) {
    layer_of[all.segments[n].label] = n;
    all.segments[n].label = static_cast<Index>(n + 1);
    all.segments[n].layer = static_cast<Index>(n);
  }
  budget.claim(std::uint64_t{all.segments.size()} * all.voxel_count(), sizeof(float),
               "probabilities");
  all.layers.assign(all.segments.size(), std::vector<float>(all.voxel_count()));
  const double most = seg.type == SegType::kFractional ? seg.most : 1;
  std::vector<float> pixels;
  for (std::size_t frame = 0; frame < seg.number.size(); ++frame) {
    read_frame(seg, frame, pixels, budget);
    float* to = all.layers[layer_of.at(seg.number[frame])].data() + frame_begin(seg, frame);
    for (const float pixel : pixels) *to++ = static_cast<float>(std::min(pixel / most, 1.0));
  }
  return out;
}

}  // namespace mesamis::detail::label_files
