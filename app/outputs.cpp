// SPDX-License-Identifier: Apache-2.0
#include "outputs.h"

#include <CLI/CLI.hpp>
#include <algorithm>

#include "arguments.h"
#include "interrupt.h"
#include "mesamis/base/error.h"

namespace mesamis {

void require_output(const std::filesystem::path& path, const std::vector<std::string>& extensions,
                    const std::string& option) {
  const std::string found = lower_extension(path);
  if (std::find(extensions.begin(), extensions.end(), found) == extensions.end()) {
    throw CLI::ValidationError(option, listed("expected a name that ends with one of", extensions) +
                                           ", found '" + path.string() + "'");
  }
  const auto folder = path.parent_path();
  std::error_code error;
  const auto type = std::filesystem::status(folder, error).type();
  using enum std::filesystem::file_type;  // none: a folder that cannot be entered
  if (!folder.empty() && type != directory && type != none) {
    throw InputError(path.string() + ": there is no folder " + folder.string());
  }
  require_writable(path);
}

void require_distinct_files(const Paths& outputs, const Paths& inputs) {
  as_usage([&] { require_distinct(outputs, inputs); });
}

Paths files_of(const OutputSet& set) {
  Paths files;
  for (const OutputSet::Member& file : set.members()) files.push_back(file.target);
  return files;
}

void commit(OutputSet& set) {
  const HeldInterrupts held;
  set.commit();
}

std::string listed(const std::string& what, const std::vector<std::string>& extensions) {
  std::string text = what;
  for (const std::string& extension : extensions) text += " " + extension;
  return text;
}

}  // namespace mesamis
