// SPDX-License-Identifier: Apache-2.0
#include "mesamis/page/run_page.h"

#include <gmock/gmock.h>

#include <nlohmann/json.hpp>
#include <regex>

#include "page/sample_run.h"
#include "support/temp_folder.h"
#include "support/throws.h"

namespace mesamis {
namespace {

using nlohmann::json;
using testing::HasSubstr;
using testing::Not;

std::string unescaped(std::string text) {
  for (const auto& [entity, character] :
       {std::pair{"&quot;", "\""}, {"&lt;", "<"}, {"&gt;", ">"}, {"&#39;", "'"}, {"&amp;", "&"}}) {
    text = std::regex_replace(text, std::regex(entity), character);
  }
  return text;
}

/// The beginnings of what follows a text, wherever it occurs.
std::vector<std::string> after_each(const std::string& page, const std::string& text) {
  constexpr std::size_t kLength = 200;
  std::vector<std::string> found;
  for (std::size_t at = 0; (at = page.find(text, at)) != std::string::npos;) {
    found.push_back(page.substr(at += text.size(), kLength));
  }
  return found;
}

/// The page of the sample, made once.
const std::string& sample_page() {
  static const SampleRun run;
  static const std::string page = run_page(run.page());
  return page;
}

/// Without the data and the script of the viewer.
std::string own_part(const std::string& page) {
  return page.substr(0, page.find("id=\"scan-copy\""));
}

TEST(RunPage, ItsNumbersAreThoseOfTheReport) {
  const json report = sample_report();
  const std::string page = own_part(sample_page());
  static const std::regex datum("<data value=\"([^\"]{0,200})\" data-of=\"([^\"]{0,99})\">");
  int seen = 0;
  for (std::sregex_iterator m(page.begin(), page.end(), datum), end; m != end; ++m) {
    const std::string pointer = unescaped((*m)[2]);
    const json::json_pointer at(pointer);
    const json value = json::parse(unescaped((*m)[1]));
    if (pointer == "/input/path" || pointer.find("warnings") != std::string::npos) continue;
    EXPECT_EQ(value, report.contains(at) ? report.at(at) : json()) << pointer;
    ++seen;
  }
  EXPECT_GT(seen, 50);
}

TEST(RunPage, LeadsNowhereAndNamesNobody) {
  const std::string &page = sample_page(), own = own_part(page);
  EXPECT_THAT(own, HasSubstr("default-src &#39;none&#39;"));
  for (const char* attribute : {" src=\"", " href=\""}) {
    for (const std::string& link : after_each(own, attribute)) {
      EXPECT_TRUE(link.starts_with("data:") || link.starts_with("#")) << link;
    }
  }
  EXPECT_EQ(page.find("UNMISTAKABLE"), std::string::npos);
  EXPECT_EQ(own.find("/home/"), std::string::npos);
  EXPECT_EQ(own.find("33.256789"), std::string::npos) << "the time it took";
  EXPECT_LT(page.size(), kLargestPage);
}

TEST(RunPage, ShowsNamesWhereTheyAreAskedFor) {
  const SampleRun run;
  RunPage page = run.page();
  page.names = true;
  EXPECT_THAT(own_part(run_page(page)), HasSubstr("UNMISTAKABLE NAME/scan.nii.gz"));
}

TEST(RunPage, HostileNamesStayText) {
  const SampleRun run;
  RunPage page = run.page();
  const std::string hostile =
      "</script><script>alert(1)</script><img src=x onerror=alert(1)>\" onload=\"";
  page.report["input"]["format"] = hostile;
  page.report["warnings"] = {hostile};
  page.report["chosen"]["gamma"] = hostile;  // as reports were once
  page.report["chosen"]["max_tets"]["reason"] = hostile;
  page.report["verdict"] = {{"kept", false}, {"message", hostile}};
  page.report["settings"]["gamma"] = hostile;
  page.report["command"] = {"segment", "x", "--label", hostile};
  page.surfaces[0].name = hostile;
  page.surfaces.push_back({&run.surface, hostile, {}});
  for (const bool names : {false, true}) {
    page.names = names;
    const std::string text = own_part(run_page(page));
    EXPECT_THAT(text, Not(HasSubstr("<script>alert")));
    EXPECT_THAT(text, Not(HasSubstr("<img src=x")));
    EXPECT_THAT(text, Not(HasSubstr("\" onload=\"")));
    EXPECT_THAT(text, HasSubstr("&lt;script&gt;alert(1)"));
  }
}

TEST(RunPage, IsTheSameEveryTimeWhateverTheRunCost) {
  const SampleRun run;
  RunPage other = run.page();
  other.report["seconds"] = 99;
  other.report["output"]["threads"] = 64;
  EXPECT_TRUE(sample_page() == run_page(other));
}

TEST(RunPage, IsForKeyboardsAndScreenReaders) {
  const std::string page = own_part(sample_page());
  EXPECT_THAT(page, HasSubstr("<html lang=\"en\">"));
  EXPECT_THAT(page, HasSubstr("href=\"#main\">Skip to the content"));
  for (const std::string& picture : after_each(page, "<img ")) {
    EXPECT_TRUE(picture.starts_with("alt=\"")) << picture;
  }
  for (const std::string& svg : after_each(page, "<svg "))
    EXPECT_THAT(svg, HasSubstr("role=\"img\""));
  for (const std::string& table : after_each(page, "<table"))
    EXPECT_THAT(table, HasSubstr("<caption"));
}

TEST(RunPage, OfAReportAloneSaysSo) {
  const std::string page = run_page({sample_report()});
  EXPECT_THAT(page, HasSubstr("Neither scan nor surface"));
  EXPECT_THAT(page, Not(HasSubstr("<canvas")));
  for (const char* text :
       {"{}", R"(["a"])", R"({"object": {"surfaces": [1, 2]}, "iterations": [3]})",
        R"({"iterations": 3, "object": 3, "input": "x", "given": 5})"}) {
    EXPECT_NO_THROW(run_page({json::parse(text)})) << text;
  }
}

TEST(RunPage, HasTheViewerWithItsData) {
  for (const char* part : {"id=\"axial\"", "id=\"space\"", "id=\"scan-copy\"", "id=\"surface-0\"",
                           "\"unit\":\"HU\"", "data-window=\"[-450,1050]\""}) {
    EXPECT_NE(sample_page().find(part), std::string::npos) << part;
  }
  EXPECT_EQ(sample_page().find("id=\"errors\""), std::string::npos) << "none are known";
  const SampleRun run;
  RunPage page = run.page();
  const std::vector<double> error(run.surface.points.size(), 0.25);
  page.surfaces[0].error = error;
  const std::string text = run_page(page);
  EXPECT_NE(text.find("expected error as colours"), std::string::npos);
  EXPECT_NE(text.find("\"error_mm\":0.25"), std::string::npos);
}

TEST(RunPage, AScanThatIsACtByItsValuesHasHounsfieldUnits) {
  SampleRun run;
  for (float& value : run.scan.samples) value = value > 150 ? 400 : -1000;
  RunPage page = run.page();
  page.report["input"]["modality"] = "";
  page.surfaces.clear();
  page.mesh = nullptr;
  EXPECT_NE(run_page(page).find("\"unit\":\"HU\""), std::string::npos);
  for (float& value : run.scan.samples) value = value < 0 ? 10 : value;
  EXPECT_NE(run_page(page).find("\"unit\":\"native units\""), std::string::npos);
}

TEST(RunPage, LeavesOutViewerThenPicturesToStaySmall) {
  const SampleRun run;
  RunPage page = run.page();
  page.most = 4000;
  const std::string texts = run_page(page);
  EXPECT_THAT(texts, HasSubstr("ictures are left out: with them"));
  EXPECT_THAT(texts, Not(HasSubstr("<img ")));
  EXPECT_THAT(texts, Not(HasSubstr("<canvas")));
  EXPECT_THAT(texts, HasSubstr("/surface/triangles"));
  page.most = own_part(sample_page()).size() + 10'000;
  const std::string pictures = run_page(page);
  EXPECT_THAT(pictures, HasSubstr("The viewer is left out: with it"));
  EXPECT_THAT(pictures, HasSubstr("<img "));
  EXPECT_THAT(pictures, Not(HasSubstr("<canvas")));
  EXPECT_LT(pictures.size(), page.most);
  EXPECT_THAT(sample_page(), Not(HasSubstr("id=\"left-out\"")));
}

TEST(WriteRunPage, AppearsWholeOrNotAtAll) {
  const TempFolder folder;
  const SampleRun run;
  write_run_page(folder / "a.html", run.page());
  EXPECT_TRUE(read_bytes(folder / "a.html") == sample_page());
  EXPECT_REFUSED(write_run_page(folder / "none/a.html", run.page()), HasSubstr("none"));
}

}  // namespace
}  // namespace mesamis
