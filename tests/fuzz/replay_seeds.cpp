// SPDX-License-Identifier: Apache-2.0
// Runs the seeds of every fuzz target of a program once, without libFuzzer.
//
//   replay_FAMILY FOLDER     as fuzz_seeds fills it: FOLDER/fuzz_NAME/SEED
#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include "fuzz_target.h"

namespace {

namespace fs = std::filesystem;

std::vector<fs::path> files_in(const fs::path& folder) {
  std::vector<fs::path> files;
  if (!fs::is_directory(folder)) return files;
  for (const auto& entry : fs::directory_iterator(folder)) files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  return files;
}

std::string bytes_of(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

}  // namespace

int main(int count, char** arguments) {
  if (count != 2) {
    std::fprintf(stderr, "usage: %s FOLDER\n", arguments[0]);
    return 2;
  }
  int without = 0;
  for (const mesamis::FuzzTarget& target : mesamis::fuzz_targets()) {
    const auto seeds = files_in(fs::path(arguments[1]) / ("fuzz_" + std::string(target.name)));
    // The line is there before a case ends the process.
    std::printf("fuzz_%s: %zu seeds\n", target.name.data(), seeds.size());
    std::fflush(stdout);
    for (const fs::path& seed : seeds) target.run(bytes_of(seed));
    without += seeds.empty();
  }
  if (without > 0) std::fprintf(stderr, "replay: error: %d targets have no seed\n", without);
  return without > 0 ? 1 : 0;
}
