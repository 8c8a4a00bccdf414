// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <optional>
#include <type_traits>
#include <utility>

/// The number of threads of a computation.
namespace mesamis {

/// Runs work that returns nothing on at most `count` threads, see with_threads().
/// @param count  at least 1; 0 means as many as are allowed where this is called.
/// @throws what the work throws.
void run_with_threads(int count, const std::function<void()>& work);

/// Runs the work, and all that it calls, on at most `count` threads. The rest of the process is not
/// affected.
/// @param count  at least 1; 0 means as many as are allowed where this is called.
/// @return what the work returns.
/// @throws what the work throws.
template <class Work>
auto with_threads(int count, Work&& work) {
  if constexpr (std::is_void_v<decltype(work())>) {
    run_with_threads(count, work);
  } else {
    std::optional<decltype(work())> result;
    run_with_threads(count, [&] { result.emplace(work()); });
    return *std::move(result);
  }
}

/// The number of threads that are allowed where this is called, at least 1.
int thread_count();

}  // namespace mesamis
