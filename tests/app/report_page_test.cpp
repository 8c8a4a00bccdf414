// SPDX-License-Identifier: Apache-2.0
// Pages of runs: what they say, what is refused, and how a browser shows them.
#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <nlohmann/json.hpp>
#include <numbers>
#include <regex>

#include "mesamis/label_files/read_labels.h"
#include "mesamis/label_files/write_labels.h"
#include "support/external_program.h"
#include "support/png_pixels.h"
#include "support/run_program.h"

namespace mesamis {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using testing::HasSubstr;
using testing::Not;

/// A sphere, its surface, mesh and report: one run for all tests.
class ReportPageTest : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    folder_ = std::make_unique<TempFolder>();
    run_program(*folder_,
                {"phantom", "sphere", "--size", "24,24,24", "--noise", "3", "-o", at("scan.nrrd")});
    const ProgramRun made = run_program(
        *folder_, {"segment", at("scan.nrrd"), "-o", at("a.ply"), "--mesh", at("a.vtu"), "--report",
                   at("a.json"), "--html", at("a.html"), "--pictures", at("pictures"), "--labelmap",
                   at("labels.nrrd"), "--error", "--max-tets", "4000", "--adaptations", "2"});
    ASSERT_THAT(made.status, testing::AnyOf(0, 4)) << made.err;
  }
  static void TearDownTestSuite() { folder_.reset(); }
  static std::string at(const std::string& name) { return *folder_ / name; }
  static json report() { return json::parse(read_bytes(at("a.json"))); }

  static std::unique_ptr<TempFolder> folder_;
};

std::unique_ptr<TempFolder> ReportPageTest::folder_;

bool holds(const std::string& page, const std::string& text) {
  return page.find(text) != std::string::npos;
}

/// The exact value that a page has of an entry of the report.
std::string value_of(const std::string& page, const std::string& pointer) {
  const std::size_t at = page.find("data-of=\"" + pointer + "\"");
  if (at == std::string::npos) return {};
  const std::size_t begin = page.rfind("value=\"", at) + 7;
  return page.substr(begin, page.find('"', begin) - begin);
}

TEST_F(ReportPageTest, HasTheNumbersOfTheReportAndIsMadeOfItAgain) {
  const std::string page = read_bytes(at("a.html"));
  const json facts = report();
  for (const char* pointer : {"/surface/triangles", "/surface/volume_mm3", "/surface/level_native",
                              "/mesh/tets", "/quality/noise", "/quality/expected_error_mm/mean"}) {
    EXPECT_EQ(value_of(page, pointer), facts.at(json::json_pointer(pointer)).dump()) << pointer;
  }
  EXPECT_LT(page.size(), 10'000'000u);
  EXPECT_EQ(facts["command"][0], "segment");
  EXPECT_TRUE(facts["warnings"].is_array());
  EXPECT_TRUE(facts["verdict"]["kept"].is_boolean());
  std::vector<std::string> listed;
  for (const json& file : facts["files"]) listed.push_back(fs::path(file["path"]).filename());
  EXPECT_THAT(listed, testing::IsSupersetOf({"a.html", "mesh-cut.png", "slice-axial.png"}));
  const ProgramRun run = run_program(*folder_, {"report", at("a.json"), "--html", at("b.html")});
  EXPECT_EQ(run.status, 0) << run.err;
  EXPECT_EQ(run.err, "");
  // A .ply holds every bit of the points.
  EXPECT_TRUE(read_bytes(at("b.html")) == read_bytes(at("a.html")));
  EXPECT_FALSE(holds(read_bytes(at("a.html")), at("scan.nrrd")));
  run_program(*folder_, {"report", at("a.json"), "--html", at("c.html"), "--html-names"});
  EXPECT_TRUE(holds(read_bytes(at("c.html")), at("scan.nrrd")));
}

