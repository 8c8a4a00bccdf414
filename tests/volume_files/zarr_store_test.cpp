// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "mesamis/volume_files/chunked_scan.h"
#include "support/throws.h"
#include "volume_files/chunk_bytes.h"

namespace mesamis {
namespace {

namespace fs = std::filesystem;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

void expect_whole(const fs::path& path, const ChunkOptions& options = {}) {
  const auto scan = open_zarr(path, options);
  EXPECT_EQ(scan->grid().size, (std::array<Index, 3>{5, 6, 7}));
  EXPECT_EQ(scan->read(0, 7), expected_slices(0, 7));
  EXPECT_EQ(scan->read(3, 1), expected_slices(3, 1));
}

template <class Number>
void expect_type(const std::string& dtype) {
  const TempFolder folder;
  ArrayBytes array;
  array.big_endian = dtype[0] == '>';
  write_bytes(folder / ".zarray", zarray(dtype));
  array.write<Number>(folder.path());
  expect_whole(folder.path());
}

TEST(ZarrStore, ReadsNumbersOfEitherByteOrder) {
  expect_type<std::int16_t>("<i2");
  expect_type<std::int16_t>(">i2");
  expect_type<std::int32_t>("<i4");
  expect_type<std::int64_t>(">i8");
  expect_type<float>("<f4");
  expect_type<float>(">f4");
  expect_type<double>("<f8");
  expect_type<double>(">f8");
}

TEST(ZarrStore, ReadsEachCompressionOfBothVersions) {
  struct Case {
    const char *v2, *v3;
    std::string (*pack)(const std::string&);
  };
  const std::array<Case, 4> cases{
      {{R"({"id": "zlib", "level": 1})", "", [](const std::string& s) { return packed(s, 15); }},
       {R"({"id": "gzip", "level": 1})", R"({"name": "gzip", "configuration": {"level": 1}})",
        [](const std::string& s) { return packed(s, 31); }},
       {R"({"id": "blosc", "cname": "lz4"})", R"({"name": "blosc", "configuration": {}})",
        [](const std::string& s) { return with_blosc(s); }},
       {R"({"id": "zstd", "level": 1})", R"({"name": "zstd", "configuration": {"level": 1}})",
        with_zstd}}};
  for (const Case& c : cases) {
    const TempFolder folder;
    ArrayBytes array;
    array.pack = c.pack;
    write_bytes(folder / "v2/.zarray", zarray("<i2", c.v2));
    array.write<std::int16_t>(folder / "v2");
    expect_whole(folder / "v2");
    if (*c.v3 == '\0') continue;
    array.separator = "/";
    array.prefix = "c/";
    write_bytes(folder / "v3/zarr.json",
                zarr_json("int16", std::string("[") + kLittle + ", " + c.v3 + "]"));
    array.write<std::int16_t>(folder / "v3");
    expect_whole(folder / "v3");
  }
}

TEST(ZarrStore, ReadsChunksWhoseFirstAxisRunsFastest) {
  const TempFolder folder;
  ArrayBytes array;
  array.fortran = true;
  std::string text = zarray();
  write_bytes(folder / "v2/.zarray", text.replace(text.find("\"C\""), 3, "\"F\""));
  array.write<std::int16_t>(folder / "v2");
  expect_whole(folder / "v2");
  array.separator = "/";
  array.prefix = "c/";
  write_bytes(folder / "v3/zarr.json",
              zarr_json("int16", R"([{"name": "transpose", "configuration": {"order": [2, 1, 0]}},
                                  )" +
                                     std::string(kLittle) + "]"));
  array.write<std::int16_t>(folder / "v3");
  expect_whole(folder / "v3");
}

TEST(ZarrStore, FillsChunksThatAreMissing) {
  const TempFolder folder;
  std::string text = zarray();
  write_bytes(folder / ".zarray",
              text.replace(text.find("\"fill_value\": 0"), 15, "\"fill_value\": 7"));
  ArrayBytes().write<std::int16_t>(folder.path());
  fs::remove(folder / "1.0.1");  // k 2 to 3, j 0 to 3, i 3 to 4
  std::vector<float> expected = expected_slices(0, 7);
  for (std::size_t k = 2; k < 4; ++k) {
    for (std::size_t j = 0; j < 4; ++j) {
      for (std::size_t i = 3; i < 5; ++i) expected[(k * 6 + j) * 5 + i] = 7;
    }
  }
  EXPECT_EQ(open_zarr(folder.path())->read(0, 7), expected);
}

/// An OME-Zarr of version 0.4 with a label image and two levels.
void write_ome(const fs::path& folder, const std::string& unit) {
  write_bytes(folder / ".zgroup", R"({"zarr_format": 2})");
  std::string image = multiscales(unit);
  image.replace(image.rfind("}]}"), 3,
                R"(}, {"path": "1", "coordinateTransformations":
                [{"type": "scale", "scale": [8, 4, 2]}]}]})");
  write_bytes(folder / ".zattrs", R"({"multiscales": [)" + image + "]}");
  for (const char* level : {"0", "1", "labels/a/0"}) {
    write_bytes(folder / level / ".zarray", zarray());
    ArrayBytes().write<std::int16_t>(folder / level);
  }
  write_bytes(folder / "labels/.zgroup", R"({"zarr_format": 2})");
  write_bytes(folder / "labels/a/.zgroup", R"({"zarr_format": 2})");
}

