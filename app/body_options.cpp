// SPDX-License-Identifier: Apache-2.0
#include "body_options.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <functional>
#include <utility>

#include "arguments.h"
#include "log.h"
#include "mesamis/base/error.h"
#include "mesamis/base/written_number.h"
#include "mesamis/body/material_law.h"
#include "mesamis/report/body_request.h"
#include "outputs.h"
#include "ranges.h"

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

void add_element_options(CLI::App& c, BodyArguments& a) {
  const auto note = [&a](const char* name) { return noted(a.of_elements, name); };
  c.add_option("--surface-quality", a.surface_quality,
               "Triangles of --output: printing or decimated, as few as --tolerance allows "
               "(default); meshing, well-shaped triangles for other meshers, within "
               "--skin-tolerance of them")
      ->check(CLI::IsMember({"printing", "decimated", "meshing"}));
  c.add_option(
       "--element-size", a.options.element_size,
       "Edge length of --body and of --surface-quality meshing, mm (default: three voxels); "
       "shorter where the surface is curved or a wall thin")
      ->check(above_zero())
      ->each(note("--element-size"));
  c.add_option("--least-size", a.options.least_size,
               "Shortest element edge wanted, mm (default: a quarter of --element-size, less where "
               "the skin misses --skin-tolerance)")
      ->check(above_zero())
      ->each(note("--least-size"));
  c.add_option(
       "--skin-tolerance", a.skin_tolerance,
       "Largest distance of the skin of the elements from the surface, mm (default: --tolerance "
       "if given, else a tenth of --element-size); more allows larger elements at bends")
      ->check(above_zero())
      ->each(note("--skin-tolerance"));
  c.add_option("--element-gradation", a.options.gradation,
               "Growth of element sizes over a length (default 0.5)")
      ->check(from_to(kGradations[0], kGradations[1]))
      ->each(note("--element-gradation"));
  c.add_option("--wall-elements", a.options.through_wall,
               "Elements across a wall (default 1; 0: any number)")
      ->check(from_to(kWallElements[0], kWallElements[1]))
      ->each(note("--wall-elements"));
}

void add_material_options(CLI::App& c, BodyArguments& a) {
  const auto note = [&a](const char* name) { return noted(a.of_material, name); };
  c.add_option("--material", a.material,
               "Stiffness of --body from the grey values: a law of docs/materials.md, or "
               "E=c*rho^p in MPa and g/cm^3; needs --calibration")
      ->type_name("LAW")
      ->each(noted(a.of_body, "--material"));
  c.add_option("--calibration", a.calibration,
               "Density of a native value, g/cm^3: a,b for a + b * value, or HU1:rho1,HU2:rho2")
      ->type_name("A,B")
      ->each(note("--calibration"));
  c.add_option("--ash", a.ash, "Conversion of QCT to ash density: schileo-2008 (default), equal")
      ->type_name("NAME")
      ->each(note("--ash"));
  c.add_option("--material-gap", a.gap, "Range of moduli in one material, MPa (default 50)")
      ->check(zero_or_more())
      ->each(note("--material-gap"));
  c.add_option(
       "--material-rim", a.rim,
       "Depth of the rim that the surroundings dim, mm; its voxels take the value below them if "
       "that is greater (default: from the scan's blur; 0: none)")
      ->check(zero_or_more())
      ->each(note("--material-rim"));
  c.add_option("--poisson", a.poisson, "Poisson ratio (default: the law's)")
      ->check(from_to(kPoissonRatios[0], kPoissonRatios[1]))
      ->each(note("--poisson"));
}

void require_masters(const BodyArguments& a) {
  require_beside(a.of_elements, a.elements(),
                 "--body or --surface-quality meshing beside it, found neither");
  require_beside(a.of_material, !a.material.empty(), "--material beside it, found none");
  require_beside(a.of_body, a.given(), "--body beside it, found none");
  if (!a.material.empty() && a.calibration.empty()) {
    throw CLI::ValidationError("--material",
                               "expected --calibration beside it: grey values alone are no "
                               "density, found none");
  }
}

BodyWishes body_wishes(const BodyArguments& a, Frame frame) {
  BodyWishes wishes;
  wishes.elements = a.options;
  wishes.elements.quadratic = a.element == "tet10";
  wishes.tolerance = a.skin_tolerance;
  wishes.rim = a.rim;
  if (!a.material.empty()) wishes.material = material_options(a);
  for (const std::string& set : a.sets) {
    wishes.sets.push_back(parsed("--set", [&] { return in_lps(parse_face_query(set), frame); }));
  }
  return wishes;
}

