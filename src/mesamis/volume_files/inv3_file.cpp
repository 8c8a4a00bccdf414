// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <map>
#include <optional>

#include "mesamis/files/refuse.h"
#include "mesamis/files/xml.h"
#include "mesamis/volume_files/formats.h"

namespace mesamis::detail::volume_files {
namespace {

constexpr std::size_t kTarBlock = 512;
constexpr std::uint64_t kLongestPlist = 1 << 20;
constexpr const char* kMainPlist = "main.plist";

/// One entry of a tar: its name without folders, where its bytes begin, how many there are.
struct TarEntry {
  std::string name;
  std::uint64_t begin = 0, size = 0;
};

std::string_view tar_field(const std::array<char, kTarBlock>& block, std::size_t at,
                           std::size_t length) {
  const std::string_view field(block.data() + at, length);
  return field.substr(0, field.find('\0'));
}

/// Octal digits, or (GNU) base 256 where the first bit is set.
std::optional<std::uint64_t> tar_size(const std::array<char, kTarBlock>& block) {
  std::uint64_t size = 0;
  if (static_cast<unsigned char>(block[124]) == 0x80) {
    for (std::size_t n = 128; n < 136; ++n) size = size << 8 | static_cast<unsigned char>(block[n]);
    return size;
  }
  const std::string_view digits = trimmed(tar_field(block, 124, 12));
  for (const char c : digits) {
    if (c < '0' || c > '7') return std::nullopt;
    size = size * 8 + static_cast<std::uint64_t>(c - '0');
  }
  return size;
}

/// A tar read from front to back.
class Tar {
 public:
  explicit Tar(const std::filesystem::path& file) : file_(file), bytes_(file, Packing::kSniffed) {}

  /// The next regular file; none at the end of the archive.
  std::optional<TarEntry> next() {
    std::array<char, kTarBlock> block;
    while (true) {
      position_ += bytes_.skip(unread_);
      if (bytes_.read(block.data(), kTarBlock) < kTarBlock || block[0] == '\0') return {};
      position_ += kTarBlock;
      const auto size = tar_size(block);
      if (std::string_view(block.data() + 257, 5) != "ustar" || !size ||
          *size > bytes_.most_bytes()) {
        refuse(file_,
               message("expected a tar entry at byte ", position_ - kTarBlock, ", found none"));
      }
      unread_ = (*size + kTarBlock - 1) / kTarBlock * kTarBlock;
      if (block[156] != '0' && block[156] != '\0') continue;
      const std::filesystem::path name(tar_field(block, 0, 100));
      return TarEntry{name.filename().string(), position_, *size};
    }
  }

  /// The bytes of the entry that next() gave.
  std::string text(const TarEntry& entry) {
    if (entry.size > kLongestPlist) {
      refuse(file_, message(entry.name, ": expected at most ", kLongestPlist, " bytes, found ",
                            entry.size));
    }
    std::string out(entry.size, '\0');
    if (bytes_.read(out.data(), out.size()) < out.size()) refuse(file_, entry.name + " is cut off");
    unread_ -= out.size();
    position_ += out.size();
    return out;
  }

 private:
  std::filesystem::path file_;
  ByteSource bytes_;
  std::uint64_t position_ = 0, unread_ = 0;
};

/// The value of a key in a dictionary of a property list, where keys and values alternate; null if
/// there is none.
const XmlElement* value_of(const XmlElement& dict, std::string_view key) {
  for (std::size_t n = 0; n + 1 < dict.children.size(); ++n) {
    const XmlElement& element = dict.children[n];
    if (element.name == "key" && trimmed(element.text) == key) return &dict.children[n + 1];
  }
  return nullptr;
}

/// A property list: <plist> with a <dict>.
class Plist {
 public:
  Plist(const std::filesystem::path& file, std::string_view xml, MemoryBudget& budget)
      : root_(parse_xml(file / kMainPlist, xml, budget).root) {}

  /// The texts at a path of keys, e.g. "matrix/shape": of one value or of an array's; empty if
  /// there is no such value.
  std::vector<std::string> texts(std::string_view path) const {
    const XmlElement* value = root_.child("dict");
    while (value != nullptr && !path.empty()) {
      const std::string_view key = path.substr(0, path.find('/'));
      path.remove_prefix(std::min(key.size() + 1, path.size()));
      value = value_of(*value, key);
    }
    if (value == nullptr) return {};
    if (value->name != "array") return {std::string(trimmed(value->text))};
    std::vector<std::string> texts;
    for (const XmlElement& item : value->children) texts.emplace_back(trimmed(item.text));
    return texts;
  }

