// SPDX-License-Identifier: Apache-2.0
#include "mesamis/page/page_assets.h"

// The assembler takes the bytes of a file as they are: no compiler has to read megabytes of
// numbers.
#define MESAMIS_EMBED(name, file)                               \
  asm(".section .rodata, \"a\", @progbits\n"                    \
      ".global mesamis_" #name "_begin\n.global mesamis_" #name \
      "_end\n"                                                  \
      ".balign 16\nmesamis_" #name "_begin:\n.incbin \"" file   \
      "\"\n"                                                    \
      "mesamis_" #name "_end:\n.byte 0\n.previous\n");          \
  extern "C" const char mesamis_##name##_begin[];               \
  extern "C" const char mesamis_##name##_end[]

MESAMIS_EMBED(page_style, MESAMIS_PAGE_STYLE);
MESAMIS_EMBED(page_script, MESAMIS_PAGE_SCRIPT);
MESAMIS_EMBED(viewer_licence, MESAMIS_VIEWER_LICENCE);
#ifdef MESAMIS_VIEWER_SCRIPT
MESAMIS_EMBED(viewer_script, MESAMIS_VIEWER_SCRIPT);
#endif

namespace mesamis::detail {
namespace {

std::string_view between(const char* begin, const char* end) {
  return {begin, static_cast<std::size_t>(end - begin)};
}

}  // namespace

std::string_view page_style() { return between(mesamis_page_style_begin, mesamis_page_style_end); }

std::string_view page_script() {
  return between(mesamis_page_script_begin, mesamis_page_script_end);
}

std::string_view viewer_licence() {
  return between(mesamis_viewer_licence_begin, mesamis_viewer_licence_end);
}

std::string_view viewer_script() {
#ifdef MESAMIS_VIEWER_SCRIPT
  return between(mesamis_viewer_script_begin, mesamis_viewer_script_end);
#else
  return {};
#endif
}

}  // namespace mesamis::detail
