// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <exception>
#include <filesystem>
#include <new>
#include <string>
#include <string_view>

#include "mesamis/base/error.h"
#include "mesamis/files/file_list.h"
#include "mesamis/files/refuse.h"

namespace mesamis::detail::files {

/// Runs the work of a reader on a path that is there. Every failure becomes an InputError of one
/// line that begins with the path and names the broken file, where that is another one.
/// @return what the work returns.
template <class Work>
auto in_one_line(const std::filesystem::path& path, Work&& work) {
  try {
    require_there(path);
    return work();
  } catch (const InputError& error) {
    if (std::string_view(error.what()).starts_with(path.string())) throw;
    refuse(path, error.what());
  } catch (const std::bad_alloc&) {
    refuse(path, "not enough memory to read it");
  } catch (const std::exception& error) {
    refuse(path, std::string("cannot be read: ") + error.what());
  }
}

}  // namespace mesamis::detail::files