TEST_F(ReportPageTest, TakesTheFilesOfTheRunAndNoOthers) {
  json moved = report();
  const std::string gone = "/nowhere/";
  moved["input"]["path"] = gone + "scan.nrrd";
  for (json& file : moved["files"]) {
    file["path"] = gone + fs::path(file["path"]).filename().string();
  }
  fs::create_directory(at("other"));
  for (const char* name : {"scan.nrrd", "a.ply", "a.vtu"}) {
    fs::copy_file(at(name), at(std::string("other/") + name));
  }
  write_bytes(at("other/r.json"), moved.dump());
  const ProgramRun run =
      run_program(*folder_, {"report", at("other/r.json"), "--html", at("b.html")});
  EXPECT_EQ(run.status, 0) << run.err;
  EXPECT_TRUE(holds(read_bytes(at("b.html")), "<canvas"));
  fs::remove(at("other/scan.nrrd"));
  const ProgramRun without =
      run_program(*folder_, {"report", at("other/r.json"), "--html", at("c.html")});
  EXPECT_EQ(without.status, 0);
  EXPECT_THAT(without.err, HasSubstr("/nowhere/scan.nrrd: not found"));
  EXPECT_FALSE(holds(read_bytes(at("c.html")), "<canvas"));
  const std::string page = at("d.html");
  json other = report();
  other["files"][0]["sha256"] = std::string(64, '0');
  write_bytes(at("other.json"), other.dump());
  EXPECT_FAILS(run_program(*folder_, {"report", at("other.json"), "--html", page}), 3,
               "a.ply: expected the file of the run");
  EXPECT_FAILS(
      run_program(*folder_, {"report", at("a.json"), "--html", page, "--scan", at("a.vtu")}), 3,
      "a.vtu");
  write_bytes(at("x.json"), "{\"program\": {\"name\": \"mesamis\"}}");
  EXPECT_FAILS(run_program(*folder_, {"report", at("x.json"), "--html", page}), 3,
               "expected the report of a run of segment");
  EXPECT_FAILS(run_program(*folder_, {"report", at("a.json")}), 2, "expected --html or --pictures");
  EXPECT_FAILS(run_program(*folder_, {"report", at("a.json"), "--html", at("b.pdf")}), 2, ".html");
  EXPECT_FAILS(run_program(*folder_, {"report", at("a.json"), "--pictures", at("a.json")}), 3,
               "a folder");
  EXPECT_FAILS(run_program(*folder_, {"segment", at("scan.nrrd"), "--html", at("none/b.html")}), 3,
               "there is no folder");
  EXPECT_FALSE(fs::exists(page));
}

TEST(ReportPage, OfAReportOfAnotherShapeIsRefusedInOneLine) {
  const TempFolder folder;
  const std::string file = folder / "r.json", page = folder / "r.html";
  const std::string head = R"({"program": {"name": "mesamis"}, "surface": {}, )";
  for (const auto& [text, entry] :
       {std::pair<std::string, std::string>{head + R"("iterations": 3})", "/iterations"},
        {head + R"("iterations": [3]})", "/iterations"},
        {head + R"("output": "x"})", "/output"},
        {head + R"("body": 3})", "/body"},
        {head + R"("input": []})", "/input"},
        {head + R"("files": {"path": "x"}})", "/files"},
        {head + R"("object": {"surfaces": [1, 2]}})", "/object/surfaces"},
        {R"({"program": {"name": "mesamis"}, "surface": [1]})", "/surface"},
        {R"(["a"])", "report of a run"}}) {
    write_bytes(file, text);
    EXPECT_FAILS(run_program(folder, {"report", file, "--html", page}), 3, entry);
    EXPECT_FALSE(fs::exists(page));
  }
  write_bytes(file, head + R"("body": null, "files": null, "verdict": {"message": 3}})");
  EXPECT_EQ(run_program(folder, {"report", file, "--html", page}).status, 0);
}

