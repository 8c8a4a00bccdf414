// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "mesamis/io/detail/number_type.h"
#include "mesamis/io/detail/xml.h"

/// VTK's XML files, read without VTK: its own reader crashes on damaged ones.
namespace mesamis::detail {

/// An attribute that counts something; missing is 0.
/// @throws InputError  if it is no whole number or negative.
std::size_t count_in(const std::filesystem::path& file, const XmlElement& element,
                     const std::string& name);

class VtkXml {
 public:
  /// @param file   for messages
  /// @param bytes  the whole file, unpacked; must live on.
  /// @param type   e.g. "PolyData".
  /// @throws InputError  if it is no such file.
  VtkXml(std::filesystem::path file, std::string_view bytes, const std::string& type);

  /// The element <PolyData>, or what the type is.
  const XmlElement& data_set() const;

  /// The values of a DataArray: text, base64 or raw, plain or packed by zlib.
  /// @throws InputError  if they are cut off, broken or packed in another way.
  std::vector<double> values(const XmlElement& data_array) const;

  /// The first text of an Array of type String; empty if it is none.
  std::string text(const XmlElement& array) const;

 private:
  std::string array_bytes(const XmlElement& data_array) const;
  std::string unpack(std::string_view stored) const;
  std::uint64_t header_number(std::string_view stored, std::size_t index) const;

  std::filesystem::path file_;
  std::string type_;
  XmlElement root_;
  std::string_view appended_;
  bool appended_is_raw_ = false, packed_ = false;
  ByteOrder order_ = ByteOrder::kLittle;
  NumberType header_type_ = NumberType::kUint32;
};

}  // namespace mesamis::detail
