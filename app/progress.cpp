// SPDX-License-Identifier: Apache-2.0
#include "progress.h"

#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <utility>

#include "log.h"

namespace mesamis {
namespace {

using namespace std::chrono_literals;

constexpr auto kBetweenBars = 100ms;
constexpr auto kBetweenJson = 500ms;
constexpr auto kBetweenLines = 2s;
constexpr double kSecondsBeforeEstimate = 1, kLeastForEstimate = 0.01;

int terminal_columns() {
  winsize size{};
  const bool known = ioctl(STDERR_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 0;
  return known ? size.ws_col : 80;
}

/// "1:05:09" or "5:09"
std::string clock_text(double seconds) {
  const long whole = std::lround(seconds);
  char text[32];
  if (whole >= 3600) {
    std::snprintf(text, sizeof text, "%ld:%02ld:%02ld", whole / 3600, whole / 60 % 60, whole % 60);
  } else {
    std::snprintf(text, sizeof text, "%ld:%02ld", whole / 60, whole % 60);
  }
  return text;
}

/// " 42 %"
std::string percent_text(double share) {
  char text[16];
  std::snprintf(text, sizeof text, "%3.0f %%", 100 * share);
  return text;
}

}  // namespace

ProgressDisplay::ProgressDisplay(bool quiet, std::vector<StageShare> stages)
    : quiet_(quiet), run_(std::move(stages)), start_(Clock::now()) {}

Progress ProgressDisplay::callback() {
  return [this](std::string_view stage, double fraction) {
    if (!quiet_) show(stage, std::isfinite(fraction) ? std::clamp(fraction, 0.0, 1.0) : 0);
    return true;
  };
}

void ProgressDisplay::begin(std::string_view stage) {
  if (quiet_) return;
  if (log_allows_bar() || log_is_json() || log_is_for_slicer()) {
    show(stage, 0);
  } else {
    enter(stage, 0);
  }
}

void ProgressDisplay::finish() {
  slicer_.finish();
  if (drawn_) std::fputs(kWipeLine, stderr);
  drawn_ = false;
}

void ProgressDisplay::show(std::string_view stage, double fraction) {
  const bool is_new = stage != stage_;
  if (is_new || fraction < fraction_in_stage_) enter(stage, fraction);
  fraction_in_stage_ = fraction;
  done_ = run_.is_known() ? run_.done(stage, fraction) : fraction;
  if (log_is_for_slicer()) {
    slicer_.show(stage, fraction, done_);
    return;
  }
  const auto now = Clock::now();
  if (log_is_json()) {
    log_json(now, fraction);
  } else if (!log_allows_bar()) {
    log_stage(now);
  } else if (!drawn_ || is_new || now - last_drawn_ >= kBetweenBars) {
    last_drawn_ = now;
    draw_bar();
  }
}

void ProgressDisplay::enter(std::string_view stage, double fraction) {
  logged_ &= stage == stage_;
  stage_ = stage;
  if (run_.is_known()) return;
  start_ = Clock::now();
  done_at_start_ = fraction;
}

/// From the time that the part done has taken.
std::optional<double> ProgressDisplay::seconds_left() const {
  const double elapsed = std::chrono::duration<double>(Clock::now() - start_).count();
  const double done = done_ - done_at_start_;
  if (elapsed < kSecondsBeforeEstimate || done < kLeastForEstimate) return {};
  return elapsed * (1 - done_) / done;
}

/// Logs a stage once; one that begins just after another is logged when it lasts.
void ProgressDisplay::log_stage(Clock::time_point now) {
  if (logged_ || now - last_line_ < kBetweenLines) return;
  last_line_ = now;
  logged_ = true;
  const long percent = std::lround(100 * done_);
  log_info(run_.is_known() ? stage_ + " (" + std::to_string(percent) + " %)" : stage_);
}

void ProgressDisplay::log_json(Clock::time_point now, double fraction) {
  if (logged_ && now - last_line_ < kBetweenJson) return;
  last_line_ = now;
  logged_ = true;
  log_progress(
      {stage_, fraction, run_.is_known() ? std::optional(done_) : std::nullopt, seconds_left()});
}

void ProgressDisplay::draw_bar() {
  const auto seconds = seconds_left();
  const std::string left = seconds ? "  " + clock_text(*seconds) + " left" : "";
  const std::string percent = " " + percent_text(done_);
  const auto room_beside = [&](const std::string& text) {
    return terminal_columns() - static_cast<int>(stage_.size() + text.size()) - 4;
  };
  const std::string text = room_beside(percent + left) < 0 ? percent : percent + left;
  const int room = room_beside(text);
  const int width = std::clamp(room, 0, 40);
  const int full = static_cast<int>(std::lround(done_ * width));
  const std::string bar = std::string(static_cast<std::size_t>(full), '#') +
                          std::string(static_cast<std::size_t>(width - full), '-');
  std::fprintf(stderr, "%s%s [%s]%s", kWipeLine, stage_.c_str(), bar.c_str(), text.c_str());
  std::fflush(stderr);
  drawn_ = true;
}

}  // namespace mesamis
