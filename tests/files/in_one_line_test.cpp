// SPDX-License-Identifier: Apache-2.0
#include "mesamis/files/in_one_line.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <new>
#include <stdexcept>

#include "support/temp_folder.h"
#include "support/throws.h"

namespace mesamis {
namespace {

using testing::HasSubstr;
using testing::StartsWith;

TEST(InOneLine, EveryFailureBeginsWithThePath) {
  const TempFolder folder;
  write_bytes(folder / "a", "x");
  const auto path = folder / "a";
  EXPECT_EQ(in_one_line(path, [] { return 3; }), 3);
  EXPECT_REFUSED(in_one_line(path, [&] { refuse(path, "broken"); }),
                 testing::Eq(path.string() + ": broken"));
  EXPECT_REFUSED(in_one_line(path, [&] { refuse("other", "broken"); }),
                 testing::AllOf(StartsWith(path.string()), HasSubstr("other: broken")));
  EXPECT_REFUSED(in_one_line(path, [] { throw std::bad_alloc(); }), HasSubstr("not enough memory"));
  EXPECT_REFUSED(in_one_line(path, [] { throw std::runtime_error("odd\nthing"); }),
                 HasSubstr("cannot be read: odd?thing"));
  EXPECT_REFUSED(in_one_line(folder / "b", [] {}), HasSubstr("no such file or directory"));
}

}  // namespace
}  // namespace mesamis
