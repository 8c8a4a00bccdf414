// SPDX-License-Identifier: Apache-2.0
#include "run_action.h"

#include <CLI/CLI.hpp>
#include <exception>
#include <filesystem>
#include <new>
#include <string_view>

#include "interrupt.h"
#include "log.h"
#include "mesamis/base/error.h"

namespace mesamis {
namespace {

/// What TBB throws where the system has no thread left; it has no type of its own.
bool is_lack_of_threads(const std::exception& error) {
  return std::string_view(error.what()).starts_with("pthread_create");
}

void tell_failure(const std::string& where, const std::string& message) {
  const bool names_it = message.find(where) != std::string::npos;
  log_error(names_it ? message : where + ": " + message);
}

}  // namespace

int run_action(const Action& action, const std::string& where) {
  try {
    return action();
  } catch (const Interrupted&) {
    return kExitDone;  // never seen: the program ends by the signal
  } catch (const CLI::Error& error) {
    tell_failure(where, error.what());
    return kExitUsage;
  } catch (const InputError& error) {
    tell_failure(where, error.what());
    return kExitInput;
  } catch (const NumericalError& error) {
    tell_failure(where, error.what());
    return kExitNotConverged;
  } catch (const std::filesystem::filesystem_error& error) {
    tell_failure(where, error.path1().string() + ": " + error.code().message());
    return kExitInput;
  } catch (const std::bad_alloc&) {
    tell_failure(where, "not enough memory for this input");
    return kExitInput;
  } catch (const std::exception& error) {
    if (is_lack_of_threads(error)) {
      tell_failure(where, "no thread can be started; --threads 1 needs none");
      return kExitInput;
    }
    tell_failure(where, std::string("internal error: ") + error.what());
    return kExitInternal;
  }
}

}  // namespace mesamis
