// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>

/// Small valid files of each format, made by the project's own writers and by those of the tests:
/// what the fuzzer begins with. fuzz_seeds FOLDER writes them to FOLDER/TARGET/.
namespace mesamis {

class SeedFolder {
 public:
  explicit SeedFolder(std::filesystem::path path) : path_(std::move(path)) {}

  /// Writes a seed of a target.
  void add(const std::string& target, const std::string& name, const std::string& bytes) const;
  /// The path for a writer that takes one; its folder is there.
  std::filesystem::path file(const std::string& target, const std::string& name) const;

 private:
  std::filesystem::path path_;
};

void write_scan_seeds(const SeedFolder& seeds);
void write_dicom_seeds(const SeedFolder& seeds);
void write_label_seeds(const SeedFolder& seeds);
void write_shape_seeds(const SeedFolder& seeds);
void write_option_seeds(const SeedFolder& seeds);

}  // namespace mesamis
