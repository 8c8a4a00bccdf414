// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

/// Several fuzz targets in one program: it is linked once, and the name by which it is called
/// chooses one. With --list it names them, with --dictionary it prints its words for libFuzzer.
namespace mesamis {

/// What is done with the bytes of a case. A case that breaks a law ends the process.
struct FuzzTarget {
  std::string_view name;  ///< "nifti": the program is called fuzz_nifti
  void (*run)(std::string_view bytes);
};

/// The targets of this program; each program defines its own.
std::span<const FuzzTarget> fuzz_targets();

/// Words for a dictionary of its inputs that the program knows by itself.
std::vector<std::string> fuzz_words();

/// Ends the process with this message unless the condition holds: a finding.
void require_law(bool holds, std::string_view message);

/// A line of the program for people: no control character, UTF-8, at most so many bytes.
void require_one_line(std::string_view message, std::size_t longest = 500);

}  // namespace mesamis
