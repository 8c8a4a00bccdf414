// SPDX-License-Identifier: Apache-2.0
#include "mesamis/slabs/same_run.h"

#include <vector>

#include "mesamis/base/error.h"
#include "mesamis/base/version.h"
#include "mesamis/method/setting_table.h"

namespace mesamis::detail::slabs {

std::string description_of(const Settings& settings) {
  std::string text = version();
  for (const Setting& setting : setting_table()) {
    text += " " + setting.name + " " + text_of(setting, setting.get(settings));
  }
  return text;
}

void require_same_run(const Scratch& scratch, const std::string& description, Team& team) {
  if (team.rank() == 0 && !scratch.has("run")) {
    ArchiveWriter archive;
    archive.add(std::vector<char>(description.begin(), description.end()));
    scratch.write("run", archive);
  }
  team.wait_for_all();
  const std::vector<char> there = scratch.read("run").next<char>();
  if (std::string(there.begin(), there.end()) == description) return;
  throw InputError(scratch.folder().string() +
                   ": expected a folder for the scratch files of this run, found those of a run "
                   "with another scan or other settings");
}

}  // namespace mesamis::detail::slabs
