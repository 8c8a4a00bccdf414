// SPDX-License-Identifier: Apache-2.0
#include "mesamis/volume_files/rounding_record.h"

#include <algorithm>
#include <sstream>

#include "mesamis/files/refuse.h"

namespace mesamis::detail::volume_files {
namespace {

/// Of the range of the samples: what most scanners resolve.
constexpr Exact kShareThatMatters = Exact{1} / 4096;

thread_local RoundingRecord* innermost = nullptr;

/// With all digits of whole numbers of 64 bits.
std::string exact_text(Exact value) {
  constexpr int kDigits = 20;
  std::ostringstream text;
  text.precision(std::abs(value) < Exact{1e19} ? kDigits : 6);
  text << value;
  return text.str();
}

std::string short_text(Exact value) {
  std::ostringstream text;
  text.precision(12);
  text << value;
  return text.str();
}

/// From the sample that is farthest from 0, in single precision, to the next number beyond it.
Exact step_at(const RoundedSamples& samples) {
  const auto far =
      static_cast<float>(std::max(std::abs(samples.least), std::abs(samples.greatest)));
  return Exact{std::nextafter(far, std::numeric_limits<float>::infinity())} - Exact{far};
}

std::string range_and_step(const RoundedSamples& samples) {
  return message("samples from ", exact_text(samples.least_but_0), " to ",
                 exact_text(samples.greatest_but_0), ", which single precision rounds to steps of ",
                 short_text(step_at(samples)), ": subtract an offset from them first");
}

}  // namespace

void RoundedSamples::note(Exact exact, float rounded) noexcept {
  if (!std::isfinite(exact)) return;
  if (!std::isfinite(rounded)) beyond = exact;
  least = std::min(least, exact);
  greatest = std::max(greatest, exact);
  if (exact != 0) {
    least_but_0 = std::min(least_but_0, exact);
    greatest_but_0 = std::max(greatest_but_0, exact);
  }
  error = std::max(error, std::abs(exact - Exact{rounded}));
  if (empty) value = rounded;
  same_value = same_value && value == rounded;
  empty = false;
}

void RoundedSamples::note(const RoundedSamples& others) noexcept {
  if (others.empty) return;
  same_value = others.same_value && same_value && (empty || value == others.value);
  value = others.value;
  least = std::min(least, others.least);
  greatest = std::max(greatest, others.greatest);
  least_but_0 = std::min(least_but_0, others.least_but_0);
  greatest_but_0 = std::max(greatest_but_0, others.greatest_but_0);
  error = std::max(error, others.error);
  if (others.beyond != 0) beyond = others.beyond;
  empty = false;
}

RoundingRecord::RoundingRecord() : outer_(innermost) { innermost = this; }

RoundingRecord::~RoundingRecord() { innermost = outer_; }

void RoundingRecord::warn(const std::filesystem::path& file,
                          std::vector<std::string>& warnings) const {
  if (noted_.beyond != 0) {
    refuse(file, message("expected samples within single precision, which ends at 3.4e+38, found ",
                         short_text(noted_.beyond)));
  }
  if (noted_.same_value && noted_.least < noted_.greatest) {
    refuse(file, message("expected samples that differ in single precision, found ",
                         range_and_step(noted_)));
  }
  const Exact range = noted_.greatest_but_0 - noted_.least_but_0;
  if (!(range > 0) || noted_.error <= kShareThatMatters * range) return;
  warnings.push_back(range_and_step(noted_));
}

void note_rounded(const RoundedSamples& samples) {
  if (innermost != nullptr) innermost->noted_.note(samples);
}

}  // namespace mesamis::detail::volume_files
