// SPDX-License-Identifier: Apache-2.0
#include "mesamis/volume_files/sidecar.h"

#include <system_error>

#include "mesamis/base/error.h"
#include "mesamis/files/json_value.h"
#include "mesamis/files/read_record.h"
#include "mesamis/files/refuse.h"

namespace mesamis::detail::volume_files {
namespace {

namespace fs = std::filesystem;

/// "a.json" for "a.nii", "a.nii.gz", "a.nrrd" and so on.
fs::path sidecar_of(fs::path image) {
  if (lower_extension(image) == ".gz") image.replace_extension();
  return image.replace_extension(".json");
}

}  // namespace

std::string modality_in_sidecar(const fs::path& image, MemoryBudget& budget,
                                std::vector<std::string>& warnings) {
  const fs::path file = sidecar_of(image);
  std::error_code ignored;
  if (!fs::is_regular_file(file, ignored)) return "";
  const ReadRecord apart;  // the sum of an image is that of its own file
  try {
    const auto json = read_metadata(file, budget);
    const auto modality = JsonValue(file, json).find("Modality");
    return modality ? upper(shown(modality->text())) : "";
  } catch (const InputError& error) {
    warnings.push_back(message("the sidecar does not count: ", error.what()));
    return "";
  }
}

}  // namespace mesamis::detail::volume_files
