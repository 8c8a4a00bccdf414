// SPDX-License-Identifier: Apache-2.0
#include "mesamis/report/json_file.h"

#include <fstream>
#include <functional>
#include <nlohmann/json.hpp>
#include <set>
#include <string>
#include <vector>

#include "mesamis/files/atomic_file.h"
#include "mesamis/files/file_list.h"
#include "mesamis/files/refuse.h"

namespace mesamis::detail::report {
namespace {

using nlohmann::json;

/// Watches a parser: nothing is nested deeply, as much of what is done with a value goes down with
/// it, and no object has a key twice, of which the parser would take the last.
class Strictness {
 public:
  explicit Strictness(const std::filesystem::path& path) : path_(path) {}

  bool operator()(int depth, json::parse_event_t event, const json& value) {
    constexpr int kDeepest = 64;
    if (depth > kDeepest) refuse("at most 64 levels of lists and objects");
    if (event == json::parse_event_t::object_start) keys_.emplace_back();
    if (event == json::parse_event_t::object_end) keys_.pop_back();
    if (event == json::parse_event_t::key &&
        !keys_.back().insert(value.get<std::string>()).second) {
      refuse("each key once", value.dump() + " twice");
    }
    return true;
  }

 private:
  [[noreturn]] void refuse(const std::string& expected, const std::string& found = "more") const {
    files::refuse(path_, "expected JSON with " + expected + ", found " + found);
  }

  std::filesystem::path path_;
  std::vector<std::set<std::string>> keys_;  // of the objects that are open
};

}  // namespace

void write_json(const OutputPath& path, const nlohmann::ordered_json& value) {
  write_file(path,
             value.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n");
}

nlohmann::json read_json(const std::filesystem::path& path) {
  require_file(path);
  std::ifstream in(path, std::ios::binary);
  try {
    Strictness strictness(path);
    return nlohmann::json::parse(in, std::ref(strictness));
  } catch (const nlohmann::json::parse_error& error) {
    refuse(path, "expected JSON, found something else at byte " + std::to_string(error.byte));
  } catch (const nlohmann::json::exception&) {
    refuse(path, "expected JSON with numbers in range, found one out of range");
  }
}

nlohmann::ordered_json vec_json(const Vec3& v) { return {v.x, v.y, v.z}; }

}  // namespace mesamis::detail::report
