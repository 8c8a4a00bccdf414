// SPDX-License-Identifier: Apache-2.0
#include "mesamis/files/dicom_data.h"

#include <zlib.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <memory>
#include <string_view>

#include "mesamis/files/byte_source.h"
#include "mesamis/files/file_list.h"
#include "mesamis/files/refuse.h"

namespace mesamis::detail::files {
namespace {

constexpr std::size_t kPreamble = 128;
constexpr std::uint32_t kUndefined = 0xffffffff;
constexpr DicomTag kItem = 0xfffee000, kItemEnd = 0xfffee00d, kSequenceEnd = 0xfffee0dd;
constexpr int kDeepest = 16;            // sequences in sequences
constexpr std::size_t kNodeBytes = 64;  // of a map, beside its value
constexpr const char* kImplicit = "1.2.840.10008.1.2";
constexpr const char* kDeflated = "1.2.840.10008.1.2.1.99";
constexpr const char* kBigEndian = "1.2.840.10008.1.2.2";

/// Ends parsing; becomes DicomFile::problem.
struct Broken {
  std::string why;
};

std::string tag_text(DicomTag tag) {
  std::array<char, 16> text;
  std::snprintf(text.data(), text.size(), "(%04x,%04x)", tag >> 16, tag & 0xffff);
  return text.data();
}

bool is_upper(unsigned char c) { return c >= 'A' && c <= 'Z'; }

/// In implicit coding, a sequence of known length is recognised by its tag alone.
bool is_known_sequence(DicomTag tag) {
  constexpr std::array kSequences{dicom::kSharedGroups,  dicom::kFrameGroups,
                                  dicom::kPlanePosition, dicom::kPlaneOrientation,
                                  dicom::kPixelMeasures, dicom::kPixelTransformation,
                                  dicom::kModalityLut,   dicom::kFrameContent,
                                  dicom::kSegments,      dicom::kSegmentIdentification,
                                  dicom::kRegions,       dicom::kReferencedFrames,
                                  dicom::kContours,      dicom::kRegionContours,
                                  dicom::kDetectors};
  return std::find(kSequences.begin(), kSequences.end(), tag) != kSequences.end();
}

struct ElementHeader {
  DicomTag tag = 0;
  bool sequence = false;  // by its VR or its tag
  bool unknown = false;   // VR "UN"
  std::uint32_t length = 0;
};

class Parser {
 public:
  Parser(const DicomFile& file, std::size_t begin, bool explicit_vr, MemoryBudget& budget)
      : bytes_(file.bytes),
        at_(begin),
        explicit_(explicit_vr),
        big_endian_(file.big_endian),
        budget_(budget) {}

  std::size_t position() const { return at_; }

  /// Elements of group 2, always explicit little endian.
  void parse_meta(DicomSet& set) {
    while (left() >= 8 && peek_group() == 2) parse_element(set);
  }
  /// Elements up to the pixel data or the end.
  void parse_all(DicomSet& set) {
    while (left() >= 8) {
      if (parse_element(set) == dicom::kPixelData) return;
    }
    if (left() > 0 && std::any_of(bytes_.begin() + static_cast<std::ptrdiff_t>(at_), bytes_.end(),
                                  [](unsigned char c) { return c != 0; })) {
      throw Broken{message("cut off in the middle of an element at byte ", at_)};
    }
  }

 private:
  std::size_t left() const { return bytes_.size() - at_; }
  unsigned peek_group() const { return static_cast<unsigned>(bytes_[at_] | bytes_[at_ + 1] << 8); }

  std::uint32_t take(std::size_t n) {
    if (left() < n) throw Broken{message("cut off at byte ", bytes_.size())};
    std::uint32_t value = 0;
    for (std::size_t i = 0; i < n; ++i) {
      value |= std::uint32_t{bytes_[at_ + i]} << 8 * (big_endian_ ? n - 1 - i : i);
    }
    at_ += n;
    return value;
  }

  DicomTag take_tag() {
    const std::uint32_t group = take(2);
    return group << 16 | take(2);
  }

  ElementHeader take_header() {
    ElementHeader header;
    header.tag = take_tag();
    if (!explicit_ || header.tag >> 16 == 0xfffe) {
      header.length = take(4);
      header.sequence = is_known_sequence(header.tag);
      return header;
    }
    if (left() < 2 || !is_upper(bytes_[at_]) || !is_upper(bytes_[at_ + 1])) {
      throw Broken{"element " + tag_text(header.tag) + message(" at byte ", at_ - 4, " has no VR")};
    }
    const std::string_view vr(reinterpret_cast<const char*>(&bytes_[at_]), 2);
    at_ += 2;
    constexpr std::array<std::string_view, 13> kLong{"OB", "OD", "OF", "OL", "OV", "OW", "SQ",
                                                     "SV", "UC", "UN", "UR", "UT", "UV"};
    const bool long_form = std::find(kLong.begin(), kLong.end(), vr) != kLong.end();
    if (long_form) take(2);
    header.length = take(long_form ? 4 : 2);
    header.unknown = vr == "UN";
    header.sequence = vr == "SQ" || (header.unknown && is_known_sequence(header.tag));
    return header;
  }

