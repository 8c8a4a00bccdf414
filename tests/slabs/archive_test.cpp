// SPDX-License-Identifier: Apache-2.0
#include "mesamis/slabs/archive.h"

#include <gtest/gtest.h>

#include <cmath>

#include "mesamis/base/types.h"
#include "support/throws.h"

namespace mesamis {
namespace {

using testing::AllOf;
using testing::HasSubstr;

ArchiveWriter three_arrays() {
  ArchiveWriter archive;
  archive.add(std::vector<double>{1, -0.0, 1e300});
  archive.add(std::vector<char>{});
  archive.add_one(Vec3{1, 2, 3});
  return archive;
}

ArchiveReader reader(std::string_view bytes) { return {std::string(bytes), "folder/name"}; }

TEST(Archive, HandsOutWhatWasAdded) {
  const ArchiveWriter written = three_arrays();
  ArchiveReader archive = reader(written.bytes());
  EXPECT_EQ(archive.size(), written.bytes().size());
  const std::vector<double> numbers = archive.next<double>();
  EXPECT_EQ(numbers, (std::vector<double>{1, 0, 1e300}));
  EXPECT_TRUE(std::signbit(numbers[1])) << "all bits";
  EXPECT_TRUE(archive.next<char>().empty());
  EXPECT_EQ(archive.next_one<Vec3>(), (Vec3{1, 2, 3}));
  EXPECT_REFUSED(archive.next<double>(), HasSubstr("folder/name: "));
}

TEST(Archive, RefusesOtherItems) {
  ArchiveReader other_size = reader(three_arrays().bytes());
  EXPECT_REFUSED(other_size.next<float>(), AllOf(HasSubstr("folder/name: "), HasSubstr("damaged")));
  ArchiveReader several = reader(three_arrays().bytes());
  EXPECT_REFUSED(several.next_one<double>(), HasSubstr("expected one item, found 3"));
}

TEST(Archive, RefusesAFileThatEndsTooEarly) {
  const ArchiveWriter written = three_arrays();
  for (std::size_t length = 0; length < written.bytes().size(); ++length) {
    const auto read_all = [&] {
      ArchiveReader archive = reader(written.bytes().substr(0, length));
      archive.next<double>();
      archive.next<char>();
      archive.next_one<Vec3>();
    };
    EXPECT_REFUSED(read_all(), HasSubstr("damaged")) << length;
  }
}

TEST(Archive, RefusesCountsThatNoFileHolds) {
  std::string bytes(three_arrays().bytes());
  for (std::size_t i = 0; i < 8; ++i) bytes[i] = '\xff';
  EXPECT_REFUSED(reader(bytes).next<double>(), HasSubstr("damaged"));
}

}  // namespace
}  // namespace mesamis
