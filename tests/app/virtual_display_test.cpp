// SPDX-License-Identifier: Apache-2.0
#include "virtual_display.h"

#include <gmock/gmock.h>
#include <signal.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <cstdio>
#include <fstream>
#include <sstream>
#include <thread>

#include "mesamis/printing/child_process.h"
#include "support/temp_folder.h"
#include "support/throws.h"
#include "support/variable.h"

namespace mesamis {
namespace {

using testing::HasSubstr;

class VirtualDisplayTest : public testing::Test {
 protected:
  void SetUp() override {
    if (find_program("Xvfb").empty()) GTEST_SKIP() << "Xvfb is not installed";
  }
};

/// Not counting one that has ended and that nobody has waited for.
bool is_running(pid_t process) {
  if (kill(process, 0) != 0) return false;
  const std::string status = read_bytes("/proc/" + std::to_string(process) + "/status");
  return status.find("State:\tZ") == std::string::npos;
}

/// Whether a process ends within ten seconds.
bool ends_soon(pid_t process) {
  for (int i = 0; i < 1000 && is_running(process); ++i) {
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  return !is_running(process);
}

/// Whether any process listens to a TCP port of this machine.
bool is_listened_to(int port) {
  char local[8];
  std::snprintf(local, sizeof local, ":%04X", static_cast<unsigned>(port));
  for (const char* table : {"/proc/net/tcp", "/proc/net/tcp6"}) {
    std::ifstream lines(table);
    for (std::string line; std::getline(lines, line);) {
      std::istringstream words(line);
      std::string number, address, remote, state;
      words >> number >> address >> remote >> state;
      if (address.ends_with(local) && state == "0A") return true;
    }
  }
  return false;
}

TEST_F(VirtualDisplayTest, RunsAsLongAsTheObject) {
  pid_t server = 0;
  {
    const VirtualDisplay display, other;
    server = display.server();
    EXPECT_EQ(display.name()[0], ':');
    EXPECT_NE(display.name(), other.name());
    EXPECT_TRUE(is_running(server));
    EXPECT_FALSE(is_listened_to(6000 + std::stoi(display.name().substr(1))));
  }
  EXPECT_FALSE(is_running(server));
  EXPECT_EQ(waitpid(-1, nullptr, WNOHANG), -1) << "a child process is left";
}

/// The first byte of the server's answer to who has no cookie: 0 no, 1 yes, 2 it asks.
int answer_without_cookie(const std::string& display) {
  const int connection = socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0);
  sockaddr_un address{};
  address.sun_family = AF_UNIX;
  const std::string path = "/tmp/.X11-unix/X" + display.substr(1);
  path.copy(address.sun_path, sizeof address.sun_path - 1);
  const char hello[12] = {'l', 0, 11};  // X11, little endian, no name and no data of a cookie
  char answer = -1;
  const bool told =
      connect(connection, reinterpret_cast<const sockaddr*>(&address), sizeof address) == 0 &&
      write(connection, hello, sizeof hello) == sizeof hello && read(connection, &answer, 1) == 1;
  close(connection);
  return told ? answer : -1;
}

TEST_F(VirtualDisplayTest, LetsInOnlyWhoHasItsCookie) {
  const TempFolder place;
  const Variable temporary("TMPDIR", place.path());
  const Variable before("XAUTHORITY", "before");
  {
    const VirtualDisplay display;
    EXPECT_EQ(answer_without_cookie(display.name()), 0);
    EXPECT_STRNE(getenv("XAUTHORITY"), "before");
    EXPECT_EQ(place.file_count(), 1);
  }
  EXPECT_STREQ(getenv("XAUTHORITY"), "before");
  EXPECT_EQ(place.file_count(), 0);
}

#ifdef __linux__
TEST_F(VirtualDisplayTest, EndsWithAProcessThatIsKilled) {
  int ends[2];
  ASSERT_EQ(pipe(ends), 0);
  const pid_t owner = fork();
  if (owner == 0) {
    const VirtualDisplay display;
    const pid_t server = display.server();
    if (write(ends[1], &server, sizeof server) != sizeof server) _exit(1);
    while (true) pause();
  }
  pid_t server = 0;
  ASSERT_EQ(read(ends[0], &server, sizeof server), static_cast<ssize_t>(sizeof server));
  EXPECT_TRUE(is_running(server));
  kill(owner, SIGKILL);
  waitpid(owner, nullptr, 0);
  EXPECT_TRUE(ends_soon(server));
  for (const int end : ends) close(end);
}
#endif

TEST(VirtualDisplay, SaysWhatToInstallWhereThereIsNoServer) {
  const TempFolder folder;
  const Variable path("PATH", folder.path());
  EXPECT_REFUSED(VirtualDisplay(), HasSubstr("xvfb"));
  // A server that ends at once.
  write_bytes(folder / "Xvfb", "#!/bin/sh\nexit 1\n");
  std::filesystem::permissions(folder / "Xvfb", std::filesystem::perms::owner_all);
  EXPECT_REFUSED(VirtualDisplay(), HasSubstr("did not start"));
  EXPECT_EQ(waitpid(-1, nullptr, WNOHANG), -1) << "a child process is left";
}

TEST(SilentStderr, IsSilentAsLongAsItLives) {
  testing::internal::CaptureStderr();
  std::fputs("before\n", stderr);
  {
    const SilentStderr silent;
    std::fputs("meanwhile\n", stderr);
    const SilentStderr nested;
  }
  std::fputs("after\n", stderr);
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "before\nafter\n");
}

}  // namespace
}  // namespace mesamis
