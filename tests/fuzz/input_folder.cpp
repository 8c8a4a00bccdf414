// SPDX-License-Identifier: Apache-2.0
#include "input_folder.h"

#include <signal.h>
#include <unistd.h>

#include <cerrno>
#include <charconv>
#include <fstream>
#include <string>

#include "fuzz_target.h"

namespace mesamis {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kPrefix = "mesamis_fuzz_";

fs::path memory_folder() {
  const fs::path shared = "/dev/shm";
  return access(shared.c_str(), W_OK) == 0 ? shared : fs::temp_directory_path();
}

bool is_abandoned(const std::string& name) {
  if (!name.starts_with(kPrefix)) return false;
  pid_t process = 0;
  const char* end = name.data() + name.size();
  const auto [stop, error] = std::from_chars(name.data() + kPrefix.size(), end, process);
  return error == std::errc() && stop == end && kill(process, 0) != 0 && errno == ESRCH;
}

void remove_abandoned(const fs::path& above) {
  std::error_code ignored;
  for (const auto& entry : fs::directory_iterator(above, ignored)) {
    if (is_abandoned(entry.path().filename().string())) fs::remove_all(entry.path(), ignored);
  }
}

}  // namespace

InputFolder::InputFolder()
    : path_(memory_folder() / (std::string(kPrefix) + std::to_string(getpid()))) {
  remove_abandoned(path_.parent_path());
  fs::create_directory(path_);
}

InputFolder::~InputFolder() {
  std::error_code ignored;
  fs::remove_all(path_, ignored);
}

fs::path InputFolder::write(const char* name, std::string_view bytes) const {
  fs::path file = path_ / name;
  std::ofstream out(file, std::ios::binary | std::ios::trunc);
  out.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  out.close();
  require_law(!out.fail(), "the input cannot be written");
  return file;
}

const InputFolder& input_folder() {
  static const InputFolder folder;
  return folder;
}

}  // namespace mesamis
