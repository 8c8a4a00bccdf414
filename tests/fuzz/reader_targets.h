// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>

#include "fuzz_target.h"
#include "input_folder.h"
#include "mesamis/base/error.h"
#include "mesamis/base/parallel.h"
#include "mesamis/files/reading.h"

/// What the targets of the readers share: a file is read, and what it gives keeps its law, or it is
/// refused in one line that names it. Anything else is a finding.
namespace mesamis {

std::span<const FuzzTarget> scan_targets();
std::span<const FuzzTarget> label_targets();
std::span<const FuzzTarget> shape_targets();

/// Far below the bound that the fuzzer itself has.
inline ReadLimits fuzz_limits() { return {.memory_gb = 0.2}; }

/// Reads a file, perhaps again in another way: the refusal of one reader is no reason to leave out
/// the next.
template <class Read>
void read_or_refuse(const std::filesystem::path& file, const Read& read) {
  try {
    with_threads(1, [&] { read(file); });
  } catch (const InputError& refusal) {
    require_one_line(refusal.what());
    // Of several files it may be another one that is broken.
    require_law(std::string_view(refusal.what()).starts_with(file.parent_path().string()),
                std::string("a refusal that does not begin with a file: ") + refusal.what());
  }
}

}  // namespace mesamis
