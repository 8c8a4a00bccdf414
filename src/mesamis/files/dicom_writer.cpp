// SPDX-License-Identifier: Apache-2.0
#include "mesamis/files/dicom_writer.h"

#include <algorithm>
#include <cstdint>

#include "mesamis/files/bytes.h"

namespace mesamis::detail::files {
namespace {

void append_tag(std::string& out, DicomTag tag) {
  append(out, static_cast<std::uint16_t>(tag >> 16));
  append(out, static_cast<std::uint16_t>(tag & 0xffff));
}

/// These have a length of 32 bits behind two bytes that are zero.
bool has_long_length(std::string_view vr) {
  constexpr std::array<std::string_view, 6> kLong{"OB", "OW", "SQ", "UC", "UN", "UT"};
  return std::find(kLong.begin(), kLong.end(), vr) != kLong.end();
}

std::string header(DicomTag tag, std::string_view vr, std::size_t length) {
  std::string out;
  append_tag(out, tag);
  out += vr;
  if (has_long_length(vr)) {
    append(out, std::uint16_t{0});
    append(out, static_cast<std::uint32_t>(length));
  } else {
    append(out, static_cast<std::uint16_t>(length));
  }
  return out;
}

/// A number of 128 bits, the most significant part first.
using Wide = std::array<std::uint32_t, 4>;

/// Divides by ten. @return the rest.
int divide_by_ten(Wide& number) {
  std::uint64_t rest = 0;
  for (std::uint32_t& part : number) {
    const std::uint64_t whole = rest << 32 | part;
    part = static_cast<std::uint32_t>(whole / 10);
    rest = whole % 10;
  }
  return static_cast<int>(rest);
}

/// FNV-1a from a basis of its own.
std::uint64_t hash_of(std::string_view text, std::uint64_t basis) {
  std::uint64_t hash = basis;
  for (const char c : text) {
    hash ^= static_cast<unsigned char>(c);
    hash *= 0x100000001b3;
  }
  return hash;
}

}  // namespace

void DicomSetWriter::set(DicomTag tag, std::string_view vr, std::string_view value) {
  const bool odd = value.size() % 2 != 0;
  std::string element = header(tag, vr, value.size() + (odd ? 1 : 0));
  element += value;
  if (odd) element += vr == "UI" || vr == "OB" ? '\0' : ' ';
  elements_[tag] = std::move(element);
}

void DicomSetWriter::set_number(DicomTag tag, std::string_view vr, std::uint32_t value) {
  std::string bytes;
  if (vr == "UL") {
    append(bytes, value);
  } else {
    append(bytes, static_cast<std::uint16_t>(value));
  }
  set(tag, vr, bytes);
}

void DicomSetWriter::set_items(DicomTag tag, const std::vector<DicomSetWriter>& items) {
  constexpr DicomTag kItem = 0xfffee000;
  std::string content;
  for (const DicomSetWriter& item : items) {
    const std::string bytes = item.bytes();
    append_tag(content, kItem);
    append(content, static_cast<std::uint32_t>(bytes.size()));
    content += bytes;
  }
  set(tag, "SQ", content);
}

std::string DicomSetWriter::bytes() const {
  std::string all;
  for (const auto& [tag, element] : elements_) all += element;
  return all;
}

DicomSetWriter dicom_code(const std::array<std::string_view, 3>& code) {
  DicomSetWriter item;
  item.set(0x00080100, "SH", code[0]);
  item.set(0x00080102, "SH", code[1]);
  item.set(0x00080104, "LO", code[2]);
  return item;
}

std::string dicom_file_bytes(const DicomSetWriter& set, const std::array<std::string, 2>& sop) {
  DicomSetWriter meta;
  meta.set(0x00020001, "OB", std::string_view("\0\1", 2));
  meta.set(0x00020002, "UI", sop[0]);
  meta.set(0x00020003, "UI", sop[1]);
  meta.set(0x00020010, "UI", "1.2.840.10008.1.2.1");
  meta.set(0x00020012, "UI", dicom_uid_of("mesamis"));
  meta.set(0x00020013, "SH", "MESAMIS");
  const std::string rest = meta.bytes();
  DicomSetWriter length;
  length.set_number(0x00020000, "UL", static_cast<std::uint32_t>(rest.size()));
  return std::string(128, '\0') + "DICM" + length.bytes() + rest + set.bytes();
}

std::string dicom_uid_of(std::string_view text) {
  const std::uint64_t high = hash_of(text, 0xcbf29ce484222325);
  const std::uint64_t low = hash_of(text, high ^ 0x9e3779b97f4a7c15);
  Wide number{static_cast<std::uint32_t>(high >> 32), static_cast<std::uint32_t>(high),
              static_cast<std::uint32_t>(low >> 32), static_cast<std::uint32_t>(low)};
  number[1] = (number[1] & 0xffff0fff) | 0x8000;      // UUID of version 8, RFC 9562
  number[2] = (number[2] & 0x3fffffff) | 0x80000000;  // and of its variant
  std::string digits;
  while (number != Wide{}) digits += static_cast<char>('0' + divide_by_ten(number));
  std::reverse(digits.begin(), digits.end());
  return "2.25." + digits;
}

}  // namespace mesamis::detail::files
