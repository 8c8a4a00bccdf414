// SPDX-License-Identifier: Apache-2.0
#include "mesamis/printing/temporary_folder.h"

#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

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

TEST(TemporaryFolder, RemovesWhatAKilledProcessLeftAndNothingElse) {
  const TempFolder place;
  const Variable temporary("TMPDIR", place.path());
  const TemporaryFolder alive("test");
  write_bytes(place / "mesamis-test-abcdef/file", "nobody says that its owner is gone");
  const pid_t child = fork();
  if (child == 0) {
    const TemporaryFolder folder("test"), other("other");
    write_bytes(folder.path() / "deep/file", "x");
    kill(getpid(), SIGKILL);
  }
  waitpid(child, nullptr, 0);
  ASSERT_EQ(place.file_count(), 4);
  const TemporaryFolder next("test");
  EXPECT_EQ(place.file_count(), 4) << "that of the other purpose stays, one comes";
  EXPECT_TRUE(std::filesystem::exists(alive.path()));
  EXPECT_TRUE(std::filesystem::exists(place / "mesamis-test-abcdef/file"));
}

TEST(TemporaryFolder, IsRefusedWhereThereIsNoPlaceForIt) {
  const TempFolder place;
  const Variable temporary("TMPDIR", (place.path() / "none").string());
  EXPECT_THROW(TemporaryFolder("test"), InputError);
}

}  // namespace
}  // namespace mesamis
