// SPDX-License-Identifier: Apache-2.0
#include "mesamis/slabs/same_run.h"

#include <gtest/gtest.h>

#include "mesamis/base/error.h"
#include "support/temp_folder.h"

namespace mesamis {
namespace {

TEST(SameRun, AFolderBelongsToItsFirstRun) {
  const TempFolder folder;
  const Scratch scratch(folder.path());
  Alone team;
  require_same_run(scratch, "one", team);
  require_same_run(scratch, "one", team);
  EXPECT_THROW(require_same_run(scratch, "another", team), InputError);
  require_same_run(scratch, "one", team);
}

TEST(SameRun, IsDescribedByItsSettings) {
  Settings settings;
  const std::string before = description_of(settings);
  EXPECT_EQ(before.find('\n'), std::string::npos);
  settings.tolerance = 0.125;
  EXPECT_NE(description_of(settings), before);
}

}  // namespace
}  // namespace mesamis
