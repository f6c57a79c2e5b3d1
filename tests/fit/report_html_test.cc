// SPDX-License-Identifier: Apache-2.0
// The report as a page holds what the report as text does, asks nothing of a network, and takes no
// markup from a file.
#include "fit/result/report_html.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <pugixml.hpp>
#include <set>
#include <string>

#include "fit/fit.h"
#include "fit/result/findings.h"
#include "tests/fit/synthetic.h"

namespace skyfit::fit {
namespace {

using testing::HasSubstr;
using testing::Not;

const Result& result() {
  static const Result fitted =
      fit_atmosphere(synthetic_reference(true_atmosphere(2), 0.02), refs::standard_spectral_data(),
                     ToySky(), FitOptions{});
  return fitted;
}

// All text of a node.
std::string text_of(pugi::xml_node node) {
  std::string text = node.value();
  for (const pugi::xml_node child : node.children()) text += text_of(child) + " ";
  return text;
}

pugi::xml_document parsed(const std::string& page) {
  pugi::xml_document document;
  EXPECT_TRUE(document.load_string(page.c_str(), pugi::parse_default | pugi::parse_doctype));
  return document;
}

const ReportFigure kFigure{
    "curves",
    "<svg xmlns='http://www.w3.org/2000/svg' xmlns:xlink='http://www.w3.org/1999/xlink'><title>t"
    "</title><g id='a' clip-path='url(#b)'><use xlink:href='#a'/></g></svg>"};

TEST(ReportPage, HoldsUnknownsFindingsAndThePreset) {
  const auto document = parsed(html_report(result(), {}, {}));
  const std::string text = text_of(document);
  for (const UnknownRow& row : result().unknowns) EXPECT_THAT(text, HasSubstr(row.unknown.name()));
  for (const Finding& finding : findings(result().preset.atmosphere))
    EXPECT_THAT(text, HasSubstr(std::string(finding.name)));
  const pugi::xml_node preset = document.find_node(
      [](pugi::xml_node n) { return n.attribute("id").value() == std::string("preset"); });
  EXPECT_EQ(preset.text().get(), preset_to_json(result().preset));
}

TEST(ReportPage, AsksNothingOfANetwork) {
  std::string page = html_report(result(), {}, {{kFigure}});
  for (const std::string space : {"http://www.w3.org/2000/svg", "http://www.w3.org/1999/xlink"})
    page.erase(page.find(space), space.size());
  for (const char* link : {"http:", "https:", "src=", "@import"})
    EXPECT_THAT(page, Not(HasSubstr(link)));
}

TEST(ReportPage, NamesOfFiguresDoNotMeet) {
  const ReportFigure figures[] = {kFigure, kFigure};
  const auto document = parsed(html_report(result(), {}, figures));
  std::set<std::string> ids, links;
  int elements = 0;
  const auto collect = [&](auto&& self, pugi::xml_node node) -> void {
    if (const auto id = node.attribute("id")) {
      ++elements;
      ids.insert(id.value());
    }
    if (const auto link = node.attribute("xlink:href")) links.insert(link.value());
    for (const pugi::xml_node child : node.children()) self(self, child);
  };
  collect(collect, document);
  EXPECT_EQ(ids.size(), elements);
  EXPECT_THAT(links, testing::ElementsAre("#figure1-a", "#figure2-a"));
  EXPECT_THAT(html_report(result(), {}, figures), HasSubstr("url(#figure2-b)"));
}

TEST(ReportPage, LinksTheLiveSkyBesideIt) {
  const auto document = parsed(html_report(result(), {}, {}, "a \"sky\"#1.html"));
  const auto find = [&](const char* element) {
    return document.find_node(
        [&](pugi::xml_node node) { return node.name() == std::string(element); });
  };
  constexpr const char* kUrl = "./a%20%22sky%22%231.html";
  EXPECT_STREQ(find("a").attribute("href").value(), kUrl);
  EXPECT_STREQ(find("iframe").attribute("src").value(), kUrl);
  EXPECT_STREQ(find("iframe").attribute("loading").value(), "lazy");
  EXPECT_THAT(html_report(result(), {}, {}), Not(HasSubstr("iframe title")));
}

TEST(ReportPage, TakesNoMarkupFromNames) {
  Result hostile = result();
  hostile.preset.name = "<script>alert(1)</script>";
  hostile.reference.notes = {"</dd><img src=x onerror=alert(1)>"};
  const std::string page = html_report(hostile, {}, {});
  EXPECT_THAT(page, Not(HasSubstr("<script>alert")));
  EXPECT_THAT(page, Not(HasSubstr("<img")));
  EXPECT_THAT(text_of(parsed(page)), HasSubstr("</dd><img src=x onerror=alert(1)>"));
}

TEST(ReportPage, RefusesAFigureThatIsNoSvg) {
  const ReportFigure none{"curves", "<p>"};
  EXPECT_THROW(html_report(result(), {}, {{none}}), std::runtime_error);
}

}  // namespace
}  // namespace skyfit::fit
