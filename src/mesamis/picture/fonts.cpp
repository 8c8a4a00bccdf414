// SPDX-License-Identifier: Apache-2.0
#include "mesamis/picture/fonts.h"

#include "mesamis/base/embedded_file.h"

MESAMIS_EMBED(font_regular, MESAMIS_FONT_REGULAR);
MESAMIS_EMBED(font_bold, MESAMIS_FONT_BOLD);

namespace mesamis::detail::picture {

std::string_view font_bytes(bool bold) noexcept {
  return bold ? MESAMIS_EMBEDDED(font_bold) : MESAMIS_EMBEDDED(font_regular);
}

}  // namespace mesamis::detail::picture
