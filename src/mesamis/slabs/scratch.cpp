// SPDX-License-Identifier: Apache-2.0
#include "mesamis/slabs/scratch.h"

#include <unistd.h>

#include <fstream>
#include <system_error>
#include <utility>

#include "mesamis/base/error.h"

namespace mesamis::detail::slabs {

namespace fs = std::filesystem;

namespace {

[[noreturn]] void refuse(const fs::path& path, const std::string& what) {
  throw InputError(path.string() + ": " + what);
}

}  // namespace

Scratch::Scratch(const fs::path& folder) : folder_(folder / "mesamis-slabs") {
  std::error_code error;
  fs::create_directories(folder_, error);
  if (!fs::is_directory(folder_)) {
    refuse(folder_, "expected a folder for scratch files, or a place for one" +
                        (error ? ", found: " + error.message() : std::string()));
  }
}

bool Scratch::has(const std::string& name) const { return fs::exists(path(name)); }

void Scratch::write(const std::string& name, const ArchiveWriter& archive) const {
  const fs::path target = path(name);
  const fs::path unfinished = path(name + ".unfinished" + std::to_string(::getpid()));
  std::ofstream out(unfinished, std::ios::binary);
  const std::string_view bytes = archive.bytes();
  out.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  out.close();
  std::error_code error;
  if (out) fs::rename(unfinished, target, error);
  if (out && !error) return;
  fs::remove(unfinished, error);
  refuse(target,
         "expected room for " + std::to_string(bytes.size()) + " bytes of scratch, found none");
}

ArchiveReader Scratch::read(const std::string& name) const {
  const fs::path file = path(name);
  std::ifstream in(file, std::ios::binary | std::ios::ate);
  if (!in) refuse(file, "expected a scratch file of this run, found none");
  const auto size = static_cast<std::streamoff>(in.tellg());
  if (size < 0 || fs::is_directory(file)) refuse(file, "the scratch file cannot be read");
  std::string bytes(static_cast<std::size_t>(size), '\0');
  in.seekg(0);
  in.read(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  if (!in) refuse(file, "the scratch file cannot be read");
  return {std::move(bytes), file};
}

void Scratch::remove(const std::string& name) const {
  std::error_code error;
  fs::remove(path(name), error);
}

void Scratch::clear() const {
  std::error_code error;
  fs::remove_all(folder_, error);
  fs::remove(folder_.parent_path(), error);
}

}  // namespace mesamis::detail::slabs
