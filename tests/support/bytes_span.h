// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>

namespace mesamis {

/// The bytes of a text, which must outlive the result.
inline std::span<const unsigned char> bytes_in(const std::string& text) {
  return {reinterpret_cast<const unsigned char*>(text.data()), text.size()};
}

}  // namespace mesamis