  Bytes take_value(const ElementHeader& header) {
    if (header.length > left()) {
      throw Broken{"element " + tag_text(header.tag) +
                   message(" claims ", header.length, " bytes at byte ", at_, ", but only ", left(),
                           " follow")};
    }
    const Bytes value = bytes_.subspan(at_, header.length);
    at_ += header.length;
    return value;
  }

  DicomTag parse_element(DicomSet& set) {
    const ElementHeader header = take_header();
    budget_.claim(1, sizeof(DicomSet::value_type) + kNodeBytes, "DICOM elements");
    DicomElement element;
    const bool undefined = header.length == kUndefined;
    if (undefined && header.tag == dicom::kPixelData) {
      element.fragments = take_fragments();
    } else if (undefined || header.sequence) {
      element.items = take_items(header);
    } else {
      element.value = take_value(header);
    }
    set.emplace(header.tag, std::move(element));
    return header.tag;
  }

  std::vector<DicomSet> take_items(const ElementHeader& header) {
    if (++depth_ > kDeepest) throw Broken{"sequences are nested too deeply"};
    // An "UN" element of undefined length is coded implicitly (DICOM PS3.5, 6.2.2).
    const bool was_explicit = explicit_;
    if (header.unknown) explicit_ = false;
    const std::size_t end = header.length == kUndefined ? bytes_.size() : end_of(header);
    std::vector<DicomSet> items;
    while (at_ < end) {
      const ElementHeader item = take_header();
      if (item.tag == kSequenceEnd) break;
      if (item.tag != kItem) {
        throw Broken{"sequence " + tag_text(header.tag) + " holds " + tag_text(item.tag) +
                     " where an item should begin"};
      }
      append_within(budget_, items, take_item(item), "DICOM items");
    }
    explicit_ = was_explicit;
    --depth_;
    return items;
  }

  std::size_t end_of(const ElementHeader& header) const {
    if (header.length <= left()) return at_ + header.length;
    throw Broken{"element " + tag_text(header.tag) +
                 message(" claims ", header.length, " bytes at byte ", at_, ", but only ", left(),
                         " follow")};
  }

  DicomSet take_item(const ElementHeader& item) {
    DicomSet set;
    const bool open = item.length == kUndefined;
    const std::size_t end = open ? bytes_.size() : end_of(item);
    while (at_ < end) {
      if (open && left() >= 8 && next_is(kItemEnd)) {
        at_ += 8;
        return set;
      }
      parse_element(set);
    }
    return set;
  }

  bool next_is(DicomTag tag) {
    const std::size_t here = at_;
    const bool is = take_tag() == tag;
    at_ = here;
    return is;
  }

  /// The first item is the offset table, the others are the fragments.
  std::vector<Bytes> take_fragments() {
    std::vector<Bytes> fragments;
    for (bool first = true;; first = false) {
      const ElementHeader item = take_header();
      if (item.tag == kSequenceEnd) return fragments;
      if (item.tag != kItem) {
        throw Broken{"pixel data hold " + tag_text(item.tag) + " where a fragment should begin"};
      }
      const Bytes fragment = take_value(item);
      if (!first) append_within(budget_, fragments, fragment, "fragments of pixels");
    }
  }

