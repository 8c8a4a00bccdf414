// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <functional>
#include <vector>

#include "mesamis/base/threads.h"
#include "mesamis/rooms.h"

/// The one door to threads. Every result is the same to the bit for any number of threads:
/// the work is cut into blocks of fixed size, and partial sums are added in block order.
namespace mesamis::detail::base {

/// Items per block of the loops below.
inline constexpr std::size_t kBlock = 4096;

/// Calls body(begin, end) once for each block of at most `block` consecutive items of [0, n).
/// Blocks run concurrently and in any order; body must not write to what another block reads.
/// @param block  at least 1.
/// @throws what body throws: the exception of one block is thrown again here.
void parallel_blocks(std::size_t n, std::size_t block,
                     const std::function<void(std::size_t, std::size_t)>& body);

/// Calls body(i) for each i of [0, n), in blocks of kBlock: for loops whose steps are short.
/// @throws what body throws.
template <class Body>
void parallel_for(std::size_t n, Body&& body) {
  parallel_blocks(n, kBlock, [&body](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) body(i);
  });
}

/// Calls body(i) for each i of [0, n), one step per block: for a few long steps (layers, files).
/// @throws what body throws.
template <class Body>
void parallel_for_each(std::size_t n, Body&& body) {
  parallel_blocks(n, 1, [&body](std::size_t begin, std::size_t) { body(begin); });
}

/// Calls body(0) and body(1), the halves of a recursion over so many items; concurrently where these
/// are many.
/// @throws what body throws.
template <class Body>
void parallel_halves(std::size_t items, Body&& body) {
  constexpr std::size_t kMany = 1 << 16;
  if (items > kMany) return parallel_for_each(2, body);
  body(0);
  body(1);
}

/// Calls body(i) for each i of [0, n), so many at a time, each with its share of the threads that
/// are allowed here: for long steps that use threads themselves, and take memory.
/// @param at_once  at least 1; no more are done at a time than there are threads.
/// @throws what body throws.
void parallel_tasks(std::size_t n, int at_once, const std::function<void(std::size_t)>& body);

/// Collects what body(begin, end, found) appends to its block's vector `found`, for the blocks of
/// [0, n), see parallel_blocks().
/// @param block  at least 1.
/// @return the items of all blocks, in block order. O(items) beside what body takes.
/// @throws what body throws.
template <class Item, class Body>
std::vector<Item> parallel_collect(std::size_t n, std::size_t block, Body&& body) {
  std::vector<std::vector<Item>> blocks((n + block - 1) / block);
  parallel_blocks(n, block, [&](std::size_t begin, std::size_t end) {
    body(begin, end, blocks[begin / block]);
  });
  std::size_t count = 0;
  for (const auto& found : blocks) count += found.size();
  std::vector<Item> all;
  all.reserve(count);
  for (const auto& found : blocks) all.insert(all.end(), found.begin(), found.end());
  return all;
}

/// Adds up partial(begin, end) over the blocks of [0, n), in block order.
/// @return in the unit of the partial sums, any unit; 0 when n is 0.
/// @throws what partial throws.
///
/// One number per block is kept.
double parallel_sum(std::size_t n, const std::function<double(std::size_t, std::size_t)>& partial);

/// Finds the largest of partial(begin, end) over the blocks of [0, n).
/// @param lowest  in the unit of the partial values, any unit.
/// @return in that unit; `lowest` when n is 0 or no value exceeds it.
/// @throws what partial throws.
///
/// One number per block is kept.
double parallel_max(std::size_t n, double lowest,
                    const std::function<double(std::size_t, std::size_t)>& partial);

}  // namespace mesamis::detail::base
