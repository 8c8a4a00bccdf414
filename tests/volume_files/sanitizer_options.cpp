// SPDX-License-Identifier: Apache-2.0
// What the address sanitizer is told in the tests of the readers; without it nobody calls these.

// Freed memory that the sanitizer keeps back must not count as memory a reader uses.
extern "C" const char* __asan_default_options();
extern "C" const char* __asan_default_options() { return "quarantine_size_mb=16"; }

// GDCM's JPEG-LS decoder does not free its buffer when the data are broken; nothing of ours does
// the like, so this one alone is left out of the leak sanitizer's count.
extern "C" const char* __lsan_default_suppressions();
extern "C" const char* __lsan_default_suppressions() { return "leak:gdcm::JPEGLSCodec::Decode\n"; }
