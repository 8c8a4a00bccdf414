// SPDX-License-Identifier: Apache-2.0
#include "mesamis/printing/temporary_folder.h"

#include <stdlib.h>

#include <cerrno>
#include <system_error>

#include "mesamis/base/error.h"

namespace mesamis {

TemporaryFolder::TemporaryFolder(const std::string& purpose) {
  std::error_code error;
  const std::filesystem::path place = std::filesystem::temp_directory_path(error);
  if (error) {
    throw InputError("TMPDIR: expected a folder for temporary files: " + error.message());
  }
  std::string name = (place / ("mesamis-" + purpose + "-XXXXXX")).string();
  if (!mkdtemp(name.data())) {
    throw InputError(place.string() + ": no folder for temporary files can be made there: " +
                     std::generic_category().message(errno));
  }
  path_ = name;
}

TemporaryFolder::~TemporaryFolder() {
  std::error_code ignored;
  std::filesystem::remove_all(path_, ignored);
}

}  // namespace mesamis
