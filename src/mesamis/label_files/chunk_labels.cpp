// SPDX-License-Identifier: Apache-2.0
#include "mesamis/label_files/chunk_labels.h"

#include <algorithm>
#include <memory>
#include <span>
#include <string>
#include <utility>

#include "mesamis/base/error.h"
#include "mesamis/files/memory_budget.h"
#include "mesamis/files/refuse.h"
#include "mesamis/label_files/label_values.h"
#include "mesamis/volume_files/chunked_scan.h"

namespace mesamis::detail::label_files {
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
    refuse(path, message("expected one image of labels, found ", labels.size(), ": ", names,
                         "; name one of them"));
  }
  return labels.front();
}

/// The segments that the store names; numbers that are no labels are left out.
std::vector<Segment> named_segments(const ChunkedScan& scan) {
  std::vector<Segment> segments;
  for (const NamedNumber& named : scan.named_numbers()) {
    Segment segment;
    if (named.number == 0 || !set_number(segment, message(named.number))) continue;
    segment.name = named.name.empty() ? message("label ", named.number) : named.name;
    segment.colour = named.colour.value_or(default_colour(segment.label));
    segments.push_back(std::move(segment));
  }
  return segments;
}

}  // namespace

bool holds_chunk_labels(const fs::path& path, const ReadLimits& limits) {
  try {
    return is_zarr(path) && open_zarr(path, {.limits = limits})->holds_labels();
  } catch (const InputError&) {
    return false;
  }
}

bool has_labels_inside(const fs::path& path) { return is_zarr(path) && !labels_in(path).empty(); }

LabelFile read_chunk_labels(const fs::path& path, const ReadLimits& limits) {
  const ChunkOptions options{.limits = limits};
  const auto scan = is_zarr(path) ? open_zarr(store_of(path), options) : open_hdf5(path, options);
  LabelFile out{{scan->grid(), {}, {}}, scan->format(), scan->warnings()};
  MemoryBudget budget(path, limits);
  LabelBuilder builder(path, out.map, {}, budget);
  out.map.segments = named_segments(*scan);
  scan->visit_samples([&](std::span<const double> samples) { builder.add(samples); });
  out.map = builder.finish(std::move(out.map), out.warnings);
  return out;
}

}  // namespace mesamis::detail::label_files
