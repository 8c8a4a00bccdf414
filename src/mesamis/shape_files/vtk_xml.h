// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "mesamis/files/memory_budget.h"
#include "mesamis/files/number_type.h"
#include "mesamis/files/xml.h"

/// VTK's XML files, read without VTK: its own reader crashes on damaged ones.
namespace mesamis::detail::shape_files {

/// An attribute that counts something; missing is 0.
/// @throws InputError  if it is no whole number or negative.
std::size_t count_in(const std::filesystem::path& file, const XmlElement& element,
                     const std::string& name);

/// The most values per tuple of an array; a file that names more is taken for damaged.
inline constexpr int kMostComponents = 1000;

/// The attribute NumberOfComponents of an array; missing is 1.
/// @return             1 to kMostComponents.
/// @throws InputError  if it is anything else.
std::size_t components_in(const std::filesystem::path& file, const XmlElement& data_array);

class VtkXml {
 public:
  /// @param file    for messages
  /// @param bytes   the whole file, unpacked; must live on.
  /// @param type    e.g. "PolyData".
  /// @param budget  of the reader; must live on.
  /// @throws InputError  if it is no such file, and as MemoryBudget::claim().
  VtkXml(std::filesystem::path file, std::string_view bytes, const std::string& type,
         MemoryBudget& budget);

  /// The element <PolyData>, or what the type is.
  const XmlElement& data_set() const;

  /// The values of a DataArray: text, base64 or raw, plain or packed by zlib. Nothing is unpacked
  /// before the array's own header names the expected size.
  /// @param count        how many values the rest of the file leads to expect.
  /// @return             values that are claimed: free_within() gives them back.
  /// @throws InputError  if there are more or fewer, they are cut off, broken or packed in another
  ///                     way, or the arrays read so far have more bytes than the file: they
  ///                     overlap; and as MemoryBudget::claim().
  std::vector<double> values(const XmlElement& data_array, std::size_t count);

  /// The first text of an Array of type String, or of a DataArray that holds the bytes of texts,
  /// see vtk_text_bytes(); empty if it is none.
  /// @throws InputError  as values(), or if the texts have more than 1 MiB.
  std::string text(const XmlElement& array);

  /// All texts of such an array.
  /// @throws InputError  as values(), or if the texts have more than 16 MiB.
  std::vector<std::string> texts(const XmlElement& array);

 private:
  class StoredArray;
  struct Layout;
  StoredArray stored_array(const XmlElement& data_array) const;
  std::uint64_t header_number(StoredArray& stored, std::size_t index) const;
  Layout layout_of(StoredArray& stored) const;
  std::vector<std::size_t> packed_sizes(StoredArray& stored, std::uint64_t blocks) const;
  std::string unpack(StoredArray& stored, const Layout& layout);
  std::string text_bytes(const XmlElement& array, std::uint64_t most_bytes);

  std::filesystem::path file_;
  MemoryBudget& budget_;
  std::string type_;
  XmlElement root_;
  std::string_view appended_;
  std::size_t appended_bytes_read_ = 0;
  bool appended_is_raw_ = false, packed_ = false;
  ByteOrder order_ = ByteOrder::kLittle;
  NumberType header_type_ = NumberType::kUint32;
};

}  // namespace mesamis::detail::shape_files
