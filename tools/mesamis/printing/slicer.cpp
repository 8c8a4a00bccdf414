// SPDX-License-Identifier: Apache-2.0
#include "mesamis/printing/slicer.h"

#include <stdlib.h>

#include <sstream>
#include <string>
#include <system_error>

#include "mesamis/base/error.h"
#include "mesamis/printing/child_process.h"

namespace mesamis::detail::printing {
namespace {

namespace fs = std::filesystem;

struct Product {
  const char* name;
  const char* program;  ///< file name in PATH
  const char* package;  ///< Debian's
};

Product product_of(Slicer slicer) {
  if (slicer == Slicer::kPrusaSlicer) return {"PrusaSlicer", "prusa-slicer", "prusa-slicer"};
  return {"CuraEngine", "CuraEngine", "cura-engine"};
}

fs::path require_program(Slicer slicer) {
  fs::path program = find_slicer(slicer);
  if (!program.empty()) return program;
  const Product product = product_of(slicer);
  throw InputError(std::string(product.program) + ": expected this program in PATH, found none; " +
                   "on Debian: apt install " + product.package);
}

fs::path require_cura_definition() {
  const char* given = getenv("CURA_ENGINE_SEARCH_PATH");
  std::istringstream folders(std::string(given ? given : "") +
                             ":/usr/share/cura/resources/definitions");
  for (std::string folder; std::getline(folders, folder, ':');) {
    const fs::path file = fs::path(folder) / "fdmprinter.def.json";
    std::error_code ignored;
    if (!folder.empty() && fs::exists(file, ignored)) return fs::absolute(file);
  }
  throw InputError(
      "fdmprinter.def.json: expected CuraEngine's definitions in "
      "/usr/share/cura/resources/definitions or CURA_ENGINE_SEARCH_PATH, found none; on Debian: "
      "apt install cura");
}

}  // namespace

const char* slicer_name(Slicer slicer) { return product_of(slicer).name; }

fs::path find_slicer(Slicer slicer) { return find_program(product_of(slicer).program); }

InstalledSlicer require_slicer(Slicer slicer) {
  fs::path program = require_program(slicer);
  if (slicer == Slicer::kPrusaSlicer) return {slicer, std::move(program), {}};
  return {slicer, std::move(program), require_cura_definition()};
}

}  // namespace mesamis::detail::printing
