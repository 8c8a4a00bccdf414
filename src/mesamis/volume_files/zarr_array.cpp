// SPDX-License-Identifier: Apache-2.0
#include "mesamis/volume_files/zarr_array.h"

#include <algorithm>
#include <limits>
#include <nlohmann/json.hpp>
#include <numeric>
#include <string_view>
#include <utility>

#include "mesamis/files/refuse.h"

namespace mesamis::detail::volume_files {
namespace {

using Kind = ChunkCodec::Kind;

/// The name of a type in version 3, and in version 2 without its byte order.
struct TypeName {
  std::string_view v3, v2;
  NumberType type;
};

constexpr std::array<TypeName, 11> kTypes{{{"int8", "i1", NumberType::kInt8},
                                           {"bool", "b1", NumberType::kUint8},
                                           {"uint8", "u1", NumberType::kUint8},
                                           {"int16", "i2", NumberType::kInt16},
                                           {"uint16", "u2", NumberType::kUint16},
                                           {"int32", "i4", NumberType::kInt32},
                                           {"uint32", "u4", NumberType::kUint32},
                                           {"int64", "i8", NumberType::kInt64},
                                           {"uint64", "u8", NumberType::kUint64},
                                           {"float32", "f4", NumberType::kFloat32},
                                           {"float64", "f8", NumberType::kFloat64}}};

constexpr const char* kExpectedType = "whole numbers of 8 to 64 bits or floating point of 32 or 64";
constexpr const char* kExpectedCodec = "one of zlib, gzip, blosc, zstd, shuffle, crc32c";

NumberType number_type(const JsonValue& value, std::string_view name,
                       std::string_view TypeName::*column) {
  for (const TypeName& known : kTypes) {
    if (known.*column == name) return known.type;
  }
  value.refuse_as(kExpectedType);
}

double read_fill(const JsonValue& value) {
  if (value.is_truth()) return value.truth() ? 1 : 0;
  if (!value.is_text()) return value.number();
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  const std::string text = value.text();
  if (text == "NaN") return std::numeric_limits<double>::quiet_NaN();
  if (text == "Infinity") return kInfinity;
  if (text == "-Infinity") return -kInfinity;
  value.refuse_as("a number, NaN, Infinity or -Infinity");
}

void set_fill(const JsonValue& metadata, ChunkLayout& layout) {
  if (const auto fill = metadata.find("fill_value")) layout.fill = read_fill(*fill);
}

void set_order(ChunkLayout& layout, bool backwards) {
  layout.order.resize(layout.shape.size());
  std::iota(layout.order.begin(), layout.order.end(), std::size_t{0});
  if (backwards) std::reverse(layout.order.begin(), layout.order.end());
}

char read_separator(const JsonValue& value) {
  const std::string text = value.text();
  if (text != "." && text != "/") value.refuse_as("\".\" or \"/\"");
  return text[0];
}

void require_axes(const JsonValue& chunks, const ChunkLayout& layout) {
  if (layout.chunk.size() == layout.shape.size()) return;
  chunks.refuse_as(
      message("a list of ", layout.shape.size(), " lengths, as many as the shape has"));
}

/// @param element  bytes of a sample, where a shuffle does not tell.
ChunkCodec read_codec(const JsonValue& codec, const std::string& name, std::size_t element) {
  if (name == "zlib" || name == "gzip") return {Kind::kDeflate};
  if (name == "blosc") return {Kind::kBlosc};
  if (name == "zstd") return {Kind::kZstd};
  if (name == "crc32c") return {Kind::kCrc32c};
  if (name == "shuffle") {
    const auto size = codec.find("elementsize");
    return {Kind::kShuffle, size ? static_cast<std::size_t>(size->count()) : element};
  }
  codec.at(codec.has("id") ? "id" : "name").refuse_as(kExpectedCodec);
}

ByteOrder order_of(const JsonValue& bytes, std::size_t size) {
  const auto configuration = bytes.find("configuration");
  const auto endian = configuration ? configuration->find("endian") : std::nullopt;
  if (!endian) {
    if (size > 1) bytes.refuse_as("a codec bytes with an endian");
    return ByteOrder::kLittle;
  }
  const std::string text = endian->text();
  if (text != "little" && text != "big") endian->refuse_as("little or big");
  return text == "big" ? ByteOrder::kBig : ByteOrder::kLittle;
}

/// The axes in the order that they have after a transposition.
void transpose_axes(const JsonValue& codec, ChunkLayout& layout) {
  const JsonValue order = codec.at("configuration").at("order");
  const std::vector<std::uint64_t> axes = order.counts();
  std::vector<std::uint64_t> sorted = axes;
  std::sort(sorted.begin(), sorted.end());
  for (std::size_t a = 0; a < layout.order.size(); ++a) {
    if (sorted.size() != layout.order.size() || sorted[a] != a) {
      order.refuse_as(message("each axis from 0 to ", layout.order.size() - 1, " once"));
    }
  }
  const std::vector<std::size_t> before = layout.order;
  for (std::size_t a = 0; a < before.size(); ++a) layout.order[a] = before[axes[a]];
}

void read_codecs(const JsonValue& codecs, ChunkLayout& layout) {
  bool in_bytes = false;
  for (const JsonValue& codec : codecs.list()) {
    const std::string name = codec.is_text() ? codec.text() : codec.at("name").text();
    if (name == "bytes" && !in_bytes) {
      layout.byte_order = order_of(codec, byte_size(layout.type));
      in_bytes = true;
    } else if (name == "transpose" && !in_bytes) {
      transpose_axes(codec, layout);
    } else if (in_bytes && !codec.is_text()) {
      layout.codecs.push_back(read_codec(codec, name, byte_size(layout.type)));
    } else if (in_bytes && name == "crc32c") {
      layout.codecs.push_back({Kind::kCrc32c});
    } else {
      codec.refuse_as("transpose, then bytes, then " + std::string(kExpectedCodec));
    }
  }
  if (!in_bytes) codecs.refuse_as("a list with the codec bytes");
}

std::string name_of_codec(const JsonValue& codec) {
  return codec.is_text() ? codec.text() : codec.at("name").text();
}

/// The table of a shard is in little endian, perhaps with a sum.
void read_index_codecs(const JsonValue& codecs, ZarrShard& shard) {
  const std::vector<JsonValue> list = codecs.list();
  const bool good =
      (list.size() == 1 || (list.size() == 2 && name_of_codec(list[1]) == "crc32c")) &&
      name_of_codec(list[0]) == "bytes" && order_of(list[0], 8) == ByteOrder::kLittle;
  if (!good) codecs.refuse_as("bytes in little endian, then crc32c or nothing");
  shard.index_has_sum = list.size() == 2;
}

/// Shards hold chunks: the array's chunks are then those within.
/// @return the codecs of the chunks.
JsonValue read_shards(const JsonValue& codec, ZarrArray& array) {
  constexpr std::uint64_t kMostChunks = 1 << 24;
  ChunkLayout& layout = array.layout;
  const JsonValue configuration = codec.at("configuration"),
                  shape = configuration.at("chunk_shape");
  const std::vector<std::uint64_t> inner = shape.counts();
  ZarrShard shard;
  std::uint64_t all = 1;
  for (std::size_t a = 0; a < layout.chunk.size(); ++a) {
    if (inner.size() != layout.chunk.size() || inner[a] < 1 || layout.chunk[a] % inner[a] != 0) {
      shape.refuse_as("lengths that divide those of the shards");
    }
    shard.chunks.push_back(layout.chunk[a] / inner[a]);
    if (shard.chunks.back() < 1 || shard.chunks.back() > kMostChunks / all) {
      shape.refuse_as(message("1 to ", kMostChunks, " chunks in a shard"));
    }
    all *= shard.chunks.back();
  }
  read_index_codecs(configuration.at("index_codecs"), shard);
  if (const auto place = configuration.find("index_location")) {
    if (place->text() != "start" && place->text() != "end") place->refuse_as("start or end");
    shard.index_at_end = place->text() == "end";
  }
  layout.chunk = inner;
  array.shard = std::move(shard);
  return configuration.at("codecs");
}

/// The codecs of an array: of its shards, and then of the chunks in them, or of chunks alone.
void read_codecs_of_array(const JsonValue& codecs, ZarrArray& array) {
  const std::vector<JsonValue> list = codecs.list();
  const bool shards = !list.empty() && name_of_codec(list[0]) == "sharding_indexed";
  if (!shards) return read_codecs(codecs, array.layout);
  if (list.size() > 1) codecs.refuse_as("sharding_indexed alone");
  read_codecs(read_shards(list[0], array), array.layout);
}

void read_encoding(const JsonValue& metadata, ZarrArray& array) {
  const JsonValue encoding = metadata.at("chunk_key_encoding");
  const std::string name = encoding.at("name").text();
  if (name != "default" && name != "v2") encoding.at("name").refuse_as("default or v2");
  const bool own = name == "default";
  array.separator = own ? '/' : '.';
  const auto configuration = encoding.find("configuration");
  const auto separator = configuration ? configuration->find("separator") : std::nullopt;
  if (separator) array.separator = read_separator(*separator);
  array.prefix = own ? std::string("c") + array.separator : std::string();
}

}  // namespace

std::uint64_t ZarrShard::index_bytes() const noexcept {
  std::uint64_t count = 1;
  for (const std::uint64_t n : chunks) count *= n;
  return 16 * count + (index_has_sum ? 4 : 0);
}

ZarrArray read_zarr_v2(const JsonValue& metadata) {
  if (metadata.at("zarr_format").count() != 2) metadata.at("zarr_format").refuse_as("2");
  ZarrArray array;
  ChunkLayout& layout = array.layout;
  layout.shape = metadata.at("shape").counts();
  layout.chunk = metadata.at("chunks").counts();
  require_axes(metadata.at("chunks"), layout);
  const JsonValue dtype = metadata.at("dtype");
  if (!dtype.is_text()) dtype.refuse_as(kExpectedType);
  const std::string name = dtype.text();
  if (name.empty() || std::string_view("<>|").find(name[0]) == std::string_view::npos) {
    dtype.refuse_as(kExpectedType);
  }
  layout.type = number_type(dtype, std::string_view(name).substr(1), &TypeName::v2);
  layout.byte_order = name[0] == '>' ? ByteOrder::kBig : ByteOrder::kLittle;
  const JsonValue order = metadata.at("order");
  const std::string letter = order.text();
  if (letter != "C" && letter != "F") order.refuse_as("C or F");
  set_order(layout, letter == "F");
  set_fill(metadata, layout);
  const auto add = [&](const JsonValue& codec) {
    layout.codecs.push_back(read_codec(codec, codec.at("id").text(), 1));
  };
  if (const auto filters = metadata.find("filters")) {
    for (const JsonValue& filter : filters->list()) add(filter);
  }
  if (const auto compressor = metadata.find("compressor")) add(*compressor);
  const auto separator = metadata.find("dimension_separator");
  if (separator) array.separator = read_separator(*separator);
  return array;
}

ZarrArray read_zarr_v3(const JsonValue& metadata) {
  if (metadata.at("zarr_format").count() != 3) metadata.at("zarr_format").refuse_as("3");
  if (metadata.at("node_type").text() != "array") metadata.at("node_type").refuse_as("array");
  ZarrArray array;
  ChunkLayout& layout = array.layout;
  layout.shape = metadata.at("shape").counts();
  const JsonValue type = metadata.at("data_type");
  if (!type.is_text()) type.refuse_as(kExpectedType);
  layout.type = number_type(type, type.text(), &TypeName::v3);
  const JsonValue grid = metadata.at("chunk_grid");
  if (grid.at("name").text() != "regular") grid.at("name").refuse_as("regular");
  const JsonValue chunks = grid.at("configuration").at("chunk_shape");
  layout.chunk = chunks.counts();
  require_axes(chunks, layout);
  set_order(layout, false);
  set_fill(metadata, layout);
  read_encoding(metadata, array);
  read_codecs_of_array(metadata.at("codecs"), array);
  const auto transformers = metadata.find("storage_transformers");
  if (transformers && !transformers->list().empty()) transformers->refuse_as("an empty list");
  return array;
}

std::string chunk_name(const ZarrArray& array, const std::vector<std::uint64_t>& place) {
  std::string name = array.prefix;
  for (std::size_t a = 0; a < place.size(); ++a) {
    if (a > 0) name += array.separator;
    name += std::to_string(place[a]);
  }
  return name;
}

}  // namespace mesamis::detail::volume_files
