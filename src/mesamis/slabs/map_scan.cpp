// SPDX-License-Identifier: Apache-2.0
#include "mesamis/slabs/map_scan.h"

#include <unistd.h>

#include <algorithm>
#include <string>
#include <system_error>

#include "mesamis/slabs/mapped_items.h"

namespace mesamis::detail::slabs {
namespace {

namespace fs = std::filesystem;

/// A file's name, which goes at the end: what is mapped stays.
class PassingName {
 public:
  explicit PassingName(fs::path path) : path_(std::move(path)) {}
  ~PassingName() {
    std::error_code ignored;
    fs::remove(path_, ignored);
  }
  PassingName(const PassingName&) = delete;
  PassingName& operator=(const PassingName&) = delete;
  const fs::path& path() const noexcept { return path_; }

 private:
  fs::path path_;
};

}  // namespace

MappedScan map_scan(const SliceSource& source, const fs::path& folder) {
  const VoxelGrid& grid = source.grid();
  const PassingName file(folder / ("mesamis-scan-" + std::to_string(::getpid())));
  make_item_file<float>(file.path(), grid.voxel_count());
  const Index slices = slab_slices(grid);
  for (Index first = 0; first < grid.size[2]; first += slices) {
    const Index count = std::min(slices, grid.size[2] - first);
    write_items<float>(file.path(), grid.offset(0, 0, first), source.read(first, count));
  }
  auto mapped = map_items<float>(file.path(), grid.voxel_count());
  return {{grid, mapped.values}, std::move(mapped.owner)};
}

}  // namespace mesamis::detail::slabs
