// SPDX-License-Identifier: Apache-2.0
// bench_body SURFACE SIZE TOLERANCE [OUTPUT.vtu]: fills a surface with elements; sizes in mm.
#include <cstdio>
#include <cstdlib>

#include "mesamis/body/make_body.h"
#include "mesamis/shape_files/mesh_files.h"
#include "mesamis/shape_files/surface_files.h"
#include "mesamis/surface/self_intersections.h"
#include "mesamis/surface/triangle_shapes.h"

using namespace mesamis;

namespace {

Box with_margin(const Box& box, double margin) {
  const Vec3 m{margin, margin, margin};
  return {box.lo - m, box.hi + m};
}

void print_skin(const MeshedBody& body, const TriMesh& surface) {
  const TriMesh skin = body_skin(body.elements);
  const SurfaceCheck check = check_surface(skin), of_surface = check_surface(surface);
  std::printf(
      "skin: %zu triangles, flaws '%s', %lld components (surface %lld), volume %.5f, "
      "distances %.4f and %.4f mm, %zu self-intersections\n",
      skin.triangles.size(), flaws_of(check).c_str(), static_cast<long long>(check.components),
      static_cast<long long>(of_surface.components), body.fit.volume_ratio,
      body.fit.skin_to_surface, body.fit.surface_to_skin, find_self_intersections(skin).size());
  const TriangleShapes shapes = triangle_shapes(skin);
  std::printf("its triangles: least angle %.2f degrees, %.3f %% above 30\n", shapes.least_angle,
              100 * shapes.share_above_30_deg);
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 4) {
    std::fprintf(stderr, "usage: bench_body SURFACE SIZE TOLERANCE [OUTPUT.vtu]\n");
    return 2;
  }
  const TriMesh surface = read_surface(argv[1]);
  BodyOptions options;
  options.element_size = std::atof(argv[2]);
  options.tolerance = std::atof(argv[3]);
  const Box box = with_margin(bounding_box(surface.points), options.element_size);
  const MeshedBody body = make_body({&surface, 1}, box, options);
  const ElementQuality& q = body.quality;
  std::printf(
      "%lld elements, angles %.2f to %.2f degrees, %.4f %% above 15, scaled Jacobian from "
      "%.4f, %.4f %% above 0.2\n",
      static_cast<long long>(q.elements), q.least_angle, q.greatest_angle,
      100 * q.share_above_15_deg, q.scaled_jacobian_min, 100 * q.share_jacobian_above);
  std::printf("%lld elements of the skin only, %.3f %% of the area narrower than %.3f mm\n",
              static_cast<long long>(body.fit.elements_of_skin_only), 100 * body.narrow_share,
              body.least_size);
  std::printf("seconds: sizes %.2f, start %.2f, body %.2f, fit %.2f\n", body.seconds.sizes,
              body.seconds.start, body.seconds.body, body.seconds.fit);
  print_skin(body, surface);
  if (argc > 4) write_vtu(argv[4], body.elements.mesh);
  return 0;
}
