// SPDX-License-Identifier: Apache-2.0
// A result that was damaged at random is drawn or refused, with one line that names the file and
// says nothing of C++.
#include <gmock/gmock.h>

#include <numbers>
#include <random>

#include "cli/fit_files.h"
#include "data_refs/references.h"
#include "data_refs/spectra.h"
#include "fit/fit.h"
#include "fit/result/record.h"
#include "render/plot/evaluate.h"
#include "render/plot/measured_figures.h"
#include "render/plot/results.h"
#include "tests/fit/scans.h"
#include "tests/fit/synthetic.h"
#include "tests/render/plot_samples.h"

namespace skyfit::plot {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

constexpr int kMutations = 400;

// What no user should read.
constexpr std::string_view kInternals[] = {"exception", "vector",  "_M_",  "basic_string",
                                           "std::",     "::at",    "stoi", "stod",
                                           "bad_",      "nlohmann"};

// Every radiance is 1.
class EvenSky : public SkyModel {
 public:
  std::string_view name() const override { return "even"; }
  SkyValues radiance(const Atmosphere<double>&, std::span<const WavelengthNode> wavelengths,
                     std::span<const SkyPoint> points, std::span<const Parameter>) const override {
    SkyValues values;
    values.points = static_cast<int>(points.size());
    values.wavelengths = static_cast<int>(wavelengths.size());
    values.value.assign(points.size() * wavelengths.size(), 1);
    return values;
  }
};

class Mutator {
 public:
  std::string operator()(std::string text) {
    switch (below(6)) {
      case 0:  // a file that was cut
        return text.substr(0, below(text.size()));
      case 1:  // lost bytes
        return text.erase(below(text.size()), 1 + below(40));
      case 2: {  // another byte
        text[below(text.size())] = static_cast<char>(below(256));
        return text;
      }
      case 3: {  // a line that is lost
        const std::size_t begin = text.find('\n', below(text.size()));
        return begin == text.npos ? "" : text.erase(begin, text.find('\n', begin + 1) - begin);
      }
      case 4: {  // a column that is lost, or one that has another name
        const std::size_t comma = text.find_first_of(",:", below(text.size()));
        return comma == text.npos ? text : text.erase(comma, 1);
      }
      default:
        return with_other_value(std::move(text));
    }
  }

 private:
  std::size_t below(std::size_t bound) { return bound == 0 ? 0 : engine_() % bound; }

  // A number or a word becomes another one.
  std::string with_other_value(std::string text) {
    static const std::string kValues[] = {"nan",     "inf",  "-1",       "0",     "1e999", "-1e300",
                                          "\"\"",    "null", "[]",       "{}",    "true",  "9e99",
                                          "\x1b[2J", "2.5",  "99999999", "'; !x", "[[1]]"};
    constexpr std::string_view kEnds = ",:[]{} \n\"";
    const std::size_t begin = text.find_first_of(kEnds, below(text.size()));
    if (begin == text.npos) return text;
    const std::size_t word = text.find_first_not_of(kEnds, begin);
    if (word == text.npos) return text;
    const std::size_t end = std::min(text.find_first_of(kEnds, word), text.size());
    return text.replace(word, end - word, kValues[below(std::size(kValues))]);
  }

  std::mt19937 engine_{20140101};
};

class DamagedResults : public PlotTest {
 protected:
  void write(const std::string& name, const std::string& text) const {
    std::ofstream(folder_ / name, std::ios::binary) << text;
  }

