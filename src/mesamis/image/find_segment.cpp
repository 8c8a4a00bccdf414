// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <charconv>
#include <numeric>

#include "mesamis/base/each_once.h"
#include "mesamis/base/error.h"
#include "mesamis/base/utf8.h"
#include "mesamis/image/label_map.h"

namespace mesamis {
namespace {

constexpr std::size_t kMostListed = 12;   // segments in a message
constexpr std::size_t kLongestName = 60;  // bytes of a name in a message

std::string lower(std::string_view text) {
  std::string out(text);
  for (char& c : out) c = c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  return out;
}

/// The text in quotes as a line of a message may show it.
std::string in_quotes(std::string_view text) {
  return "\"" + shortened(as_one_line(text), kLongestName) + "\"";
}

std::string title(const Segment& segment) {
  return in_quotes(segment.name) + " (" + std::to_string(segment.label) + ")";
}

std::string list(const std::vector<Segment>& segments) {
  std::string text;
  for (std::size_t n = 0; n < std::min(segments.size(), kMostListed); ++n) {
    text += (n > 0 ? ", " : "") + title(segments[n]);
  }
  return segments.size() > kMostListed ? text + ", ..." : text;
}

/// The least number of characters to insert, remove or replace: Levenshtein's distance.
std::size_t distance(std::string_view a, std::string_view b) {
  std::vector<std::size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), std::size_t{0});
  for (std::size_t i = 0; i < a.size(); ++i) {
    std::size_t corner = row[0]++;
    for (std::size_t j = 0; j < b.size(); ++j) {
      const std::size_t replaced = corner + (a[i] == b[j] ? 0 : 1);
      corner = row[j + 1];
      row[j + 1] = std::min({replaced, row[j] + 1, corner + 1});
    }
  }
  return row.back();
}

/// How far a name is from what was asked for. A name that contains it comes first.
std::size_t strangeness(std::string_view name, std::string_view wanted) {
  const std::string a = lower(name.substr(0, kLongestName));
  const std::string b = lower(wanted.substr(0, kLongestName));
  return a.find(b) != std::string::npos ? 0 : 1 + distance(a, b);
}

[[noreturn]] void refuse_unknown(std::span<const Segment> segments, std::string_view wanted) {
  std::string message =
      "label: expected the name or number of a segment, found " + in_quotes(wanted);
  std::vector<Segment> all(segments.begin(), segments.end());
  if (all.empty()) throw InputError(message + "; there are none");
  if (all.size() <= kMostListed) throw InputError(message + "; there are " + list(all));
  std::vector<std::pair<std::size_t, std::size_t>> order;
  for (std::size_t n = 0; n < all.size(); ++n) {
    order.emplace_back(strangeness(all[n].name, wanted), n);
  }
  constexpr std::size_t kNearest = 5;
  std::partial_sort(order.begin(), order.begin() + kNearest, order.end());
  std::vector<Segment> nearest;
  for (std::size_t n = 0; n < kNearest; ++n) nearest.push_back(all[order[n].second]);
  throw InputError(message + "; the nearest of " + std::to_string(all.size()) + " are " +
                   list(nearest));
}

template <class Fits>
std::vector<Segment> those_that(std::span<const Segment> segments, Fits fits) {
  std::vector<Segment> found;
  std::copy_if(segments.begin(), segments.end(), std::back_inserter(found), fits);
  return found;
}

/// The number that fills the text; 0 if there is none.
std::int64_t number_in(std::string_view text) {
  std::int64_t number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  return error == std::errc() && end == text.data() + text.size() ? number : 0;
}

}  // namespace

Segment find_segment(std::span<const Segment> segments, std::string_view name_or_label) {
  const std::int64_t number = number_in(name_or_label);
  auto found = those_that(segments, [&](const Segment& s) {
    return s.name == name_or_label ||
           (number > 0 && (s.label == number || s.number_in_file == number));
  });
  if (found.empty()) {
    const std::string name = lower(name_or_label);
    found = those_that(segments, [&](const Segment& s) { return lower(s.name) == name; });
  }
  if (found.empty()) refuse_unknown(segments, name_or_label);
  if (found.size() > 1) {
    throw InputError("label: expected one segment called " + in_quotes(name_or_label) + ", found " +
                     std::to_string(found.size()) + ": " + list(found));
  }
  return found[0];
}

std::vector<Segment> find_segments(std::span<const Segment> segments,
                                   std::span<const std::string> names_or_labels) {
  std::vector<Segment> found;
  for (const std::string& text : names_or_labels) {
    const Segment segment = find_segment(segments, text);
    add_once(found, segment);
  }
  return found;
}

}  // namespace mesamis
