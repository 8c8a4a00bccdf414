// SPDX-License-Identifier: Apache-2.0
// What the leak sanitizer is told in the tests of surfaces; without it nobody calls this.

// lib3mf does not close the files it opens in a ZIP archive. Nothing of ours calls libzip, so that
// leaving it out hides no leak of ours.
extern "C" const char* __lsan_default_suppressions();
extern "C" const char* __lsan_default_suppressions() { return "leak:libzip.so\nleak:lib3MF.so\n"; }
