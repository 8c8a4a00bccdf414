// SPDX-License-Identifier: Apache-2.0
// GDCM's JPEG-LS decoder does not free its buffer when the data are broken; nothing of ours does
// the like, so this one alone is left out of the leak sanitizer's count.
extern "C" const char* __lsan_default_suppressions();
extern "C" const char* __lsan_default_suppressions() { return "leak:gdcm::JPEGLSCodec::Decode\n"; }
