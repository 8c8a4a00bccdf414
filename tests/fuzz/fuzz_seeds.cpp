// SPDX-License-Identifier: Apache-2.0
#include "fuzz_seeds.h"

#include <cstdio>
#include <exception>
#include <fstream>

namespace mesamis {

namespace fs = std::filesystem;

fs::path SeedFolder::file(const std::string& target, const std::string& name) const {
  const fs::path folder = path_ / ("fuzz_" + target);
  fs::create_directories(folder);
  return folder / name;
}

void SeedFolder::add(const std::string& target, const std::string& name,
                     const std::string& bytes) const {
  std::ofstream(file(target, name), std::ios::binary) << bytes;
}

}  // namespace mesamis

int main(int count, char** arguments) {
  using namespace mesamis;
  if (count != 2) {
    std::fprintf(stderr, "usage: fuzz_seeds FOLDER\n");
    return 2;
  }
  try {
    const SeedFolder seeds(arguments[1]);
    write_scan_seeds(seeds);
    write_dicom_seeds(seeds);
    write_label_seeds(seeds);
    write_shape_seeds(seeds);
    write_option_seeds(seeds);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "fuzz_seeds: error: %s\n", error.what());
    return 1;
  }
  return 0;
}