  // Damages `name` again and again; the number of times that it was refused.
  template <class Use>
  int refusals(const std::string& name, const std::string& text, const Use& use) const {
    Mutator mutated;
    int refused = 0;
    for (int i = 0; i < kMutations; ++i) {
      const std::string damaged = mutated(text);
      write(name, damaged);
      try {
        use();
      } catch (const std::exception& error) {
        ++refused;
        const std::string message = error.what();
        EXPECT_THAT(message, ::testing::AnyOf(HasSubstr(name), HasSubstr(folder_.string()),
                                              HasSubstr("figure ")))
            << damaged.substr(0, 300);
        EXPECT_EQ(message.find('\n'), message.npos) << message;
        EXPECT_LT(message.size(), 700u) << message;
        for (const std::string_view internal : kInternals)
          EXPECT_THAT(message, Not(HasSubstr(std::string(internal)))) << damaged;
      }
    }
    write(name, text);
    return refused;
  }
};

std::string preset_text() {
  Preset preset;
  preset.name = "a name";
  const std::vector<std::vector<double>> matrix = {{4e-4}};
  preset.fit = {{"model", "even"},
                {"reference",
                 {{"name", "cie:12"},
                  {"description", "A sky"},
                  {"quantity", "relative_luminance"},
                  {"exclude_sun_deg", 3}}},
                {"likelihood", {{"scale", "profiled"}}},
                {"covariance", {{"parameters", {"ground.albedo"}}, {"matrix", matrix}}}};
  return preset_to_json(preset);
}

TEST_F(DamagedResults, OfAnAnalyticSkyAreDrawnOrRefused) {
  const auto reference = refs::load_reference("cie:12", {0.7}, refs::Sampling::kPrincipalPlane);
  const EvenSky sky;
  const std::string samples = samples_to_csv(
      evaluated_samples(reference, Preset{}.atmosphere, refs::standard_spectral_data(), sky, 0.05));
  write("preset.json", preset_text());
  write("samples.csv", samples);
  const auto draw = [&] {
    const FitOutcome fit = read_fit_outcome(folder_);
    comparison_of({&fit, 1}, refs::standard_spectral_data(),
                  [&](std::string_view, Transfer) -> const SkyModel& { return sky; });
    fit::fitted_covariance(fit.preset, (folder_ / "preset.json").string());
  };
  EXPECT_NO_THROW(draw());
  EXPECT_GT(refusals("preset.json", preset_text(), draw), kMutations / 2);
  EXPECT_GT(refusals("samples.csv", samples, draw), kMutations / 3);
}

// What a fit of two spectral scans leaves.
class DamagedMeasuredResults : public DamagedResults {
 protected:
  static const fit::Result& result() {
    static const fit::Result fitted = [] {
      const fit::ToySky sky;
      refs::Reference scans =
          fit::synthetic_scans(sky, fit::true_atmosphere(1), fit::SyntheticScans{});
      for (refs::Scan& scan : scans.scans) scan.time_utc = kTime;
      fit::FitOptions options;
      options.start = fit::power_law_air();
      return fit::fit_atmosphere(scans, refs::standard_spectral_data(), sky, options);
    }();
    return fitted;
  }

  DamagedMeasuredResults() {
    std::vector<Sample> measured;
    for (const int scan : {1, 2})
      for (const double nm : {450.0, 550.0, 650.0})
        for (int k = 0; k < 6; ++k)
          measured.push_back({scan, 30, 10.0 + 10 * k, 45.0 * k, nm, 0.1 + 0.01 * k, 0.01, 0.1});
    samples_ = samples_to_csv(measured);
    write("preset.json", preset_);
    write("report.json", report_);
    write("samples.csv", samples_);
  }

  void draw() const {
    const MeasuredOutcome fit = cli::read_measured_outcome(folder_);
    for (const MeasuredFigure& figure : measured_figures())
      if (figure.can_draw(fit)) plot::draw(figure, {&fit, 1}, 1);
  }

  static constexpr const char* kTime = "2020-06-01T09:00:00Z";
  const std::string preset_ = preset_to_json(result().preset);
  const std::string report_ = fit::report_json(result()).dump(2);
  std::string samples_;
};

TEST_F(DamagedMeasuredResults, AreDrawnOrRefused) {
  const auto use = [&] { draw(); };
  EXPECT_NO_THROW(draw());
  EXPECT_GT(refusals("preset.json", preset_, use), kMutations / 3);
  EXPECT_GT(refusals("report.json", report_, use), kMutations / 6);
  EXPECT_GT(refusals("samples.csv", samples_, use), kMutations / 3);
}

// The lines of a data block are syntax to gnuplot.
TEST_F(DamagedMeasuredResults, ATimeThatIsACommandIsRefused) {
  std::string preset = preset_;
  const std::string time = kTime;
  preset.replace(preset.find(time), time.size(), "2020\\nEOD\\n!touch x");
  write("preset.json", preset);
  EXPECT_THAT([&] { draw(); },
              ::testing::ThrowsMessage<std::invalid_argument>(HasSubstr(
                  "preset.json: fit.scan_results[0].time_utc = "
                  "\"2020\\nEOD\\n!touch x\": expected YYYY-MM-DDTHH:MM:SSZ or nothing")));
}

}  // namespace
}  // namespace skyfit::plot