TEST_F(ReportPageTest, ShowsObjectsInTheirColours) {
  const ProgramRun run =
      run_program(*folder_, {"segment", at("scan.nrrd"), "--labels", at("labels.nrrd"), "-o",
                             at("all.vtp"), "--report", at("r.json"), "--html", at("l.html")});
  EXPECT_EQ(run.status, 0) << run.err;
  const std::string page = read_bytes(at("l.html"));
  const json facts = json::parse(read_bytes(at("r.json")));
  EXPECT_EQ(value_of(page, "/object/surfaces/0/triangles"),
            facts["object"]["surfaces"][0]["triangles"].dump());
  EXPECT_TRUE(holds(page, "labelled objects"));
}

TEST_F(ReportPageTest, OfLabelsIsMadeAgainToTheByteToo) {
  LabelFile file = read_label_map(at("labels.nrrd"), {});
  LabelMap& map = file.map;
  for (std::size_t n = 0; n < map.layers[0].size(); ++n) {
    const bool right = n % static_cast<std::size_t>(map.size[0]) > 11;
    if (map.layers[0][n] != 0 && right) map.layers[0][n] = 2;
  }
  map.segments.push_back({"right", 2, 0, {200, 100, 50}});
  write_label_map(at("two.nrrd"), map);
  const ProgramRun made = run_program(
      *folder_, {"segment", at("scan.nrrd"), "--labels", at("two.nrrd"), "-o", at("two.ply"),
                 "--error", "--report", at("two.json"), "--html", at("two.html")});
  EXPECT_EQ(made.status, 0) << made.err;
  const ProgramRun run =
      run_program(*folder_, {"report", at("two.json"), "--html", at("again.html")});
  EXPECT_EQ(run.status, 0) << run.err;
  EXPECT_TRUE(read_bytes(at("again.html")) == read_bytes(at("two.html")));
}

TEST_F(ReportPageTest, RefusesShapesThatTheUserNamesButTheRunDidNotWrite) {
  fs::create_directory(at("theirs"));
  for (const char* name : {"a.ply", "a.vtu"}) {
    const std::string option = std::string(name) == "a.ply" ? "--surface" : "--mesh";
    const auto page_with = [&](const std::string& file) {
      return run_program(*folder_,
                         {"report", at("a.json"), "--html", at("named.html"), option, file});
    };
    EXPECT_EQ(page_with(at(name)).status, 0);
    fs::remove(at("named.html"));
    const std::string other = at(std::string("theirs/") + name);
    write_bytes(other, read_bytes(at(name)) + " ");
    EXPECT_FAILS(page_with(other), 3, "expected a file of the run, found another one");
    EXPECT_FALSE(fs::exists(at("named.html")));
  }
}

/// Starts a browser without a window on a page.
/// @return what it wrote to stdout and stderr.
ProgramRun browse(const TempFolder& folder, const std::string& page,
                  std::vector<std::string> more) {
  const std::string browser =
      is_installed("chromium-headless-shell") ? "chromium-headless-shell" : "chromium";
  std::vector<std::string> command{"timeout",
                                   "120",
                                   browser,
                                   "--headless",
                                   "--no-sandbox",
                                   "--use-gl=angle",
                                   "--use-angle=swiftshader",
                                   "--enable-unsafe-swiftshader",
                                   "--virtual-time-budget=30000",
                                   "--user-data-dir=" + (folder / "profile").string(),
                                   "--disable-background-networking",
                                   "--disable-component-update",
                                   "--disable-sync",
                                   "--no-first-run",
                                   "--enable-logging=stderr",
                                   "--hide-scrollbars"};
  command.insert(command.end(), more.begin(), more.end());
  command.push_back("file://" + page);
  return run_command(folder, command);
}

/// What the page said, or the browser of it.
std::vector<std::string> console_lines(const std::string& err) {
  std::vector<std::string> lines;
  std::istringstream in(err);
  for (std::string line; std::getline(in, line);) {
    if (line.find("CONSOLE") != std::string::npos) lines.push_back(line.substr(0, 300));
  }
  return lines;
}

