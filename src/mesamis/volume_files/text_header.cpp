// SPDX-License-Identifier: Apache-2.0
#include "mesamis/volume_files/text_header.h"

#include <algorithm>
#include <array>
#include <cstdlib>
#include <sstream>

#include "mesamis/files/file_list.h"
#include "mesamis/files/read_record.h"
#include "mesamis/files/refuse.h"

namespace mesamis::detail::volume_files {
namespace {

namespace fs = std::filesystem;

constexpr std::uint64_t kLongestHeader = 1 << 20;

template <class Number>
std::vector<Number> parse_all(const std::filesystem::path& file, const std::string& field,
                              std::string_view text, std::size_t expected) {
  std::vector<Number> numbers;
  for (const std::string& word : words_of(text)) {
    Number value{};
    if (!parse_number(std::string_view(word), value)) {
      refuse(file, message("expected numbers in the field ", in_quotes(field), ", found ",
                           in_quotes(word)));
    }
    numbers.push_back(value);
  }
  if (numbers.size() != expected) {
    refuse(file, message("expected ", expected, " numbers in the field ", in_quotes(field),
                         ", found ", numbers.size()));
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

bool HeaderLines::ends_here() {
  if (ends_ == Ends::kUnknown) {
    const auto follows = in_.peek();
    const bool alone = follows != '\n' && follows != '\r';
    ends_ = alone ? Ends::kReturn : Ends::kNewline;
  }
  return ends_ == Ends::kReturn;
}

bool HeaderLines::next(std::string& line) {
  line.clear();
  char c = 0;
  bool any = false;
  while (in_.get(c)) {
    any = true;
    if (++position_ > kLongestHeader) {
      refuse(file_,
             message("expected a header of at most ", kLongestHeader, " bytes, found no end"));
    }
    if (c == '\n' && ends_ == Ends::kUnknown) ends_ = Ends::kNewline;
    if (c == '\n' || (c == '\r' && ends_here())) break;
    line += c;
  }
  if (line.ends_with('\r')) line.pop_back();
  return any;
}

std::filesystem::path data_path(const std::filesystem::path& header, const std::string& name,
                                bool allow_outside) {
  const std::filesystem::path path(name);
  const std::size_t longest = allow_outside ? 4096 : 255;  // bytes: of a path, of a file's name
  const bool is_name = name.size() <= longest && name.find('\0') == std::string::npos;
  if (!is_name) {
    refuse(header, message("expected the name of a data file, found ", in_quotes(name)));
  }
  const bool leaves = path.is_absolute() || std::find(path.begin(), path.end(), "..") != path.end();
  if (leaves && !allow_outside) {
    refuse(header, message("expected a data file in the header's folder, found ", in_quotes(name),
                           " (--allow-outside allows it)"));
  }
  return header.parent_path() / path;
}

std::vector<std::string> numbered_names(const std::filesystem::path& file, std::string_view text) {
  constexpr std::int64_t kMost = 100'000, kMostNumber = 1'000'000'000;
  const std::vector<std::string> words = words_of(text);
  std::array<std::int64_t, 3> range{0, 0, 1};  // first, last, step
  bool good = words.size() >= 3;
  for (std::size_t n = 0; good && n < 3 && n + 1 < words.size(); ++n) {
    good = parse_number(std::string_view(words[n + 1]), range[n]);
  }
  const auto [first, last, step] = range;
  const std::string name = words.empty() ? "" : words[0];
  const auto mark = name.find('%'), end = name.find('d', std::min(mark, name.size()));
  std::int64_t width = 0;
  const std::string_view digits =
      end == std::string::npos ? "" : std::string_view(name).substr(mark + 1, end - mark - 1);
  good = good && end != std::string::npos && (digits.empty() || parse_number(digits, width)) &&
         width >= 0 && width <= 20 && step != 0 && std::abs(step) <= kMost && first >= 0 &&
         last >= 0 && first <= kMostNumber && last <= kMostNumber &&
         std::abs(last - first) / std::abs(step) < kMost && (last >= first) == (step > 0);
  if (!good) {
    refuse(file, message("expected a pattern of data files, such as slice%03d.raw 1 20 1, found ",
                         in_quotes(text)));
  }
  std::vector<std::string> names;
  for (std::int64_t n = first; step > 0 ? n <= last : n >= last; n += step) {
    std::string number = std::to_string(n);
    const auto wanted = static_cast<std::size_t>(width);
    if (number.size() < wanted) number.insert(0, wanted - number.size(), '0');
    names.push_back(name.substr(0, mark) + number + name.substr(end + 1));
  }
  return names;
}

std::vector<fs::path> listed_paths(const fs::path& header, std::string_view name,
                                   const std::vector<std::string>& listed, bool allow_outside) {
  const auto names = name.starts_with("LIST") ? listed : numbered_names(header, name);
  if (names.empty()) refuse(header, "expected a list of data files, found an empty one");
  std::vector<fs::path> paths;
  paths.reserve(names.size());
  for (const std::string& one : names) paths.push_back(data_path(header, one, allow_outside));
  return paths;
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

}  // namespace mesamis::detail::volume_files
