// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <zlib.h>

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "mesamis/files/bytes.h"

namespace mesamis {

/// The bytes as one stream of raw deflate.
inline std::string raw_deflated(const std::string& bytes) {
  z_stream stream{};
  deflateInit2(&stream, Z_BEST_COMPRESSION, Z_DEFLATED, -15, 8, Z_DEFAULT_STRATEGY);
  std::string packed(deflateBound(&stream, static_cast<uLong>(bytes.size())), '\0');
  stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(bytes.data()));
  stream.avail_in = static_cast<uInt>(bytes.size());
  stream.next_out = reinterpret_cast<Bytef*>(packed.data());
  stream.avail_out = static_cast<uInt>(packed.size());
  deflate(&stream, Z_FINISH);
  packed.resize(stream.total_out);
  deflateEnd(&stream);
  return packed;
}

/// A ZIP archive of parts: names and bytes.
inline std::string zip_bytes(const std::vector<std::pair<std::string, std::string>>& parts,
                             bool deflated = true) {
  std::string bytes, directory;
  for (const auto& [name, plain] : parts) {
    const std::string stored = deflated ? raw_deflated(plain) : plain;
    const auto begin = static_cast<std::uint32_t>(bytes.size());
    std::string common;  // version, flags, method, time, date, checksum, sizes
    append(common, std::uint16_t{20});
    append(common, std::uint16_t{0});
    append(common, std::uint16_t{deflated ? std::uint16_t{8} : std::uint16_t{0}});
    append(common, std::uint32_t{0});
    append(common, static_cast<std::uint32_t>(
                       crc32_z(0, reinterpret_cast<const Bytef*>(plain.data()), plain.size())));
    append(common, static_cast<std::uint32_t>(stored.size()));
    append(common, static_cast<std::uint32_t>(plain.size()));
    append(common, static_cast<std::uint16_t>(name.size()));
    append(common, std::uint16_t{0});  // extra
    bytes += "PK\3\4" + common + name + stored;
    append(directory += "PK\1\2", std::uint16_t{20});
    directory += common + std::string(10, '\0');  // comment, disk, attributes
    append(directory, begin);
    directory += name;
  }
  const auto begin = static_cast<std::uint32_t>(bytes.size());
  bytes += directory + "PK\5\6" + std::string(4, '\0');
  append(bytes, static_cast<std::uint16_t>(parts.size()));
  append(bytes, static_cast<std::uint16_t>(parts.size()));
  append(bytes, static_cast<std::uint32_t>(directory.size()));
  append(bytes, begin);
  append(bytes, std::uint16_t{0});
  return bytes;
}

}  // namespace mesamis