  Bytes bytes_;
  std::size_t at_;
  bool explicit_, big_endian_;
  MemoryBudget& budget_;
  int depth_ = 0;
};

bool has_magic(Bytes bytes) {
  return bytes.size() >= kPreamble + 4 && std::memcmp(&bytes[kPreamble], "DICM", 4) == 0;
}

/// The rest of the file behind `begin`, inflated (raw deflate, PS3.5 A.5).
std::vector<unsigned char> inflate_rest(Bytes packed, MemoryBudget& budget) {
  std::vector<unsigned char> out;
  z_stream stream{};
  if (inflateInit2(&stream, -15) != Z_OK) throw Broken{"zlib could not be started"};
  stream.next_in = const_cast<unsigned char*>(packed.data());
  stream.avail_in = static_cast<uInt>(packed.size());
  const std::unique_ptr<z_stream, int (*)(z_stream*)> end(&stream, inflateEnd);
  std::array<unsigned char, 1 << 16> block;
  int status = Z_OK;
  while (status == Z_OK) {
    stream.next_out = block.data();
    stream.avail_out = static_cast<uInt>(block.size());
    status = inflate(&stream, Z_NO_FLUSH);
    const std::size_t size = out.size() + block.size() - stream.avail_out;
    if (size > out.capacity()) {
      reserve_within(budget, out, std::max(size, 2 * out.size()), "deflated data");
    }
    out.insert(out.end(), block.data(), block.data() + (block.size() - stream.avail_out));
  }
  if (status != Z_STREAM_END) throw Broken{"the deflated data are broken or cut off"};
  return out;
}

void parse(DicomFile& file, MemoryBudget& budget) {
  std::size_t begin = has_magic(file.bytes) ? kPreamble + 4 : 0;
  Parser meta(file, begin, true, budget);
  DicomSet meta_set;
  meta.parse_meta(meta_set);
  begin = meta.position();
  file.transfer_syntax = text_of(meta_set, dicom::kTransferSyntax);
  if (file.transfer_syntax == kDeflated) {
    file.bytes = inflate_rest(Bytes(file.bytes).subspan(begin), budget);
    begin = 0;
  }
  const Bytes bytes(file.bytes);
  file.big_endian = file.transfer_syntax == kBigEndian;
  // Without a transfer syntax, a VR in the first element shows explicit coding.
  const bool vr_there =
      bytes.size() >= begin + 6 && is_upper(bytes[begin + 4]) && is_upper(bytes[begin + 5]);
  const bool explicit_vr =
      file.transfer_syntax.empty() ? vr_there : file.transfer_syntax != kImplicit;
  Parser(file, begin, explicit_vr, budget).parse_all(file.elements);
}

}  // namespace

bool begins_like_dicom(Bytes bytes) {
  if (has_magic(bytes)) return true;
  if (bytes.size() < 8 || bytes[1] != 0 || bytes[3] != 0) return false;
  return bytes[0] == 2 || bytes[0] == 8;
}

DicomFile read_dicom_file(const std::filesystem::path& path, MemoryBudget& budget) {
  std::vector<unsigned char> bytes;
  ByteSource source(path, Packing::kPlain);
  reserve_within(budget, bytes, source.most_bytes(), "bytes of the file");
  bytes.resize(source.most_bytes());
  bytes.resize(source.read(bytes.data(), bytes.size()));
  return parse_dicom_file(path, std::move(bytes), budget);
}

DicomFile parse_dicom_file(const std::filesystem::path& path, std::vector<unsigned char> bytes,
                           MemoryBudget& budget) {
  DicomFile file;
  file.path = path;
  file.bytes = std::move(bytes);
  try {
    parse(file, budget);
  } catch (const Broken& broken) {
    file.problem = broken.why;
  }
  return file;
}

DicomFile parse_dicom(const std::filesystem::path& path, std::string_view bytes,
                      MemoryBudget& budget) {
  std::vector<unsigned char> copy;
  reserve_within(budget, copy, bytes.size(), "bytes of the file");
  copy.assign(bytes.begin(), bytes.end());
  return parse_dicom_file(path, std::move(copy), budget);
}

std::string text_of(const DicomSet& set, DicomTag tag) {
  const auto element = set.find(tag);
  if (element == set.end()) return "";
  constexpr std::size_t kLongest = 1 << 16;
  const Bytes all = element->second.value, value = all.first(std::min(all.size(), kLongest));
  return std::string(
      trimmed(std::string_view(reinterpret_cast<const char*>(value.data()), value.size())));
}

std::optional<int> number_of(const DicomFile& file, const DicomSet& set, DicomTag tag) {
  const auto numbers = numbers_of(file, set, tag, 1);
  return numbers ? std::optional(numbers->front()) : std::nullopt;
}

std::optional<std::vector<int>> numbers_of(const DicomFile& file, const DicomSet& set, DicomTag tag,
                                           std::size_t count) {
  const auto element = set.find(tag);
  if (element == set.end() || element->second.value.size() < 2 * count) return std::nullopt;
  const Bytes v = element->second.value;
  std::vector<int> numbers(count);
  for (std::size_t n = 0; n < count; ++n) {
    const int first = v[2 * n], second = v[2 * n + 1];
    numbers[n] = file.big_endian ? first << 8 | second : second << 8 | first;
  }
  return numbers;
}

std::optional<std::vector<double>> decimals_of(const DicomSet& set, DicomTag tag,
                                               std::size_t count) {
  const std::string text = text_of(set, tag);
  std::vector<double> numbers;
  for (std::size_t begin = 0; begin <= text.size() && numbers.size() <= count;) {
    const std::size_t end = std::min(text.find('\\', begin), text.size());
    double value = 0;
    if (!parse_number(trimmed(std::string_view(text).substr(begin, end - begin)), value)) return {};
    numbers.push_back(value);
    begin = end + 1;
  }
  return numbers.size() == count ? std::optional(numbers) : std::nullopt;
}

const DicomSet* first_item(const DicomSet& set, DicomTag tag) {
  const auto element = set.find(tag);
  if (element == set.end() || element->second.items.empty()) return nullptr;
  return &element->second.items.front();
}

}  // namespace mesamis::detail::files
