// SPDX-License-Identifier: Apache-2.0
#include "mesamis/picture/series_style.h"

#include <iterator>

namespace mesamis::detail::picture {
namespace {

// Dark and light alternate.
constexpr const char* kColors[] = {"#1b2a6b", "#d4550f", "#0b7f6f",
                                   "#7b1e5a", "#3a8fd0", "#6b5a00"};
constexpr const char* kDashes[] = {"none", "10 5", "2 5", "12 5 2 5", "18 4"};
constexpr const char* kMarkers[] = {
    "M-5.5 0a5.5 5.5 0 1 0 11 0a5.5 5.5 0 1 0 -11 0z",  // circle
    "M-5 -5h10v10h-10z",                                // square
    "M0 -6.5L6.2 4.8H-6.2z",                            // triangle
    "M0 -7L7 0L0 7L-7 0z",                              // diamond
};

template <std::size_t N>
const char* cyclic(const char* const (&values)[N], std::size_t number) {
  return values[number % N];
}

}  // namespace

SeriesStyle series_style(std::size_t number) {
  // Filled and hollow markers alternate, and change places after each round of shapes.
  const bool filled = (number + number / std::size(kMarkers)) % 2 == 0;
  return {cyclic(kColors, number), cyclic(kDashes, number), cyclic(kMarkers, number), filled};
}

}  // namespace mesamis::detail::picture
