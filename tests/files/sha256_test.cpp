// SPDX-License-Identifier: Apache-2.0
#include "mesamis/files/sha256.h"

#include <gtest/gtest.h>

#include "support/temp_folder.h"
#include "support/throws.h"

namespace mesamis {
namespace {

std::string sha256_of(const TempFolder& folder, const std::string& bytes) {
  write_bytes(folder / "file", bytes);
  return sha256(folder / "file");
}

/// The examples of FIPS 180-4 that NIST publishes.
TEST(Sha256, GivesThePublishedValues) {
  const TempFolder folder;
  EXPECT_EQ(sha256_of(folder, ""),
            "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855");
  EXPECT_EQ(sha256_of(folder, "abc"),
            "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
  EXPECT_EQ(sha256_of(folder, "abcdbcdecdefdefgefghfghighijhijkijkljklmklmnlmnomnopnopq"),
            "248d6a61d20638b8e5c026930c3e6039a33ce45964ff2167f6ecedd419db06c1");
  EXPECT_EQ(sha256_of(folder,
                      "abcdefghbcdefghicdefghijdefghijkefghijklfghijklmghijklmnhijklmno"
                      "ijklmnopjklmnopqklmnopqrlmnopqrsmnopqrstnopqrstu"),
            "cf5b16a778af8380036ce59e7b0492370b249b11e8f07a51afac45037afee9d1");
  EXPECT_EQ(
      sha256_of(folder, std::string(1'000'000, 'a')),  // many buffers, the last one partly filled
      "cdc76e5c9914fb9281a1c7e284d73e67f1809a48a497200e046d39ccc7112cd0");
}

TEST(Sha256, ADirectoryIsItsFilesOneAfterAnother) {
  const TempFolder folder;
  write_bytes(folder / "z", "c");
  write_bytes(folder / "b/second", "b");
  write_bytes(folder / "a", "a");
  const std::string whole = sha256(folder.path());
  EXPECT_EQ(whole, sha256_of(folder, "abc"));
}

TEST(Sha256, AFileOfOneBufferIsReadToItsEnd) {
  const std::string buffer(1 << 16, 'x');
  const TempFolder folder;
  write_bytes(folder / "a", buffer);
  write_bytes(folder / "b", "y");
  const std::string whole = sha256(folder.path());
  EXPECT_EQ(whole, sha256_of(folder, buffer + "y"));
}

TEST(Sha256, OfFilesThatWereReadIsThatOfThemOneAfterAnother) {
  const TempFolder folder;
  write_bytes(folder / "a", "ab");
  write_bytes(folder / "b", "c");
  const std::vector<ReadFile> files{{folder / "a", state_of(folder / "a")},
                                    {folder / "b", state_of(folder / "b")}};
  EXPECT_EQ(sha256(files), sha256_of(folder, "abc"));
}

TEST(Sha256, AFileThatHasChangedSinceItWasReadIsRefused) {
  const TempFolder folder;
  write_bytes(folder / "a", "ab");
  const std::vector<ReadFile> files{{folder / "a", state_of(folder / "a")}};
  write_bytes(folder / "new", "xy");  // as long, and perhaps in the same moment
  std::filesystem::rename(folder / "new", folder / "a");
  EXPECT_REFUSED(sha256(files), testing::HasSubstr("found it changed"));
}

TEST(Sha256, AMissingFileIsRefused) {
  const TempFolder folder;
  EXPECT_REFUSED(sha256(folder / "none"), testing::HasSubstr("none: cannot be read"));
}

}  // namespace
}  // namespace mesamis
