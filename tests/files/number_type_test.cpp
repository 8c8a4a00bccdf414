// SPDX-License-Identifier: Apache-2.0
// bytes.h and number_type.h: numbers as files hold them.
#include "mesamis/files/number_type.h"

#include <gtest/gtest.h>

namespace mesamis {
namespace {

TEST(Bytes, NumbersAreLittleEndianUnlessTheFileIsBigEndian) {
  std::string bytes;
  append(bytes, std::uint32_t{0x01020304});
  append(bytes, std::int16_t{-2});
  append(bytes, 1.0);
  EXPECT_EQ(bytes, std::string("\x04\x03\x02\x01\xfe\xff\0\0\0\0\0\0\xf0\x3f", 14));
  EXPECT_EQ(load<std::uint32_t>(bytes.data()), 0x01020304u);
  EXPECT_EQ(load<std::uint32_t>(bytes.data(), ByteOrder::kBig), 0x04030201u);
  EXPECT_EQ(load<std::int16_t>(bytes.data() + 4), -2);
  EXPECT_EQ(load<double>(bytes.data() + 6), 1.0);
}

TEST(NumberType, EachHasItsSizeAndItsValue) {
  const std::string ones(8, '\xff');
  const auto value = [&](NumberType type) {
    return load_number(ones.data(), type, ByteOrder::kLittle);
  };
  EXPECT_EQ(value(NumberType::kInt8), -1);
  EXPECT_EQ(value(NumberType::kUint8), 255);
  EXPECT_EQ(value(NumberType::kInt16), -1);
  EXPECT_EQ(value(NumberType::kUint16), 65535);
  EXPECT_EQ(value(NumberType::kInt32), -1);
  EXPECT_EQ(value(NumberType::kUint32), 4294967295.0);
  EXPECT_EQ(value(NumberType::kInt64), -1);
  EXPECT_EQ(value(NumberType::kUint64), 18446744073709551616.0);  // rounded
  EXPECT_TRUE(value(NumberType::kFloat32) != value(NumberType::kFloat32));
  EXPECT_TRUE(value(NumberType::kFloat64) != value(NumberType::kFloat64));
  for (int n = 0; n <= static_cast<int>(NumberType::kFloat64); ++n) {
    const auto type = static_cast<NumberType>(n);
    EXPECT_EQ(byte_size(type), with_number_type(type, [](auto zero) { return sizeof(zero); }));
  }
}

}  // namespace
}  // namespace mesamis
