// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <type_traits>
#include <utility>

namespace mesamis {

namespace detail::files {
class OutputSet;
}

/// The path of an output file and the set of files that it appears with, see OutputSet::file(). A
/// path converts implicitly: the file then appears on its own.
struct OutputPath : std::filesystem::path {
  /// A file on its own. Converts whatever a path is made of.
  // NOLINTBEGIN(google-explicit-constructor,bugprone-forwarding-reference-overload)
  template <class Path>
  requires(std::is_constructible_v<std::filesystem::path, Path> &&
           !std::is_base_of_v<OutputPath, std::remove_cvref_t<Path>>) OutputPath(Path&& name)
      : std::filesystem::path(std::forward<Path>(name)) {}
  // NOLINTEND(google-explicit-constructor,bugprone-forwarding-reference-overload)
  /// A file of a set.
  /// @param with  lives until the file is written; nullptr: none.
  OutputPath(std::filesystem::path name, detail::files::OutputSet* with)
      : std::filesystem::path(std::move(name)), set(with) {}

  detail::files::OutputSet* set = nullptr;
};

}  // namespace mesamis
