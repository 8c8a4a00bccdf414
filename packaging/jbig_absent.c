// SPDX-License-Identifier: Apache-2.0
// Stands where libtiff expects libjbig, which is under the GPL and is not in the tar. A TIFF with JBIG
// compression, a codec for fax pages, is refused as damaged; no scan has it.
#include <stddef.h>

enum { kEndOfInput = 32 };  // any status but 0 (done): nothing was decoded

void jbg_dec_init(void* state) { (void)state; }
void jbg_dec_free(void* state) { (void)state; }
int jbg_dec_in(void* state, unsigned char* data, size_t size, size_t* used) {
  (void)state, (void)data, (void)size;
  if (used != NULL) *used = 0;
  return kEndOfInput;
}
unsigned char* jbg_dec_getimage(const void* state, int plane) {
  (void)state, (void)plane;
  return NULL;
}
unsigned long jbg_dec_getsize(const void* state) {
  (void)state;
  return 0;
}
const char* jbg_strerror(int status) {
  (void)status;
  return "JBIG compression is not supported";
}
int jbg_newlen(unsigned char* data, size_t size) {
  (void)data, (void)size;
  return kEndOfInput;
}
void jbg_enc_init(void* state, unsigned long width, unsigned long height, int planes,
                  unsigned char** bits, void* put, void* file) {
  (void)state, (void)width, (void)height, (void)planes, (void)bits, (void)put, (void)file;
}
void jbg_enc_out(void* state) { (void)state; }
void jbg_enc_free(void* state) { (void)state; }
