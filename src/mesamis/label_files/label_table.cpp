// SPDX-License-Identifier: Apache-2.0
#include "mesamis/label_files/label_table.h"

#include <algorithm>
#include <optional>
#include <set>
#include <string>
#include <string_view>

#include "mesamis/files/byte_source.h"
#include "mesamis/files/file_list.h"
#include "mesamis/files/in_one_line.h"
#include "mesamis/files/refuse.h"
#include "mesamis/files/text_scan.h"
#include "mesamis/files/text_writer.h"
#include "mesamis/label_files/label_values.h"

namespace mesamis::detail::label_files {
namespace {

namespace fs = std::filesystem;

constexpr std::uint64_t kMostBytes = 1 << 24;

struct Word {
  std::string_view text;
  bool quoted = false;
};

/// The words of a line; what stands in quotes is one word. None if a quote is left open.
std::optional<std::vector<Word>> words_of(std::string_view line) {
  std::vector<Word> words;
  for (;;) {
    line.remove_prefix(std::min(line.find_first_not_of(" \t\r"), line.size()));
    if (line.empty()) return words;
    if (!line.starts_with('"')) {
      words.push_back({take_word(line)});
      continue;
    }
    const std::size_t end = line.find('"', 1);
    if (end == std::string_view::npos) return std::nullopt;
    words.push_back({line.substr(1, end - 1), true});
    line.remove_prefix(end + 1);
  }
}

/// Three whole numbers of 0 to 255 from `first` on.
std::optional<std::array<std::uint8_t, 3>> bytes_in(const std::vector<Word>& words,
                                                    std::size_t first) {
  std::array<std::uint8_t, 3> colour{};
  for (std::size_t c = 0; c < 3; ++c) {
    std::int64_t value = 0;
    if (!parse_number(words[first + c].text, value) || value < 0 || value > 255) {
      return std::nullopt;
    }
    colour[c] = static_cast<std::uint8_t>(value);
  }
  return colour;
}

/// IDX R G B A VIS MSH "NAME", or IDX NAME [R G B [A]].
std::optional<Segment> segment_in(std::string_view line) {
  const auto words = words_of(line);
  if (!words || words->size() < 2) return std::nullopt;
  Segment segment;
  if (!set_number(segment, (*words)[0].text)) return std::nullopt;
  const bool snap = words->size() == 8 && (*words)[7].quoted;
  const std::size_t count = words->size();
  if (!snap && count != 2 && count != 5 && count != 6) return std::nullopt;
  const auto colour = count == 2 ? default_colour(segment.label) : bytes_in(*words, snap ? 1 : 2);
  segment.name = (*words)[snap ? 7 : 1].text;
  if (!colour || (segment.name.empty() && number_of(segment) > 0)) return std::nullopt;
  segment.colour = *colour;
  return segment;
}

std::vector<Segment> parse_table(const fs::path& path, std::string_view text) {
  std::vector<Segment> table;
  std::set<std::int64_t> seen;
  std::string_view line;
  for (std::size_t number = 1; take_line(text, line); ++number) {
    const std::string_view content = trimmed(line);
    if (content.empty() || content.starts_with('#')) continue;
    const auto segment = segment_in(content);
    if (!segment) {
      refuse(path,
             message("line ", number, ": expected IDX R G B A VIS MSH \"NAME\" or IDX NAME R G B A",
                     " with a whole IDX from 0, found ", in_quotes(content)));
    }
    const std::int64_t label = number_of(*segment);
    if (label == 0) continue;
    if (!seen.insert(label).second) {
      refuse(path, message("line ", number, ": expected each label once, found ", label, " again"));
    }
    table.push_back(*segment);
  }
  if (table.empty()) refuse(path, "expected a table of labels, found none");
  return table;
}

std::string plain_name(std::string name) {
  for (char& c : name) {
    if (c == '"') c = '\'';
    if (static_cast<unsigned char>(c) < ' ') c = '?';
  }
  return name;
}

}  // namespace

std::vector<Segment> read_label_table(const fs::path& path) {
  return in_one_line(path, [&] {
    const std::uint64_t size = size_of(path);
    if (size > kMostBytes) {
      refuse(path, message("expected a table of at most ", kMostBytes, " bytes, found ", size));
    }
    std::string text(size, '\0');
    text.resize(ByteSource(path, Packing::kPlain).read(text.data(), size));
    return parse_table(path, text);
  });
}

void write_label_table(const OutputPath& path, std::span<const Segment> segments) {
  std::set<Index> seen;
  for (const Segment& s : segments) {
    if (s.label < 1 || s.label > kMaxLabel || !seen.insert(s.label).second) {
      refuse(path, message("cannot be written: expected each label of 1 to ", kMaxLabel,
                           " once, found ", s.label));
    }
  }
  TextWriter out(path);
  out << "# ITK-SnAP Label Description File\n"
         "# IDX  R  G  B  A  VIS MSH  LABEL (A: 0 to 1; VIS: shown; MSH: in 3D)\n"
         "0 0 0 0 0 0 0 \"Clear Label\"\n";
  for (const Segment& s : segments) {
    out << s.label;
    for (const std::uint8_t c : s.colour) out << " " << static_cast<int>(c);
    out << " 1 1 1 \"" << plain_name(s.name) << "\"\n";
  }
  out.commit();
}

}  // namespace mesamis::detail::label_files
