// SPDX-License-Identifier: Apache-2.0
#include "mesamis/base/parallel.h"

#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/info.h>
#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/task_arena.h>
#ifdef MESAMIS_THREAD_SANITIZER
#include <sanitizer/tsan_interface.h>
#endif

#include <algorithm>
#include <optional>
#include <vector>

namespace mesamis {
namespace {

// The thread sanitizer does not see how TBB, which is not built with it, passes work from thread
// to thread: it is told, so that what it reports are races between blocks.
#ifdef MESAMIS_THREAD_SANITIZER
void hand_over(char& token) { __tsan_release(&token); }
void take_over(char& token) { __tsan_acquire(&token); }
#else
void hand_over(char&) {}
void take_over(char&) {}
#endif

std::size_t block_count(std::size_t n, std::size_t block) { return (n + block - 1) / block; }

std::vector<double> block_values(std::size_t n,
                                 const std::function<double(std::size_t, std::size_t)>& partial) {
  std::vector<double> values(block_count(n, kBlock));
  parallel_blocks(n, kBlock, [&](std::size_t begin, std::size_t end) {
    values[begin / kBlock] = partial(begin, end);
  });
  return values;
}

}  // namespace

void run_with_threads(int count, const std::function<void()>& work) {
  if (count <= 0 || count == thread_count()) return work();
  // TBB has as many workers as the machine has processors, unless it is asked for more. Of several
  // limits the lowest holds, also for threads elsewhere: none is set that is not needed.
  std::optional<tbb::global_control> allowed;
  if (count > tbb::info::default_concurrency()) {
    allowed.emplace(tbb::global_control::max_allowed_parallelism, static_cast<std::size_t>(count));
  }
  tbb::task_arena arena(count);
  arena.execute(work);
}

int thread_count() { return tbb::this_task_arena::max_concurrency(); }

namespace detail::base {

void parallel_blocks(std::size_t n, std::size_t block,
                     const std::function<void(std::size_t, std::size_t)>& body) {
  const std::size_t blocks = block_count(n, block);
  auto run = [&](std::size_t b) { body(b * block, std::min(n, (b + 1) * block)); };
  if (blocks <= 1 || thread_count() == 1) {
    for (std::size_t b = 0; b < blocks; ++b) run(b);
    return;
  }
  char start = 0, finish = 0;
  hand_over(start);
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, blocks, 1),
                    [&](const tbb::blocked_range<std::size_t>& range) {
                      take_over(start);
                      for (std::size_t b = range.begin(); b != range.end(); ++b) run(b);
                      hand_over(finish);
                    });
  take_over(finish);
}

void parallel_tasks(std::size_t n, int at_once, const std::function<void(std::size_t)>& body) {
  const int threads = thread_count();
  const auto together =
      static_cast<int>(std::min(n, static_cast<std::size_t>(std::min(at_once, threads))));
  if (together <= 1) {
    for (std::size_t i = 0; i < n; ++i) body(i);
    return;
  }
  // A task has an arena of its own, so that none of its threads takes up another task as well.
  tbb::task_arena tasks(together);
  tasks.execute([&] {
    parallel_for_each(n, [&](std::size_t i) {
      const bool has_one_more = tbb::this_task_arena::current_thread_index() < threads % together;
      tbb::task_arena own(threads / together + (has_one_more ? 1 : 0));
      own.execute([&] { body(i); });
    });
  });
}

double parallel_sum(std::size_t n, const std::function<double(std::size_t, std::size_t)>& partial) {
  double sum = 0;
  for (const double value : block_values(n, partial)) sum += value;
  return sum;
}

double parallel_max(std::size_t n, double lowest,
                    const std::function<double(std::size_t, std::size_t)>& partial) {
  double largest = lowest;
  for (const double value : block_values(n, partial)) largest = std::max(largest, value);
  return largest;
}

}  // namespace detail::base

}  // namespace mesamis
