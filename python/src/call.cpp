// SPDX-License-Identifier: Apache-2.0
#include "call.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <condition_variable>
#include <exception>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "mesamis/base/error.h"
#include "mesamis/base/parallel.h"

namespace mesamis::python {
namespace {

constexpr std::chrono::milliseconds kBetweenCalls{50};

struct Event {
  std::string stage;
  double fraction = 0;
};

/// What the working thread tells the waiting one.
class Mailbox {
 public:
  Progress progress() {
    return [this](std::string_view stage, double fraction) {
      const std::lock_guard lock(mutex_);
      if (events_.empty() || events_.back().stage != stage) {
        events_.push_back({std::string(stage), 0});
      }
      events_.back().fraction = std::isfinite(fraction) ? std::clamp(fraction, 0.0, 1.0) : 0;
      return !stop_;
    };
  }

  void stop() {
    const std::lock_guard lock(mutex_);
    stop_ = true;
  }

  void finish() {
    const std::lock_guard lock(mutex_);
    done_ = true;
    changed_.notify_all();
  }

  /// Waits a while, or until the work is done, and takes the events.
  /// @return  whether it is done.
  bool wait(std::vector<Event>& events) {
    std::unique_lock lock(mutex_);
    changed_.wait_for(lock, kBetweenCalls, [this] { return done_; });
    events = std::move(events_);
    events_.clear();
    return done_;
  }

 private:
  std::mutex mutex_;
  std::condition_variable changed_;
  std::vector<Event> events_;
  bool stop_ = false, done_ = false;
};

/// @throws py::error_already_set  for an answer that is neither true nor false.
bool is_false(const py::object& answer) {
  const int truth = PyObject_IsTrue(answer.ptr());
  if (truth < 0) throw py::error_already_set();
  return truth == 0;
}

/// Runs what Python wants to do meanwhile.
/// @return  whether the work may go on.
bool tell(const py::object& progress, const std::vector<Event>& events) {
  if (PyErr_CheckSignals() != 0) throw py::error_already_set();
  if (progress.is_none()) return true;
  return std::none_of(events.begin(), events.end(), [&](const Event& event) {
    const py::object answer = progress(event.stage, event.fraction);
    return !answer.is_none() && is_false(answer);
  });
}

}  // namespace

void run_released(const CallOptions& call, const std::function<void(const Progress&)>& work) {
  if (call.threads < 0) {
    throw InputError("threads: expected 0 or more, found " + std::to_string(call.threads));
  }
  Mailbox mailbox;
  std::exception_ptr failure;
  std::jthread worker([&] {
    try {
      run_with_threads(call.threads, [&] { work(mailbox.progress()); });
    } catch (...) {
      failure = std::current_exception();
    }
    mailbox.finish();
  });
  std::optional<py::error_already_set> raised;
  bool stopped = false;
  for (bool done = false; !done;) {
    std::vector<Event> events;
    {
      const py::gil_scoped_release lock_released;
      done = mailbox.wait(events);
    }
    if (raised) continue;
    try {
      if (stopped || tell(call.progress, events)) continue;
      stopped = true;
      mailbox.stop();
    } catch (const py::error_already_set& error) {
      raised = error;
      mailbox.stop();
    }
  }
  worker.join();
  if (raised) throw py::error_already_set(*raised);
  if (failure) std::rethrow_exception(failure);
  if (stopped) throw Cancelled();
}

}  // namespace mesamis::python
