// SPDX-License-Identifier: Apache-2.0
// mesamis as a module of 3D Slicer: the description, and calls as Slicer makes them of it.
#include <gmock/gmock.h>

#include <array>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <regex>
#include <set>
#include <sstream>

#include "mesamis/base/types.h"
#include "mesamis/files/xml.h"
#include "mesamis/label_files/read_labels.h"
#include "mesamis/method/setting_table.h"
#include "mesamis/shape_files/mesh_files.h"
#include "mesamis/shape_files/surface_files.h"
#include "support/ball_volume.h"
#include "support/external_program.h"
#include "support/run_program.h"
#include "support/wide_budget.h"

namespace mesamis {
namespace {
using testing::HasSubstr;
using Words = std::vector<std::string>;

// ---- What Slicer does with a description.

XmlElement description(const TempFolder& folder) {
  const ProgramRun run = run_program(folder, {"slicer-segment", "--xml"});
  EXPECT_EQ(run.status, 0);
  EXPECT_EQ(run.err, "");
  WideBudget budget;
  return parse_xml("description", run.out, budget).root;
}

std::string text_in(const XmlElement& element, const std::string& name) {
  const XmlElement* child = element.child(name);
  return child == nullptr ? "" : child->text;
}

std::vector<XmlElement> parameters(const XmlElement& root) {
  std::vector<XmlElement> found;
  for (const XmlElement& group : root.children) {
    if (group.name != "parameters") continue;
    for (const XmlElement& p : group.children) {
      if (p.name != "label" && p.name != "description") found.push_back(p);
    }
  }
  return found;
}

/// The command line that Slicer builds: the file of results, every value that has a flag, those of
/// files only where a node is chosen, switches only where they are on, and what has an index last.
Words slicer_call(const XmlElement& root, const std::map<std::string, Words>& chosen,
                  const std::string& results) {
  static const std::set<std::string> kOnlyGiven{"file",     "string", "string-vector", "image",
                                                "geometry", "point",  "region"};
  Words words{"slicer-segment", "--returnparameterfile", results};
  std::map<int, std::string> placed;
  for (const XmlElement& p : parameters(root)) {
    const std::string name = text_in(p, "name"), flag = text_in(p, "longflag");
    const auto given = chosen.find(name);
    const Words values = given != chosen.end()           ? given->second
                         : text_in(p, "default").empty() ? Words{}
                                                         : Words{text_in(p, "default")};
    if (const std::string index = text_in(p, "index"); !index.empty()) {
      placed[std::stoi(index)] = values.at(0);
    } else if (flag.empty()) {
      EXPECT_EQ(text_in(p, "channel"), "output") << name << " can neither be given nor read";
    } else if (p.name == "boolean") {
      if (values.at(0) == "true") words.push_back("--" + flag);
    } else {
      if (!kOnlyGiven.contains(p.name)) {
        EXPECT_EQ(values.size(), 1u) << name;
      }
      for (const std::string& value : values) words.insert(words.end(), {"--" + flag, value});
    }
  }
  for (const auto& [index, value] : placed) words.push_back(value);
  return words;
}

/// Takes the marks of progress off stdout, inner ones first, as Slicer does.
std::string without_marks(std::string out) {
  for (const char* mark :
       {"progress", "stage-progress", "name", "comment", "time", "start", "end"}) {
    const std::string tag = "filter-" + std::string(mark) + ">";
    out = std::regex_replace(out, std::regex("<" + tag + "[^<]*</" + tag + "[ \t\n\r]*"), "");
  }
  return out;
}

std::vector<double> numbers_marked(const std::string& out, const std::string& mark) {
  std::vector<double> numbers;
  const std::regex pattern("<" + mark + ">([^<]*)</" + mark + ">");
  for (std::sregex_iterator at(out.begin(), out.end(), pattern), end; at != end; ++at) {
    numbers.push_back(std::stod((*at)[1]));
  }
  return numbers;
}

/// "name = value" lines.
std::map<std::string, std::string> results_in(const std::filesystem::path& file) {
  std::map<std::string, std::string> results;
  std::istringstream lines(read_bytes(file));
  for (std::string line; std::getline(lines, line);) {
    const std::size_t at = line.find(" =");
    const std::string value = line.substr(at + 2);
    results[line.substr(0, at)] = value.substr(std::min<std::size_t>(1, value.size()));
  }
  return results;
}

// ---- A scan as Slicer hands it over.

/// The axes of an oblique grid in LPS, mm per voxel; its determinant is below 0: mirrored.
constexpr std::array<Vec3, 3> kAxes{Vec3{0.72, -0.54, 0}, Vec3{-0.54, -0.72, 0}, Vec3{0, 0, 1.1}};
constexpr Vec3 kOrigin{-40, 25, -300};
constexpr Index kSize = 24;
constexpr double kRadius = 6;

Vec3 world_of(double i, double j, double k) {
  return kOrigin + i * kAxes[0] + j * kAxes[1] + k * kAxes[2];
}

/// Where the ball's middle is: not the middle of the grid, so that a wrong frame shows.
const Vec3 kCenter = world_of(11, 13, 12);

std::string vector_text(const Vec3& v) {
  std::ostringstream text;
  text << v.x << "," << v.y << "," << v.z;
  return text.str();
}

/// As ITK writes a temporary volume for Slicer: LPS, raw, little endian.
template <class Sample>
std::string slicer_nrrd(const std::string& type, double outside, double inside) {
  std::string samples;
  for (Index k = 0; k < kSize; ++k) {
    for (Index j = 0; j < kSize; ++j) {
      for (Index i = 0; i < kSize; ++i) {
        const double r = norm(world_of(i, j, k) - kCenter);
        const auto value = static_cast<Sample>(
            std::lround(outside + (inside - outside) * blurred_ball(r, kRadius, 0.7)));
        samples.append(reinterpret_cast<const char*>(&value), sizeof value);
      }
    }
  }
  const auto in_brackets = [](const Vec3& v) { return "(" + vector_text(v) + ")"; };
  return "NRRD0004\n# Complete NRRD file format specification at:\n"
         "# http://teem.sourceforge.net/nrrd/format.html\ntype: " +
         type + "\ndimension: 3\nspace: left-posterior-superior\nsizes: 24 24 24\n" +
         "space directions: " + in_brackets(kAxes[0]) + " " + in_brackets(kAxes[1]) + " " +
         in_brackets(kAxes[2]) + "\nkinds: domain domain domain\nendian: little\nencoding: raw\n" +
         "space origin: " + in_brackets(kOrigin) + "\n\n" + samples;
}

class Slicer : public testing::Test {
 protected:
  void SetUp() override { write_bytes(scan(), slicer_nrrd<std::int16_t>("short", -100, 900)); }
  std::string scan() const { return folder_ / "DEHJ_vtkMRMLScalarVolumeNodeB.nrrd"; }
  std::string model() const { return folder_ / "DEHJ_vtkMRMLModelNodeE.vtp"; }
  std::string results() const { return folder_ / "DEHJ_x7.params"; }

