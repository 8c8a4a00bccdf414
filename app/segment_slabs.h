// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <optional>

#include "commands.h"
#include "mesamis/method/settings.h"

namespace CLI {
class App;
}  // namespace CLI

/// Runs of `segment` on scans that are larger than the memory.
namespace mesamis {

struct SegmentOptions;

/// Of the index of a mesh that is written slab by slab.
inline constexpr const char* kPiecesExtension = ".pvtu";

struct SlabArguments {
  std::optional<Index> slabs;        ///< --slabs: the part of the scan at a time; 0: auto
  std::filesystem::path checkpoint;  ///< --checkpoint; may be empty

  bool given() const { return slabs.has_value() || !checkpoint.empty(); }
};

/// Adds the options. `arguments` must outlive the parsing.
void add_slab_options(CLI::App& command, SlabArguments& arguments);

/// Checks what needs no scan: that nothing is asked for that needs all of a scan at once.
/// @throws CLI::ValidationError
void require_slabs(const SegmentOptions& run, const Settings& settings);

/// Finds the object slab by slab, with the processes of the team, and writes it.
/// @return the exit status.
/// @throws InputError  as open_any_slices() and run_in_slabs().
int run_slabs(const SegmentOptions& run, const SlabArguments& slabs, const Settings& settings,
              const CommonOptions& common);

}  // namespace mesamis
