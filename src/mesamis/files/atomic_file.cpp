// SPDX-License-Identifier: Apache-2.0
#include "mesamis/files/atomic_file.h"

#include <fstream>

#include "mesamis/files/output_set.h"
#include "mesamis/files/pending_file.h"
#include "mesamis/files/refuse.h"

namespace mesamis::detail::files {

namespace fs = std::filesystem;

AtomicFile::AtomicFile(const OutputPath& target)
    : file_(std::make_unique<PendingFile>(target)),
      temporary_(file_->temporary()),
      set_(target.set) {}

AtomicFile::~AtomicFile() = default;

void AtomicFile::commit() {
  file_->harden();
  if (set_ != nullptr) return set_->add(std::move(file_));
  file_->replace();
  const fs::path folder = file_->folder();
  file_.reset();
  flush_folder(folder);
}

void write_file(const OutputPath& path, std::string_view bytes) {
  AtomicFile file(path);
  std::ofstream out(file.temporary_path(), std::ios::binary);
  out.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  out.close();
  if (!out) refuse(path, "cannot be written; is the disk full?");
  file.commit();
}

void remove_unfinished_files() noexcept { remove_pending_files(); }

}  // namespace mesamis::detail::files