  /// Runs the module as Slicer does.
  ProgramRun call(std::map<std::string, Words> chosen = {}) const {
    chosen.insert({{"scan", {scan()}}, {"model", {model()}}});
    return run_program(folder_, slicer_call(description(folder_), chosen, results()));
  }
  ProgramRun segment(Words more) const {
    more.insert(more.begin(), {"segment", scan(), "-o", folder_ / "segment.vtp", "--quiet"});
    return run_program(folder_, more);
  }
  /// The mean of the model's points in Slicer's own frame: it turns what is LPS into RAS.
  Vec3 middle_in_slicer() const {
    const TriMesh surface = read_surface(model());
    Vec3 sum;
    for (const Vec3& p : surface.points) sum = sum + p;
    const Vec3 lps = (1.0 / static_cast<double>(surface.points.size())) * sum;
    return {-lps.x, -lps.y, lps.z};
  }

  TempFolder folder_;
};

// ---- The description.

TEST_F(Slicer, ReadsADescriptionAndNothingElse) {
  const ProgramRun run = run_program(folder_, {"slicer-segment", "--xml"});
  EXPECT_THAT(run.out, testing::StartsWith("<?xml version=\"1.0\""));
  EXPECT_THAT(run.out, testing::EndsWith("</executable>\n"));
  const XmlElement root = description(folder_);
  EXPECT_EQ(root.name, "executable");
  EXPECT_EQ(text_in(root, "license"), "Apache-2.0");
  EXPECT_THAT(run_program(folder_, {"slicer-segment", "--help"}).out, HasSubstr("--max_tets"));
  EXPECT_THAT(run_program(folder_, {"--help"}).out, HasSubstr("slicer-segment"));
}

TEST_F(Slicer, AcceptsTheDescriptionByItsSchema) {
  MESAMIS_REQUIRE_PROGRAM("xmllint");
  write_bytes(folder_ / "module.xml", run_program(folder_, {"slicer-segment", "--xml"}).out);
  const std::string schema = MESAMIS_SOURCE_DIR "/tests/app/slicer_module.xsd";
  const auto check = [&] {
    return run_command(folder_, {"xmllint", "--noout", "--schema", schema, folder_ / "module.xml"});
  };
  const ProgramRun good = check();
  EXPECT_EQ(good.status, 0) << good.err;
  std::string spoiled = read_bytes(folder_ / "module.xml");
  spoiled.replace(spoiled.find("<longflag>"), 10, "<longflag>-");
  write_bytes(folder_ / "module.xml", spoiled);
  EXPECT_NE(check().status, 0);
}

TEST_F(Slicer, SeesEverySettingOfTheTable) {
  std::map<std::string, XmlElement> by_name;
  for (const XmlElement& p : parameters(description(folder_))) by_name[text_in(p, "name")] = p;
  for (const Setting& setting : setting_table()) {
    const SettingValue value = setting.get({});
    if (const bool* on = std::get_if<bool>(&value)) {
      const std::string name = (*on ? "no_" : "") + setting.name;
      ASSERT_TRUE(by_name.contains(name)) << name;
      EXPECT_EQ(text_in(by_name[name], "default"), "false") << "Slicer passes only what is on";
      continue;
    }
    ASSERT_TRUE(by_name.contains(setting.name)) << setting.name;
    const XmlElement& p = by_name[setting.name];
    EXPECT_EQ(parse_value(setting, text_in(p, "default")), value) << setting.name;
    EXPECT_THAT(text_in(p, "description"), HasSubstr(setting.help)) << setting.name;
    if (const XmlElement* range = p.child("constraints")) {
      EXPECT_EQ(std::stod(text_in(*range, "minimum")), setting.low) << setting.name;
      EXPECT_EQ(std::stod(text_in(*range, "maximum")), setting.high) << setting.name;
    }
  }
  EXPECT_NE(by_name["adaptations"].child("constraints"), nullptr);
  EXPECT_EQ(by_name["level"].name, "string") << "it may be auto";
  EXPECT_EQ(by_name["solver_tolerance"].name, "string") << "Slicer would show 0.00";
}

// ---- Calls.

TEST_F(Slicer, GetsTheSurfaceOfSegmentWhereTheScanIs) {
  const ProgramRun run = call();
  ASSERT_EQ(run.status, 0) << run.err;
  EXPECT_EQ(run.err, "");
  ASSERT_EQ(segment({}).status, 0);
  EXPECT_TRUE(read_bytes(model()) == read_bytes(folder_ / "segment.vtp"));
  const Vec3 expected{-kCenter.x, -kCenter.y, kCenter.z};
  EXPECT_LT(norm(middle_in_slicer() - expected), 0.15);
  const TriMesh surface = read_surface(model());
  EXPECT_TRUE(check_surface(surface).closed());
  EXPECT_THAT(read_bytes(model()), HasSubstr("Name=\"SPACE\""));
}

TEST_F(Slicer, IsToldHowFarTheRunHasCome) {
  const ProgramRun run = call({{"max_tets", {"3000"}}});
  ASSERT_EQ(run.status, 0) << run.err;
  const std::string lines = without_marks(run.out);
  EXPECT_EQ(std::count(lines.begin(), lines.end(), '\n'), 5) << lines;
  EXPECT_THAT(lines, testing::StartsWith("mesamis: object")) << "what came out, for Slicer's log";
  const auto whole = numbers_marked(run.out, "filter-progress");
  ASSERT_GT(whole.size(), 5u);
  EXPECT_TRUE(std::is_sorted(whole.begin(), whole.end()));
  EXPECT_EQ(whole.front(), 0);
  EXPECT_EQ(whole.back(), 1);
  for (const double share : numbers_marked(run.out, "filter-stage-progress")) {
    EXPECT_TRUE(share >= 0 && share <= 1) << share;
  }
  const auto count = [&](const std::string& tag) {
    std::size_t n = 0;
    for (std::size_t at = 0; (at = run.out.find(tag, at)) != std::string::npos; ++at) ++n;
    return n;
  };
  EXPECT_GT(count("<filter-start>"), 4u);
  EXPECT_EQ(count("<filter-start>"), count("</filter-end>"));
  EXPECT_EQ(numbers_marked(run.out, "filter-time").size(), count("<filter-end>"));
  EXPECT_THAT(run.out, HasSubstr("<filter-comment>preparation</filter-comment>"));
}

TEST_F(Slicer, ReadsTheFiguresOfARun) {
  ASSERT_EQ(call({{"preview", {"true"}}, {"report", {folder_ / "r.json"}}}).status, 0);
  const auto report = nlohmann::json::parse(read_bytes(folder_ / "r.json"));
  const auto figures = results_in(results());
  ASSERT_EQ(figures.size(), 7u);
  EXPECT_EQ(figures.at("result_objects"), "1");
  EXPECT_EQ(std::stoul(figures.at("result_triangles")), read_surface(model()).triangles.size());
  EXPECT_DOUBLE_EQ(std::stod(figures.at("result_volume_cm3")),
                   report["surface"]["volume_mm3"].get<double>() / 1000);
  EXPECT_DOUBLE_EQ(std::stod(figures.at("result_level")), report["surface"]["level_native"]);
  EXPECT_EQ(figures.at("result_outcome"), "converged");
}

TEST_F(Slicer, GetsLabelMapTetrahedraAndExpectedError) {
  const std::string labels = folder_ / "l.nrrd", mesh = folder_ / "m.vtu";
  const ProgramRun run =
      call({{"labelmap", {labels}}, {"mesh", {mesh}}, {"error", {"true"}}, {"max_tets", {"3000"}}});
  ASSERT_EQ(run.status, 0) << run.err;
  const auto marks = read_label_map(labels, {});
  EXPECT_EQ(marks.map.size, (std::array<Index, 3>{kSize, kSize, kSize}));
  EXPECT_NEAR(marks.map.origin.x, kOrigin.x, 1e-9);
  EXPECT_GT(read_vtu(mesh).mesh.cells.size(), 1000u);
  EXPECT_THAT(read_bytes(model()), HasSubstr("Name=\"expected_error\""));
}

TEST_F(Slicer, ChoosesByLabelsSeedsAndRegions) {
  const std::string labels = folder_ / "DEHJ_vtkMRMLLabelMapVolumeNodeB.nrrd";
  write_bytes(labels, slicer_nrrd<std::int16_t>("short", 0, 1));
  ProgramRun run = call({{"labels", {labels}}, {"label", {"1"}}, {"error", {"true"}}});
  ASSERT_EQ(run.status, 0) << run.err;
  EXPECT_THAT(run.err, HasSubstr("warning: --error"));
  EXPECT_EQ(results_in(results()).at("result_objects"), "1");
  EXPECT_EQ(results_in(results()).at("result_level"), "");

  run = call({{"seed", {vector_text(kCenter)}}, {"preview", {"true"}}});
  EXPECT_EQ(run.status, 0) << run.err;

  // Half of the ball: Slicer gives centre and half sizes, and a matrix where it is rotated.
  const std::string half = vector_text(kCenter + Vec3{0, 0, 20}) + ",30,30,20";
  run = call({{"region", {half}}, {"preview", {"true"}}});
  ASSERT_EQ(run.status, 0) << run.err;
  const std::string whole_file = read_bytes(model());
  EXPECT_GT(middle_in_slicer().z, kCenter.z + 1);
  run = call({{"region", {vector_text(kCenter + Vec3{0, 0, 20}) + ",20,30,30,0,0,-1,0,1,0,1,0,0"}},
              {"preview", {"true"}}});
  ASSERT_EQ(run.status, 0) << run.err;
  EXPECT_TRUE(read_bytes(model()) == whole_file) << "the same box, turned by a right angle";
}

TEST_F(Slicer, TakesUntouchedValuesForNone) {
  write_bytes(folder_ / "s.json", R"({"max_tets": 3000, "adaptations": 2})");
  const ProgramRun run = call({{"settings", {folder_ / "s.json"}},
                               {"report", {folder_ / "r.json"}},
                               {"no_follow", {"true"}}});
  ASSERT_EQ(run.status, 0) << run.err;
  const auto report = nlohmann::json::parse(read_bytes(folder_ / "r.json"));
  EXPECT_EQ(report["settings"]["max_tets"], 3000);
  EXPECT_EQ(report["settings"]["adaptations"], 2);
  EXPECT_EQ(report["settings"]["follow"], false);
}

TEST_F(Slicer, LoadsWhatHasNotConvergedWithAWarning) {
  const ProgramRun run = call({{"time_limit", {"0.001"}}});
  EXPECT_EQ(run.status, 0) << "Slicer loads nothing of another status";
  EXPECT_EQ(run.error_lines(), 1u);
  EXPECT_THAT(run.err, HasSubstr("not converged"));
  EXPECT_EQ(results_in(results()).at("result_outcome"), "not converged");
  EXPECT_FALSE(read_surface(model()).triangles.empty());
}

TEST_F(Slicer, IsToldInOneLineWhatIsWrong) {
  const auto fails = [&](std::map<std::string, Words> chosen, int status, const char* words) {
    const ProgramRun run = call(std::move(chosen));
    EXPECT_EQ(run.status, status);
    EXPECT_EQ(run.error_lines(), 1u) << run.err;
    EXPECT_THAT(run.err, HasSubstr(words));
    EXPECT_FALSE(std::filesystem::exists(model()));
    EXPECT_FALSE(std::filesystem::exists(results()));
  };
  fails({{"level", {"5x"}}}, 2, "--level: expected X|auto|local, found '5x'");
  fails({{"max_tets", {"1"}}}, 2, "--max_tets: expected 100 to");
  fails({{"margin", {"wide"}}}, 2, "--margin: expected a number above 0, found 'wide'");
  fails({{"region", {"1,2,3"}}}, 2, "--region: expected 6 numbers");
  fails({{"tissue", {"bone"}}, {"values", {"1:2"}}}, 2, "--values: expected --tissue bright");
  fails({{"modality", {"US"}}}, 2, "modality");
  fails({{"tissue", {"bone"}}, {"modality", {"MR"}}}, 3, "tissue: expected a CT scan");
  fails({{"scan", {folder_ / "none.nrrd"}}}, 3, "none.nrrd");
  fails({{"level", {"5000"}}}, 3, "level");
  EXPECT_FAILS(run_program(folder_, {"slicer-segment", scan()}), 2, "expected a scan and a model");
  const std::string bytes = read_bytes(scan());
  for (const std::string& over : {std::string(scan()), std::string(model())}) {
    EXPECT_EQ(run_program(folder_, {"slicer-segment", scan(), model(), "--preview",
                                    "--returnparameterfile", over})
                  .status,
              2);
  }
  EXPECT_EQ(read_bytes(scan()), bytes);
  EXPECT_FAILS(run_program(folder_, {"slicer-segment", scan(), "m.xyz"}), 2, ".vtp");
}

/// The installed folder: the script of the build, beside a program in another tree.
TEST_F(Slicer, FindsTheProgramFromTheFolderOfModules) {
  namespace fs = std::filesystem;
  const fs::path module = folder_ / "moved/share/mesamis/slicer/MesamisSegment";
  fs::create_directories(module.parent_path());
  fs::create_directories(folder_ / "moved/bin");
  fs::copy_file(fs::path(MESAMIS_PROGRAM).parent_path() / "app/slicer/MesamisSegment", module);
  fs::create_symlink(MESAMIS_PROGRAM, folder_ / "moved/bin/mesamis");
  EXPECT_EQ(module.filename().string().find('.'), std::string::npos)
      << "Slicer takes no name with a dot for a module";
  setenv("LD_LIBRARY_PATH", (folder_ / "libraries of Slicer").c_str(), 1);
  const ProgramRun run = run_command(folder_, {module, "--xml"});
  unsetenv("LD_LIBRARY_PATH");
  EXPECT_EQ(run.status, 0) << run.err;
  EXPECT_EQ(run.out, run_program(folder_, {"slicer-segment", "--xml"}).out);
}

/// What VTK, and with it Slicer, makes of the file: the frame as text in the field data.
TEST_F(Slicer, ReadsTheFrameThroughVtk) {
  const std::string python = "/usr/bin/python3";
  if (run_command(folder_, {python, "-c", "import vtkmodules.vtkIOXML"}).status != 0) {
    GTEST_SKIP() << "python3-vtk9 is not installed";
  }
  ASSERT_EQ(call({{"preview", {"true"}}}).status, 0);
  const ProgramRun run =
      run_command(folder_, {python, "-c",
                            "import sys\n"
                            "from vtkmodules.vtkIOXML import vtkXMLPolyDataReader\n"
                            "reader = vtkXMLPolyDataReader()\n"
                            "reader.SetFileName(sys.argv[1])\n"
                            "reader.Update()\n"
                            "mesh = reader.GetOutput()\n"
                            "print(mesh.GetFieldData().GetAbstractArray('SPACE').GetValue(0),"
                            " mesh.GetNumberOfPolys())\n",
                            model()});
  EXPECT_EQ(run.out, "LPS " + std::to_string(read_surface(model()).triangles.size()) + "\n")
      << run.err;
}

}  // namespace
}  // namespace mesamis
