// SPDX-License-Identifier: Apache-2.0
#include "mesamis/files/json_value.h"

#include <nlohmann/json.hpp>

#include "mesamis/files/byte_source.h"
#include "mesamis/files/file_list.h"
#include "mesamis/files/refuse.h"

namespace mesamis::detail::files {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

std::string metadata_text(const fs::path& file, MemoryBudget& budget) {
  constexpr std::uint64_t kMostBytes = std::uint64_t{64} << 20;
  ByteSource source(file, Packing::kPlain);
  const std::uint64_t size = source.most_bytes();
  if (size > kMostBytes) {
    refuse(file, message("expected metadata of at most 64 MiB, found ", size, " bytes"));
  }
  budget.claim(size, 1, "metadata");
  std::string text(size, '\0');
  text.resize(source.read(text.data(), size));
  return text;
}

}  // namespace

json read_metadata(const fs::path& file, MemoryBudget& budget) {
  constexpr int kDeepest = 64;
  constexpr std::uint64_t kMostPerByte = 64;  // "{}," becomes a value and its map
  require_file(file);
  const ScopedFile scope(budget, file);
  const std::string text = metadata_text(file, budget);
  budget.claim(text.size(), kMostPerByte, "metadata");
  const auto watch = [&](int depth, json::parse_event_t, const json&) {
    if (depth > kDeepest) {
      refuse(file, message("expected JSON of at most ", kDeepest, " levels, found more"));
    }
    return true;
  };
  try {
    return json::parse(text, watch);
  } catch (const json::parse_error& error) {
    refuse(file, message("expected JSON, found something else at byte ", error.byte));
  } catch (const json::exception&) {
    refuse(file, "expected JSON with numbers in range, found one out of range");
  }
}

void JsonValue::refuse_as(std::string_view expected) const {
  constexpr std::size_t kLongest = 60;
  std::string found = value_->is_array() ? message("a list of ", value_->size())
                      : value_->is_object()
                          ? message("an object of ", value_->size())
                          : value_->dump(-1, ' ', true, json::error_handler_t::replace);
  if (found.size() > kLongest) found = found.substr(0, kLongest) + "...";
  refuse(*file_, message(where_.empty() ? std::string("JSON") : shown(where_), ": expected ",
                         expected, ", found ", found));
}

JsonValue JsonValue::at(const char* key) const {
  if (!has(key)) refuse_as(message("an object with ", in_quotes(key)));
  return {*file_, (*value_)[key], where_.empty() ? key : where_ + "." + key};
}

std::optional<JsonValue> JsonValue::find(const char* key) const {
  if (!has(key) || (*value_)[key].is_null()) return {};
  return at(key);
}

std::vector<JsonValue> JsonValue::list() const {
  if (!value_->is_array()) refuse_as("a list");
  std::vector<JsonValue> values;
  for (const json& value : *value_) values.emplace_back(*file_, value, where_ + "[]");
  return values;
}

std::vector<std::uint64_t> JsonValue::counts() const {
  std::vector<std::uint64_t> values;
  for (const JsonValue& value : list()) values.push_back(value.count());
  return values;
}

std::vector<double> JsonValue::numbers() const {
  std::vector<double> values;
  for (const JsonValue& value : list()) values.push_back(value.number());
  return values;
}

std::uint64_t JsonValue::count() const {
  if (!value_->is_number_unsigned()) refuse_as("a whole number that is not negative");
  return value_->get<std::uint64_t>();
}

double JsonValue::number() const {
  if (!value_->is_number()) refuse_as("a number");
  return value_->get<double>();
}

bool JsonValue::truth() const {
  if (!value_->is_boolean()) refuse_as("true or false");
  return value_->get<bool>();
}

std::string JsonValue::text() const {
  if (!value_->is_string()) refuse_as("a string");
  return value_->get<std::string>();
}

}  // namespace mesamis::detail::files
