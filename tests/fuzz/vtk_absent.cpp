// SPDX-License-Identifier: Apache-2.0
// Stands in for the rooms that VTK makes large, picture and baseline: the targets of the options
// never run a command.
#include "fuzz_target.h"
#include "mesamis/baseline/baseline_surface.h"
#include "mesamis/picture/picture.h"

namespace mesamis {
namespace {

void refuse() { require_law(false, "a command was run"); }

}  // namespace

double drawing_memory(std::size_t, const PictureOptions&) noexcept {
  refuse();
  return 0;
}
void draw_surface(const std::filesystem::path&, const TriMesh&, const PictureOptions&,
                  std::span<const double>) {
  refuse();
}
void draw_objects(const std::filesystem::path&, std::span<const NamedSurface>,
                  const PictureOptions&) {
  refuse();
}
void draw_mesh(const std::filesystem::path&, const MeshWithArrays&, const PictureOptions&) {
  refuse();
}
void draw_slice(const std::filesystem::path&, const Volume&, const TriMesh*,
                const PictureOptions&) {
  refuse();
}

BaselineSurface make_baseline(const Volume&, const BaselineOptions&, const Progress&) {
  refuse();
  return {};
}
bool has_geodesic_contour() { return false; }
void require_valid(const IsosurfaceOptions&) { refuse(); }
void require_valid(const GeodesicOptions&) { refuse(); }

}  // namespace mesamis
