// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "mesamis/files/output_set.h"
#include "mesamis/files/refuse.h"

namespace mesamis {

/// Checks the name of an output file before the work starts.
/// @param extensions  that the option can write, lower case; the file's may be in either case.
/// @throws CLI::ValidationError  naming the option, for another extension.
/// @throws InputError            if the folder does not exist, or as require_writable().
void require_output(const std::filesystem::path& path, const std::vector<std::string>& extensions,
                    const std::string& option);

using Paths = std::vector<std::filesystem::path>;

/// Checks that no output lies over another one or over an input.
/// @throws CLI::ValidationError  naming the file.
void require_distinct_files(const Paths& outputs, const Paths& inputs);

/// The files that wait in a set.
Paths files_of(const OutputSet& set);

/// Lets the files of a run appear. An interrupt waits until all are there.
/// @throws InputError  as OutputSet::commit().
void commit(OutputSet& set);

/// "Surface: .stl .ply ...": the formats that an option can write, for its help.
std::string listed(const std::string& what, const std::vector<std::string>& extensions);

}  // namespace mesamis
