// SPDX-License-Identifier: Apache-2.0
#include "mesamis/page/page_assets.h"

#include "mesamis/base/embedded_file.h"

MESAMIS_EMBED(page_style, MESAMIS_PAGE_STYLE);
MESAMIS_EMBED(page_script, MESAMIS_PAGE_SCRIPT);
MESAMIS_EMBED(viewer_licence, MESAMIS_VIEWER_LICENCE);
#ifdef MESAMIS_VIEWER_SCRIPT
MESAMIS_EMBED(viewer_script, MESAMIS_VIEWER_SCRIPT);
#endif

namespace mesamis::detail {

std::string_view page_style() { return MESAMIS_EMBEDDED(page_style); }

std::string_view page_script() { return MESAMIS_EMBEDDED(page_script); }

std::string_view viewer_licence() { return MESAMIS_EMBEDDED(viewer_licence); }

std::string_view viewer_script() {
#ifdef MESAMIS_VIEWER_SCRIPT
  return MESAMIS_EMBEDDED(viewer_script);
#else
  return {};
#endif
}

}  // namespace mesamis::detail
