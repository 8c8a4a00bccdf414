// SPDX-License-Identifier: Apache-2.0
#include "mesamis/shape_files/vtk_xml_writer.h"

#include <zlib.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <fstream>
#include <set>
#include <sstream>

#include "mesamis/base/error.h"
#include "mesamis/files/atomic_file.h"
#include "mesamis/files/refuse.h"
#include "mesamis/files/xml_text.h"

namespace mesamis::detail::shape_files {
namespace {

constexpr std::size_t kBlockBytes = 32768;  // VTK's default; every array's values fill it evenly
constexpr int kCompressionLevel = 1;        // doubles pack badly; more effort gains little
constexpr const char* kTextType = "String";

/// The values of an array in blocks of whole tuples, as many as a file's block holds values.
template <class Visit>
void visit_blocks(const VtkArray& array, std::size_t values_per_block, Visit visit) {
  std::string bytes;
  for (std::size_t begin = 0; begin < array.values; begin += values_per_block) {
    bytes.clear();
    array.append_values(begin, std::min(begin + values_per_block, array.values), bytes);
    visit(bytes);
  }
}

/// The smallest and the largest value, or Euclidean norm of a tuple, as VTK states them.
/// Comparisons with NaN are false, so that NaN does not count.
std::array<double, 2> range_of(const VtkArray& array) {
  std::array<double, 2> range{1e299, -1e299};  // VTK_DOUBLE_MAX: what it states for no values
  if (array.values == 0) return range;
  const auto components = static_cast<std::size_t>(array.components);
  visit_blocks(array, 1024 * components, [&](const std::string& bytes) {
    const std::size_t tuple_bytes = components * sizeof(double);
    for (std::size_t at = 0; at < bytes.size(); at += tuple_bytes) {
      double value = load<double>(bytes.data() + at);
      if (components > 1) {
        value *= value;
        for (std::size_t c = 1; c < components; ++c) {
          const double next = load<double>(bytes.data() + at + c * sizeof(double));
          value += next * next;
        }
      }
      if (value < range[0]) range[0] = value;
      if (value > range[1]) range[1] = value;
    }
  });
  if (components > 1) range = {std::sqrt(range[0]), std::sqrt(range[1])};
  return range;
}

std::string with_11_digits(double value) {
  char text[32];
  const auto end = std::to_chars(text, text + sizeof text, value, std::chars_format::general, 11);
  return {text, end.ptr};
}

/// The end of an attribute whose width VTK keeps fixed: room for 20 characters and the quote.
std::string fixed_width(std::string value) {
  constexpr std::size_t kWidth = 21;
  value += '"';
  value.resize(std::max(value.size(), kWidth), ' ');
  return value;
}

class Writer {
 public:
  explicit Writer(std::ostream& out) : out_(out) {}

  void write(const VtkFile& file) {
    write_header(file);
    const auto first = here();
    for_each_array(file, [&](const VtkArray& array) {
      offsets_.push_back(here() - first);
      write_data(array);
    });
    out_ << "\n  </AppendedData>\n</VTKFile>\n";
    for (std::size_t a = 0; a < offsets_.size(); ++a) {
      out_.seekp(offset_places_[a]);
      out_ << fixed_width(std::to_string(offsets_[a]));
    }
  }

 private:
  /// The stream itself does not fail where its place cannot be told.
  std::streampos here() {
    const std::streampos place = out_.tellp();
    if (place == std::streampos(-1)) out_.setstate(std::ios::failbit);
    return place;
  }

  template <class Visit>
  static void for_each_array(const VtkFile& file, Visit visit) {
    for (const VtkArray& array : file.field_data) visit(array);
    for (const VtkArrayGroup& group : file.groups) {
      for (const VtkArray& array : group.arrays) visit(array);
    }
  }

  void write_header(const VtkFile& file) {
    out_ << "<VTKFile type=\"" << file.type
         << "\" version=\"1.0\" byte_order=\"LittleEndian\" header_type=\"UInt64\" "
            "compressor=\"vtkZLibDataCompressor\">\n  <"
         << file.type << ">\n";
    write_group("    ", {"FieldData", file.field_data});
    out_ << "    <Piece";
    for (const auto& [name, count] : file.counts) {
      out_ << ' ' << name << "=\"" << fixed_width(std::to_string(count));
    }
    out_ << ">\n";
    for (const VtkArrayGroup& group : file.groups) write_group("      ", group);
    out_ << "    </Piece>\n  </" << file.type << ">\n  <AppendedData encoding=\"raw\">\n   _";
  }

  void write_group(const std::string& indent, const VtkArrayGroup& group) {
    out_ << indent << '<' << group.element;
    if (!group.scalars.empty()) out_ << " Scalars=\"" << xml_escaped(group.scalars) << '"';
    out_ << ">\n";
    for (const VtkArray& array : group.arrays) write_declaration(indent + "  ", array);
    out_ << indent << "</" << group.element << ">\n";
  }

