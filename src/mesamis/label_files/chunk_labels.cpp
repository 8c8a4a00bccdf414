// SPDX-License-Identifier: Apache-2.0
#include "mesamis/label_files/chunk_labels.h"

#include <algorithm>
#include <memory>
#include <utility>

#include "mesamis/chunk_files/chunked_scan.h"
#include "mesamis/files/memory_budget.h"
#include "mesamis/files/refuse.h"
#include "mesamis/label_files/label_values.h"

namespace mesamis::detail {
namespace {

namespace fs = std::filesystem;

/// The labels that lie in an image, as NGFF has them: groups in a group "labels".
std::vector<fs::path> labels_in(const fs::path& image) {
  const fs::path group = image / "labels";
  std::vector<fs::path> labels;
  if (!is_zarr(group)) return labels;
  for (const auto& entry : fs::directory_iterator(group)) {
    if (entry.is_directory() && is_zarr(entry.path())) labels.push_back(entry.path());
  }
  std::sort(labels.begin(), labels.end());
  return labels;
}

/// The path itself, or the only labels of an image.
fs::path store_of(const fs::path& path) {
  const std::vector<fs::path> labels = labels_in(path);
  if (labels.empty()) return path;
  if (labels.size() > 1) {
    std::string names;
    for (const fs::path& one : labels) {
      names += (names.empty() ? "" : ", ") + shown("labels/" + one.filename().string());
    }
    refuse(path, say("expected one image of labels, found ", labels.size(), ": ", names,
                     "; name one of them"));
  }
  return labels.front();
}

}  // namespace

LabelFile read_chunk_labels(const fs::path& path, const ReadLimits& limits) {
  const ChunkOptions options{.limits = limits};
  const auto scan = is_zarr(path) ? open_zarr(store_of(path), options) : open_hdf5(path, options);
  LabelFile out{{scan->grid(), {}, {}}, scan->format(), scan->warnings()};
  MemoryBudget budget(path, limits);
  LabelBuilder builder(path, out.map, {}, budget);
  for (Index k = 0; k < out.map.size[2]; ++k) builder.add(scan->read(k, 1));
  out.map = builder.finish(std::move(out.map), out.warnings);
  return out;
}

}  // namespace mesamis::detail
