// SPDX-License-Identifier: Apache-2.0
// The graphics driver leaks and is unloaded before leaks are counted, so that they cannot be named
// and left out; the address sanitizer counts none in the tests of pictures.
extern "C" const char* __asan_default_options();
extern "C" const char* __asan_default_options() { return "detect_leaks=0"; }
