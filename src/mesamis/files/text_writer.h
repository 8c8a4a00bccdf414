// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <charconv>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>
#include <type_traits>

#include "mesamis/files/atomic_file.h"
#include "mesamis/files/refuse.h"

namespace mesamis::detail::files {

/// Appends the shortest decimals that read back as the same double; never "-0".
inline void append_shortest(std::string& out, double value) {
  char text[32];
  out.append(text, std::to_chars(text, text + sizeof text, value + 0.0).ptr);
}

/// Writes a text file in pieces of 1 MiB; the file appears with commit(), or not at all.
class TextWriter {
 public:
  /// @throws InputError  as AtomicFile.
  explicit TextWriter(const OutputPath& path)
      : name_(path.string()), file_(path), out_(file_.temporary_path(), std::ios::binary) {}

  TextWriter& operator<<(std::string_view text) {
    text_ += text;
    if (text_.size() >= kPiece) flush();
    return *this;
  }
  template <class Number>
  requires std::is_arithmetic_v<Number> TextWriter& operator<<(Number value) {
    char digits[32];  // the shortest decimals that read back to the same bits
    return *this << std::string_view(digits, std::to_chars(digits, digits + 32, value).ptr);
  }
  /// Writes the shortest decimals that read back to the same bits.
  /// @throws InputError  if the value is not finite.
  void number(double value) {
    require_finite(value);
    *this << value;
  }
  /// Writes at most `significant` digits.
  /// @throws InputError  if the value is not finite.
  void number(double value, int significant) {
    require_finite(value);
    char digits[64];
    const auto end =
        std::to_chars(digits, digits + 64, value, std::chars_format::general, significant);
    *this << std::string_view(digits, end.ptr);
  }
  /// @throws InputError  if the file cannot be written.
  void commit() {
    flush();
    out_.close();
    if (!out_) refuse(name_, "cannot be written");
    file_.commit();
  }

 private:
  static constexpr std::size_t kPiece = 1 << 20;
  void require_finite(double value) const {
    if (!std::isfinite(value)) refuse(name_, "a value to write is not finite");
  }
  void flush() {
    out_.write(text_.data(), static_cast<std::streamsize>(text_.size()));
    text_.clear();
  }
  std::string name_;
  AtomicFile file_;
  std::ofstream out_;
  std::string text_;
};

}  // namespace mesamis::detail::files