 private:
  XmlElement root_;
};

std::vector<std::string> need(const std::filesystem::path& file, const Plist& plist,
                              const std::string& key, std::size_t count) {
  std::vector<std::string> texts = plist.texts(key);
  if (texts.size() != count) {
    refuse(file, message("main.plist: expected ", count, " values for ", in_quotes(key), ", found ",
                         texts.size()));
  }
  return texts;
}

template <class Number>
std::array<Number, 3> three(const std::filesystem::path& file, const Plist& plist,
                            const std::string& key) {
  std::array<Number, 3> numbers{};
  const std::vector<std::string> texts = need(file, plist, key, 3);
  for (std::size_t n = 0; n < 3; ++n) {
    if (!parse_number(std::string_view(texts[n]), numbers[n])) {
      refuse(file, message("main.plist: expected numbers for ", in_quotes(key), ", found ",
                           in_quotes(texts[n])));
    }
  }
  return numbers;
}

NumberType sample_type(const std::filesystem::path& file, const std::string& dtype) {
  static const std::map<std::string, NumberType> kTypes{
      {"int8", NumberType::kInt8},       {"uint8", NumberType::kUint8},
      {"int16", NumberType::kInt16},     {"uint16", NumberType::kUint16},
      {"int32", NumberType::kInt32},     {"uint32", NumberType::kUint32},
      {"float32", NumberType::kFloat32}, {"float64", NumberType::kFloat64}};
  const auto type = kTypes.find(dtype);
  if (type == kTypes.end()) {
    refuse(file, message("main.plist: expected a dtype of one number, found ", in_quotes(dtype)));
  }
  return type->second;
}

std::optional<Plist> find_main_plist(const std::filesystem::path& file, MemoryBudget& budget) {
  Tar tar(file);
  while (const auto entry = tar.next()) {
    if (entry->name == kMainPlist) return Plist(file, tar.text(*entry), budget);
  }
  return std::nullopt;
}

std::optional<TarEntry> find_entry(const std::filesystem::path& file, const std::string& name) {
  Tar tar(file);
  while (const auto entry = tar.next()) {
    if (entry->name == name) return entry;
  }
  return std::nullopt;
}

void place(ScanFile& scan, const Plist& plist) {
  const auto s = stated_or(
      scan, [&] { return three<double>(scan.file, plist, "spacing"); }, std::array<double, 3>{});
  for (const double step : s) {
    if (step > 0 || scan.given_spacing) continue;
    refuse(scan.file, message("main.plist: expected a positive spacing, found ", step,
                              " (--spacing X,Y,Z replaces it)"));
  }
  set_stated_axes(scan, {{Vec3{1, 0, 0}, Vec3{0, -1, 0}, Vec3{0, 0, 1}}, {s[0], s[1], s[2]}});
}

}  // namespace

ScanFile open_inv3(const std::filesystem::path& file, const Opening& opening) {
  ScanFile scan = begin_scan(file, "InVesalius", opening);
  const auto plist = find_main_plist(file, opening.budget);
  if (!plist) refuse(file, "expected an InVesalius project, found no main.plist in it");
  const auto shape = three<std::int64_t>(file, *plist, "matrix/shape");
  set_size(scan, {shape[2], shape[1], shape[0]});
  place(scan, *plist);
  const std::string matrix = need(file, *plist, "matrix/filename", 1)[0];
  const auto entry = find_entry(file, matrix);
  if (!entry) refuse(file, message("expected the matrix ", in_quotes(matrix), ", found none"));
  scan.source.file = file;
  scan.source.type = sample_type(file, need(file, *plist, "matrix/dtype", 1)[0]);
  scan.source.packing = Packing::kSniffed;
  scan.source.skip = entry->begin;
  const std::uint64_t needed = scan.grid.voxel_count() * byte_size(scan.source.type);
  if (entry->size != needed) {
    refuse(file, message(matrix, ": expected ", needed, " bytes, found ", entry->size));
  }
  const std::vector<std::string> modality = plist->texts("modality");
  if (modality.size() == 1) scan.grid.modality = shown(modality[0]);
  return scan;
}

}  // namespace mesamis::detail::volume_files
