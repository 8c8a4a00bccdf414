// SPDX-License-Identifier: Apache-2.0
#include "mesamis/shape_files/vtk_xml.h"

#include <zlib.h>

#include <algorithm>
#include <cstdint>

#include "mesamis/files/deflate.h"
#include "mesamis/files/refuse.h"
#include "mesamis/files/text_scan.h"

namespace mesamis::detail::shape_files {
namespace {

namespace fs = std::filesystem;

/// Appends to `bytes`. Stops at `most` bytes, give or take two, and at the first character that is
/// not base64. Padding may stand amid the text: VTK encodes an array's header and its data one
/// after the other.
void decode_base64(std::string_view text, std::size_t most, std::string& bytes) {
  auto digit = [](char c) {
    constexpr std::string_view kDigits =
        "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    const auto at = kDigits.find(c);
    return at == kDigits.npos ? -1 : static_cast<int>(at);
  };
  for (; text.size() >= 4 && bytes.size() < most; text.remove_prefix(4)) {
    const std::size_t padding = text[3] != '=' ? 0 : text[2] != '=' ? 1 : 2;
    unsigned group = 0;
    for (std::size_t i = 0; i < 4; ++i) {
      const int value = i < 4 - padding ? digit(text[i]) : 0;
      if (value < 0) return;
      group = group << 6 | static_cast<unsigned>(value);
    }
    for (std::size_t i = 0; i < 3 - padding; ++i) {
      bytes += static_cast<char>(group >> (16 - 8 * i) & 0xff);
    }
  }
}

NumberType type_named(const fs::path& file, const std::string& name) {
  constexpr const char* kNames[] = {"Int8",   "UInt8", "Int16",  "UInt16",  "Int32",
                                    "UInt32", "Int64", "UInt64", "Float32", "Float64"};
  const auto* found = std::find(std::begin(kNames), std::end(kNames), name);
  if (found == std::end(kNames))
    refuse(file, "expected a type of numbers, found " + in_quotes(name));
  return static_cast<NumberType>(found - std::begin(kNames));
}

std::vector<double> numbers_in(const fs::path& file, std::string_view text, MemoryBudget& budget) {
  std::vector<double> numbers;
  for (auto word = take_word(text); !word.empty(); word = take_word(text)) {
    double value = 0;
    if (!parse_number(word, value)) refuse(file, "expected a number, found " + in_quotes(word));
    append_within(budget, numbers, value, "values of arrays");
  }
  return numbers;
}

}  // namespace

/// The bytes of one array as they are stored, from its header on. Base64 is decoded as far as it is
/// needed: what follows belongs to other arrays.
class VtkXml::StoredArray {
 public:
  StoredArray(std::string_view stored, bool is_base64, bool is_appended, MemoryBudget& budget)
      : stored_(stored), is_base64_(is_base64), is_appended_(is_appended), budget_(budget) {}
  ~StoredArray() { budget_.give_back(decoded_.capacity()); }
  StoredArray(const StoredArray&) = delete;
  StoredArray& operator=(const StoredArray&) = delete;

  /// The first n bytes, or fewer where the file ends before.
  std::string_view first(std::size_t n) {
    if (!is_base64_) return stored_.substr(0, n);
    if (decoded_.size() < n) {
      decoded_.clear();
      constexpr std::size_t kGroup = 3;  // bytes of the last four digits
      reserve_within(budget_, decoded_, std::min(n, stored_.size()) + kGroup, "stored values");
      decode_base64(stored_, n, decoded_);
    }
    return std::string_view(decoded_).substr(0, n);
  }
  /// No array of this file has more.
  std::size_t most_bytes() const { return stored_.size(); }
  bool is_appended() const { return is_appended_; }

 private:
  std::string_view stored_;
  bool is_base64_, is_appended_;
  MemoryBudget& budget_;
  std::string decoded_;
};

/// The layout of an array as its header states it: blocks one after another, packed or not.
struct VtkXml::Layout {
  struct Block {
    std::size_t stored_size, plain_size;
  };
  std::size_t header_size = 0;
  std::vector<Block> blocks;
  std::uint64_t plain_size = 0;  ///< of all blocks