#define MESAMIS_REQUIRE_BROWSER()                                                \
  if (!is_installed("chromium-headless-shell") && !is_installed("chromium")) {   \
    GTEST_SKIP() << "neither chromium-headless-shell nor chromium is installed"; \
  }                                                                              \
  static_assert(true)

/// The addresses outside of the file that the browser asked for, but for those that newer ones ask
/// for themselves, whatever they are told: the time, updates, a dictionary, who is logged in. Such
/// requests are of no origin; the page's are found, whatever they ask for.
std::string outside_requests(const std::string& net_log) {
  static const std::regex outside(
      R"re("url":"(https?|wss?|ftp)://)re"
      R"re((?!(clients2\.google|update\.googleapis|redirector\.gvt1|accounts\.google)\.com/))re"
      R"re([^"]{0,200})re"),
      of_page(
          R"re("initiator":"(?!not an origin")[^\n]{0,900}"url":"(https?|wss?|ftp):[^"]{0,200})re");
  std::smatch found;
  const bool any =
      std::regex_search(net_log, found, outside) || std::regex_search(net_log, found, of_page);
  return any ? found.str() : "";
}

using IsColour = bool (*)(const PngPixels::Colour&);

bool is_outline(const PngPixels::Colour& c) {
  return c.r > 200 && c.g > 90 && c.g < 190 && c.b < 90;
}

/// A rectangle of a picture, pixels.
struct Panel {
  std::size_t left, right, top, bottom;
};

std::size_t count(const PngPixels& image, const Panel& panel, IsColour is) {
  std::size_t found = 0;
  for (std::size_t y = panel.top; y < panel.bottom; ++y) {
    for (std::size_t x = panel.left; x < panel.right; ++x) found += is(image.at(x, y));
  }
  return found;
}

/// Where pixels of a colour lie within a panel.
Panel extent(const PngPixels& image, const Panel& panel, IsColour is) {
  Panel found{panel.right, panel.left, panel.bottom, panel.top};
  for (std::size_t y = panel.top; y < panel.bottom; ++y) {
    for (std::size_t x = panel.left; x < panel.right; ++x) {
      if (!is(image.at(x, y))) continue;
      found = {std::min(found.left, x), std::max(found.right, x), std::min(found.top, y),
               std::max(found.bottom, y)};
    }
  }
  return found;
}

/// Whether no ray from the middle of an outline leaves it without meeting it: it has no gap.
bool is_continuous(const PngPixels& image, const Panel& outline, IsColour is) {
  const double mid_x = 0.5 * static_cast<double>(outline.left + outline.right),
               mid_y = 0.5 * static_cast<double>(outline.top + outline.bottom);
  const double reach = 0.75 * static_cast<double>(outline.right - outline.left);
  for (int ray = 0; ray < 360; ++ray) {
    const double angle = ray * std::numbers::pi / 180;
    bool met = false;
    for (double r = reach / 3; r < reach && !met; r += 0.5) {
      met = is(image.at(static_cast<std::size_t>(mid_x + r * std::cos(angle)),
                        static_cast<std::size_t>(mid_y + r * std::sin(angle))));
    }
    if (!met) return false;
  }
  return true;
}

/// The panels of the viewer as the page lays them out: "left right top bottom", written by a script
/// at the end of a copy of the page.
std::vector<Panel> panels_of(const std::string& dom) {
  static const std::regex place("data-place=\"([0-9]+) ([0-9]+) ([0-9]+) ([0-9]+)\"");
  std::vector<Panel> panels;
  for (std::sregex_iterator at(dom.begin(), dom.end(), place), end; at != end; ++at) {
    const auto number = [&](std::size_t n) {
      return static_cast<std::size_t>(std::stoul((*at)[n].str()));
    };
    panels.push_back({number(1), number(2), number(3), number(4)});
  }
  return panels;
}

constexpr const char* kTellPlaces = R"html(<script>
setInterval(() => { for (const p of document.querySelectorAll(".panel")) {
  const r = p.getBoundingClientRect(); scrollTo(0, 0);
  p.dataset.place = [r.left, r.right, r.top, r.bottom].map(Math.round).join(" ");
} }, 50);
</script>)html";

