// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "mesamis/rooms.h"

/// Shared by the text headers of NRRD and MetaImage.
namespace mesamis::detail::volume_files {

/// Header lines one by one; bounded, so that a binary file is not taken for a long line.
class HeaderLines {
 public:
  /// @throws InputError  if the file cannot be read.
  explicit HeaderLines(const std::filesystem::path& file);
  /// The next line without its end (\n, \r\n or, if the first line has it, \r alone); false at the
  /// end of the file.
  /// @throws InputError  if a line or the header is longer than a header can be.
  bool next(std::string& line);
  /// Bytes read so far.
  std::uint64_t position() const { return position_; }

 private:
  enum class Ends { kUnknown, kNewline, kReturn };

  /// Whether a \r that was read ends its line alone: the first line tells.
  bool ends_here();

  std::filesystem::path file_;
  std::ifstream in_;
  Ends ends_ = Ends::kUnknown;
  std::uint64_t position_ = 0;
};

/// Fields by lower-case name.
using HeaderFields = std::map<std::string, std::string>;

/// Where a header's data file is.
/// @param name           as the header has it: of a file in its folder or below.
/// @param allow_outside  the name may lead out of that folder, by ".." or as an absolute path.
/// @throws InputError    if it does where it may not: a header from elsewhere must not choose which
///                       files of the machine are read.
std::filesystem::path data_path(const std::filesystem::path& header, const std::string& name,
                                bool allow_outside);

/// The names that a pattern stands for: "slice%03d.raw 1 20 1" is slice001.raw to slice020.raw.
/// @param text  a name with one %d, %03d or the like, the first and the last number, and the step
///              (1 where it is not given); what follows is ignored.
/// @throws InputError  for any other text, and for more than 100 000 names.
std::vector<std::string> numbered_names(const std::filesystem::path& file, std::string_view text);

/// Where the data files of a header are that names several, one after the other.
/// @param header  the file.
/// @param name    "LIST ...", or a pattern as numbered_names() takes it.
/// @param listed  the lines that follow the header, for a LIST.
/// @throws InputError  for no name at all, and as data_path() does.
std::vector<std::filesystem::path> listed_paths(const std::filesystem::path& header,
                                                std::string_view name,
                                                const std::vector<std::string>& listed,
                                                bool allow_outside);

/// Words between white space.
std::vector<std::string> words_of(std::string_view text);

/// Numbers between white space. @throws InputError  naming the field if one is none or their
/// count is not the one expected.
std::vector<double> numbers_of(const std::filesystem::path& file, const std::string& field,
                               std::string_view text, std::size_t expected);

/// The same for whole numbers.
std::vector<std::int64_t> whole_numbers_of(const std::filesystem::path& file,
                                           const std::string& field, std::string_view text,
                                           std::size_t expected);

}  // namespace mesamis::detail::volume_files
