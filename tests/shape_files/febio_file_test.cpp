// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>

#include <sstream>

#include "mesamis/files/memory_budget.h"
#include "mesamis/files/xml.h"
#include "mesamis/shape_files/element_files.h"
#include "shape_files/element_example.h"
#include "support/external_program.h"
#include "support/temp_folder.h"

namespace mesamis {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

XmlElement read_feb(const std::filesystem::path& path) {
  MemoryBudget budget(path, {});
  return parse_xml(path, read_bytes(path), budget).root;
}

std::vector<int> numbers_of(std::string text) {
  std::replace(text.begin(), text.end(), ',', ' ');
  std::istringstream in(text);
  return {std::istream_iterator<int>(in), {}};
}

/// The children of an element that have a tag, by their names or, where they have none, their ids.
std::map<std::string, XmlElement> children(const XmlElement& parent, const std::string& tag) {
  std::map<std::string, XmlElement> found;
  for (const auto& child : parent.children) {
    if (child.name != tag) continue;
    const std::string name = child.attribute("name");
    found[name.empty() ? child.attribute("id") : name] = child;
  }
  return found;
}

TEST(Febio, OfTwoElementsIsThisText) {
  const TempFolder folder;
  write_elements(folder / "m.feb", two_elements(false));
  EXPECT_EQ(read_bytes(folder / "m.feb"),
            R"(<?xml version="1.0" encoding="UTF-8"?>
<febio_spec version="4.0">
  <!-- mesamis, SPACE=LPS, lengths in mm, moduli in MPa, densities in tonne/mm^3 -->
  <Module type="solid"/>
  <Material>
    <material id="1" name="STIFF" type="isotropic elastic"><density>1.9e-09</density><E>17000</E><v>0.3</v></material>
    <material id="2" name="SOFT" type="isotropic elastic"><E>350.5</E><v>0.25</v></material>
  </Material>
  <Mesh>
    <Nodes name="ALL">
      <node id="1">0,0,0</node>
      <node id="2">2,0,0</node>
      <node id="3">0,2,0</node>
      <node id="4">0,0,2</node>
      <node id="5">2,2,2.5</node>
    </Nodes>
    <Elements type="tet4" name="HEAD-STIFF">
      <elem id="1">1,2,3,4</elem>
    </Elements>
    <Elements type="tet4" name="SHAFT-SOFT">
      <elem id="2">2,5,3,4</elem>
    </Elements>
    <ElementSet name="HEAD">1</ElementSet>
    <ElementSet name="SHAFT">2</ElementSet>
    <NodeSet name="FLOOR">1,2,3</NodeSet>
    <Surface name="FLOOR">
      <tri3 id="1">1,3,2</tri3>
    </Surface>
  </Mesh>
  <MeshDomains>
    <SolidDomain name="HEAD-STIFF" mat="STIFF"/>
    <SolidDomain name="SHAFT-SOFT" mat="SOFT"/>
  </MeshDomains>
</febio_spec>
)");
}

/// FEBio's tet10 has the order of Abaqus, tri6 the mid-side nodes 1-2, 2-3, 3-1.
TEST(Febio, QuadraticElementsHaveItsOrder) {
  const TempFolder folder;
  const FiniteElements e = two_elements(true);
  write_elements(folder / "m.feb", e);
  const auto root = read_feb(folder / "m.feb");
  const auto& mesh = *root.child("Mesh");
  for (const auto& [name, elements] : children(mesh, "Elements")) {
    EXPECT_EQ(elements.attribute("type"), "tet10");
    expect_middles(
        points_of(e.points, numbers_of(elements.children.at(0).text)), 4,
        std::array<std::array<int, 2>, 6>{{{0, 1}, {1, 2}, {2, 0}, {0, 3}, {1, 3}, {2, 3}}});
  }
  const auto faces = children(children(mesh, "Surface").at("FLOOR"), "tri6");
  expect_middles(points_of(e.points, numbers_of(faces.at("1").text)), 3,
                 std::array<std::array<int, 2>, 3>{{{0, 1}, {1, 2}, {2, 0}}});
  EXPECT_THAT(numbers_of(children(mesh, "NodeSet").at("FLOOR").text),
              ElementsAre(1, 2, 3, 6, 7, 8));
}

/// Every element is in one domain, every domain has its material, and the frame is that asked for.
TEST(Febio, DomainsPartitionTheElements) {
  const TempFolder folder;
  FiniteElements e = box_elements({{0, 0, 0}, {3, 4, 5}}, {2, 3, 4}, false);
  e.parts.push_back({"OTHER"});
  e.materials.push_back({"MAT_002", 10, 0.1, 1});
  for (std::size_t c = 0; c < e.cells.size(); ++c) {
    e.part_of_cell[c] = c % 3 == 0;
    e.material_of_cell[c] = c % 2 == 0;
  }
  write_elements(folder / "m.feb", e, {.frame = Frame::kRas});
  const auto root = read_feb(folder / "m.feb");
  const auto& mesh = *root.child("Mesh");
  std::vector<int> seen(e.cells.size(), 0);
  const auto domains = children(*root.child("MeshDomains"), "SolidDomain");
  const auto elements = children(mesh, "Elements");
  EXPECT_EQ(elements.size(), 4u);
  EXPECT_EQ(domains.size(), 4u);
  for (const auto& [name, domain] : elements) {
    for (const auto& [id, element] : children(domain, "elem")) {
      const auto c = static_cast<std::size_t>(std::stoi(id)) - 1;
      ++seen[c];
      const auto& part = e.parts[static_cast<std::size_t>(e.part_of_cell[c])].name;
      const auto& material = e.materials[static_cast<std::size_t>(e.material_of_cell[c])].name;
      EXPECT_EQ(name, part + "-" + material);
      EXPECT_EQ(domains.at(name).attribute("mat"), material);
    }
  }
  EXPECT_EQ(seen, std::vector<int>(e.cells.size(), 1));
  const Vec3 p = e.points[7];
  std::istringstream node(children(mesh, "Nodes").at("ALL").children.at(7).text);
  char comma = 0;
  Vec3 q;
  node >> q.x >> comma >> q.y >> comma >> q.z;
  EXPECT_EQ(q, (Vec3{-p.x, -p.y, p.z}));
  EXPECT_THAT(read_bytes(folder / "m.feb"), HasSubstr("SPACE=RAS"));
}

TEST(Febio, WithoutMaterialsHasTheMeshAlone) {
  const TempFolder folder;
  FiniteElements e = two_elements(false);
  e.materials.clear();
  e.material_of_cell.clear();
  write_elements(folder / "m.feb", e);
  const auto root = read_feb(folder / "m.feb");
  EXPECT_EQ(root.child("Material"), nullptr);
  EXPECT_EQ(root.child("MeshDomains"), nullptr);
  const auto elements = children(*root.child("Mesh"), "Elements");
  EXPECT_EQ(elements.count("HEAD"), 1u);
  EXPECT_EQ(elements.count("SHAFT"), 1u);
}

TEST(Febio, ItselfRunsTheFile) {
  MESAMIS_REQUIRE_PROGRAM("febio4");
  const TempFolder folder;
  write_elements(folder / "m.feb", box_elements({{0, 0, 0}, {2, 2, 2}}, {2, 2, 2}, true));
  std::string text = read_bytes(folder / "m.feb");
  text.insert(text.find("  <Material>"),
              "<Control><analysis>STATIC</analysis><time_steps>1</time_steps>"
              "<step_size>1</step_size></Control>");
  text.insert(text.find("</febio_spec>"),
              "<Boundary><bc name=\"fix\" type=\"zero displacement\" node_set=\"BOTTOM\">"
              "<x_dof>1</x_dof><y_dof>1</y_dof><z_dof>1</z_dof></bc></Boundary>");
  write_bytes(folder / "m.feb", text);
  EXPECT_EQ(run_in(folder.path(), "febio4 -i m.feb"), 0) << read_bytes(folder / "log");
}

}  // namespace
}  // namespace mesamis
