// SPDX-License-Identifier: Apache-2.0
#include "mesamis/files/atomic_file.h"

#include <fstream>

#include "mesamis/files/output_set.h"
#include "mesamis/files/pending_file.h"
#include "mesamis/files/refuse.h"

namespace mesamis {

namespace fs = std::filesystem;

AtomicFile::AtomicFile(fs::path target)
    : file_(std::make_unique<detail::PendingFile>(std::move(target))),
      temporary_(file_->temporary()) {}

AtomicFile::~AtomicFile() = default;

void AtomicFile::commit() {
  file_->harden();
  if (OutputSet* set = OutputSet::current()) return set->add(std::move(file_));
  file_->replace();
  const fs::path folder = file_->folder();
  file_.reset();
  detail::flush_folder(folder);
}

void write_file(const fs::path& path, std::string_view bytes) {
  AtomicFile file(path);
  std::ofstream out(file.temporary_path(), std::ios::binary);
  out.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  out.close();
  if (!out) detail::refuse(path, "cannot be written; is the disk full?");
  file.commit();
}

void remove_unfinished_files() noexcept { detail::remove_pending_files(); }

}  // namespace mesamis
