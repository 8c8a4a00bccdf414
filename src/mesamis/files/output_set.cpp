// SPDX-License-Identifier: Apache-2.0
#include "mesamis/files/output_set.h"

#include <set>
#include <string>
#include <system_error>

#include "mesamis/base/error.h"
#include "mesamis/files/pending_file.h"
#include "mesamis/files/refuse.h"

namespace mesamis::detail::files {
namespace {

namespace fs = std::filesystem;

/// The one name of a file that is there or not.
fs::path identity(const fs::path& path) {
  const fs::path place = without_links(path);
  std::error_code error;
  const fs::path folder = fs::canonical(place.parent_path(), error);
  return error ? place.lexically_normal() : folder / place.filename();
}

bool is_same_file(const fs::path& output, const fs::path& input) {
  std::error_code error;  // of files that are not there
  if (fs::equivalent(output, input, error) && !error) return true;
  try {
    return identity(output) == identity(input);
  } catch (const InputError&) {  // an input that is none is for its reader to refuse
    return false;
  }
}

}  // namespace

OutputSet::OutputSet(OutputSet* outer) : outer_(outer) {}

OutputSet::~OutputSet() = default;

void OutputSet::add(std::unique_ptr<PendingFile> file) { files_.push_back(std::move(file)); }

std::vector<OutputSet::Member> OutputSet::members() const {
  std::vector<Member> members;
  for (const auto& file : files_) members.push_back({file->target(), file->temporary()});
  return members;
}

void OutputSet::commit() {
  if (outer_ != nullptr) {
    for (auto& file : files_) outer_->add(std::move(file));
    return files_.clear();
  }
  replace_all();
  std::set<fs::path> folders;
  for (const auto& file : files_) folders.insert(file->folder());
  files_.clear();
  for (const fs::path& folder : folders) flush_folder(folder);
}

void OutputSet::replace_all() {
  auto next = files_.begin();
  try {
    for (; next != files_.end(); ++next) (*next)->replace();
  } catch (const InputError&) {
    while (next != files_.begin()) (*--next)->put_back();
    throw;
  }
}

void require_writable(const fs::path& target) { const PendingFile tried(target); }

void require_distinct(std::span<const fs::path> outputs, std::span<const fs::path> inputs) {
  std::set<fs::path> seen;
  for (const fs::path& output : outputs) {
    if (output.empty()) continue;
    if (!seen.insert(identity(output)).second) {
      refuse(output, "expected a file of its own for each output, found it twice");
    }
    for (const fs::path& input : inputs) {
      if (input.empty() || !is_same_file(output, input)) continue;
      refuse(output, "expected another file than the input, found " + input.string());
    }
  }
}

}  // namespace mesamis::detail::files
