// SPDX-License-Identifier: Apache-2.0
#include "log.h"

#include <spdlog/pattern_formatter.h>
#include <spdlog/sinks/stdout_sinks.h>
#include <spdlog/spdlog.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <chrono>
#include <nlohmann/json.hpp>
#include <thread>

#include "arguments.h"
#include "mesamis/base/utf8.h"
#include "slicer_progress.h"

namespace mesamis {
namespace {

bool bar_allowed = false, is_json = false, is_for_slicer = false, is_quiet = false,
     is_helper = false;
std::vector<std::string> warnings;

constexpr const char* kJsonTime = R"({"time":"%Y-%m-%dT%H:%M:%S.%e%z",)";

void append(const std::string& text, spdlog::memory_buf_t& to) {
  to.append(text.data(), text.data() + text.size());
}

/// As a JSON string, quotes included.
std::string quoted(const std::string& text) {
  return nlohmann::json(text).dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

class JsonMessage : public spdlog::custom_flag_formatter {
 public:
  void format(const spdlog::details::log_msg& message, const std::tm&,
              spdlog::memory_buf_t& to) override {
    append(quoted({message.payload.data(), message.payload.size()}), to);
  }
  std::unique_ptr<custom_flag_formatter> clone() const override {
    return std::make_unique<JsonMessage>();
  }
};

/// "warning: " before what is one.
class LevelPrefix : public spdlog::custom_flag_formatter {
 public:
  void format(const spdlog::details::log_msg& message, const std::tm&,
              spdlog::memory_buf_t& to) override {
    if (message.level == spdlog::level::warn) append("warning: ", to);
  }
  std::unique_ptr<custom_flag_formatter> clone() const override {
    return std::make_unique<LevelPrefix>();
  }
};

}  // namespace

std::string line_of(const std::string& message) {
  constexpr std::size_t kLongest = 470;
  return shortened(one_line(message), kLongest);
}

void set_up_log(const CommonOptions& options) {
  const bool terminal = isatty(STDERR_FILENO) != 0;
  bar_allowed = terminal && !options.log_json && !options.quiet && !options.is_helper() &&
                !options.for_slicer;
  is_json = options.log_json;
  is_for_slicer = options.for_slicer;
  is_helper = options.is_helper();
  is_quiet = options.quiet || is_helper;
  auto formatter = std::make_unique<spdlog::pattern_formatter>();
  formatter->add_flag<JsonMessage>('J').add_flag<LevelPrefix>('W');
  formatter->set_pattern(is_json ? std::string(kJsonTime) + R"("level":"%l","message":%J})"
                                 : std::string(bar_allowed ? kWipeLine : "") + "mesamis: %W%v");
  auto logger = std::make_shared<spdlog::logger>("mesamis",
                                                 std::make_shared<spdlog::sinks::stderr_sink_mt>());
  logger->set_formatter(std::move(formatter));
  logger->set_level(is_quiet ? spdlog::level::err : spdlog::level::info);
  logger->flush_on(spdlog::level::info);
  spdlog::set_default_logger(std::move(logger));
}

void log_info(const std::string& message) {
  if (is_for_slicer && !is_json) {
    if (!is_quiet) tell_slicer("mesamis: " + line_of(message));
    return;
  }
  spdlog::default_logger_raw()->info(spdlog::string_view_t(line_of(message)));
}
void log_warning(const std::string& message) {
  warnings.push_back(message);
  spdlog::default_logger_raw()->warn(spdlog::string_view_t(line_of(message)));
}
void log_error(const std::string& message) {
  // What all processes of a team meet is told by the first, which then ends the others.
  if (is_helper) std::this_thread::sleep_for(std::chrono::seconds(2));
  spdlog::default_logger_raw()->error(spdlog::string_view_t(line_of(message)));
}

const std::vector<std::string>& warnings_logged() { return warnings; }
void forget_warnings() { warnings.clear(); }

bool log_is_json() { return is_json; }
bool log_is_for_slicer() { return is_for_slicer; }

void log_progress(const StageProgress& progress) {
  auto formatter = std::make_unique<spdlog::pattern_formatter>();
  formatter->set_pattern(std::string(kJsonTime) + R"("level":"progress",%v})");
  spdlog::logger logger("progress", std::make_shared<spdlog::sinks::stderr_sink_mt>());
  logger.set_formatter(std::move(formatter));
  const auto number = [](double x) { return nlohmann::json(x).dump(); };
  std::string entries =
      R"("stage":)" + quoted(progress.stage) + R"(,"fraction":)" + number(progress.fraction);
  if (progress.done) entries += R"(,"done":)" + number(*progress.done);
  if (progress.seconds_left) entries += R"(,"seconds_left":)" + number(*progress.seconds_left);
  logger.info(entries);
}

bool log_allows_bar() { return bar_allowed; }

}  // namespace mesamis
