// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <memory>
#include <nlohmann/json.hpp>
#include <string_view>
#include <system_error>
#include <utility>

#include "mesamis/files/byte_source.h"
#include "mesamis/files/bytes.h"
#include "mesamis/files/file_list.h"
#include "mesamis/files/in_one_line.h"
#include "mesamis/files/refuse.h"
#include "mesamis/volume_files/multiscales.h"
#include "mesamis/volume_files/zarr_array.h"

namespace mesamis::detail::volume_files {
namespace {

namespace fs = std::filesystem;

constexpr const char *kArray2 = ".zarray", *kGroup2 = ".zgroup", *kAttributes2 = ".zattrs",
                     *kNode3 = "zarr.json";

bool is_there(const fs::path& path) {
  std::error_code ignored;
  return fs::exists(path, ignored);
}

bool is_node(const fs::path& folder) {
  return is_there(folder / kArray2) || is_there(folder / kGroup2) || is_there(folder / kNode3);
}

/// A file of metadata; an empty object where there is none.
struct Document {
  fs::path file;
  nlohmann::json json = nlohmann::json::object();
  JsonValue value() const { return {file, json}; }
};

Document read_document(const fs::path& file, MemoryBudget& budget) {
  if (!is_there(file)) return {file};
  return {file, read_metadata(file, budget)};
}

/// A group or an array.
struct Node {
  Document metadata, attributes;  // in version 3 the metadata hold the attributes
  bool array = false, v3 = false;

  std::vector<ScaleLevel> levels() const {
    const JsonValue all = attributes.value();
    if (!v3) return read_multiscales(all);
    const auto own = all.find("attributes");
    return own ? read_multiscales(*own) : std::vector<ScaleLevel>{};
  }
};

Node read_node(const fs::path& folder, MemoryBudget& budget) {
  if (is_there(folder / kArray2)) {
    return {read_document(folder / kArray2, budget), {}, true, false};
  }
  if (is_there(folder / kNode3)) {
    const Document document = read_document(folder / kNode3, budget);
    return {document, document, document.value().at("node_type").text() == "array", true};
  }
  return {read_document(folder / kGroup2, budget), read_document(folder / kAttributes2, budget)};
}

/// A name inside the store leads into it.
fs::path inside(const fs::path& file, const std::string& name) {
  const fs::path path = fs::path(name).relative_path().lexically_normal();
  if (name.find('\0') != std::string::npos || (!path.empty() && *path.begin() == "..")) {
    refuse(file, message("expected a path that stays within the store, found ", in_quotes(name)));
  }
  return path == "." ? fs::path() : path;
}

/// The array that is read, and its level where it belongs to an image.
struct Found {
  fs::path folder;
  std::optional<ScaleLevel> level;
};

Found finest(const fs::path& folder, const std::vector<ScaleLevel>& levels) {
  return {folder / inside(folder, levels.front().path), levels.front()};
}

/// Every array of three axes below a group, and every image, whose finest level counts.
class Search {
 public:
  explicit Search(MemoryBudget& budget) : budget_(budget) {}

  void look(const fs::path& folder, int depth) {
    constexpr int kDeepest = 8;
    constexpr int kMostNodes = 10'000;
    if (depth > kDeepest || ++nodes_ > kMostNodes) {
      refuse(folder, "expected a store of at most 10000 groups, 8 below each other, found more");
    }
    const Node node = read_node(folder, budget_);
    if (node.array) {
      if (node.metadata.value().at("shape").list().size() >= 3) found.push_back({folder, {}});
      return;
    }
    const auto levels = node.levels();
    if (!levels.empty()) return found.push_back(finest(folder, levels));
    for (const fs::path& child : children(folder)) look(child, depth + 1);
  }

  std::vector<Found> found;

 private:
  static std::vector<fs::path> children(const fs::path& folder) {
    std::vector<fs::path> all;
    for (const auto& entry : fs::directory_iterator(folder)) {
      if (entry.is_directory() && is_node(entry.path())) all.push_back(entry.path());
    }
    std::sort(all.begin(), all.end());
    return all;
  }

