// SPDX-License-Identifier: Apache-2.0
// The program with closed or full standard streams.
#include <gmock/gmock.h>

#include "support/run_program.h"

namespace mesamis {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

/// Runs mesamis as a shell starts it.
/// @param streams  redirections.
ProgramRun run_shell(const TempFolder& folder, const std::string& arguments,
                     const std::string& streams) {
  return run_command(folder, {"sh", "-c", MESAMIS_PROGRAM " " + arguments + " " + streams});
}

TEST(Streams, AResultThatNobodyGotIsAFailure) {
  const TempFolder folder;
  for (const char* arguments : {"settings", "--help", "phantom --list"}) {
    if (fs::exists("/dev/full")) {
      EXPECT_FAILS(run_shell(folder, arguments, ">/dev/full"), 3, "stdout: cannot be written");
    }
    EXPECT_FAILS(run_shell(folder, arguments, ">&-"), 3, "stdout: cannot be written");
  }
}

TEST(Streams, ClosedOnesNeverBecomeAFileOfOurs) {
  const TempFolder folder;
  const std::string scan = folder / "s.nrrd", surface = folder / "a.stl";
  ASSERT_EQ(run_program(folder, {"phantom", "sphere", "--size", "12,12,12", "-o", scan}).status, 0);
  const std::string arguments = "segment " + scan + " --preview -o " + surface;
  ASSERT_EQ(run_shell(folder, arguments, "").status, 0);
  const std::string whole = read_bytes(surface);
  for (const char* streams : {"2>&-", "<&- >&- 2>&-", "<&-", ">&-"}) {
    fs::remove(surface);
    EXPECT_EQ(run_shell(folder, arguments, streams).status, 0) << streams;
    EXPECT_EQ(read_bytes(surface), whole) << streams;
  }
  EXPECT_EQ(run_shell(folder, "info " + (folder / "none.nii").string(), "2>&-").status, 3);
}

TEST(Streams, AFileThatGrowsBeyondTheLimitIsAnError) {
  const TempFolder folder;
  EXPECT_FAILS(run_command(folder, {"sh", "-c",
                                    "ulimit -f 8; exec " MESAMIS_PROGRAM " phantom sphere -o " +
                                        (folder / "s.nrrd").string()}),
               3, "s.nrrd: cannot be written");
  EXPECT_EQ(folder.file_count(), 2) << "stdout and stderr";
}

}  // namespace
}  // namespace mesamis
