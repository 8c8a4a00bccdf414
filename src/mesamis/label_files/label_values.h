// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "mesamis/files/memory_budget.h"
#include "mesamis/image/label_map.h"

/// Numbers of files as labels, probabilities and colours.
namespace mesamis::detail::label_files {

/// How the values of several layers lie among the samples of a file.
struct LayerOrder {
  std::size_t inner = 1;  ///< layers whose values of one voxel follow one another
  std::size_t outer = 1;  ///< layers that follow one another
};

/// Makes layers of labels from the samples of a file, which come block by block in its order.
///
/// Samples within 0.01 of a whole number are rounded, and NaN is background; warnings count them.
/// Numbers above kMaxLabel, which atlases have, get labels that no other object of the file has.
class LabelBuilder {
 public:
  /// Larger whole numbers may have been rounded, to double or to single precision.
  static constexpr double kExactDouble = 9007199254740992.0, kExactFloat = 16777216.0;

  /// @param file    for messages.
  /// @param budget  for the layers, which are claimed and made when the first sample is there. It
  ///                must live as long.
  LabelBuilder(std::filesystem::path file, const VoxelGrid& grid, const LayerOrder& order,
               MemoryBudget& budget);

  /// Takes the next samples, at most as many as are left.
  /// @throws InputError  naming the voxel of the first sample that is no label or so large that it
  ///                     may have been rounded, for more than kMaxLabel different ones, and as
  ///                     MemoryBudget::claim().
  ///
  /// O(samples).
  void add(std::span<const double> samples);
  void add(std::span<const float> samples);

  /// Fills the layers of a map whose grid is set, and adds the segments that are missing.
  /// @param map       its segments may name numbers above kMaxLabel: their label is then 0.
  /// @param warnings  what was rounded or renumbered is added.
  /// @throws InputError  as with_all_segments().
  ///
  /// O(samples).
  LabelMap finish(LabelMap map, std::vector<std::string>& warnings);

 private:
  void begin();
  void add_one(double sample, double exact);
  double whole(double sample, double exact);
  std::uint16_t code_of(std::int64_t number);
  std::vector<std::uint16_t> labels_of_codes() const;
  std::string place() const;
  std::string renumbered(const std::vector<std::uint16_t>& label) const;

  std::filesystem::path file_;
  VoxelGrid grid_;
  LayerOrder order_;
  MemoryBudget& budget_;
  std::vector<std::vector<std::uint16_t>> layers_;  // codes, until the end
  std::vector<std::int64_t> numbers_{0};            // of the codes
  std::vector<std::uint16_t> small_;                // codes of numbers up to kMaxLabel
  std::unordered_map<std::int64_t, std::uint16_t> large_;
  std::size_t outer_ = 0, voxel_ = 0, inner_ = 0;  // of the next sample
  std::size_t rounded_ = 0, nan_ = 0;
  std::string first_rounded_;
};

/// Splits samples into layers of probabilities; values up to 1e-3 beyond 0 and 1 are set to these.
/// @throws InputError  naming the first voxel whose sample is none.
std::vector<std::vector<float>> probability_layers(const std::filesystem::path& file,
                                                   const VoxelGrid& grid, const LayerOrder& order,
                                                   const std::vector<float>& samples);

/// A label in decimals, 0 to 65535; none if the text is no such number.
std::optional<Index> label_in(std::string_view text);

/// Gives a segment the number that a file has for it, in decimals: its label up to kMaxLabel, else
/// its number in the file and the label 0.
/// @return false if the text is no number of 0 to 2^53 - 1.
bool set_number(Segment& segment, std::string_view text);

/// The number that a file has for a segment.
inline std::int64_t number_of(const Segment& segment) {
  return segment.number_in_file > 0 ? segment.number_in_file : std::int64_t{segment.label};
}

/// A colour of three decimals of 0 to 1; none if one of them is no such number.
std::optional<std::array<std::uint8_t, 3>> colour_in(const std::array<std::string_view, 3>& text);

/// The share of a colour's greatest value, in the shortest decimals that colour_in() reads back.
std::string colour_share(std::uint8_t colour);

}  // namespace mesamis::detail::label_files
