// SPDX-License-Identifier: Apache-2.0
#include "fuzz_target.h"

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <filesystem>

namespace mesamis {
namespace {

const FuzzTarget* chosen = nullptr;

/// Code points of RFC 3629, decoded one by one: not the code that is tested.
bool is_utf8(std::string_view text) {
  for (std::size_t i = 0; i < text.size();) {
    const auto first = static_cast<unsigned char>(text[i++]);
    const int more = first < 0x80           ? 0
                     : (first >> 5) == 0x06 ? 1
                     : (first >> 4) == 0x0e ? 2
                     : (first >> 3) == 0x1e ? 3
                                            : -1;
    if (more < 0) return false;
    std::uint32_t code = more == 0 ? first : first & (0x3fu >> more);
    for (int n = 0; n < more; ++n) {
      if (i == text.size() || (text[i] & 0xc0) != 0x80) return false;
      code = code << 6 | (static_cast<unsigned char>(text[i++]) & 0x3fu);
    }
    constexpr std::uint32_t kLeast[] = {0, 0x80, 0x800, 0x10000};
    if (code < kLeast[more] || code > 0x10ffff || (code >= 0xd800 && code < 0xe000)) return false;
  }
  return true;
}

void list_targets() {
  for (const FuzzTarget& target : fuzz_targets()) std::printf("fuzz_%s\n", target.name.data());
}

/// Quotes and backslashes do not occur in the words.
void print_dictionary() {
  for (const std::string& word : fuzz_words()) std::printf("\"%s\"\n", word.c_str());
}

const FuzzTarget* find_target(std::string_view program) {
  if (!program.starts_with("fuzz_")) return nullptr;
  for (const FuzzTarget& target : fuzz_targets()) {
    if (target.name == program.substr(5)) return &target;
  }
  return nullptr;
}

}  // namespace

void require_law(bool holds, std::string_view message) {
  if (holds) return;
  std::fprintf(stderr, "fuzz: error: %.*s\n", static_cast<int>(message.size()), message.data());
  std::abort();
}

void require_one_line(std::string_view message, std::size_t longest) {
  const std::string shown = std::string(message);
  const bool control = std::any_of(message.begin(), message.end(), [](char c) {
    return static_cast<unsigned char>(c) < 32 || c == 127;
  });
  require_law(!control, "a message of several lines: " + shown);
  require_law(is_utf8(message), "a message that is no UTF-8: " + shown);
  require_law(message.size() <= longest, "a message that is too long: " + shown);
}

}  // namespace mesamis

extern "C" int LLVMFuzzerInitialize(int* count, char*** arguments);
extern "C" int LLVMFuzzerInitialize(int* count, char*** arguments) {
  using namespace mesamis;
  const std::string_view first = *count > 1 ? (*arguments)[1] : "";
  if (first == "--list" || first == "--dictionary") {
    first == "--list" ? list_targets() : print_dictionary();
    std::exit(0);
  }
  const std::string program = std::filesystem::path((*arguments)[0]).filename().string();
  chosen = find_target(program);
  if (chosen) return 0;
  std::fprintf(stderr, "fuzz: error: expected the name of a target, found %s; there are:\n",
               program.c_str());
  list_targets();
  std::exit(2);
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  mesamis::chosen->run({reinterpret_cast<const char*>(data), size});
  return 0;
}

// GDCM's JPEG-LS decoder does not free its buffer when the data are broken.
extern "C" const char* __lsan_default_suppressions();
extern "C" const char* __lsan_default_suppressions() { return "leak:gdcm::JPEGLSCodec::Decode\n"; }
