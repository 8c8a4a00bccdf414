// SPDX-License-Identifier: Apache-2.0
#include "print_gate.h"

#include "mesamis/surface/self_intersections.h"

namespace mesamis {
namespace {

using nlohmann::ordered_json;

void add(std::string& list, const std::string& item) { list += (list.empty() ? "" : ", ") + item; }

std::string prusa_flaw(const PrusaInfo& info) {
  std::string flaw;
  if (info.open_edges != 0) add(flaw, "open_edges = " + std::to_string(info.open_edges));
  for (const auto& [what, count] : info.repairs) add(flaw, what + " = " + std::to_string(count));
  if (flaw.empty() && !info.manifold) flaw = "manifold = no";
  return flaw;
}

ordered_json prusa_json(const PrusaInfo& info) {
  ordered_json repairs = ordered_json::object();
  for (const auto& [what, count] : info.repairs) repairs[what] = count;
  return {{"manifold", info.manifold},
          {"open_edges", info.open_edges},
          {"parts", info.parts},
          {"volume_mm3", info.volume},
          {"repairs", repairs}};
}

}  // namespace

PrintGate check_for_print(const TriMesh& surface) {
  return {check_surface(surface), find_self_intersections(surface).size()};
}

std::string print_flaw(const PrintGate& gate) {
  std::string flaw = solid_flaws_of(gate.check);
  if (gate.prusa && !gate.prusa->sound()) {
    add(flaw, "prusa-slicer --info: " + prusa_flaw(*gate.prusa));
  }
  return flaw;
}

ordered_json gate_json(const PrintGate& gate) {
  ordered_json by = ordered_json::array({"mesamis"});
  if (gate.prusa) by.push_back("prusa-slicer --info");
  return {{"passed", print_flaw(gate).empty()},
          {"by", by},
          {"closed", gate.check.closed()},
          {"manifold", gate.check.manifold()},
          {"open_edges", gate.check.open_edges},
          {"nonmanifold_edges", gate.check.nonmanifold_edges},
          {"misoriented_edges", gate.check.misoriented_edges},
          {"nonmanifold_points", gate.check.nonmanifold_points},
          {"degenerate_triangles", gate.check.degenerate_triangles},
          {"parts", gate.check.components},
          {"volume_mm3", gate.check.volume},
          {"self_intersections", gate.self_intersections},
          {"prusa_slicer", gate.prusa ? prusa_json(*gate.prusa) : ordered_json()}};
}

}  // namespace mesamis
