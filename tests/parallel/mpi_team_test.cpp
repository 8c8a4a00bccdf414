// SPDX-License-Identifier: Apache-2.0
// What several processes do together is tested with the program, in
// tests/app/segment_slabs_test.cpp.
#include "mesamis/parallel/mpi_team.h"

#include <gtest/gtest.h>
#include <unistd.h>

namespace mesamis {
namespace {

TEST(MpiTeam, IsAProcessOnItsOwnWhereNobodyStartedMore) {
  if (geteuid() == 0) setenv("OMPI_ALLOW_RUN_AS_ROOT", "1", 0);
  int count = 1;
  std::string name = "test";
  char* arguments[]{name.data(), nullptr};
  char** first = arguments;
  MpiTeam team(count, first);
  EXPECT_EQ(team.size(), 1);
  EXPECT_EQ(team.rank(), 0);
  team.wait_for_all();
  team.wait_for_all();
}

}  // namespace
}  // namespace mesamis
