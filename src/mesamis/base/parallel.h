// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <functional>

/// The one door to threads. Every result is the same to the bit for any number of threads:
/// the work is cut into blocks of fixed size, and partial sums are added in block order.
namespace mesamis {

/// Limits the threads used by everything below, for the whole process.
/// @param count  at least 1; 0 means as many as the machine has.
void set_thread_count(int count);
int thread_count();

inline constexpr std::size_t kBlock = 4096;

/// Calls body(begin, end) once for each block of at most `block` consecutive items of [0, n).
/// Blocks run concurrently and in any order; body must not write to what another block reads.
void parallel_blocks(std::size_t n, std::size_t block,
                     const std::function<void(std::size_t, std::size_t)>& body);

/// Calls body(i) for each i of [0, n), for loops whose steps are light.
template <class Body>
void parallel_for(std::size_t n, Body&& body) {
  parallel_blocks(n, kBlock, [&body](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) body(i);
  });
}

/// Calls body(i) for each i of [0, n), for a few heavy steps (parts, slabs, files).
template <class Body>
void parallel_for_each(std::size_t n, Body&& body) {
  parallel_blocks(n, 1, [&body](std::size_t begin, std::size_t) { body(begin); });
}

/// Sum over the blocks of [0, n) of partial(begin, end), added in block order.
double parallel_sum(std::size_t n, const std::function<double(std::size_t, std::size_t)>& partial);

/// Largest of partial(begin, end) over the blocks of [0, n); `lowest` when n is 0.
double parallel_max(std::size_t n, double lowest,
                    const std::function<double(std::size_t, std::size_t)>& partial);

}  // namespace mesamis
