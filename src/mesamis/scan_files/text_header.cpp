// SPDX-License-Identifier: Apache-2.0
#include "mesamis/scan_files/text_header.h"

#include <algorithm>
#include <sstream>

#include "mesamis/files/file_list.h"
#include "mesamis/files/read_record.h"
#include "mesamis/files/refuse.h"

namespace mesamis::detail {
namespace {

constexpr std::uint64_t kLongestHeader = 1 << 20;

template <class Number>
std::vector<Number> parse_all(const std::filesystem::path& file, const std::string& field,
                              std::string_view text, std::size_t expected) {
  std::vector<Number> numbers;
  for (const std::string& word : words_of(text)) {
    Number value{};
    if (!parse_number(std::string_view(word), value)) {
      refuse(file,
             say("expected numbers in the field ", in_quotes(field), ", found ", in_quotes(word)));
    }
    numbers.push_back(value);
  }
  if (numbers.size() != expected) {
    refuse(file, say("expected ", expected, " numbers in the field ", in_quotes(field), ", found ",
                     numbers.size()));
  }
  return numbers;
}

}  // namespace

HeaderLines::HeaderLines(const std::filesystem::path& file) : file_(file) {
  require_file(file);
  const FileState before = state_of(file);
  in_.open(file, std::ios::binary);
  if (!in_) refuse(file, "cannot be read");
  note_read(file, before);
}

bool HeaderLines::next(std::string& line) {
  line.clear();
  char c = 0;
  bool any = false;
  while (in_.get(c)) {
    any = true;
    if (++position_ > kLongestHeader) {
      refuse(file_, say("expected a header of at most ", kLongestHeader, " bytes, found no end"));
    }
    if (c == '\n') break;
    line += c;
  }
  if (line.ends_with('\r')) line.pop_back();
  return any;
}

std::filesystem::path data_path(const std::filesystem::path& header, const std::string& name,
                                bool allow_outside) {
  const std::filesystem::path path(name);
  const bool leaves = path.is_absolute() || std::find(path.begin(), path.end(), "..") != path.end();
  if (leaves && !allow_outside) {
    refuse(header, say("expected a data file in the header's folder, found ", in_quotes(name),
                       " (--allow-outside allows it)"));
  }
  return header.parent_path() / path;
}

std::vector<std::string> words_of(std::string_view text) {
  std::istringstream in{std::string(text)};
  std::vector<std::string> words;
  for (std::string word; in >> word;) words.push_back(word);
  return words;
}

std::vector<double> numbers_of(const std::filesystem::path& file, const std::string& field,
                               std::string_view text, std::size_t expected) {
  return parse_all<double>(file, field, text, expected);
}

std::vector<std::int64_t> whole_numbers_of(const std::filesystem::path& file,
                                           const std::string& field, std::string_view text,
                                           std::size_t expected) {
  return parse_all<std::int64_t>(file, field, text, expected);
}

}  // namespace mesamis::detail
