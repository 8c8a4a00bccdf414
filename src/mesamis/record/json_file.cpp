// SPDX-License-Identifier: Apache-2.0
#include "mesamis/record/json_file.h"

#include <fstream>

#include "mesamis/base/error.h"
#include "mesamis/files/atomic_file.h"

namespace mesamis {

void write_json(const std::filesystem::path& path, const nlohmann::ordered_json& value) {
  write_file(path,
             value.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n");
}

nlohmann::json read_json(const std::filesystem::path& path) {
  std::ifstream in(path, std::ios::binary);
  if (!in || std::filesystem::is_directory(path)) {
    throw InputError(path.string() + ": cannot be opened");
  }
  try {
    return nlohmann::json::parse(in);
  } catch (const nlohmann::json::parse_error& error) {
    throw InputError(path.string() + ": expected JSON, found something else at byte " +
                     std::to_string(error.byte));
  } catch (const nlohmann::json::exception&) {
    throw InputError(path.string() +
                     ": expected JSON with numbers in range, found one that is not");
  }
}

nlohmann::ordered_json vec_json(const Vec3& v) { return {v.x, v.y, v.z}; }

}  // namespace mesamis
