// SPDX-License-Identifier: Apache-2.0
#include "mesamis/printing/child_process.h"

#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <stdlib.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <optional>
#include <sstream>
#include <system_error>
#ifdef __linux__
#include <sys/prctl.h>
#endif

#include "mesamis/base/error.h"

namespace mesamis::detail::printing {
namespace {

using Clock = std::chrono::steady_clock;

constexpr int kCannotStart = 127;       // exit status, as a shell reports it
constexpr int kPollMilliseconds = 100;  // between two looks at `stop` and the clock
constexpr int kExitMilliseconds = 5;    // between closing the output and the end of the process

std::string error_text(int error) { return std::generic_category().message(error); }

/// Everything the child needs, made before fork(): nothing may be allocated after it.
struct Start {
  std::vector<std::string> arguments, environment;
  std::vector<char*> argument_pointers, environment_pointers;
  std::string folder;
  pid_t parent = getpid();
};

std::vector<char*> pointers_to(std::vector<std::string>& texts) {
  std::vector<char*> pointers;
  pointers.reserve(texts.size() + 1);
  for (std::string& text : texts) pointers.push_back(text.data());
  pointers.push_back(nullptr);
  return pointers;
}

void prepare(const ChildRequest& request, Start& start) {
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
}

/// A pipe that other child processes do not inherit. Both ends are closed at the end.
class Pipe {
 public:
  Pipe() {
    if (pipe(ends_.data()) != 0) {
      throw InputError("no pipe to a child process can be made: " + error_text(errno));
    }
    for (const int end : ends_) fcntl(end, F_SETFD, FD_CLOEXEC);
    fcntl(reading(), F_SETFL, O_NONBLOCK);
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

/// Blocks all signals of this thread, so that no handler of the caller runs in the child.
class BlockedSignals {
 public:
  BlockedSignals() {
    sigset_t all;
    sigfillset(&all);
    pthread_sigmask(SIG_BLOCK, &all, &before_);
  }
  ~BlockedSignals() { pthread_sigmask(SIG_SETMASK, &before_, nullptr); }
  BlockedSignals(const BlockedSignals&) = delete;
  BlockedSignals& operator=(const BlockedSignals&) = delete;

 private:
  sigset_t before_;
};

/// Default actions for all signals that are not ignored (nohup), and none blocked.
void reset_signals() {
  for (int number = 1; number < NSIG; ++number) {
    struct sigaction action;
    if (sigaction(number, nullptr, &action) != 0 || action.sa_handler == SIG_IGN) continue;
    action.sa_handler = SIG_DFL;
    action.sa_flags = 0;
    sigaction(number, &action, nullptr);
  }
  sigset_t none;
  sigemptyset(&none);
  sigprocmask(SIG_SETMASK, &none, nullptr);
}

/// A copy of a descriptor that is none of stdin, stdout and stderr, whatever the caller closed.
int above_standard(int file) { return fcntl(file, F_DUPFD_CLOEXEC, STDERR_FILENO + 1); }

/// Runs in the child, where only what a signal handler may call is allowed.
[[noreturn]] void execute(const Start& start, int output) {
#ifdef __linux__
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (getppid() != start.parent) _exit(kCannotStart);  // it ended before the line above
#endif
  reset_signals();
  const int from = above_standard(open("/dev/null", O_RDONLY | O_CLOEXEC));
  const int to = above_standard(output);
  dup2(from, STDIN_FILENO);
  dup2(to, STDOUT_FILENO);
  dup2(to, STDERR_FILENO);
  if (chdir(start.folder.c_str()) == 0) {
    execve(start.argument_pointers[0], start.argument_pointers.data(),
           start.environment_pointers.data());
  }
  _exit(kCannotStart);
}

/// A process that runs. It is killed and waited for if it has not been when this ends.
class Child {
 public:
  Child(const Start& start, int output) {
    const BlockedSignals blocked;
    process_ = fork();
    if (process_ == 0) execute(start, output);
    if (process_ < 0) {
      throw InputError(start.arguments[0] + ": cannot be started: " + error_text(errno));
    }
  }
  ~Child() {
    if (process_ <= 0) return;
    stop();
    int status = 0;
    rusage usage{};
    wait(status, usage);
  }
  Child(const Child&) = delete;
  Child& operator=(const Child&) = delete;

  void stop() const { kill(process_, SIGKILL); }

  /// The process is not released, so that its number belongs to nobody else.
  bool has_ended() const {
    siginfo_t info{};
    const int failed =
        waitid(P_PID, static_cast<id_t>(process_), &info, WEXITED | WNOWAIT | WNOHANG);
    return failed ? errno != EINTR : info.si_pid != 0;
  }

  /// Waits for the end and releases the process.
  /// @return 0, or errno if the status is lost.
  int wait(int& status, rusage& usage) {
    pid_t ended = 0;
    do {
      ended = wait4(process_, &status, 0, &usage);
    } while (ended < 0 && errno == EINTR);
    process_ = 0;
    return ended < 0 ? errno : 0;
  }

 private:
  pid_t process_ = 0;
};

/// Appends what has arrived, until the text is longer than the limit.
/// @return false at the end of the output.
bool read_available(int file, std::size_t limit, std::string& text) {
  std::array<char, 65536> buffer;
  while (text.size() <= limit) {
    const ssize_t count = read(file, buffer.data(), buffer.size());
    if (count > 0) text.append(buffer.data(), static_cast<std::size_t>(count));
    if (count == 0) return false;
    if (count < 0 && errno != EINTR) return true;
  }
  return true;
}

void wait_for_output(int file, int milliseconds) {
  pollfd output{file, POLLIN, 0};
  poll(&output, 1, milliseconds);
}

double seconds_since(Clock::time_point begin) {
  return std::chrono::duration<double>(Clock::now() - begin).count();
}

/// The bounds that a request sets to a child that has run since `begin`.
class Bounds {
 public:
  Bounds(const ChildRequest& request, const std::function<bool()>& stop)
      : request_(request), stop_(stop) {}

  std::size_t output_limit() const { return request_.output_limit; }

  /// @return why the child must be killed; none if it may go on.
  /// @throws Cancelled  if the caller stops the run.
  std::optional<ChildEnd> exceeded(const std::string& output) const {
    if (output.size() > request_.output_limit) return ChildEnd::kOutputLimit;
    const bool timed = request_.timeout_seconds > 0;
    if (timed && seconds_since(begin_) > request_.timeout_seconds) return ChildEnd::kTimeout;
    if (stop_ && stop_()) throw Cancelled();
    return std::nullopt;
  }

 private:
  const ChildRequest& request_;
  const std::function<bool()>& stop_;
  Clock::time_point begin_ = Clock::now();
};

/// Collects the output until the child ends.
/// @return why it must be killed; none if it ended by itself.
std::optional<ChildEnd> follow(const Child& child, const Bounds& bounds, int file,
                               std::string& output) {
  for (bool open = true; !child.has_ended();) {
    wait_for_output(open ? file : -1, open ? kPollMilliseconds : kExitMilliseconds);
    open = open && read_available(file, bounds.output_limit(), output);
    if (const auto end = bounds.exceeded(output)) return end;
  }
  read_available(file, bounds.output_limit(), output);
  if (output.size() > bounds.output_limit()) return ChildEnd::kOutputLimit;
  return std::nullopt;
}

double megabytes(const rusage& usage) {
#ifdef __APPLE__
  constexpr double kUnit = 1;  // bytes
#else
  constexpr double kUnit = 1024;
#endif
  return kUnit * static_cast<double>(usage.ru_maxrss) / 1e6;
}

double cpu_seconds(const rusage& usage) {
  const auto seconds = [](const timeval& t) {
    return static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec);
  };
  return seconds(usage.ru_utime) + seconds(usage.ru_stime);
}

void finish(const ChildRequest& request, Child& child, ChildRun& run) {
  int status = 0;
  rusage usage{};
  if (const int error = child.wait(status, usage)) {
    throw InputError(
        request.program.string() +
        ": expected its exit status, found none (is SIGCHLD ignored?): " + error_text(error));
  }
  run.status = WIFSIGNALED(status) ? -WTERMSIG(status) : WEXITSTATUS(status);
  run.peak_memory_mb = megabytes(usage);
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

ChildRun run_child(const ChildRequest& request, const std::function<bool()>& stop) {
  Start start;
  prepare(request, start);
  Pipe output;
  if (stop && stop()) throw Cancelled();
  const auto begin = Clock::now();
  Child child(start, output.writing());
  output.close_writing();
  ChildRun run;
  const auto killed_for = follow(child, Bounds(request, stop), output.reading(), run.output);
  if (killed_for) child.stop();
  finish(request, child, run);
  if (run.status < 0) run.end = ChildEnd::kSignal;
  if (killed_for) run.end = *killed_for;
  run.output.resize(std::min(run.output.size(), request.output_limit));
  run.seconds = seconds_since(begin);
  return run;
}

}  // namespace mesamis::detail::printing
