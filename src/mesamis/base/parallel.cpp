// SPDX-License-Identifier: Apache-2.0
#include "mesamis/base/parallel.h"

#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/info.h>
#include <oneapi/tbb/parallel_for.h>
#ifdef MESAMIS_THREAD_SANITIZER
#include <sanitizer/tsan_interface.h>
#endif

#include <algorithm>
#include <memory>
#include <vector>

namespace mesamis {
namespace {

std::unique_ptr<tbb::global_control>& limit() {
  static std::unique_ptr<tbb::global_control> control;
  return control;
}

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

void set_thread_count(int count) {
  // The old limit goes first: the strictest of all living controls is the one that acts.
  limit().reset();
  if (count > 0) {
    limit() = std::make_unique<tbb::global_control>(tbb::global_control::max_allowed_parallelism,
                                                    static_cast<std::size_t>(count));
  }
}

int thread_count() {
  return static_cast<int>(
      tbb::global_control::active_value(tbb::global_control::max_allowed_parallelism));
}

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

}  // namespace mesamis
