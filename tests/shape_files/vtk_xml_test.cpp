// SPDX-License-Identifier: Apache-2.0
#include "mesamis/shape_files/vtk_xml.h"

#include <gtest/gtest.h>
#include <zlib.h>

#include <string>

#include "mesamis/files/bytes.h"
#include "support/throws.h"
#include "support/wide_budget.h"

namespace mesamis {
namespace {

using testing::HasSubstr;
using Numbers = std::vector<double>;

constexpr const char* kPacked = "compressor=\"vtkZLibDataCompressor\"";

/// A file of the type T with one element of arrays, and what comes after the mark '_'.
std::string file_of(const std::string& arrays, const std::string& appended = "",
                    const std::string& encoding = "raw", const std::string& options = "") {
  return "<VTKFile type=\"T\" header_type=\"UInt32\" " + options + "><T>" + arrays +
         "</T><AppendedData encoding=\"" + encoding + "\">_" + appended;
}

std::string array_at(std::size_t offset, const std::string& type = "UInt8") {
  return "<DataArray type=\"" + type + "\" Name=\"a\" format=\"appended\" offset=\"" +
         std::to_string(offset) + "\"/>";
}

std::string number_bytes(const std::vector<std::uint32_t>& numbers) {
  std::string bytes;
  for (const std::uint32_t number : numbers) append(bytes, number);
  return bytes;
}

/// Blocks of equal bytes as VTK packs them.
std::string packed_zeros(std::uint32_t block_size, std::uint32_t blocks, std::uint32_t last) {
  std::vector<std::uint32_t> header{blocks, block_size, last};
  std::string data;
  for (std::uint32_t b = 0; b < blocks; ++b) {
    const std::string plain(b + 1 == blocks && last != 0 ? last : block_size, '\0');
    uLongf size = compressBound(plain.size());
    std::string out(size, '\0');
    compress(reinterpret_cast<Bytef*>(out.data()), &size,
             reinterpret_cast<const Bytef*>(plain.data()), plain.size());
    data += out.substr(0, size);
    header.push_back(static_cast<std::uint32_t>(size));
  }
  return number_bytes(header) + data;
}

Numbers values(const std::string& file, std::size_t count) {
  WideBudget budget;
  VtkXml xml("a.vt", file, "T", budget);
  return xml.values(xml.data_set().children.at(0), count);
}

std::string ascii(const std::string& text, const std::string& type = "Float64") {
  return file_of("<DataArray type=\"" + type + "\" format=\"ascii\">" + text + "</DataArray>");
}

TEST(VtkXml, ReadsTextRawAndBase64) {
  EXPECT_EQ(values(ascii(" 1 -2.5\n1e3 "), 3), (Numbers{1, -2.5, 1000}));
  const std::string raw = number_bytes({3}) + "\x01\x02\xff";
  EXPECT_EQ(values(file_of(array_at(0), raw), 3), (Numbers{1, 2, 255}));
  EXPECT_EQ(values(file_of(array_at(2), "xx" + raw), 3), (Numbers{1, 2, 255}));
  EXPECT_EQ(values(file_of(array_at(0), "AwAAAAEC/w==", "base64"), 3), (Numbers{1, 2, 255}));
  EXPECT_EQ(
      values(file_of("<DataArray type=\"UInt8\" format=\"binary\"> AwAAAAEC/w== </DataArray>"), 3),
      (Numbers{1, 2, 255}));
}

/// A comment inside a number is no part of it; a child separates.
TEST(VtkXml, CommentsDoNotCutNumbers) {
  EXPECT_EQ(values(ascii("1<!--c-->0 <![CDATA[2]]>"), 2), (Numbers{10, 2}));
  EXPECT_EQ(values(ascii("1<Value/>0"), 2), (Numbers{1, 0}));
  EXPECT_REFUSED(values(ascii("1<Value/>0"), 1), HasSubstr("expected 1 values"));
}

TEST(VtkXml, ReadsPackedBlocks) {
  const std::string data = packed_zeros(1000, 3, 10);
  EXPECT_EQ(values(file_of(array_at(0), data, "raw", kPacked), 2010), Numbers(2010));
  EXPECT_EQ(values(file_of(array_at(0), number_bytes({0, 1000, 0}), "raw", kPacked), 0), Numbers());
}

TEST(VtkXml, AnotherNumberOfValuesIsRefusedBeforeItIsUnpacked) {
  const std::string data = packed_zeros(1 << 20, 2, 0);
  EXPECT_REFUSED(values(file_of(array_at(0), data, "raw", kPacked), 100),
                 HasSubstr("expected 100 values in the array \"a\", found 2097152"));
  EXPECT_REFUSED(values(ascii("1 2"), 3), HasSubstr("expected 3 values"));
}

TEST(VtkXml, SizesThatDoNotFitTheFileAreRefused) {
  const std::vector<std::vector<std::uint32_t>> headers{
      {}, {1}, {1, 100}, {4'000'000'000u, 1, 1}, {1, 4'000'000'000u, 0, 20}, {1, 100, 0, 4000}};
  for (const auto& header : headers) {
    const std::string file = file_of(array_at(0), number_bytes(header) + "   ", "raw", kPacked);
    EXPECT_REFUSED(values(file, 100), HasSubstr("an array is cut off"));
  }
  EXPECT_REFUSED(values(file_of(array_at(0), number_bytes({100})), 100), HasSubstr("cut off"));
  EXPECT_REFUSED(values(file_of(array_at(99), "123"), 1), HasSubstr("beyond the end"));
  EXPECT_REFUSED(
      values(file_of(array_at(0), number_bytes({1, 4, 0, 4}) + "abcd", "raw", kPacked), 4),
      HasSubstr("broken"));
}

/// A small file could otherwise name one packed block a thousand times.
TEST(VtkXml, ArraysThatShareABlockAreRefused) {
  std::string arrays;
  for (int n = 0; n < 1000; ++n) arrays += array_at(0);
  const std::uint32_t size = 1 << 20;
  const std::string file = file_of(arrays, packed_zeros(size, 1, 0), "raw", kPacked);
  WideBudget budget;
  VtkXml xml("a.vt", file, "T", budget);
  const auto& all = xml.data_set().children;
  EXPECT_EQ(xml.values(all[0], size).size(), size);
  EXPECT_REFUSED(xml.values(all[1], size), HasSubstr("overlap"));
}

/// 8 MB of zeros in 8 kB, as 64 MB of doubles.
TEST(VtkXml, ValuesAreClaimedBeforeTheyAreUnpacked) {
  constexpr std::uint32_t kCount = 8'000'000;
  const std::string file = file_of(array_at(0), packed_zeros(kCount, 1, 0), "raw", kPacked);
  for (const auto& [memory_gb, fits] : {std::pair{0.0079, false}, {0.04, false}, {0.08, true}}) {
    MemoryBudget budget("a.vt", {memory_gb});
    VtkXml xml("a.vt", file, "T", budget);
    const XmlElement& array = xml.data_set().children.at(0);
    if (!fits) {
      EXPECT_REFUSED(xml.values(array, kCount), HasSubstr("a.vt: memory: expected"));
      continue;
    }
    Numbers numbers = xml.values(array, kCount);
    EXPECT_GE(budget.held(), kCount * sizeof(double));
    EXPECT_LT(budget.held(), kCount * sizeof(double) + 10'000);  // the packed ones are given back
    free_within(budget, numbers);
    EXPECT_LT(budget.held(), 10'000u);
  }
}

TEST(VtkXml, NumbersOfTextAreClaimed) {
  std::string text;
  for (int n = 0; n < 100'000; ++n) text += "0 ";
  const std::string file = ascii(text);
  MemoryBudget budget("a.vt", {0.0008});
  VtkXml xml("a.vt", file, "T", budget);
  EXPECT_REFUSED(xml.values(xml.data_set().children.at(0), 100'000), HasSubstr("memory"));
}

TEST(VtkXml, NumbersOfComponentsAreBounded) {
  XmlElement array;
  EXPECT_EQ(components_in("a.vt", array), 1u);
  array.attributes = {{"Name", "m"}, {"NumberOfComponents", "6"}};
  EXPECT_EQ(components_in("a.vt", array), 6u);
  for (const char* count : {"0", "-1", "1001", "1099511627776", "six", "99999999999999999999"}) {
    array.attributes[1].second = count;
    EXPECT_REFUSED(components_in("a.vt", array), HasSubstr("a.vt: expected")) << count;
  }
}

TEST(VtkXml, TextsAreReadUpToTheirEndAndBounded) {
  const auto text_of = [](const std::string& file) {
    WideBudget budget;
    VtkXml xml("a.vt", file, "T", budget);
    return xml.text(xml.data_set().children.at(0));
  };
  EXPECT_EQ(text_of(file_of("<Array format=\"ascii\">82 65 83 0</Array>")), "RAS");
  const std::string stored = number_bytes({4}) + std::string("LPS\0", 4);
  EXPECT_EQ(text_of(file_of(array_at(0, "String"), stored)), "LPS");
  EXPECT_REFUSED(
      text_of(file_of(array_at(0, "String"), packed_zeros(1 << 20, 2, 0), "raw", kPacked)),
      HasSubstr("expected texts of at most 1048576 bytes"));
}

TEST(VtkXml, OtherFilesAreRefused) {
  WideBudget budget;
  EXPECT_REFUSED(VtkXml("a.vt", "<a/>", "T", budget), HasSubstr("is not a VTK XML file"));
  EXPECT_REFUSED(VtkXml("a.vt", "<VTKFile type=\"U\"><U/></VTKFile>", "T", budget),
                 HasSubstr("found \"U\""));
  EXPECT_REFUSED(
      VtkXml("a.vt", file_of("", "", "raw", "compressor=\"vtkLZ4DataCompressor\""), "T", budget),
      HasSubstr("vtkLZ4DataCompressor"));
  EXPECT_REFUSED(
      VtkXml("a.vt", "<!DOCTYPE VTKFile [<!ENTITY a \"b\">]>" + file_of(""), "T", budget),
      HasSubstr("declarations of entities"));
}

}  // namespace
}  // namespace mesamis