  void add(std::size_t stored_size, std::size_t size) {
    blocks.push_back({stored_size, size});
    plain_size += size;
  }
};

std::size_t count_in(const fs::path& file, const XmlElement& element, const std::string& name) {
  std::int64_t count = 0;
  const std::string text = element.attribute(name);
  if (!text.empty() && (!parse_number(std::string_view(text), count) || count < 0)) {
    refuse(file, "expected a count in " + name + ", found " + in_quotes(text));
  }
  return static_cast<std::size_t>(count);
}

std::size_t components_in(const fs::path& file, const XmlElement& data_array) {
  if (data_array.attribute("NumberOfComponents").empty()) return 1;
  const std::size_t count = count_in(file, data_array, "NumberOfComponents");
  if (count >= 1 && count <= std::size_t{kMostComponents}) return count;
  refuse(file, message("expected 1 to ", kMostComponents, " components in the array ",
                       in_quotes(data_array.attribute("Name")), ", found ", count));
}

VtkXml::VtkXml(fs::path file, std::string_view bytes, const std::string& type, MemoryBudget& budget)
    : file_(std::move(file)), budget_(budget), type_(type) {
  if (bytes.substr(0, 1000).find("<VTKFile") == bytes.npos) refuse(file_, "is not a VTK XML file");
  XmlDocument document = parse_xml(file_, bytes, budget_, {.ends_at_appended_data = true});
  root_ = std::move(document.root);
  appended_ = document.appended;
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

std::vector<double> VtkXml::values(const XmlElement& data_array, std::size_t count) {
  auto require_count = [&](std::uint64_t found) {
    if (found == count) return;
    refuse(file_, message("expected ", count, " values in the array ",
                          in_quotes(data_array.attribute("Name")), ", found ", found));
  };
  if (data_array.attribute("format") == "ascii") {
    std::vector<double> numbers = numbers_in(file_, data_array.text, budget_);
    require_count(numbers.size());
    return numbers;
  }
  const NumberType type = type_named(file_, data_array.attribute("type"));
  const std::size_t size = byte_size(type);
  StoredArray stored = stored_array(data_array);
  const Layout layout = layout_of(stored);
  require_count(layout.plain_size / size);
  const ScopedClaim blocks(budget_, layout.blocks.capacity(), sizeof(Layout::Block), "blocks");
  const ScopedClaim unpacked(budget_, layout.plain_size, 1, "unpacked values");
  const std::string bytes = unpack(stored, layout);
  std::vector<double> numbers;
  reserve_within(budget_, numbers, count, "values of arrays");
  numbers.resize(count);
  for (std::size_t i = 0; i < count; ++i) {
    numbers[i] = load_number(bytes.data() + i * size, type, order_);
  }
  return numbers;
}

std::string VtkXml::text_bytes(const XmlElement& array, std::uint64_t most_bytes) {
  if (array.attribute("format") != "ascii") {
    StoredArray stored = stored_array(array);
    const Layout layout = layout_of(stored);
    if (layout.plain_size <= most_bytes) return unpack(stored, layout);
    refuse(file_,
           message("expected texts of at most ", most_bytes, " bytes, found ", layout.plain_size));
  }
  std::string bytes;
  std::vector<double> codes = numbers_in(file_, array.text, budget_);
  for (const double code : codes) {
    bytes += code > 0 && code < 256 ? static_cast<char>(static_cast<unsigned char>(code)) : '\0';
  }
  free_within(budget_, codes);
  return bytes;
}

std::string VtkXml::text(const XmlElement& array) {
  const std::string bytes = text_bytes(array, 1 << 20);
  return bytes.substr(0, bytes.find('\0'));
}

std::vector<std::string> VtkXml::texts(const XmlElement& array) {
  const std::string bytes = text_bytes(array, 1 << 24);
  std::vector<std::string> texts;
  for (std::size_t at = 0; at < bytes.size();) {
    const std::size_t end = std::min(bytes.find('\0', at), bytes.size());
    budget_.claim(1, end - at, "texts");
    append_within(budget_, texts, bytes.substr(at, end - at), "texts");
    at = end + 1;
  }
  return texts;
}

VtkXml::StoredArray VtkXml::stored_array(const XmlElement& data_array) const {
  const std::string format = data_array.attribute("format");
  if (format == "binary") return {trimmed(data_array.text), true, false, budget_};
  if (format != "appended") {
    refuse(file_, "expected an array in ascii, binary or appended, found " + in_quotes(format));
  }
  std::int64_t offset = 0;
  if (!parse_number(std::string_view(data_array.attribute("offset")), offset) || offset < 0 ||
      static_cast<std::uint64_t>(offset) >= appended_.size()) {
    refuse(file_, "an array begins beyond the end of the file");
  }
  return {appended_.substr(static_cast<std::size_t>(offset)), !appended_is_raw_, true, budget_};
}

std::uint64_t VtkXml::header_number(StoredArray& stored, std::size_t index) const {
  const std::size_t size = byte_size(header_type_);
  const std::string_view bytes = stored.first((index + 1) * size);
  if (bytes.size() < (index + 1) * size) refuse(file_, "an array is cut off");
  const char* number = bytes.data() + index * size;
  return size == 8 ? load<std::uint64_t>(number, order_) : load<std::uint32_t>(number, order_);
}

/// Plain: the number of bytes, the bytes. Packed: the number of blocks, the size of a block and of
/// the last one if that is smaller, the packed size of each block, the blocks.
VtkXml::Layout VtkXml::layout_of(StoredArray& stored) const {
  const std::size_t size = byte_size(header_type_);
  const std::uint64_t first = header_number(stored, 0);
  if (first > stored.most_bytes()) refuse(file_, "an array is cut off");
  Layout layout{size, {}, 0};
  if (!packed_) layout.add(static_cast<std::size_t>(first), static_cast<std::size_t>(first));
  if (!packed_ || first == 0) return layout;
  const std::vector<std::size_t> packed = packed_sizes(stored, first);
  const std::uint64_t whole = header_number(stored, 1), partial = header_number(stored, 2);
  for (const std::size_t& block : packed) {
    const std::uint64_t plain = &block == &packed.back() && partial != 0 ? partial : whole;
    if (plain / kMostDeflateRatio > block) refuse(file_, "an array is cut off");
    layout.add(block, static_cast<std::size_t>(plain));
  }
  layout.header_size = (3 + packed.size()) * size;
  return layout;
}

std::vector<std::size_t> VtkXml::packed_sizes(StoredArray& stored, std::uint64_t blocks) const {
  header_number(stored, static_cast<std::size_t>(2 + blocks));  // decodes the header at once
  std::vector<std::size_t> sizes;
  std::uint64_t sum = 0;
  // The sizes, and the layout that is made of them.
  const ScopedClaim claim(budget_, blocks, sizeof(std::size_t) + 2 * sizeof(Layout::Block),
                          "blocks");
  sizes.reserve(static_cast<std::size_t>(blocks));
  for (std::uint64_t b = 0; b < blocks; ++b) {
    const std::uint64_t size = header_number(stored, static_cast<std::size_t>(3 + b));
    if (size > stored.most_bytes() - sum) refuse(file_, "an array is cut off");
    sum += size;
    sizes.push_back(static_cast<std::size_t>(size));
  }
  return sizes;
}

std::string VtkXml::unpack(StoredArray& stored, const Layout& layout) {
  std::size_t end = layout.header_size;
  for (const Layout::Block& block : layout.blocks) end += block.stored_size;
  const std::string_view bytes = stored.first(end);
  if (bytes.size() < end) refuse(file_, "an array is cut off");
  // Each byte belongs to one array: many that name the same block would multiply the memory.
  if (stored.is_appended()) appended_bytes_read_ += end;
  if (appended_bytes_read_ > appended_.size()) refuse(file_, "its arrays overlap");
  std::string plain(static_cast<std::size_t>(layout.plain_size), '\0');
  if (!packed_) return plain.assign(bytes.substr(layout.header_size));
  std::size_t at = layout.header_size, done = 0;
  for (const auto& [stored_size, plain_size] : layout.blocks) {
    auto length = static_cast<uLongf>(plain_size);
    const int status = uncompress(reinterpret_cast<Bytef*>(plain.data() + done), &length,
                                  reinterpret_cast<const Bytef*>(bytes.data() + at), stored_size);
    if (status != Z_OK || length != plain_size) refuse(file_, "the packed values are broken");
    at += stored_size;
    done += plain_size;
  }
  return plain;
}

}  // namespace mesamis::detail::shape_files
