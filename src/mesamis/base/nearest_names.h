// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "mesamis/rooms.h"

/// Names that a user may have meant.
namespace mesamis::detail::base {

/// The fewest characters to insert, remove, replace or swap with their neighbour that turn one text
/// into the other; no character is edited twice (optimal string alignment).
///
/// O(product of the lengths).
std::size_t edit_distance(std::string_view a, std::string_view b);

/// The names nearest to a word, by edit_distance(): at most three, equally near, in the order given.
/// If none is near enough, those that begin with the word.
/// @return empty if no name is like the word: a third of its characters may differ, one at least.
std::vector<std::string> nearest_names(std::string_view word, std::span<const std::string> names);

/// "; did you mean --tolerance?", or "; did you mean level or label?"; empty without such names.
std::string did_you_mean(std::string_view word, std::span<const std::string> names);

}  // namespace mesamis::detail::base
