// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "mesamis/files/memory_budget.h"

namespace mesamis::detail::files {

/// Reads a file of JSON: at most 64 MiB, at most 64 levels.
/// @throws InputError  naming the file.
///
/// Linear in the bytes. What the values take is claimed while they are read, and then given back.
nlohmann::json read_metadata(const std::filesystem::path& file, MemoryBudget& budget);

/// A value in a file of JSON, which refuses what it is not. It belongs to the document, which must
/// live as long.
class JsonValue {
 public:
  JsonValue(const std::filesystem::path& file, const nlohmann::json& value, std::string where = {})
      : file_(&file), value_(&value), where_(std::move(where)) {}

  bool has(const char* key) const { return value_->is_object() && value_->contains(key); }
  /// A member. @throws InputError  if there is none.
  JsonValue at(const char* key) const;
  /// A member; none if it is absent or null.
  std::optional<JsonValue> find(const char* key) const;
  /// @throws InputError  if it is no list.
  std::vector<JsonValue> list() const;
  /// @throws InputError  if it is no list of whole numbers that are not negative.
  std::vector<std::uint64_t> counts() const;
  /// @throws InputError  if it is no list of numbers.
  std::vector<double> numbers() const;
  /// @throws InputError  if it is no whole number that is not negative.
  std::uint64_t count() const;
  /// @throws InputError  if it is no number.
  double number() const;
  /// @throws InputError  if it is no string.
  std::string text() const;
  /// @throws InputError  if it is neither true nor false.
  bool truth() const;

  bool is_text() const { return value_->is_string(); }
  bool is_truth() const { return value_->is_boolean(); }
  bool is_null() const { return value_->is_null(); }
  const std::filesystem::path& file() const { return *file_; }

  /// @throws InputError  "FILE: WHERE: expected EXPECTED, found ...".
  [[noreturn]] void refuse_as(std::string_view expected) const;

 private:
  const std::filesystem::path* file_;
  const nlohmann::json* value_;
  std::string where_;
};

}  // namespace mesamis::detail::files
