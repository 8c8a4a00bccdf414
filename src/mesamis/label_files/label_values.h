// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string_view>
#include <vector>

#include "mesamis/image/label_map.h"

/// Numbers of files as labels, probabilities and colours.
namespace mesamis::detail {

/// How the values of several layers lie among the samples of a file.
struct LayerOrder {
  std::size_t inner = 1;  ///< layers whose values of one voxel follow one another
  std::size_t outer = 1;  ///< layers that follow one another
};

/// Splits samples into layers of labels.
/// @throws InputError  naming the first voxel whose sample is no whole number of 0 to 65535.
std::vector<std::vector<std::uint16_t>> label_layers(const std::filesystem::path& file,
                                                     const VoxelGrid& grid, const LayerOrder& order,
                                                     const std::vector<float>& samples);

/// Splits samples into layers of probabilities; values up to 1e-3 beyond 0 and 1 are set to these.
/// @throws InputError  naming the first voxel whose sample is none.
std::vector<std::vector<float>> probability_layers(const std::filesystem::path& file,
                                                   const VoxelGrid& grid, const LayerOrder& order,
                                                   const std::vector<float>& samples);

/// A label in decimals, 0 to 65535; none if the text is no such number.
std::optional<Index> label_in(std::string_view text);

/// A colour of three decimals of 0 to 1; none if one of them is no such number.
std::optional<std::array<std::uint8_t, 3>> colour_in(const std::array<std::string_view, 3>& text);

/// The share of a colour's greatest value, in the shortest decimals that colour_in() reads back.
std::string colour_share(std::uint8_t colour);

}  // namespace mesamis::detail
