// SPDX-License-Identifier: Apache-2.0
#include "mesamis/io/detail/vtk_xml.h"

#include <zlib.h>

#include <algorithm>
#include <cstdint>

#include "mesamis/io/detail/refuse.h"
#include "mesamis/io/detail/text_scan.h"

namespace mesamis::detail {
namespace {

namespace fs = std::filesystem;

/// Stops at the first character that is not base64. Padding may stand amid the text: VTK encodes an
/// array's header and its data one after the other.
std::string base64_bytes(std::string_view text) {
  auto digit = [](char c) {
    constexpr std::string_view kDigits =
        "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    const auto at = kDigits.find(c);
    return at == kDigits.npos ? -1 : static_cast<int>(at);
  };
  std::string bytes;
  for (; text.size() >= 4; text.remove_prefix(4)) {
    const std::size_t padding = text[3] != '=' ? 0 : text[2] != '=' ? 1 : 2;
    unsigned group = 0;
    for (std::size_t i = 0; i < 4; ++i) {
      const int value = i < 4 - padding ? digit(text[i]) : 0;
      if (value < 0) return bytes;
      group = group << 6 | static_cast<unsigned>(value);
    }
    for (std::size_t i = 0; i < 3 - padding; ++i) {
      bytes += static_cast<char>(group >> (16 - 8 * i) & 0xff);
    }
  }
  return bytes;
}

NumberType type_named(const fs::path& file, const std::string& name) {
  constexpr const char* kNames[] = {"Int8",   "UInt8", "Int16",  "UInt16",  "Int32",
                                    "UInt32", "Int64", "UInt64", "Float32", "Float64"};
  const auto* found = std::find(std::begin(kNames), std::end(kNames), name);
  if (found == std::end(kNames))
    refuse(file, "expected a type of numbers, found " + in_quotes(name));
  return static_cast<NumberType>(found - std::begin(kNames));
}

std::vector<double> numbers_in(const fs::path& file, std::string_view text) {
  std::vector<double> numbers;
  for (auto word = take_word(text); !word.empty(); word = take_word(text)) {
    double value = 0;
    if (!parse_number(word, value)) refuse(file, "expected a number, found " + in_quotes(word));
    numbers.push_back(value);
  }
  return numbers;
}

}  // namespace

std::size_t count_in(const fs::path& file, const XmlElement& element, const std::string& name) {
  std::int64_t count = 0;
  const std::string text = element.attribute(name);
  if (!text.empty() && (!parse_number(std::string_view(text), count) || count < 0)) {
    refuse(file, "expected a count in " + name + ", found " + in_quotes(text));
  }
  return static_cast<std::size_t>(count);
}

VtkXml::VtkXml(fs::path file, std::string_view bytes, const std::string& type)
    : file_(std::move(file)), type_(type) {
  if (bytes.substr(0, 1000).find("<VTKFile") == bytes.npos) refuse(file_, "is not a VTK XML file");
  root_ = parse_xml(file_, bytes, &appended_);
  if (root_.attribute("type") != type || root_.child(type) == nullptr) {
    refuse(file_, "expected VTK data of the type " + type + ", found " +
                      in_quotes(root_.attribute("type")));
  }
  const std::string compressor = root_.attribute("compressor");
  packed_ = !compressor.empty();
  if (packed_ && compressor != "vtkZLibDataCompressor") {
    refuse(file_, "expected no compressor or zlib, found " + in_quotes(compressor));
  }
  if (root_.attribute("byte_order") == "BigEndian") order_ = ByteOrder::kBig;
  if (root_.attribute("header_type") == "UInt64") header_type_ = NumberType::kUint64;
  if (const XmlElement* appended = root_.child("AppendedData")) {
    appended_is_raw_ = appended->attribute("encoding") == "raw";
  }
}

const XmlElement& VtkXml::data_set() const { return *root_.child(type_); }

std::vector<double> VtkXml::values(const XmlElement& data_array) const {
  if (data_array.attribute("format") == "ascii") return numbers_in(file_, data_array.text);
  const NumberType type = type_named(file_, data_array.attribute("type"));
  const std::string bytes = array_bytes(data_array);
  std::vector<double> numbers(bytes.size() / byte_size(type));
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    numbers[i] = load_number(bytes.data() + i * byte_size(type), type, order_);
  }
  return numbers;
}

std::string VtkXml::text(const XmlElement& array) const {
  std::string bytes;
  if (array.attribute("format") == "ascii") {
    for (const double code : numbers_in(file_, array.text)) {
      bytes += code > 0 && code < 128 ? static_cast<char>(code) : '\0';
    }
  } else {
    bytes = array_bytes(array);
  }
  return bytes.substr(0, bytes.find('\0'));
}

std::string VtkXml::array_bytes(const XmlElement& data_array) const {
  const std::string format = data_array.attribute("format");
  if (format == "binary") return unpack(base64_bytes(trimmed(data_array.text)));
  if (format != "appended") {
    refuse(file_, "expected an array in ascii, binary or appended, found " + in_quotes(format));
  }
  std::int64_t offset = 0;
  if (!parse_number(std::string_view(data_array.attribute("offset")), offset) || offset < 0 ||
      static_cast<std::uint64_t>(offset) >= appended_.size()) {
    refuse(file_, "an array begins beyond the end of the file");
  }
  const std::string_view stored = appended_.substr(static_cast<std::size_t>(offset));
  return appended_is_raw_ ? unpack(stored) : unpack(base64_bytes(stored));
}

std::uint64_t VtkXml::header_number(std::string_view stored, std::size_t index) const {
  const std::size_t size = byte_size(header_type_);
  if (stored.size() / size <= index) refuse(file_, "an array is cut off");
  const char* bytes = stored.data() + index * size;
  return size == 8 ? load<std::uint64_t>(bytes, order_) : load<std::uint32_t>(bytes, order_);
}

/// Plain: the number of bytes, the bytes. Packed: the number of blocks, the size of a block and of
/// the last one if that is smaller, the packed size of each block, the blocks.
std::string VtkXml::unpack(std::string_view stored) const {
  const std::size_t size = byte_size(header_type_);
  const std::uint64_t first = header_number(stored, 0);
  if (!packed_) {
    if (first > stored.size() - size) refuse(file_, "an array is cut off");
    return std::string(stored.substr(size, static_cast<std::size_t>(first)));
  }
  if (first == 0) return {};
  if (first > stored.size() / size) refuse(file_, "an array is cut off");
  const std::uint64_t whole = header_number(stored, 1), partial = header_number(stored, 2);
  auto at = static_cast<std::size_t>((3 + first) * size);
  std::string bytes;
  for (std::uint64_t block = 0; block < first; ++block) {
    const std::uint64_t packed = header_number(stored, static_cast<std::size_t>(3 + block));
    const std::uint64_t plain = block + 1 == first && partial != 0 ? partial : whole;
    constexpr std::uint64_t kMostDeflateRatio = 1032;
    if (at > stored.size() || packed > stored.size() - at || plain / kMostDeflateRatio > packed) {
      refuse(file_, "an array is cut off");
    }
    const std::size_t before = bytes.size();
    bytes.resize(before + static_cast<std::size_t>(plain));
    auto length = static_cast<uLongf>(plain);
    const int status =
        uncompress(reinterpret_cast<Bytef*>(bytes.data() + before), &length,
                   reinterpret_cast<const Bytef*>(stored.data() + at), static_cast<uLong>(packed));
    if (status != Z_OK || length != plain) refuse(file_, "the packed values are broken");
    at += static_cast<std::size_t>(packed);
  }
  return bytes;
}

}  // namespace mesamis::detail
