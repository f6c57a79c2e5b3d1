// SPDX-License-Identifier: Apache-2.0
#include "fit/result/report_html.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <pugixml.hpp>
#include <sstream>
#include <stdexcept>
#include <string_view>
#include <vector>

#include "fit/result/findings.h"
#include "fit/result/report.h"
#include "fit/result/report_style.h"
#include "fit/result/report_words.h"
#include "model/base/counted.h"
#include "model/base/misfit.h"
#include "model/numerics/angles.h"

namespace skyfit::fit {
namespace {

using pugi::xml_node;

xml_node add(xml_node parent, const char* element, std::string_view text = {},
             const char* style_class = nullptr) {
  xml_node node = parent.append_child(element);
  if (style_class) node.append_attribute("class") = style_class;
  if (!text.empty()) node.append_child(pugi::node_pcdata).set_value(std::string(text).c_str());
  return node;
}

// Not closed as an empty element, which HTML does not have.
xml_node add_cell(xml_node row, const char* element, std::string_view text) {
  xml_node cell = row.append_child(element);
  cell.append_child(pugi::node_pcdata).set_value(std::string(text).c_str());
  return cell;
}

// A file's name as a relative URL: what is not unreserved (RFC 3986) is percent-encoded.
std::string url_of(std::string_view file) {
  std::string url;
  for (const char c : file) {
    const bool plain = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') ||
                       std::string_view("-._~").find(c) != std::string_view::npos;
    url += plain ? std::string(1, c) : fmt::format("%{:02X}", static_cast<unsigned char>(c));
  }
  return "./" + url;
}

void add_section(xml_node body, std::string_view title) { add(body, "h2", title); }

xml_node add_table(xml_node parent, const std::vector<std::string>& header) {
  xml_node table = add(add(parent, "div", {}, "wide"), "table");
  xml_node row = add(add(table, "thead"), "tr");
  for (const std::string& cell : header) add_cell(row, "th", cell);
  return add(table, "tbody");
}

xml_node add_row(xml_node table, const std::vector<std::string>& cells) {
  xml_node row = add(table, "tr");
  for (const std::string& cell : cells) add_cell(row, "td", cell);
  return row;
}

void add_summary(xml_node body, const Result& result) {
  add(body, "h1", "Fit of " + result.preset.name);
  add(body, "p", brief_report(result), result.converged ? "lead" : "lead mark");
  add_section(body, "What was fitted to what");
  xml_node list = add(body, "dl");
  const auto item = [&](std::string_view term, std::string_view text) {
    add(list, "dt", term);
    add(list, "dd", text);
  };
  item("Reference", result.reference.description);
  item("Model", fmt::format("{} ({} transfer), skyfit {}", result.model_name,
                            transfer_name(result.transfer), result.version));
  item("Started from", result.start_name);
  item("Likelihood", likelihood_text(result));
  item("Samples", samples_text(result));
  item("Solver", fmt::format("{} after {}; {:.3g} s", result.termination, effort_text(result),
                             result.wall_seconds));
  for (const std::string& note : result.reference.notes) item("Note", note);
  for (const auto& [reason, count] : result.samples_left_out)
    item("Left out", fmt::format("{}: {}", counted(count, "sample"), reason));
}

// Names in one document are unique: those of each figure get a prefix, and what refers to them too.
void prefix_names(xml_node node, const std::string& prefix) {
  for (pugi::xml_attribute a : node.attributes()) {
    std::string value = a.value();
    if (std::string_view(a.name()) == "id") value = prefix + value;
    if (value.starts_with('#') && std::string_view(a.name()).ends_with("href"))
      value.insert(1, prefix);
    if (const auto at = value.find("url(#"); at != std::string::npos) value.insert(at + 5, prefix);
    a = value.c_str();
  }
  for (xml_node child : node.children()) prefix_names(child, prefix);
}

// A page of its own, which the browser reads when it is asked for: the report stays small and
// prints.
void add_live_sky(xml_node body, const std::string& file) {
  if (file.empty()) return;
  add_section(body, "The sky, live");
  xml_node text =
      add(body, "p",
          "The fitted atmosphere by the model reference: move the sun, the observer and "
          "the fitted parameters, and measure the light. ");
  add(text, "a", file).append_attribute("href") = url_of(file).c_str();
  xml_node details = add(body, "details");
  add(details, "summary", "Show it here");
  xml_node frame = add_cell(details, "iframe", " ");  // not an empty element, which HTML closes not
  frame.append_attribute("src") = url_of(file).c_str();
  frame.append_attribute("title") = "The fitted sky";
  frame.append_attribute("loading") = "lazy";
}

void add_figures(xml_node body, std::span<const ReportFigure> figures) {
  if (figures.empty()) return;
  add_section(body, "Figures");
  for (std::size_t i = 0; i < figures.size(); ++i) {
    pugi::xml_document document;
    const auto read = document.load_string(figures[i].svg.c_str());
    xml_node svg = document.child("svg");
    if (!read || !svg)
      throw std::runtime_error(fmt::format("the figure \"{}\" is no SVG", figures[i].title));
    prefix_names(svg, fmt::format("figure{}-", i + 1));
    svg.remove_child("title");
    svg.append_attribute("role") = "img";
    svg.append_attribute("aria-label") = figures[i].title.c_str();
    xml_node figure = add(body, "figure");
    figure.append_copy(svg);
    add(figure, "figcaption", figures[i].title);
  }
}

void add_errors(xml_node body, const Result& result) {
  add_section(body, "Errors");
  xml_node table = add_table(
      body, {"", "RMS of log, %", value_name(result) + ", %", "spectral, %", "mean bias, %"});
  const auto row = [&](std::string_view name, const Errors& e) {
    add_row(table, {std::string(name), log_misfit_digits(e.rms_log, 4), number_text(e.luminance, 4),
                    number_text(e.spectral, 4), number_text(e.mean_bias, 3)});
  };
  row("all scans, at the start", result.start_errors);
  row("all scans, fitted", result.errors);
  for (std::size_t s = 0; s < result.scans.size(); ++s)
    row(scan_name(result, s), result.scans[s].errors);
  add(body, "p", errors_meaning(result), "small");
  if (!result.irradiances.empty()) {
    xml_node beside = add_table(
        body, {irradiances_title(result), "samples", "start", "fitted", "mean bias", "one sigma"});
    for (const IrradianceErrors& e : result.irradiances) {
      add_row(beside, {std::string(kIrradianceNames[e.what]), std::to_string(e.samples),
                       number_text(e.start_rms, 4), number_text(e.rms, 4),
                       number_text(e.mean_bias, 3), number_text(e.sigma, 3)});
    }
  }
  if (result.polarisation.empty()) return;
  xml_node readings = add_table(
      body, {"Polarisation, RMS in percentage points", "readings", "start", "fitted", "one sigma"});
  for (const PolarisationErrors& e : result.polarisation) {
    add_row(readings,
            {std::string(polarisation_name(e.what)), std::to_string(e.readings),
             number_text(e.start_rms, 4), number_text(e.rms, 4), number_text(e.sigma, 3)});
  }
}

void add_unknowns(xml_node body, const Result& result) {
  add_section(body, "Parameters");
  xml_node table =
      add_table(body, {"unknown", "unit", "start", "fitted", "one sigma", "prior", "remark"});
  for (const UnknownRow& row : result.unknowns) {
    xml_node cells = add_row(table, {row.unknown.name(), std::string(row.unknown.unit()),
                                     number_text(row.start, 4), number_text(row.fitted),
                                     number_text(row.sigma, 3), prior_text(row), remark_text(row)});
    cells.last_child().append_attribute("class") = "mark";
  }
  for (const FixedRow& row : result.fixed) {
    add_row(table, {row.parameter.name(), std::string(parameter_info(row.parameter).unit),
                    number_text(row.start, 4), number_text(row.value), "-", "", "fixed"});
  }
  add(body, "p", sigma_text(result), "small");
}

// The correlations from which on two unknowns are said to trade.
constexpr double kTrade = 0.9;

std::string unknown_name(const Result& result, Eigen::Index row) {
  const int u = result.covariance_unknowns[static_cast<std::size_t>(row)];
  return result.unknowns[static_cast<std::size_t>(u)].unknown.name();
}

std::vector<std::string> what_the_data_do_not_tell(const Result& result) {
  std::vector<std::string> sentences;
  for (const UnknownRow& row : result.unknowns) {
    const std::string name = row.unknown.name();
    if (row.at_bound) {
      sentences.push_back(fmt::format("{} lies {}, {} {}: the data would take it further.", name,
                                      remark_text(row), number_text(row.fitted),
                                      row.unknown.unit()));
    } else if (!row.identifiable) {
      sentences.push_back(fmt::format("The data say less about {} than {} do{}.", name,
                                      row.unknown.prior ? "its prior" : "its bounds",
                                      row.unknown.prior ? "es" : ""));
    }
  }
  for (std::string& sentence : pulled_priors(result)) sentences.push_back(std::move(sentence));
  for (Eigen::Index i = 0; i < result.correlation.rows(); ++i) {
    for (Eigen::Index j = 0; j < i; ++j) {
      const double r = result.correlation(i, j);
      if (std::abs(r) < kTrade) continue;
      sentences.push_back(fmt::format(
          "{} and {} trade against each other (correlation {:.2f}): the data know one combination "
          "of them better than either.",
          unknown_name(result, j), unknown_name(result, i), r));
    }
  }
  if (result.downweighted > 0) {
    sentences.push_back(fmt::format("The loss leaves {} less than half their weight.",
                                    counted(result.downweighted, "sample")));
  }
  return sentences;
}

void add_identifiability(xml_node body, const Result& result) {
  add_section(body, "What the data do not tell");
  const std::vector<std::string> sentences = what_the_data_do_not_tell(result);
  if (sentences.empty()) {
    add(body, "p",
        fmt::format("No unknown lies at a bound or at its prior, and no two are correlated by {} "
                    "or more.",
                    kTrade));
    return;
  }
  xml_node list = add(body, "ul");
  for (const std::string& sentence : sentences) add(list, "li", sentence);
}

void add_correlations(xml_node body, const Result& result) {
  const Eigen::Index count = result.correlation.rows();
  add_section(body, "Correlations");
  if (count == 0) {
    add(body, "p",
        result.covariance_unknowns.empty()
            ? "There is no covariance: every unknown is at a bound."
            : "The covariance is singular: data and priors leave a direction open.",
        "mark");
    return;
  }
  std::vector<std::string> header = {""};
  for (Eigen::Index j = 0; j < count; ++j) header.push_back(fmt::format("{}", j + 1));
  xml_node table = add_table(body, header);
  for (Eigen::Index i = 0; i < count; ++i) {
    xml_node row = add(table, "tr");
    add(row, "td", fmt::format("{} {}", i + 1, unknown_name(result, i)));
    for (Eigen::Index j = 0; j <= i; ++j) {
      const double r = result.correlation(i, j);
      add(row, "td", fmt::format("{:.2f}", r)).append_attribute("style") =
          fmt::format("background: rgb({} / {:.2f})", r < 0 ? "230 110 30" : "60 120 220",
                      i == j ? 0 : 0.7 * std::abs(r))
              .c_str();
    }
  }
  add(body, "p",
      fmt::format("Condition number of the normal matrix with unit diagonal: {:.3g}.",
                  result.condition_number),
      "small");
}

void add_findings(xml_node body, const Result& result) {
  add_section(body, "Physics found");
  xml_node table = add_table(body, {"", "value", "plausible", "", "source"});
  for (const Finding& finding : findings(result.preset.atmosphere)) {
    xml_node row =
        add_row(table, {std::string(finding.name), number_text(finding.value, 4),
                        fmt::format("{:.3g} to {:.3g}", finding.lower, finding.upper),
                        finding.plausible() ? "yes" : "no", std::string(finding.source)});
    row.last_child().append_attribute("class") = "text small";
    if (!finding.plausible())
      row.last_child().previous_sibling().append_attribute("class") = "mark";
  }
}

void add_checks(xml_node body, const Result& result, const Checks& checks) {
  if (!checks.hold_outs.empty()) {
    add_section(body, "Errors of what was left out");
    xml_node table = add_table(body, {"", "RMS of log, %", "luminance, %", "spectral, %",
                                      "own: RMS of log, %", "luminance, %", "spectral, %"});
    for (const HoldOut& held : checks.hold_outs) {
      add_row(
          table,
          {held.name.substr(held.name.rfind('/') + 1), log_misfit_digits(held.predicted.rms_log, 4),
           number_text(held.predicted.luminance, 4), number_text(held.predicted.spectral, 4),
           log_misfit_digits(held.pointed.rms_log, 4), number_text(held.pointed.luminance, 4),
           number_text(held.pointed.spectral, 4)});
    }
    add(body, "p", hold_outs_meaning(), "small");
  }
  if (!checks.profiles.empty()) {
    add_section(body, "Profile likelihoods");
    xml_node table = add_table(body, {"unknown", "unit", "68 %", "95 %"});
    for (const Profile& profile : checks.profiles)
      add_row(table, {profile.name, profile.unit, interval_text(profile, profile.percent68),
                      interval_text(profile, profile.percent95)});
  }
  if (checks.bootstrap) {
    add_section(body, fmt::format("Bootstrap over the directions, {} repetitions, {} failed",
                                  checks.bootstrap->repetitions, checks.bootstrap->failed));
    add(body, "p",
        "Directions are drawn one by one: sigma is too small where the residuals of neighbours "
        "agree. Priors are not drawn.",
        "small");
    xml_node table = add_table(body, {"unknown", "mean", "sigma", "sigma of covariance"});
    for (std::size_t u = 0; u < result.unknowns.size(); ++u) {
      add_row(table, {result.unknowns[u].unknown.name(), number_text(checks.bootstrap->mean[u]),
                      number_text(checks.bootstrap->sigma[u], 3),
                      number_text(result.unknowns[u].sigma, 3)});
    }
  }
}

void add_preset(xml_node body, const Result& result) {
  add_section(body, "The preset");
  add(body, "p",
      "The fitted atmosphere with the record of its fit, as skyfit and its renderer read it.");
  add(body, "button", "Download preset.json").append_attribute("id") = "download";
  xml_node details = add(body, "details");
  add(details, "summary", "Show it");
  add(details, "pre", preset_to_json(result.preset)).append_attribute("id") = "preset";
  add(body, "script", kScript);
}

}  // namespace

std::string html_report(const Result& result, const Checks& checks,
                        std::span<const ReportFigure> figures, const std::string& live_sky) {
  pugi::xml_document document;
  xml_node html = document.append_child("html");
  html.append_attribute("lang") = "en";
  xml_node head = add(html, "head");
  head.append_child("meta").append_attribute("charset") = "utf-8";
  xml_node viewport = head.append_child("meta");
  viewport.append_attribute("name") = "viewport";
  viewport.append_attribute("content") = "width=device-width, initial-scale=1";
  add(head, "title", "Fit of " + result.preset.name);
  add(head, "style", kStyle);
  xml_node body = add(html, "body");
  add_summary(body, result);
  add_live_sky(body, live_sky);
  add_figures(body, figures);
  add_errors(body, result);
  add_unknowns(body, result);
  add_identifiability(body, result);
  add_correlations(body, result);
  add_findings(body, result);
  add_checks(body, result, checks);
  add_preset(body, result);
  std::ostringstream page;
  page << "<!DOCTYPE html>\n";
  document.save(page, "", pugi::format_raw | pugi::format_no_declaration, pugi::encoding_utf8);
  return std::move(page).str() + "\n";
}

}  // namespace skyfit::fit
