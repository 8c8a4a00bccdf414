// SPDX-License-Identifier: Apache-2.0
#include "child_process.h"

#include <fcntl.h>
#include <signal.h>
#include <stdlib.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <chrono>
#include <sstream>
#include <system_error>
#ifdef __linux__
#include <sys/prctl.h>
#endif

#include "interrupt.h"
#include "mesamis/base/error.h"
#include "process.h"

namespace mesamis {
namespace {

constexpr int kCannotStart = 127;  // as a shell says it

/// All that the child needs, made before fork(): after it nothing may be allocated.
struct Start {
  std::vector<std::string> arguments, environment;
  std::vector<char*> argument_pointers, environment_pointers;
  std::string folder;
};

std::vector<char*> pointers_to(std::vector<std::string>& texts) {
  std::vector<char*> pointers;
  pointers.reserve(texts.size() + 1);
  for (std::string& text : texts) pointers.push_back(text.data());
  pointers.push_back(nullptr);
  return pointers;
}

Start prepare(const ChildRequest& request) {
  Start start;
  start.folder = request.folder.string();
  start.arguments = request.arguments;
  start.arguments.insert(start.arguments.begin(), request.program.string());
  start.environment = {"HOME=" + start.folder, "TMPDIR=" + start.folder, "LC_ALL=C"};
  for (const std::string name : {"PATH", "LD_LIBRARY_PATH"}) {
    if (const char* value = getenv(name.c_str())) {
      start.environment.push_back(name + "=" + value);
    }
  }
  start.argument_pointers = pointers_to(start.arguments);
  start.environment_pointers = pointers_to(start.environment);
  return start;
}

/// A pipe that programs started meanwhile do not inherit, closed at the end.
class Pipe {
 public:
  Pipe() {
    if (pipe(ends_.data()) != 0) throw InputError("no pipe to another program can be made");
    for (const int end : ends_) fcntl(end, F_SETFD, FD_CLOEXEC);
  }
  ~Pipe() {
    close(ends_[0]);
    close_writing();
  }
  Pipe(const Pipe&) = delete;
  Pipe& operator=(const Pipe&) = delete;
  int reading() const { return ends_[0]; }
  int writing() const { return ends_[1]; }
  void close_writing() {
    if (ends_[1] >= 0) close(ends_[1]);
    ends_[1] = -1;
  }

 private:
  std::array<int, 2> ends_{-1, -1};
};

/// The interrupts, kept back while a child is started or forgotten.
class BlockedInterrupts {
 public:
  BlockedInterrupts() {
    sigset_t all;
    sigemptyset(&all);
    for (const int number : {SIGINT, SIGTERM, SIGHUP}) sigaddset(&all, number);
    pthread_sigmask(SIG_BLOCK, &all, &before_);
  }
  ~BlockedInterrupts() { pthread_sigmask(SIG_SETMASK, &before_, nullptr); }
  BlockedInterrupts(const BlockedInterrupts&) = delete;
  BlockedInterrupts& operator=(const BlockedInterrupts&) = delete;
  const sigset_t& before() const { return before_; }

 private:
  sigset_t before_;
};

void restore_signals(const sigset_t& mask) {
  for (const int number : {SIGINT, SIGTERM, SIGHUP}) {
    if (signal(number, SIG_DFL) == SIG_IGN) signal(number, SIG_IGN);  // nohup
  }
  pthread_sigmask(SIG_SETMASK, &mask, nullptr);
}

/// In the child: what may be called here is what may be called in a signal handler.
[[noreturn]] void become(const Start& start, int output, const sigset_t& mask) {
#ifdef __linux__
  prctl(PR_SET_PDEATHSIG, SIGKILL);
#endif
  restore_signals(mask);
  const int nothing = open("/dev/null", O_RDONLY);
  dup2(nothing, STDIN_FILENO);
  dup2(output, STDOUT_FILENO);
  dup2(output, STDERR_FILENO);
  if (chdir(start.folder.c_str()) == 0) {
    execve(start.argument_pointers[0], start.argument_pointers.data(),
           start.environment_pointers.data());
  }
  _exit(kCannotStart);
}

pid_t start_child(const Start& start, int output) {
  const BlockedInterrupts blocked;
  const pid_t child = fork();
  if (child == 0) become(start, output, blocked.before());
  if (child < 0) {
    throw InputError(start.arguments[0] +
                     ": cannot be started: " + std::generic_category().message(errno));
  }
  set_child_to_kill(child);
  return child;
}

/// Until the child, and whoever shares its output, has closed it.
std::string read_all(int file) {
  std::string text;
  std::array<char, 65536> buffer;
  while (true) {
    const ssize_t count = read(file, buffer.data(), buffer.size());
    if (count > 0) text.append(buffer.data(), static_cast<std::size_t>(count));
    if (count == 0 || (count < 0 && errno != EINTR)) return text;
  }
}

/// Waits first and takes the child away afterwards, so that its number is nobody else's while it
/// may be killed.
void await_child(pid_t child, ChildRun& run) {
  siginfo_t ended;
  while (waitid(P_PID, static_cast<id_t>(child), &ended, WEXITED | WNOWAIT) != 0 &&
         errno == EINTR) {
  }
  const BlockedInterrupts blocked;
  set_child_to_kill(0);
  int status = 0;
  rusage usage{};
  wait4(child, &status, 0, &usage);
  run.status = WIFSIGNALED(status) ? -WTERMSIG(status) : WEXITSTATUS(status);
  run.peak_memory_mb = peak_memory_mb(usage);
  run.cpu_seconds = cpu_seconds(usage);
}

}  // namespace

std::filesystem::path find_program(const std::string& name) {
  const char* path = getenv("PATH");
  std::istringstream folders(path ? path : "");
  for (std::string folder; std::getline(folders, folder, ':');) {
    const std::filesystem::path file = std::filesystem::path(folder) / name;
    std::error_code ignored;
    if (!folder.empty() && std::filesystem::is_regular_file(file, ignored) &&
        access(file.c_str(), X_OK) == 0) {
      return std::filesystem::absolute(file);
    }
  }
  return {};
}

ChildRun run_child(const ChildRequest& request) {
  const Start start = prepare(request);
  Pipe output;
  check_interrupted();
  const auto begin = std::chrono::steady_clock::now();
  const pid_t child = start_child(start, output.writing());
  output.close_writing();
  ChildRun run;
  run.output = read_all(output.reading());
  await_child(child, run);
  run.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  check_interrupted();
  return run;
}

}  // namespace mesamis
