// SPDX-License-Identifier: Apache-2.0
#include "mesamis/page/page_assets.h"

#include "mesamis/base/embedded_file.h"

MESAMIS_EMBED(page_style, MESAMIS_PAGE_STYLE);
MESAMIS_EMBED(page_script, MESAMIS_PAGE_SCRIPT);

namespace mesamis::detail::page {

std::string_view page_style() { return MESAMIS_EMBEDDED(page_style); }

std::string_view page_script() { return MESAMIS_EMBEDDED(page_script); }

}  // namespace mesamis::detail::page
