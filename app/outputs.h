// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace mesamis {

/// Checks an output file before any work is done for it.
/// @param extensions  those the option can write, lower case; the file's may be in either case.
/// @throws CLI::ValidationError  naming the option, for another extension.
/// @throws InputError            if the folder does not exist.
void require_output(const std::filesystem::path& path, const std::vector<std::string>& extensions,
                    const std::string& option);

/// "Surface: .stl .ply ...", as an option's help lists what it can write.
std::string listed(const std::string& what, const std::vector<std::string>& extensions);

/// The extension in lower case, with its dot.
std::string lower_extension(const std::filesystem::path& path);

}  // namespace mesamis
