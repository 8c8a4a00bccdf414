// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "mesamis/run/outcome.h"
#include "mesamis/run/request.h"

namespace mesamis {

/// Does all that the program does between reading and writing: chooses the object, runs the method,
/// fills the objects with elements where that is asked for, and judges the result.
///
/// 1. choose_object(), or choose_in_place(): the image that shows the object alone;
/// 2. run_on_object(); with labels or several seeds run_on_labels() or surfaces_of_labels();
/// 3. make_elements();
/// 4. check_surface() and judge().
/// @param request   a scan of three axes, labels, or both.
/// @param listener  optional.
/// @throws InputError  as these functions, or if neither a scan nor labels are given, or what needs
///                     a scan is asked of labels alone.
/// @throws Cancelled   if progress says stop.
///
/// Time and memory are those of the steps. The same bits for any number of threads, but for a run
/// that had enough.
Outcome segment(Request request, const Listener& listener = {});

}  // namespace mesamis
