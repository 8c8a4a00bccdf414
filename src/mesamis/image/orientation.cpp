// SPDX-License-Identifier: Apache-2.0
#include "mesamis/image/orientation.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace mesamis::detail::image {
namespace {

constexpr std::array<std::array<char, 2>, 3> kLetters{{{'L', 'R'}, {'P', 'A'}, {'S', 'I'}}};

char letter_along(int axis, double cosine) {
  return kLetters[static_cast<std::size_t>(axis)][cosine < 0];
}

}  // namespace

int body_axis(const Vec3& direction) noexcept {
  int axis = 0;
  for (const int other : {1, 2}) {
    if (std::abs(direction[other]) > std::abs(direction[axis])) axis = other;
  }
  return axis;
}

char side_letter(const Vec3& direction) noexcept {
  const int axis = body_axis(direction);
  return letter_along(axis, direction[axis]);
}

GridOrientation orientation_of(const Mat3& direction) {
  const auto cosine = [&direction](int axis, std::size_t grid_axis) {
    return direction.rows[static_cast<std::size_t>(axis)][static_cast<int>(grid_axis)];
  };
  std::array<int, 3> body{0, 1, 2}, best = body;
  double most = -1;
  do {
    double sum = 0;
    for (std::size_t a = 0; a < 3; ++a) sum += std::abs(cosine(body[a], a));
    if (sum > most) best = body, most = sum;
  } while (std::next_permutation(body.begin(), body.end()));
  GridOrientation found{{}, 0};
  for (std::size_t a = 0; a < 3; ++a) {
    const double c = cosine(best[a], a);
    found.letters[a] = letter_along(best[a], c);
    const double angle = std::acos(std::min(std::abs(c), 1.0)) * 180 / std::numbers::pi;
    found.oblique_deg = std::max(found.oblique_deg, angle);
  }
  return found;
}

}  // namespace mesamis::detail::image
