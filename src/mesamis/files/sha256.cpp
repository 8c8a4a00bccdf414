// SPDX-License-Identifier: Apache-2.0
#include "mesamis/files/sha256.h"

#include <openssl/evp.h>

#include <array>
#include <memory>
#include <vector>

#include "mesamis/base/error.h"
#include "mesamis/files/byte_source.h"
#include "mesamis/files/file_list.h"

namespace mesamis::detail::files {
namespace {

/// SHA-256 (FIPS 180-4) by libcrypto, which uses the processor's own instructions for it.
class Sha256 {
 public:
  Sha256() : context_(EVP_MD_CTX_new()) {
    require(context_ != nullptr && EVP_DigestInit_ex(context_.get(), EVP_sha256(), nullptr) == 1);
  }

  void add_file(const std::filesystem::path& file) {
    ByteSource source(file, Packing::kPlain);
    std::vector<unsigned char> buffer(1 << 16);
    for (std::size_t got = buffer.size(); got == buffer.size();) {
      got = source.read(buffer.data(), buffer.size());
      require(EVP_DigestUpdate(context_.get(), buffer.data(), got) == 1);
    }
  }

  std::string hex() {
    std::array<unsigned char, 32> digest{};
    require(EVP_DigestFinal_ex(context_.get(), digest.data(), nullptr) == 1);
    std::string out;
    for (const unsigned char byte : digest) {
      out += "0123456789abcdef"[byte >> 4];
      out += "0123456789abcdef"[byte & 15];
    }
    return out;
  }

 private:
  struct FreeContext {
    void operator()(EVP_MD_CTX* context) const { EVP_MD_CTX_free(context); }
  };

  static void require(bool done) {
    if (!done) throw NumericalError("SHA-256: libcrypto could not compute it");
  }

  std::unique_ptr<EVP_MD_CTX, FreeContext> context_;
};

}  // namespace

std::string sha256(const std::filesystem::path& path) {
  Sha256 hash;
  std::error_code ignored;
  if (std::filesystem::is_directory(path, ignored)) {
    for (const auto& file : files_below(path)) hash.add_file(file);
  } else {
    hash.add_file(path);
  }
  return hash.hex();
}

std::string sha256(const std::vector<ReadFile>& files) {
  Sha256 hash;
  for (const ReadFile& file : files) {
    hash.add_file(file.path);
    require_unchanged(file);  // afterwards: what was added is what was read
  }
  return hash.hex();
}

}  // namespace mesamis::detail::files
