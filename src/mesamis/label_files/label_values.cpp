// SPDX-License-Identifier: Apache-2.0
#include "mesamis/label_files/label_values.h"

#include <algorithm>
#include <cmath>

#include "mesamis/files/refuse.h"
#include "mesamis/files/text_writer.h"

namespace mesamis::detail {
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
  return say("voxel ", i, " ", j, " ", k);
}

}  // namespace

std::vector<std::vector<std::uint16_t>> label_layers(const std::filesystem::path& file,
                                                     const VoxelGrid& grid, const LayerOrder& order,
                                                     const std::vector<float>& samples) {
  std::vector<std::vector<std::uint16_t>> layers(order.inner * order.outer);
  for (auto& layer : layers) layer.resize(grid.voxel_count());
  for_each_sample(grid, order, samples, [&](std::size_t layer, std::size_t voxel, float sample) {
    if (!(sample >= 0 && sample <= kMaxLabel) || sample != std::floor(sample)) {
      refuse(file, say("expected labels, whole numbers of 0 to ", kMaxLabel, ", found ", sample,
                       " at ", place_of(grid, voxel)));
    }
    layers[layer][voxel] = static_cast<std::uint16_t>(sample);
  });
  return layers;
}

std::vector<std::vector<float>> probability_layers(const std::filesystem::path& file,
                                                   const VoxelGrid& grid, const LayerOrder& order,
                                                   const std::vector<float>& samples) {
  constexpr float kBeyond = 1e-3f;
  std::vector<std::vector<float>> layers(order.inner * order.outer);
  for (auto& layer : layers) layer.resize(grid.voxel_count());
  for_each_sample(grid, order, samples, [&](std::size_t layer, std::size_t voxel, float sample) {
    if (!(sample >= -kBeyond && sample <= 1 + kBeyond)) {
      refuse(file, say("expected probabilities of 0 to 1, found ", sample, " at ",
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

}  // namespace mesamis::detail