  void write_declaration(const std::string& indent, const VtkArray& array) {
    const bool is_text = array.type == std::string_view(kTextType);
    out_ << indent << (is_text ? "<Array" : "<DataArray") << " type=\"" << array.type
         << "\" Name=\"" << xml_escaped(array.name) << '"';
    if (array.tuples > 0) out_ << " NumberOfTuples=\"" << std::to_string(array.tuples) << '"';
    if (array.components > 1) {
      out_ << " NumberOfComponents=\"" << std::to_string(array.components) << '"';
    }
    out_ << " format=\"appended\"";
    if (!is_text) write_range(array);
    out_ << " offset=\"";
    offset_places_.push_back(here());
    out_ << fixed_width("") << "/>\n";
  }

  /// VTK leaves the range of the whole numbers that make up cells open.
  void write_range(const VtkArray& array) {
    std::string least = array.least, most = array.most;
    if (array.type == std::string_view(vtk_type_name<double>())) {
      const auto range = range_of(array);
      least = with_11_digits(range[0]);
      most = with_11_digits(range[1]);
    }
    out_ << " RangeMin=\"" << fixed_width(least) << " RangeMax=\"" << fixed_width(most);
  }

  void write_data(const VtkArray& array) {
    const std::size_t bytes = array.values * array.value_size;
    const std::size_t blocks = (bytes + kBlockBytes - 1) / kBlockBytes;
    std::vector<std::uint64_t> header{blocks, kBlockBytes, bytes % kBlockBytes};
    const auto place = here();
    header.resize(3 + blocks);
    write_numbers(header);
    std::size_t block = 3;
    visit_blocks(array, kBlockBytes / array.value_size,
                 [&](const std::string& plain) { header[block++] = write_packed(plain); });
    const auto end = here();
    out_.seekp(place);
    write_numbers(header);
    out_.seekp(end);
  }

  void write_numbers(const std::vector<std::uint64_t>& numbers) {
    std::string bytes;
    for (const std::uint64_t number : numbers) append(bytes, number);
    out_ << bytes;
  }

  /// @return  the number of packed bytes.
  std::uint64_t write_packed(const std::string& plain) {
    uLongf size = compressBound(static_cast<uLong>(plain.size()));
    packed_.resize(size);
    const int status = compress2(reinterpret_cast<Bytef*>(packed_.data()), &size,
                                 reinterpret_cast<const Bytef*>(plain.data()),
                                 static_cast<uLong>(plain.size()), kCompressionLevel);
    if (status != Z_OK) throw std::bad_alloc();  // its only other cause is a buffer too small
    out_.write(packed_.data(), static_cast<std::streamsize>(size));
    return size;
  }

  std::ostream& out_;
  std::vector<std::streampos> offset_places_;
  std::vector<std::streamoff> offsets_;
  std::string packed_;
};

void require_distinct_names(const std::vector<VtkArray>& arrays) {
  std::set<std::string> names;
  for (const VtkArray& array : arrays) {
    if (names.insert(array.name).second) continue;
    throw InputError("mesh: expected arrays of different names, found two named " +
                     in_quotes(array.name));
  }
}

void require_distinct_names(const VtkFile& file) {
  require_distinct_names(file.field_data);
  for (const VtkArrayGroup& group : file.groups) require_distinct_names(group.arrays);
}

}  // namespace

VtkArray vtk_text(std::string name, std::string text) {
  return vtk_texts(std::move(name), {std::move(text)});
}

VtkArray vtk_texts(std::string name, const std::vector<std::string>& texts) {
  std::string all;
  for (const std::string& text : texts) (all += text) += '\0';
  const std::size_t size = all.size();
  auto append_values = [all = std::move(all)](std::size_t begin, std::size_t end,
                                              std::string& bytes) {
    bytes.append(all, begin, end - begin);
  };
  return {std::move(name), kTextType, 1, size, 1, std::move(append_values), texts.size()};
}

VtkArray vtk_text_bytes(std::string name, const std::vector<std::string>& texts) {
  std::string all;
  for (const std::string& text : texts) {
    if (&text != &texts.front()) all += '\0';
    all += text;
  }
  const auto code = [](char c) { return static_cast<unsigned char>(c); };
  VtkArray array = vtk_array<std::uint8_t>(std::move(name), 1, all.size(),
                                           [all, code](std::size_t i) { return code(all[i]); });
  array.tuples = all.size();
  if (all.empty()) return array;
  const auto [least, most] = std::minmax_element(
      all.begin(), all.end(), [code](char a, char b) { return code(a) < code(b); });
  array.least = std::to_string(code(*least));
  array.most = std::to_string(code(*most));
  return array;
}

void write_vtk_xml(const OutputPath& path, const VtkFile& file) {
  require_distinct_names(file);
  AtomicFile target(path);
  std::ofstream out(target.temporary_path(), std::ios::binary);
  Writer(out).write(file);
  out.close();
  if (!out) refuse(path, "cannot be written; is the disk full?");
  target.commit();
}

std::string vtk_xml_bytes(const VtkFile& file) {
  require_distinct_names(file);
  std::ostringstream out;
  Writer(out).write(file);
  return std::move(out).str();
}

}  // namespace mesamis::detail::shape_files