TEST(ZarrStore, ReadsTheFinestLevelOfAnImage) {
  const TempFolder folder;
  write_ome(folder.path(), "micrometer");
  const auto scan = open_zarr(folder.path());
  EXPECT_EQ(scan->format(), "OME-Zarr");
  EXPECT_EQ(scan->grid().spacing, (Vec3{1e-3 * 1, 1e-3 * 2, 1e-3 * 4}));
  EXPECT_EQ(scan->grid().origin, (Vec3{1e-3 * 10, 1e-3 * 20, 1e-3 * 30}));
  EXPECT_THAT(scan->warnings(), IsEmpty());
  expect_whole(folder.path());
}

TEST(ZarrStore, ReadsTheLevelThatIsNamed) {
  const TempFolder folder;
  write_ome(folder.path(), "millimeter");
  EXPECT_EQ(open_zarr(folder.path(), {.dataset = "1"})->grid().spacing, (Vec3{2, 4, 8}));
  EXPECT_EQ(open_zarr(folder / "1")->grid().spacing, (Vec3{2, 4, 8}));
  EXPECT_EQ(open_zarr(folder / "1/")->grid().spacing, (Vec3{2, 4, 8}));
  const auto label = open_zarr(folder.path(), {.dataset = "labels/a"});
  EXPECT_EQ(label->format(), "Zarr");
  EXPECT_THAT(label->warnings(), ElementsAre(HasSubstr(": 1 mm assumed")));
  EXPECT_THAT(open_zarr(folder.path(), {.spacing = Vec3{3, 3, 3}})->warnings(),
              ElementsAre(HasSubstr("is replaced by the one given")));
}

TEST(ZarrStore, ReadsAnImageOfVersion3WithTimeAndChannel) {
  const TempFolder folder;
  write_bytes(folder / "zarr.json", R"({"zarr_format": 3, "node_type": "group", "attributes":
      {"ome": {"version": "0.5", "multiscales": [{"axes": [{"name": "t"}, {"name": "c"},
      {"name": "z", "unit": "millimeter"}, {"name": "y", "unit": "millimeter"},
      {"name": "x", "unit": "millimeter"}], "datasets": [{"path": "s0",
      "coordinateTransformations": [{"type": "scale", "scale": [1, 1, 4, 2, 1]}]}]}]}}})");
  std::string text = zarr_json("int16", std::string("[") + kLittle + "]");
  text.replace(text.find("[7, 6, 5]"), 9, "[1, 1, 7, 6, 5]");
  text.replace(text.find("[2, 4, 3]"), 9, "[1, 1, 2, 4, 3]");
  write_bytes(folder / "s0/zarr.json", text);
  ArrayBytes array;
  array.separator = "/";
  array.prefix = "c/0/0/";
  array.write<std::int16_t>(folder / "s0");
  expect_whole(folder.path());
  EXPECT_EQ(open_zarr(folder.path())->grid().spacing, (Vec3{1, 2, 4}));
  text.replace(text.find("[1, 1, 7, 6, 5]"), 15, "[1, 3, 7, 6, 5]");
  write_bytes(folder / "s0/zarr.json", text);
  EXPECT_REFUSED(open_zarr(folder.path()), HasSubstr("3 channels (--channel 0 to 2)"));
  EXPECT_EQ(open_zarr(folder.path(), {.channel = 0})->grid().size[0], 5);
}

TEST(ZarrStore, FindsTheOnlyArrayOfAGroup) {
  const TempFolder folder;
  write_bytes(folder / ".zgroup", R"({"zarr_format": 2})");
  EXPECT_REFUSED(open_zarr(folder.path()), HasSubstr("expected an array of 3 axes, found none"));
  write_bytes(folder / "raw/.zarray", zarray());
  ArrayBytes().write<std::int16_t>(folder / "raw");
  write_bytes(folder / "line/.zarray", R"({"zarr_format": 2, "shape": [7], "chunks": [2]})");
  expect_whole(folder.path());
  write_bytes(folder / "other/.zarray", zarray());
  EXPECT_REFUSED(open_zarr(folder.path()), HasSubstr("found 2: other, raw"));
  expect_whole(folder.path(), {.dataset = "raw"});
}

TEST(ZarrStore, KnowsAStoreByItsFiles) {
  const TempFolder folder;
  EXPECT_FALSE(is_zarr(folder.path()));
  EXPECT_FALSE(is_zarr(folder / "nothing"));
  write_ome(folder.path(), "");
  EXPECT_TRUE(is_zarr(folder.path()));
  EXPECT_TRUE(is_zarr(folder / "0"));
  EXPECT_FALSE(is_zarr(folder / "0/0.0.0"));
}

