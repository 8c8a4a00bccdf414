// SPDX-License-Identifier: Apache-2.0
// Stands where libhdf5 expects libcurl, which would bring thirty libraries for files on the network.
// No file is read from there: whoever asks is told that it failed.
#include <stddef.h>

enum { kFailed = 2 };  // CURLE_FAILED_INIT

int curl_global_init(long flags) {
  (void)flags;
  return kFailed;
}
void curl_global_cleanup(void) {}
void* curl_easy_init(void) { return NULL; }
void curl_easy_cleanup(void* handle) { (void)handle; }
int curl_easy_perform(void* handle) {
  (void)handle;
  return kFailed;
}
int curl_easy_setopt(void* handle, int option, ...) {
  (void)handle, (void)option;
  return kFailed;
}
void* curl_slist_append(void* list, const char* text) {
  (void)list, (void)text;
  return NULL;
}
void curl_slist_free_all(void* list) { (void)list; }
