// SPDX-License-Identifier: Apache-2.0
#include "mesamis/label_files/label_values.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "mesamis/files/refuse.h"
#include "mesamis/files/text_writer.h"

namespace mesamis::detail::label_files {
namespace {

/// Calls visit(layer, voxel, sample) for each sample.
template <class Visit>
void for_each_sample(const VoxelGrid& grid, const LayerOrder& order,
                     const std::vector<float>& samples, Visit visit) {
  const std::size_t voxels = grid.voxel_count();
  std::size_t at = 0;
  for (std::size_t outer = 0; outer < order.outer; ++outer) {
    for (std::size_t voxel = 0; voxel < voxels; ++voxel) {
      for (std::size_t inner = 0; inner < order.inner; ++inner) {
        visit(outer * order.inner + inner, voxel, samples[at++]);
      }
    }
  }
}

std::string place_of(const VoxelGrid& grid, std::size_t voxel) {
  const auto [i, j, k] = grid.voxel(voxel);
  return message("voxel ", i, " ", j, " ", k);
}

}  // namespace

LabelBuilder::LabelBuilder(std::filesystem::path file, const VoxelGrid& grid,
                           const LayerOrder& order, MemoryBudget& budget)
    : file_(std::move(file)),
      grid_(grid),
      order_(order),
      budget_(budget),
      small_(std::size_t{kMaxLabel} + 1) {}

void LabelBuilder::begin() {
  if (!layers_.empty()) return;
  const std::size_t layers = order_.inner * order_.outer;
  budget_.claim(layers * grid_.voxel_count(), sizeof(std::uint16_t), "labels");
  layers_.assign(layers, std::vector<std::uint16_t>(grid_.voxel_count()));
}

void LabelBuilder::add(std::span<const double> samples) {
  begin();
  for (const double sample : samples) add_one(sample, kExactDouble);
}

void LabelBuilder::add(std::span<const float> samples) {
  begin();
  for (const float sample : samples) add_one(static_cast<double>(sample), kExactFloat);
}

void LabelBuilder::add_one(double sample, double exact) {
  const double number = whole(sample, exact);
  if (number != 0) {
    layers_[outer_ * order_.inner + inner_][voxel_] = code_of(static_cast<std::int64_t>(number));
  }
  if (++inner_ < order_.inner) return;
  inner_ = 0;
  if (++voxel_ < grid_.voxel_count()) return;
  voxel_ = 0;
  ++outer_;
}

/// The nearest whole number, if it is near enough.
double LabelBuilder::whole(double sample, double exact) {
  if (sample >= 0 && sample <= kMaxLabel && sample == std::floor(sample)) return sample;
  if (std::isnan(sample)) {
    ++nan_;
    return 0;
  }
  constexpr double kNear = 0.01;  // what scaling and resampling leave of a whole number
  const double number = std::round(sample);
  if (!(std::abs(sample - number) <= kNear) || number < 0 || !(number < exact)) {
    refuse(file_,
           message("expected labels, whole numbers of 0 to ", static_cast<std::int64_t>(exact) - 1,
                   ", found ", sample, " at ", place()));
  }
  if (number != sample && rounded_++ == 0) first_rounded_ = message(sample, " at ", place());
  return number;
}

std::uint16_t LabelBuilder::code_of(std::int64_t number) {
  std::uint16_t& code =
      number <= kMaxLabel ? small_[static_cast<std::size_t>(number)] : large_[number];
  if (code == 0) {
    if (numbers_.size() > static_cast<std::size_t>(kMaxLabel)) {
      refuse(file_, message("expected at most ", kMaxLabel, " different labels, found more"));
    }
    code = static_cast<std::uint16_t>(numbers_.size());
    numbers_.push_back(number);
  }
  return code;
}

/// Numbers up to kMaxLabel are labels; the larger ones, in ascending order, get those that follow
/// the greatest of these, then those that are left.
std::vector<std::uint16_t> LabelBuilder::labels_of_codes() const {
  std::vector<std::uint16_t> label(numbers_.size());
  std::vector<std::pair<std::int64_t, std::uint16_t>> large(large_.begin(), large_.end());
  std::sort(large.begin(), large.end());
  std::size_t greatest = 0;
  for (std::size_t code = 1; code < numbers_.size(); ++code) {
    if (numbers_[code] > kMaxLabel) continue;
    label[code] = static_cast<std::uint16_t>(numbers_[code]);
    greatest = std::max(greatest, std::size_t{label[code]});
  }
  std::size_t next = greatest;
  for (const auto& [number, code] : large) {
    do {
      next = next % static_cast<std::size_t>(kMaxLabel) + 1;
    } while (small_[next] != 0);
    label[code] = static_cast<std::uint16_t>(next);
  }
  return label;
}

std::string LabelBuilder::place() const { return place_of(grid_, voxel_); }

std::string LabelBuilder::renumbered(const std::vector<std::uint16_t>& label) const {
  constexpr std::size_t kMostShown = 3;
  std::string text =
      message(large_.size(), " labels are above ", kMaxLabel, " and get new numbers: ");
  std::size_t shown = 0;
  for (std::size_t code = 1; code < numbers_.size() && shown < kMostShown; ++code) {
    if (numbers_[code] <= kMaxLabel) continue;
    text += message(shown++ ? ", " : "", numbers_[code], " becomes ", label[code]);
  }
  return text + (large_.size() > kMostShown ? ", ..." : "");
}

LabelMap LabelBuilder::finish(LabelMap map, std::vector<std::string>& warnings) {
  begin();
  for (const Segment& named : map.segments) {  // of which some may not occur
    std::uint16_t& code = small_[static_cast<std::size_t>(named.label)];
    code = std::max(code, std::uint16_t{1});
  }
  const std::vector<std::uint16_t> label = labels_of_codes();
  for (auto& layer : layers_) {
    for (std::uint16_t& code : layer) code = label[code];
  }
  map.layers = std::move(layers_);
  std::vector<Segment> names = map.segments;
  std::erase_if(names, [](const Segment& s) { return s.label != 0; });
  std::erase_if(map.segments, [](const Segment& s) { return s.label == 0; });
  map = with_all_segments(std::move(map));
  if (!large_.empty()) {
    std::vector<std::int64_t> number(std::size_t{kMaxLabel} + 1);
    for (const auto& [large, code] : large_) number[label[code]] = large;
    for (Segment& segment : map.segments) {
      segment.number_in_file = number[static_cast<std::size_t>(segment.label)];
      if (segment.number_in_file > 0) segment.name = message("label ", segment.number_in_file);
    }
    map = with_names(std::move(map), names);
    warnings.push_back(renumbered(label));
  }
  if (rounded_ > 0) {
    warnings.push_back(message(rounded_, " values are nearly whole, the first ", first_rounded_,
                               ": rounded to labels"));
  }
  if (nan_ > 0) warnings.push_back(message(nan_, " values are not a number: taken as background"));
  return map;
}

std::vector<std::vector<float>> probability_layers(const std::filesystem::path& file,
                                                   const VoxelGrid& grid, const LayerOrder& order,
                                                   const std::vector<float>& samples) {
  constexpr float kBeyond = 1e-3f;
  std::vector<std::vector<float>> layers(order.inner * order.outer);
  for (auto& layer : layers) layer.resize(grid.voxel_count());
  for_each_sample(grid, order, samples, [&](std::size_t layer, std::size_t voxel, float sample) {
    if (!(sample >= -kBeyond && sample <= 1 + kBeyond)) {
      refuse(file, message("expected probabilities of 0 to 1, found ", sample, " at ",
                           place_of(grid, voxel)));
    }
    layers[layer][voxel] = std::clamp(sample, 0.0f, 1.0f);
  });
  return layers;
}

std::optional<Index> label_in(std::string_view text) {
  std::int64_t number = 0;
  if (!parse_number(trimmed(text), number) || number < 0 || number > kMaxLabel) return std::nullopt;
  return static_cast<Index>(number);
}

bool set_number(Segment& segment, std::string_view text) {
  std::int64_t number = 0;
  const auto most = static_cast<std::int64_t>(LabelBuilder::kExactDouble) - 1;
  if (!parse_number(trimmed(text), number) || number < 0 || number > most) return false;
  segment.label = number <= kMaxLabel ? static_cast<Index>(number) : 0;
  segment.number_in_file = number <= kMaxLabel ? 0 : number;
  return true;
}

std::optional<std::array<std::uint8_t, 3>> colour_in(const std::array<std::string_view, 3>& text) {
  std::array<std::uint8_t, 3> colour{};
  for (std::size_t c = 0; c < 3; ++c) {
    double share = 0;
    if (!parse_number(trimmed(text[c]), share) || !(share >= 0 && share <= 1)) return std::nullopt;
    colour[c] = static_cast<std::uint8_t>(std::lround(255 * share));
  }
  return colour;
}

std::string colour_share(std::uint8_t colour) {
  std::string share;
  append_shortest(share, colour / 255.0);
  return share;
}

}  // namespace mesamis::detail::label_files
