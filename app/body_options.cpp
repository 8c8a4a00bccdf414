// SPDX-License-Identifier: Apache-2.0
#include "body_options.h"

#include "arguments.h"
#include "mesamis/material/density.h"
#include "mesamis/material/material_law.h"
#include "mesamis/shape_files/element_files.h"
#include "outputs.h"

namespace mesamis {
namespace {

namespace fs = std::filesystem;

MaterialOptions material_options(const BodyArguments& a) {
  MaterialOptions options;
  options.law = parsed("--material", [&] { return parse_material_law(a.material); });
  options.calibration = parsed("--calibration", [&] { return parse_calibration(a.calibration); });
  if (!a.ash.empty()) options.ash = parsed("--ash", [&] { return find_ash_rule(a.ash); });
  if (a.gap) options.gap = *a.gap;
  options.poisson = a.poisson;
  return options;
}

void add_material_options(CLI::App& c, BodyArguments& a) {
  c.add_option("--material", a.material,
               "Stiffness of --body from the grey values: a law of docs/materials.md, or "
               "E=c*rho^p in MPa and g/cm^3; needs --calibration");
  c.add_option("--calibration", a.calibration,
               "Density g/cm^3 of a native value: a,b for a + b * value, or HU1:rho1,HU2:rho2");
  c.add_option("--ash", a.ash, "Ash density of the calibration's: schileo-2008 (default), equal");
  c.add_option("--material-gap", a.gap, "MPa between the ends of a bin of materials (default 50)")
      ->check(CLI::NonNegativeNumber);
  c.add_option("--poisson", a.poisson, "Poisson ratio (default: the law's)")
      ->check(CLI::Range(-0.99, 0.499));
}

}  // namespace

void add_body_options(CLI::App& c, BodyArguments& a) {
  c.add_option("--body", a.files,
               "Body for finite elements: .inp .feb .msh .vtu .mesh; its skin lies within "
               "--tolerance of the surface");
  c.add_option("--element", a.element, "Of --body: tet4 (default), tet10 with mid-side nodes")
      ->check(CLI::IsMember({"tet4", "tet10"}));
  c.add_option("--element-size", a.options.element_size,
               "Edge length of --body, mm (default: three voxels); less where it is curved or thin")
      ->check(CLI::PositiveNumber);
  c.add_option("--least-size", a.options.least_size,
               "Edges of --body are not wanted shorter, mm (default: a quarter of --element-size)")
      ->check(CLI::PositiveNumber);
  c.add_option("--element-gradation", a.options.gradation,
               "By how much sizes of --body may grow over a length (default 0.5)")
      ->check(CLI::Range(0.05, 5.0));
  c.add_option("--wall-elements", a.options.through_wall,
               "Elements of --body between two sides of a wall (default 1; 0: any)")
      ->check(CLI::Range(0, 10));
  c.add_option("--gmsh-version", a.gmsh, "Of a .msh of --body: 2.2 (default), 4.1")
      ->check(CLI::IsMember({"2.2", "4.1"}));
  add_material_options(c, a);
  c.add_option("--set", a.sets,
               "Faces and nodes of --body for loads: NAME=top:z,2mm, bottom:AXIS,MM, "
               "box:X0,Y0,Z0,X1,Y1,Z1, normal:X,Y,Z,DEGREES, between:1,2");
}

void require_body(const BodyArguments& a) {
  const bool asks = !a.material.empty() || !a.calibration.empty() || !a.sets.empty();
  if (asks && !a.given()) {
    throw CLI::ValidationError(
        "--body", "expected a file for --material, --calibration or --set, found none");
  }
  if (a.material.empty() != a.calibration.empty()) {
    throw CLI::ValidationError(a.material.empty() ? "--calibration" : "--material",
                               a.material.empty()
                                   ? "expected --material beside it, found none"
                                   : "expected --calibration beside it: grey values alone are no "
                                     "density, found none");
  }
  for (const fs::path& path : a.files) {
    require_output(path, {".inp", ".feb", ".msh", ".vtu", ".mesh"}, "--body");
    if (a.element == "tet10" && lower_extension(path) == ".mesh") {
      throw CLI::ValidationError(
          "--body", "expected .inp, .feb, .msh or .vtu for tet10, found " + path.string());
    }
  }
  body_request(a, 1);
}

BodyRequest body_request(const BodyArguments& a, double tolerance) {
  BodyRequest request;
  request.elements = a.options;
  request.elements.tolerance = tolerance;
  request.elements.quadratic = a.element == "tet10";
  if (!a.material.empty()) request.material = material_options(a);
  for (const std::string& set : a.sets) {
    request.sets.push_back(parsed("--set", [&] { return parse_face_query(set); }));
  }
  return request;
}

void write_bodies(const BodyArguments& a, const BodyOutput& body, Frame frame) {
  ElementWriteOptions options;
  options.frame = frame;
  options.gmsh = a.gmsh == "4.1" ? GmshVersion::k41 : GmshVersion::k22;
  for (const fs::path& path : a.files) write_elements(path, body.elements, options);
}

}  // namespace mesamis
