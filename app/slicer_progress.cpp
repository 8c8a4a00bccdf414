// SPDX-License-Identifier: Apache-2.0
#include "slicer_progress.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>

#include "mesamis/files/xml_text.h"

namespace mesamis {
namespace {

using namespace std::chrono_literals;

constexpr auto kBetween = 100ms;

std::string element(const char* name, const std::string& text) {
  return fmt::format("<{0}>{1}</{0}>", name, text);
}

}  // namespace

void tell_slicer(const std::string& line) {
  std::fputs((line + "\n").c_str(), stdout);
  std::fflush(stdout);
}

void tell_slicer_done() { tell_slicer(element("filter-progress", "1")); }

void SlicerProgress::show(std::string_view stage, double fraction, double done) {
  if (stage != stage_) {
    enter(stage);
    tell(0, done);
  }
  const auto now = Clock::now();
  if (fraction <= told_ || now - last_told_ < kBetween) return;
  last_told_ = now;
  tell(fraction, done);
}

void SlicerProgress::enter(std::string_view stage) {
  finish();
  stage_ = stage;
  start_ = last_told_ = Clock::now();
  const std::string name = xml_escaped(stage);
  tell_slicer("<filter-start>\n" + element("filter-name", name) + "\n" +
              element("filter-comment", name) + "\n</filter-start>");
}

void SlicerProgress::tell(double fraction, double done) {
  told_ = std::clamp(fraction, 0.0, 1.0);
  tell_slicer(element("filter-progress", fmt::format("{:.4f}", done)) + "\n" +
              element("filter-stage-progress", fmt::format("{:.4f}", told_)));
}

void SlicerProgress::finish() {
  if (stage_.empty()) return;
  const double seconds = std::chrono::duration<double>(Clock::now() - start_).count();
  tell_slicer("<filter-end>\n" + element("filter-name", xml_escaped(stage_)) + "\n" +
              element("filter-time", fmt::format("{:.3f}", seconds)) + "\n</filter-end>");
  stage_.clear();
}

}  // namespace mesamis
