// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>

#include "mesamis/rooms.h"

/// Makes the bytes of a file part of a program: MESAMIS_EMBED(name, "path"), outside namespaces,
/// once per name; MESAMIS_EMBEDDED(name) is then a std::string_view of them. A zero follows.
///
/// The assembler takes the bytes as they are: no compiler has to read megabytes of numbers.
#define MESAMIS_EMBED(name, file)                               \
  asm(".section .rodata, \"a\", @progbits\n"                    \
      ".global mesamis_" #name "_begin\n.global mesamis_" #name \
      "_end\n"                                                  \
      ".balign 16\nmesamis_" #name "_begin:\n.incbin \"" file   \
      "\"\n"                                                    \
      "mesamis_" #name "_end:\n.byte 0\n.previous\n");          \
  extern "C" const char mesamis_##name##_begin[];               \
  extern "C" const char mesamis_##name##_end[]

#define MESAMIS_EMBEDDED(name) \
  std::string_view(mesamis_##name##_begin, mesamis_##name##_end - mesamis_##name##_begin)
