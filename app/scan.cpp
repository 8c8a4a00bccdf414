// SPDX-License-Identifier: Apache-2.0
#include "scan.h"

#include "log.h"
#include "mesamis/base/error.h"

namespace mesamis {

VolumeFile read_scan(const std::filesystem::path& path, const std::string& series) {
  VolumeFile file = read_volume(path, {series});
  for (const std::string& warning : file.warnings) log_warning(warning);
  try {
    require_usable(file.volume);
  } catch (const InputError& error) {
    throw InputError(path.string() + ": " + error.what());
  }
  return file;
}

}  // namespace mesamis
