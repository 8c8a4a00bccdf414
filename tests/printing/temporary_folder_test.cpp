// SPDX-License-Identifier: Apache-2.0
#include "mesamis/printing/temporary_folder.h"

#include <gtest/gtest.h>

#include "mesamis/base/error.h"
#include "support/temp_folder.h"
#include "support/variable.h"

namespace mesamis {
namespace {

TEST(TemporaryFolder, IsPrivateAndRemovedWithItsContent) {
  const TempFolder place;
  const Variable temporary("TMPDIR", place.path());
  std::filesystem::path path;
  {
    const TemporaryFolder folder("test");
    path = folder.path();
    EXPECT_EQ(path.parent_path(), place.path());
    EXPECT_EQ(std::filesystem::status(path).permissions(), std::filesystem::perms::owner_all);
    write_bytes(path / "deep/er/file", "x");
    EXPECT_NE(TemporaryFolder("test").path(), path);
  }
  EXPECT_EQ(place.file_count(), 0);
}

TEST(TemporaryFolder, IsRefusedWhereThereIsNoPlaceForIt) {
  const TempFolder place;
  const Variable temporary("TMPDIR", (place.path() / "none").string());
  EXPECT_THROW(TemporaryFolder("test"), InputError);
}

}  // namespace
}  // namespace mesamis