/// One line per object whose surface is not all that meshers were promised.
void warn_of_skins(const OutcomeDetails& outcome) {
  const auto& quality = outcome.elements.quality;
  const std::vector<FoundObject> objects = outcome.objects();
  for (std::size_t n = 0; n < quality.size(); ++n) {
    const std::string missed = unmet(quality[n]);
    if (missed.empty()) continue;
    const std::string of = objects.size() > 1 ? "'" + objects[n].segment.name + "': " : "";
    log_warning(std::string("--surface-quality: ").append(of).append(missed));
  }
}

}  // namespace

void add_body_options(CLI::App& c, BodyArguments& a) {
  const auto note = [&a](const char* name) { return noted(a.of_body, name); };
  c.add_option("--body", a.files,
               "Body for finite elements: .inp .feb .msh .vtu .mesh; its skin lies within "
               "--skin-tolerance of the surface");
  c.add_option("--element", a.element,
               "Element type of --body: tet4 (default), tet10 with mid-side nodes")
      ->check(CLI::IsMember({"tet4", "tet10"}))
      ->each(note("--element"));
  add_element_options(c, a);
  c.add_option("--gmsh-version", a.gmsh, "Version of a .msh of --body: 2.2 (default), 4.1")
      ->check(CLI::IsMember({"2.2", "4.1"}))
      ->each(note("--gmsh-version"));
  add_material_options(c, a);
  c.add_option("--set", a.sets,
               "Faces and nodes of --body for loads: NAME=top:z,2mm, bottom:AXIS,MM, "
               "box:X0,Y0,Z0,X1,Y1,Z1, normal:X,Y,Z,DEGREES, between:1,2 (the first and the second "
               "object), outer, inner; in the frame of --frame")
      ->type_name("NAME=PLACE")
      ->each(note("--set"));
}

void require_body(const BodyArguments& a) {
  require_masters(a);
  if (const std::string wrong = wrong_least_size(a.options); !wrong.empty()) {
    throw CLI::ValidationError("--least-size", wrong);
  }
  const bool holds_sets = std::ranges::any_of(
      a.files, [](const fs::path& path) { return lower_extension(path) != ".mesh"; });
  if (!a.sets.empty() && !holds_sets) {
    throw CLI::ValidationError("--set",
                               "expected --body .inp, .feb, .msh or .vtu, which hold sets, "
                               "found .mesh alone");
  }
  for (const fs::path& path : a.files) {
    require_output(path, {".inp", ".feb", ".msh", ".vtu", ".mesh"}, "--body");
    if (a.element == "tet10" && lower_extension(path) == ".mesh") {
      throw CLI::ValidationError(
          "--body", "expected .inp, .feb, .msh or .vtu for tet10, found " + path.string());
    }
  }
  const BodyWishes wishes = body_wishes(a, Frame::kLps);
  parsed("--set", [&] { require_set_names(wishes.sets); });
}

void require_elements_for(const BodyArguments& a, const Settings& settings) {
  if (!a.elements()) return;
  const std::string option = a.given() ? "--body" : "--surface-quality";
  parsed(option, [&] { require_fillable(settings, a.skin_tolerance); });
}

ElementRequest element_request(const BodyArguments& a, Frame frame, double memory_gb) {
  if (!a.elements()) return {};
  return {body_wishes(a, frame), a.given(), a.meshing(), memory_gb};
}

void warn_of_elements(const BodyArguments& a, const OutcomeDetails& outcome) {
  warn_of_skins(outcome);
  if (!outcome.elements.body) return;
  if (!outcome.elements.loose.empty()) log_warning("--body: " + outcome.elements.loose);
  const FiniteElements& body = outcome.elements.body->elements;
  const bool bare = a.gmsh == "2.2" && !body.sets.empty() && !body.materials.empty();
  for (const fs::path& path : a.files) {
    if (!bare || lower_extension(path) != ".msh") continue;
    log_warning("--body " + path.string() +
                ": version 2.2 with --set holds no element values; --gmsh-version 4.1 and .vtu do");
  }
}

}  // namespace mesamis
