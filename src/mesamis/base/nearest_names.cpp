// SPDX-License-Identifier: Apache-2.0
#include "mesamis/base/nearest_names.h"

#include <algorithm>
#include <limits>
#include <numeric>

namespace mesamis::detail::base {
namespace {

constexpr std::size_t kMostNames = 3;
/// A longer word is no name that was mistyped.
constexpr std::size_t kLongestWord = 60;

std::vector<std::string> beginning_with(std::string_view word, std::span<const std::string> names) {
  constexpr std::size_t kShortest = 3;
  std::vector<std::string> found;
  if (word.size() < kShortest) return found;
  for (const std::string& name : names) {
    if (name.starts_with(word) && found.size() < kMostNames) found.push_back(name);
  }
  return found;
}

}  // namespace

std::size_t edit_distance(std::string_view a, std::string_view b) {
  std::vector<std::size_t> before(b.size() + 1), last(b.size() + 1), row(b.size() + 1);
  std::iota(last.begin(), last.end(), std::size_t{0});
  for (std::size_t i = 1; i <= a.size(); ++i) {
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t differs = a[i - 1] == b[j - 1] ? 0 : 1;
      row[j] = std::min({last[j] + 1, row[j - 1] + 1, last[j - 1] + differs});
      const bool swapped = i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1];
      if (swapped) row[j] = std::min(row[j], before[j - 2] + 1);
    }
    before.swap(last);
    last.swap(row);
  }
  return last.back();
}

std::vector<std::string> nearest_names(std::string_view word, std::span<const std::string> names) {
  std::vector<std::string> nearest;
  if (word.size() > kLongestWord) return nearest;
  const std::size_t letters = word.size() - std::min(word.find_first_not_of('-'), word.size());
  std::size_t least = std::max<std::size_t>(1, letters / 3);
  for (const std::string& name : names) {
    const std::size_t distance = edit_distance(word, name);
    if (distance > least || distance >= letters) continue;
    if (distance < least) nearest.clear();
    least = distance;
    if (nearest.size() < kMostNames) nearest.push_back(name);
  }
  return nearest.empty() ? beginning_with(word, names) : nearest;
}

std::string did_you_mean(std::string_view word, std::span<const std::string> names) {
  const std::vector<std::string> nearest = nearest_names(word, names);
  if (nearest.empty()) return {};
  std::string text = "; did you mean " + nearest.front();
  for (std::size_t n = 1; n < nearest.size(); ++n) {
    text += (n + 1 < nearest.size() ? ", " : " or ") + nearest[n];
  }
  return text + "?";
}

}  // namespace mesamis::detail::base
