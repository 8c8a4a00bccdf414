// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>
#include <vector>

#include "mesamis/method/setting_table.h"

namespace mesamis::detail::method {

/// The rows of setting_table(), built.
std::vector<Setting> build_setting_rows();

/// Whether the value is this word, and no number.
bool is_word(const SettingValue& value, std::string_view word);

}  // namespace mesamis::detail::method