  MemoryBudget& budget_;
  int nodes_ = 0;
};

fs::path whole_path(const fs::path& path) {
  const fs::path whole = fs::absolute(path).lexically_normal();
  return whole.has_filename() ? whole : whole.parent_path();
}

/// The topmost group around a node, and the way from there.
std::pair<fs::path, fs::path> store_of(const fs::path& path) {
  const fs::path whole = whole_path(path);
  fs::path root = whole;
  while (root.has_relative_path() && is_node(root.parent_path())) root = root.parent_path();
  return {root, whole.lexically_relative(root)};
}

/// The level of the image that an array belongs to: a group around it names it.
std::optional<ScaleLevel> level_of(const fs::path& root, const fs::path& folder,
                                   MemoryBudget& budget) {
  for (fs::path group = folder; group != root;) {
    group = group.parent_path();
    if (!is_node(group)) continue;
    for (ScaleLevel& level : read_node(group, budget).levels()) {
      if (group / inside(group, level.path) == folder) return std::move(level);
    }
  }
  return {};
}

std::string names_of(const fs::path& root, const std::vector<Found>& found) {
  std::vector<std::string> names;
  names.reserve(found.size());
  for (const Found& array : found) {
    names.push_back(shown(array.folder.lexically_relative(root).string()));
  }
  return first_of(names);
}

Found find_array(const fs::path& path, const std::string& dataset, MemoryBudget& budget) {
  const auto [root, way] = store_of(path);
  const fs::path start = (root / way / inside(path, dataset)).lexically_normal();
  const fs::path folder = start.has_filename() ? start : start.parent_path();
  if (!is_node(folder)) {
    refuse(path, dataset.empty() ? "expected a Zarr array or group, found none"
                                 : message("expected a Zarr array or group ", in_quotes(dataset),
                                           " within it, found none"));
  }
  if (read_node(folder, budget).array) return {folder, level_of(root, folder, budget)};
  Search search(budget);
  search.look(folder, 0);
  if (search.found.empty()) refuse(path, "expected an array of 3 axes, found none");
  if (search.found.size() > 1) {
    refuse(path, message("expected one array of 3 axes, or a path to one inside, found ",
                         search.found.size(), ": ", names_of(root, search.found)));
  }
  return search.found.front();
}

/// The table of the shard that was read last.
struct ShardIndex {
  fs::path file;
  std::string table;
};

std::string read_bytes_of(const fs::path& file, std::uint64_t begin, std::uint64_t size,
                          MemoryBudget& budget) {
  const std::uint64_t there = size_of(file);
  if (begin > there || size > there - begin) {
    refuse(file,
           message("expected ", size, " bytes from byte ", begin, " on, found a file of ", there));
  }
  budget.claim(size, 1, "a chunk as stored");
  std::string bytes(size, '\0');
  ByteSource source(file, Packing::kPlain, begin);
  bytes.resize(source.read(bytes.data(), size));
  return bytes;
}

void read_index(const fs::path& file, const ZarrShard& shard, MemoryBudget& budget,
                ShardIndex& index) {
  if (index.file == file) return;
  const std::uint64_t size = shard.index_bytes(), all = size_of(file);
  if (size > all) {
    refuse(file, message("expected a table of ", size, " bytes in the shard, found ", all));
  }
  index.file.clear();
  std::string table = read_bytes_of(file, shard.index_at_end ? all - size : 0, size, budget);
  if (shard.index_has_sum) {
    table = unpack_chunk(file, std::move(table), {{ChunkCodec::Kind::kCrc32c}}, size - 4);
  }
  index.table = std::move(table);
  index.file = file;
}

/// A chunk within a shard, by its place among all chunks.
std::optional<StoredChunk> read_chunk_in_shard(const fs::path& folder, const ZarrArray& array,
                                               std::vector<std::uint64_t> place,
                                               MemoryBudget& budget, ShardIndex& index) {
  constexpr std::uint64_t kMissing = ~std::uint64_t{0};
  const ZarrShard& shard = *array.shard;
  std::uint64_t within = 0;
  for (std::size_t a = 0; a < place.size(); ++a) {
    within = within * shard.chunks[a] + place[a] % shard.chunks[a];
    place[a] /= shard.chunks[a];
  }
  const fs::path file = folder / chunk_name(array, place);
  if (!is_there(file)) return {};
  require_file(file);
  read_index(file, shard, budget, index);
  const auto begin = load<std::uint64_t>(index.table.data() + 16 * within);
  const auto size = load<std::uint64_t>(index.table.data() + 16 * within + 8);
  if (begin == kMissing && size == kMissing) return {};
  return StoredChunk{file, read_bytes_of(file, begin, size, budget), array.layout.codecs};
}

std::optional<StoredChunk> read_chunk(const fs::path& file, const ChunkLayout& layout,
                                      MemoryBudget& budget) {
  if (!is_there(file)) return {};
  require_file(file);
  ByteSource source(file, Packing::kPlain);
  const std::uint64_t size = source.most_bytes();
  budget.claim(size, 1, "a chunk as stored");
  StoredChunk chunk{file, std::string(size, '\0'), layout.codecs};
  chunk.bytes.resize(source.read(chunk.bytes.data(), size));
  return chunk;
}

ZarrArray read_array(const fs::path& folder, MemoryBudget& budget) {
  const Node node = read_node(folder, budget);
  if (!node.array) refuse(folder, "expected a Zarr array, found none");
  const JsonValue metadata = node.metadata.value();
  return node.v3 ? read_zarr_v3(metadata) : read_zarr_v2(metadata);
}

/// The attributes by which CF conventions scale values are told: they are not applied.
void warn_of_scale(const fs::path& folder, MemoryBudget& budget,
                   std::vector<std::string>& warnings) {
  const Document own = read_document(folder / kAttributes2, budget);
  const Document v3 = read_document(folder / kNode3, budget);
  const auto attributes = v3.value().find("attributes");
  for (const char* name : {"scale_factor", "add_offset"}) {
    if (!own.value().has(name) && !(attributes && attributes->has(name))) continue;
    warnings.push_back(
        message("the attribute ", name, " is not applied: values are kept as stored"));
  }
}

OpenedArray opened(const fs::path& path, const Found& found, const ChunkOptions& options,
                   MemoryBudget& budget) {
  ZarrArray array = read_array(found.folder, budget);
  OpenedArray out;
  out.path = path;
  out.format = found.level ? "OME-Zarr" : "Zarr";
  const auto axes = found.level ? found.level->axes : std::vector<std::string>{};
  out.grid.size =
      require_layout(found.folder, array.layout, axes, {options.volume, options.channel});
  if (!axes.empty() && axes.size() != array.layout.shape.size()) {
    refuse(found.folder, message("expected as many axes as the image states, ", axes.size(),
                                 ", found ", array.layout.shape.size()));
  }
  require_chain(found.folder, array.layout.codecs);
  warn_of_scale(found.folder, budget, out.warnings);
  if (found.level) {
    const auto& more = found.level->warnings;
    if (!options.spacing) out.warnings.insert(out.warnings.end(), more.begin(), more.end());
    out.grid.origin = found.level->origin;
    out.labels = found.level->labels;
  }
  set_spacing(out, found.level ? found.level->spacing : std::nullopt, options.spacing);
  out.layout = array.layout;
  out.limits = options.limits;
  // One read() at a time fetches chunks.
  out.fetch = [array = std::move(array), folder = found.folder,
               index = std::make_shared<ShardIndex>()](const std::vector<std::uint64_t>& place,
                                                       MemoryBudget& memory) {
    if (array.shard) return read_chunk_in_shard(folder, array, place, memory, *index);
    return read_chunk(folder / chunk_name(array, place), array.layout, memory);
  };
  return out;
}

}  // namespace

bool is_zarr(const fs::path& path) noexcept {
  try {
    return is_node(whole_path(path));
  } catch (const std::exception&) {
    return false;
  }
}

std::unique_ptr<ChunkedScan> open_zarr(const fs::path& path, const ChunkOptions& options) {
  MemoryBudget budget(path, options.limits);
  return in_one_line(path, [&] {
    const Found found = find_array(path, options.dataset, budget);
    return make_chunked_scan(opened(path, found, options, budget));
  });
}

}  // namespace mesamis::detail::volume_files
