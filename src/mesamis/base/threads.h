// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <optional>
#include <type_traits>
#include <utility>

/// How many threads a computation may use.
namespace mesamis {

/// Runs work that returns nothing with at most so many threads, see with_threads().
/// @param count  at least 1; 0 means as many as are allowed where this is called.
/// @throws what the work throws.
void run_with_threads(int count, const std::function<void()>& work);

/// Runs the work, and all that it calls, with at most so many threads. Nothing else in the process
/// is affected.
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
