// SPDX-License-Identifier: Apache-2.0
#include "mesamis/volume_files/zarr_array.h"

#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "support/throws.h"
#include "volume_files/chunk_bytes.h"

namespace mesamis {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

ZarrArray v2(const std::string& text) {
  const std::filesystem::path file(".zarray");
  const auto json = nlohmann::json::parse(text);
  return read_zarr_v2({file, json});
}

ZarrArray v3(const std::string& text) {
  const std::filesystem::path file("zarr.json");
  const auto json = nlohmann::json::parse(text);
  return read_zarr_v3({file, json});
}

std::string with(std::string text, const std::string& before, const std::string& after) {
  return text.replace(text.find(before), before.size(), after);
}

TEST(ZarrArray, ReadsVersion2) {
  const ZarrArray array = v2(zarray(">u2", R"({"id": "blosc", "cname": "lz4"})"));
  EXPECT_THAT(array.layout.shape, ElementsAre(7, 6, 5));
  EXPECT_THAT(array.layout.chunk, ElementsAre(2, 4, 3));
  EXPECT_THAT(array.layout.order, ElementsAre(0, 1, 2));
  EXPECT_EQ(array.layout.type, NumberType::kUint16);
  EXPECT_EQ(array.layout.byte_order, ByteOrder::kBig);
  EXPECT_EQ(array.layout.codecs.at(0).kind, ChunkCodec::Kind::kBlosc);
  EXPECT_EQ(chunk_name(array, {1, 2, 30}), "1.2.30");
}

TEST(ZarrArray, ReadsWhatVersion2MayChoose) {
  EXPECT_THAT(v2(with(zarray(), "\"C\"", "\"F\"")).layout.order, ElementsAre(2, 1, 0));
  const ZarrArray array = v2(zarray("|u1", "null", R"(, "dimension_separator": "/")"));
  EXPECT_EQ(chunk_name(array, {1, 2, 30}), "1/2/30");
  const auto fill = [](const char* value) {
    return v2(with(zarray(), "\"fill_value\": 0", std::string("\"fill_value\": ") + value))
        .layout.fill;
  };
  EXPECT_TRUE(std::isnan(fill("\"NaN\"")));
  EXPECT_EQ(fill("\"-Infinity\""), -HUGE_VAL);
  EXPECT_EQ(fill("-3.5"), -3.5);
  EXPECT_EQ(fill("null"), 0);
  const ZarrArray shuffled = v2(
      with(zarray(), "\"filters\": null", R"("filters": [{"id": "shuffle", "elementsize": 2}])"));
  EXPECT_EQ(shuffled.layout.codecs.at(0).element, 2u);
}

/// Masks are often stored as booleans, a byte each.
TEST(ZarrArray, BooleansAreNumbers) {
  const auto fill = [](std::string text, const char* value) {
    return with(std::move(text), "\"fill_value\": 0", std::string("\"fill_value\": ") + value);
  };
  const ZarrArray second = v2(fill(zarray("|b1"), "true"));
  EXPECT_EQ(second.layout.type, NumberType::kUint8);
  EXPECT_EQ(second.layout.fill, 1);
  const ZarrArray third = v3(fill(zarr_json("bool", R"(["bytes"])"), "false"));
  EXPECT_EQ(third.layout.type, NumberType::kUint8);
  EXPECT_EQ(third.layout.fill, 0);
}

TEST(ZarrArray, ReadsVersion3) {
  const ZarrArray array =
      v3(zarr_json("float64", R"([{"name": "transpose", "configuration": {"order": [2, 0, 1]}},
      {"name": "bytes", "configuration": {"endian": "big"}},
      {"name": "zstd", "configuration": {"level": 0}}, {"name": "crc32c"}])"));
  EXPECT_THAT(array.layout.order, ElementsAre(2, 0, 1));
  EXPECT_EQ(array.layout.type, NumberType::kFloat64);
  EXPECT_EQ(array.layout.byte_order, ByteOrder::kBig);
  EXPECT_EQ(array.layout.codecs.size(), 2u);
  EXPECT_EQ(chunk_name(array, {1, 2, 30}), "c/1/2/30");
}

TEST(ZarrArray, NamesChunksAsVersion3Says) {
  const auto name = [](const char* encoding) {
    return chunk_name(v3(zarr_json("uint8", R"(["bytes"])", encoding)), {1, 2, 30});
  };
  EXPECT_EQ(name(R"({"name": "default", "configuration": {"separator": "."}})"), "c.1.2.30");
  EXPECT_EQ(name(R"({"name": "v2"})"), "1.2.30");
  EXPECT_EQ(name(R"({"name": "v2", "configuration": {"separator": "/"}})"), "1/2/30");
}

TEST(ZarrArray, RefusesShardsInOneClearLine) {
  EXPECT_REFUSED(v3(zarr_json("uint8", R"([{"name": "sharding_indexed", "configuration": {}}])")),
                 HasSubstr("chunk_shape"));
}

TEST(ZarrArray, RefusesWhatItDoesNotKnow) {
  EXPECT_REFUSED(v2(zarray("<f2")), HasSubstr("dtype: expected whole numbers"));
  EXPECT_REFUSED(v2(zarray("u2")), HasSubstr("dtype"));
  EXPECT_REFUSED(v2(zarray("")), HasSubstr("dtype"));
  EXPECT_REFUSED(v2(with(zarray(), "\"<i2\"", R"([["r", "|u1"]])")), HasSubstr("dtype"));
  EXPECT_REFUSED(v2(zarray("<i2", R"({"id": "lzma"})")),
                 HasSubstr("expected one of zlib, gzip, blosc, zstd"));
  EXPECT_REFUSED(v2(with(zarray(), "\"C\"", "\"K\"")), HasSubstr("order: expected C or F"));
  EXPECT_REFUSED(v2(with(zarray(), "[2, 4, 3]", "[2, 4]")), HasSubstr("a list of 3 lengths"));
  EXPECT_REFUSED(v2(with(zarray(), "[2, 4, 3]", "[2, 4, -3]")), HasSubstr("whole number"));
  EXPECT_REFUSED(v2("{}"), HasSubstr("an object with \"zarr_format\""));
  EXPECT_REFUSED(v2(zarray("<i2", "null", R"(, "dimension_separator": "..")")),
                 HasSubstr("dimension_separator"));
  EXPECT_REFUSED(v3(zarr_json("uint8", "[]")), HasSubstr("a list with the codec bytes"));
  EXPECT_REFUSED(v3(zarr_json("uint16", R"([{"name": "bytes"}])")), HasSubstr("endian"));
  EXPECT_REFUSED(v3(zarr_json("complex64", R"(["bytes"])")), HasSubstr("data_type"));
  EXPECT_REFUSED(v3(zarr_json("uint8", R"([{"name": "gzip"}, "bytes"])")), HasSubstr("transpose"));
  EXPECT_REFUSED(
      v3(zarr_json("uint8", R"([{"name": "transpose", "configuration": {"order": [0, 0, 1]}}])")),
      HasSubstr("each axis from 0 to 2 once"));
}

}  // namespace
}  // namespace mesamis
