// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>

#include "mesamis/slabs/background.h"

/// The nodes of the first grid on the disk: 16 bytes each, since a large scan has many. Numbers are
/// rounded: u to 0.01 grey values, v to 3e-5, logarithms of metrics to 5e-4. They are first guesses
/// and sizes of cells.
namespace mesamis::detail::slabs {

inline constexpr std::int64_t kBytesOfNode = 16;

/// Writes the values at the nodes of a window.
/// @throws InputError  as make_item_file() and write_items().
void write_nodes(const std::filesystem::path& path, const GridWindow& window);

/// Reads the slices of nodes between two heights, and one beyond each where there is one.
/// @param path   of write_nodes().
/// @param frame  box and size of the window that was written.
/// @return a window of those slices; of a window that lies elsewhere, its nearest two.
/// @throws InputError  as map_items().
GridWindow read_nodes(const std::filesystem::path& path, const GridWindow& frame, double low,
                      double high);

}  // namespace mesamis::detail::slabs
