// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>

/// Files that are part of the program: the page's style and script, and the viewer of scans.
namespace mesamis::detail {

std::string_view page_style();
std::string_view page_script();
/// The viewer, NiiVue, as a script; empty where it is not part of this build.
std::string_view viewer_script();
/// Its licence, which goes with it.
std::string_view viewer_licence();

}  // namespace mesamis::detail
