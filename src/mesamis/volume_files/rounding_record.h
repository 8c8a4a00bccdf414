// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <concepts>
#include <cstdint>
#include <filesystem>
#include <limits>
#include <string>
#include <type_traits>
#include <vector>

#include "mesamis/rooms.h"

/// What single precision loses of samples that a file holds in more digits.
namespace mesamis::detail::volume_files {

/// Holds every whole number of 64 bits, where the machine has such a type.
using Exact = long double;

/// Samples before they were rounded to single precision, in their unit.
struct RoundedSamples {
  Exact least = std::numeric_limits<Exact>::infinity(), greatest = -least;
  /// The same of samples other than 0, which often stands for what was not measured.
  Exact least_but_0 = least, greatest_but_0 = greatest;
  Exact error = 0;         ///< the largest by which one was rounded
  Exact beyond = 0;        ///< one that is too large for single precision; 0: none
  bool same_value = true;  ///< all that were noted are rounded to one value
  float value = 0;         ///< that one
  bool empty = true;

  /// Notes a sample; not those that are no finite numbers.
  void note(Exact exact, float rounded) noexcept;
  /// Notes those of another block.
  void note(const RoundedSamples& others) noexcept;
};

/// Whether numbers of a type, as they are stored, may have more digits than single precision.
template <class Stored>
constexpr bool kMayBeRounded = std::same_as<Stored, double> ||
                               (std::integral<Stored> && sizeof(Stored) >= sizeof(float));

/// The same of native values, slope * stored + intercept: whole ones of up to 24 bits have not.
template <class Stored>
bool may_be_rounded(double slope, double intercept) noexcept {
  if (slope == 1 && intercept == 0) return kMayBeRounded<Stored>;
  if (!std::integral<Stored> || kMayBeRounded<Stored>) return true;
  constexpr double kMost = 1 << 24, kMostStored = 1 << 8 * sizeof(std::uint16_t);
  const bool whole = slope == std::floor(slope) && intercept == std::floor(intercept);
  return !whole || std::abs(slope) * kMostStored + std::abs(intercept) > kMost;
}

/// Notes what is rounded on this thread while it lives. Of records within one another the innermost
/// counts.
class RoundingRecord {
 public:
  /// Begins an empty record.
  RoundingRecord();
  ~RoundingRecord();
  RoundingRecord(const RoundingRecord&) = delete;
  RoundingRecord& operator=(const RoundingRecord&) = delete;

  /// Adds a warning where the samples lose more than a 4096th of their range.
  /// @throws InputError  if they differ, but single precision has one value for all of them, or
  ///                     none that is large enough.
  void warn(const std::filesystem::path& file, std::vector<std::string>& warnings) const;

 private:
  friend void note_rounded(const RoundedSamples&);

  RoundingRecord* outer_;
  RoundedSamples noted_;
};

/// For readers: notes samples that were rounded, where somebody asks.
void note_rounded(const RoundedSamples& samples);

}  // namespace mesamis::detail::volume_files