/// How a page looks in a window.
struct Shot {
  ProgramRun run;
  PngPixels image;
  std::vector<Panel> panels;  ///< axial, coronal, sagittal, in space
};

Shot shot_of(const TempFolder& folder, const std::string& page, const std::string& size,
             std::vector<std::string> more = {}) {
  const std::string copy = folder / "copy.html", shot = folder / "shot.png";
  write_bytes(copy, read_bytes(page) + kTellPlaces);
  more.insert(more.end(), {"--screenshot=" + shot, "--window-size=" + size, "--dump-dom"});
  ProgramRun run = browse(folder, copy, more);
  const std::string png = read_bytes(shot);
  std::vector<Panel> panels = panels_of(run.out);
  return {std::move(run), PngPixels(png), std::move(panels)};
}

TEST_F(ReportPageTest, ABrowserDrawsOutlinesOnThreeSlicesAndAsksForNothing) {
  MESAMIS_REQUIRE_BROWSER();
  const std::string net = at("net.json");
  const Shot shot = shot_of(*folder_, at("a.html"), "1600,1000", {"--log-net-log=" + net});
  ASSERT_EQ(shot.run.status, 0) << shot.run.err;
  EXPECT_THAT(console_lines(shot.run.err), testing::IsEmpty());
  EXPECT_TRUE(holds(shot.run.out, "data-ready=\"yes\"")) << "every volume and surface was taken";
  const std::string requests = read_bytes(net);
  EXPECT_TRUE(holds(requests, "\"events\""));
  EXPECT_EQ(outside_requests(requests), "");
  ASSERT_EQ(shot.panels.size(), 4u);
  for (std::size_t slice = 0; slice < 3; ++slice) {
    const Panel& panel = shot.panels[slice];
    const Panel outline = extent(shot.image, panel, is_outline);
    EXPECT_GT(outline.bottom - outline.top, (panel.right - panel.left) / 2) << "on the object";
    EXPECT_TRUE(is_continuous(shot.image, outline, is_outline)) << slice;
  }
  const auto is_surface = [](const PngPixels::Colour& c) { return c.r > c.g && c.g > c.b + 20; };
  EXPECT_GT(count(shot.image, shot.panels[3], is_surface), 10'000u) << "the surface in space";
  EXPECT_LT(shot.panels[0].left, 60u) << "the whole width is used";
  EXPECT_GT(shot.panels[3].right, 1540u);
}

/// So that the test above could fail: also where a page asks those whom the browser asks itself.
TEST_F(ReportPageTest, ABrowserTellsOfPagesThatAsk) {
  MESAMIS_REQUIRE_BROWSER();
  for (const std::string address : {"http://localhost:9/a.png", "http://update.googleapis.com/a"}) {
    const std::string page = at("asks.html"), net = at("asks.json");
    write_bytes(page, "<img src='" + address + "'>");
    ASSERT_EQ(browse(*folder_, page, {"--dump-dom", "--log-net-log=" + net}).status, 0);
    EXPECT_THAT(outside_requests(read_bytes(net)), testing::HasSubstr(address));
  }
}

TEST_F(ReportPageTest, OnAPhonePanelsLieOneBelowAnother) {
  MESAMIS_REQUIRE_BROWSER();
  const Shot shot = shot_of(*folder_, at("a.html"), "500,2600");
  ASSERT_EQ(shot.panels.size(), 4u);
  for (std::size_t n = 1; n < 4; ++n) {
    EXPECT_GE(shot.panels[n].top, shot.panels[n - 1].bottom);
    EXPECT_LE(shot.panels[n].right, 500u);
  }
  EXPECT_GT(count(shot.image, shot.panels[0], is_outline), 300u);
}

}  // namespace
}  // namespace mesamis
