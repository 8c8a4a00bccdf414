// SPDX-License-Identifier: Apache-2.0
#include "mesamis/files/refuse.h"

#include <algorithm>
#include <charconv>
#include <system_error>

#include "mesamis/base/error.h"
#include "mesamis/base/utf8.h"

namespace mesamis::detail::files {
namespace {

template <class Number>
bool parse_whole(std::string_view text, Number& value) {
  if (text.starts_with('+')) text.remove_prefix(1);
  const char* end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, value);
  return error == std::errc{} && stop == end;
}

}  // namespace

std::string shown(std::string_view text) {
  std::string out(text);
  std::replace_if(
      out.begin(), out.end(), [](char c) { return c < ' ' || c > '~'; }, '?');
  return out;
}

std::string in_quotes(std::string_view text, std::size_t longest) {
  return '"' + shown(text.substr(0, longest)) + (text.size() > longest ? "...\"" : "\"");
}

void refuse(const std::filesystem::path& file, const std::string& what) {
  constexpr std::size_t kLongest = 400;  // bytes; files may bring texts of any length
  throw InputError(as_one_line(file.string() + ": " + shortened(what, kLongest)));
}

std::string lower(std::string_view text) {
  std::string out(text);
  for (char& c : out) c = c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  return out;
}

std::string upper(std::string_view text) {
  std::string out(text);
  for (char& c : out) c = c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c;
  return out;
}

std::string lower_extension(const std::filesystem::path& path) {
  return lower(path.extension().string());
}

std::string_view trimmed(std::string_view text) {
  constexpr std::string_view kBlank(" \t\r\n\v\f\0", 7);
  const auto first = text.find_first_not_of(kBlank);
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(kBlank) - first + 1);
}

bool parse_number(std::string_view text, double& value) { return parse_whole(text, value); }
bool parse_number(std::string_view text, std::int64_t& value) { return parse_whole(text, value); }

}  // namespace mesamis::detail::files