TEST(ZarrStore, RefusesPathsOutOfTheStore) {
  const TempFolder folder;
  write_bytes(folder / "a/.zgroup", R"({"zarr_format": 2})");
  write_bytes(folder / "b/.zarray", zarray());
  EXPECT_REFUSED(open_zarr(folder / "a", {.dataset = "../b"}),
                 HasSubstr("expected a path that stays within the store, found \"../b\""));
  std::string image = multiscales("");
  image.replace(image.find("\"path\": \"0\""), 11, "\"path\": \"../b\"");
  write_bytes(folder / "a/.zattrs", R"({"multiscales": [)" + image + "]}");
  EXPECT_REFUSED(open_zarr(folder / "a"), HasSubstr("within the store"));
  EXPECT_REFUSED(open_zarr(folder / "c"), HasSubstr("c: "));
}

TEST(ZarrStore, RefusesChunksOfAnotherLength) {
  const TempFolder folder;
  write_bytes(folder / ".zarray", zarray());
  ArrayBytes().write<std::int16_t>(folder.path());
  write_bytes(folder / "1.0.0", std::string(47, 'x'));
  const auto scan = open_zarr(folder.path());
  EXPECT_REFUSED(scan->read(0, 7), HasSubstr("1.0.0: expected a chunk of 48 bytes, found 47"));
  EXPECT_EQ(scan->read(4, 3), expected_slices(4, 3));
  EXPECT_EQ(scan->read(0, 1), expected_slices(0, 1));
}

TEST(ZarrStore, RefusesHugeClaimsBeforeMemoryIsTaken) {
  const TempFolder folder;
  std::string text = zarray("<i2", R"({"id": "zlib"})");
  text.replace(text.find("[2, 4, 3]"), 9, "[60000, 4000, 3]");
  write_bytes(folder / ".zarray", text);
  write_bytes(folder / "0.0.0", packed("few", 15));
  const auto scan = open_zarr(folder.path(), {.limits = {.memory_gb = 0.01}});
  EXPECT_REFUSED(scan->read(0, 1), HasSubstr("memory"));
}

TEST(ZarrStore, RefusesBrokenMetadata) {
  const TempFolder folder;
  write_bytes(folder / ".zarray", zarray().substr(0, 40));
  EXPECT_REFUSED(open_zarr(folder.path()), HasSubstr(".zarray: expected JSON"));
  fs::remove(folder / ".zarray");
  write_bytes(folder / "zarr.json", "[]");
  EXPECT_REFUSED(open_zarr(folder.path()), HasSubstr("an object with \"node_type\""));
}

/// Castagnoli's sum, bit by bit.
std::uint32_t crc32c_of(const std::string& bytes) {
  std::uint32_t sum = ~0U;
  for (const char byte : bytes) {
    sum ^= static_cast<unsigned char>(byte);
    for (int bit = 0; bit < 8; ++bit) sum = sum >> 1 ^ ((sum & 1) != 0 ? 0x82f63b78U : 0);
  }
  return ~sum;
}

/// Two shards of 1 x 2 x 3 chunks of one voxel each; a chunk may be missing.
TEST(ZarrStore, ReadsShards) {
  for (const bool at_end : {true, false}) {
    for (const bool sum : {true, false}) {
      const TempFolder folder;
      write_bytes(folder / "zarr.json",
                  std::string(R"({"zarr_format": 3, "node_type": "array", "shape": [2, 2, 3],
        "data_type": "uint8", "fill_value": 99, "chunk_grid": {"name": "regular", "configuration":
        {"chunk_shape": [1, 2, 3]}}, "chunk_key_encoding": {"name": "default"}, "codecs": [{"name":
        "sharding_indexed", "configuration": {"chunk_shape": [1, 1, 1], "codecs": [{"name":
        "bytes"}], "index_codecs": [{"name": "bytes", "configuration": {"endian": "little"}})") +
                      (sum ? R"(, {"name": "crc32c"})" : "") + R"(], "index_location": ")" +
                      (at_end ? "end" : "start") + R"("}}]})");
      for (int k = 0; k < 2; ++k) {
        std::string table, chunks;
        const std::uint64_t before = at_end ? 0 : 6 * 16 + (sum ? 4 : 0);
        for (int n = 0; n < 6; ++n) {
          const bool missing = n == 4;
          table += bytes_of(missing ? ~std::uint64_t{0} : before + chunks.size());
          table += bytes_of(missing ? ~std::uint64_t{0} : std::uint64_t{1});
          if (!missing) chunks += static_cast<char>(10 * k + n);
        }
        if (sum) table += bytes_of(crc32c_of(table));
        write_bytes(folder / ("c/" + std::to_string(k) + "/0/0"),
                    at_end ? chunks + table : table + chunks);
      }
      const auto scan = open_zarr(folder.path());
      EXPECT_THAT(scan->read(0, 2), ElementsAre(0, 1, 2, 3, 99, 5, 10, 11, 12, 13, 99, 15));
      write_bytes(folder / "c/1/0/0", "short");
      EXPECT_REFUSED(open_zarr(folder.path())->read(1, 1), HasSubstr("in the shard, found 5"));
    }
  }
}

}  // namespace
}  // namespace mesamis
