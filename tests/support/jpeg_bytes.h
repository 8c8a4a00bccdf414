// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <cstdlib>
#include <string>
#include <vector>

/// Small grey JPEG pictures made by hand (ISO 10918-1).
namespace mesamis {

/// Huffman-coded data: bits from the most significant on, 0xff followed by a zero byte.
class JpegBits {
 public:
  void put(unsigned value, int count) {
    for (int bit = count - 1; bit >= 0; --bit) put_bit(value >> bit & 1);
  }
  /// A difference: its category as a code of five bits, then its own bits.
  void put_difference(int difference) {
    int category = 0;
    while (std::abs(difference) >> category) ++category;
    put(static_cast<unsigned>(category), 5);
    if (category == 16) return;  // 32768 has no bits of its own
    const int value = difference > 0 ? difference : difference + (1 << category) - 1;
    put(static_cast<unsigned>(value), category);
  }
  std::string bytes() {
    while (filled_ > 0) put_bit(1);
    return bytes_;
  }

 private:
  void put_bit(unsigned bit) {
    current_ = current_ << 1 | bit;
    if (++filled_ < 8) return;
    bytes_ += static_cast<char>(current_);
    if ((current_ & 0xff) == 0xff) bytes_ += '\0';
    current_ = 0;
    filled_ = 0;
  }

  std::string bytes_;
  unsigned current_ = 0;
  int filled_ = 0;
};

inline std::string big16_bytes(int value) {
  return {static_cast<char>(value >> 8), static_cast<char>(value & 0xff)};
}

/// A marker and its segment.
inline std::string jpeg_segment(int marker, const std::string& content) {
  return "\xff" + std::string(1, static_cast<char>(marker)) +
         big16_bytes(static_cast<int>(content.size()) + 2) + content;
}

/// Start of frame: size and precision of one component.
inline std::string jpeg_frame(int marker, int bits, int columns, int rows) {
  return jpeg_segment(marker, std::string(1, static_cast<char>(bits)) + big16_bytes(rows) +
                                  big16_bytes(columns) + std::string("\1\1\x11\0", 4));
}

/// Huffman table 0: the categories from 0 to the largest in codes of five bits.
inline std::string jpeg_difference_table(int largest) {
  std::string table(17, '\0');
  table[5] = static_cast<char>(largest + 1);
  for (int category = 0; category <= largest; ++category) table += static_cast<char>(category);
  return jpeg_segment(0xc4, table);
}

/// Lossless JPEG (process 14) that predicts each sample from its left neighbour.
inline std::string lossless_jpeg(int bits, int columns, const std::vector<std::uint16_t>& samples) {
  const int rows = static_cast<int>(samples.size()) / columns;
  JpegBits data;
  for (std::size_t n = 0; n < samples.size(); ++n) {
    const auto width = static_cast<std::size_t>(columns);
    const int before = n == 0           ? 1 << (bits - 1)
                       : n % width == 0 ? samples[n - width]
                                        : samples[n - 1];
    int difference = (samples[n] - before) & 0xffff;  // modulo 2^16
    if (difference > 32768) difference -= 65536;
    data.put_difference(difference);
  }
  return "\xff\xd8" + jpeg_frame(0xc3, bits, columns, rows) + jpeg_difference_table(16) +
         jpeg_segment(0xda, std::string("\1\1\0\1\0\0", 6)) + data.bytes() + "\xff\xd9";
}

/// A picture of 8 x 8 equal samples by the cosine transform: sequential, 8 or 12 bits.
inline std::string flat_jpeg(int bits, int value) {
  std::string no_coefficients(17, '\0');  // one code of one bit: end of block
  no_coefficients[0] = 0x10;
  no_coefficients[1] = 1;
  JpegBits data;
  data.put_difference(8 * (value - (1 << (bits - 1))));
  data.put(0, 1);
  std::string quantization(65, '\1');
  quantization[0] = 0;
  return "\xff\xd8" + jpeg_segment(0xdb, quantization) +
         jpeg_frame(bits == 8 ? 0xc0 : 0xc1, bits, 8, 8) + jpeg_difference_table(15) +
         jpeg_segment(0xc4, no_coefficients + '\0') +
         jpeg_segment(0xda, std::string("\1\1\0\0\x3f\0", 6)) + data.bytes() + "\xff\xd9";
}

}  // namespace mesamis
