// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "mesamis/method/setting_table.h"

namespace mesamis {

/// The rows of setting_table(), built.
std::vector<Setting> build_setting_rows();

}  // namespace mesamis
