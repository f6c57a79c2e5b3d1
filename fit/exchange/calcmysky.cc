// SPDX-License-Identifier: Apache-2.0
#include "fit/exchange/calcmysky.h"

#include <fmt/format.h>

#include <cmath>
#include <cstdio>
#include <map>
#include <stdexcept>

#include "fit/exchange/programs.h"
#include "model/atmosphere/optics.h"
#include "model/base/text.h"
#include "model/numerics/angles.h"

namespace skyfit::fit {
namespace {

using namespace calcmysky;

void expect_within_format(const Atmosphere<double>& a) {
  const double distance = kSunRadius_m / a.star.angular_radius_rad() / kAu_m,
               height = a.top_radius_m - a.bottom_radius_m;
  if (distance < 0.5)
    throw std::invalid_argument(fmt::format(
        "star.angular_diameter_deg = {:g}: CalcMySky holds at most {:.3g}",
        a.star.angular_diameter_deg, 2 * kSunRadius_m / (0.5 * kAu_m) * kDegreesPerRadian));
  if (height > 1e6)
    throw std::invalid_argument(fmt::format(
        "top_radius_m = {:g}: CalcMySky holds atmospheres of at most 1000 km", a.top_radius_m));
}

// What an .atmo file says: entries of the file, or of a section with its code. Keys in lower case;
// CalcMySky takes them in any.
struct Section {
  std::string kind, name;  // "Scatterer", "Absorber"; empty: the file's own
  std::map<std::string, std::string> values;
  std::map<std::string, Code> codes;
};

class AtmoReader {
 public:
  AtmoReader(std::string_view text, std::string_view source) : source_(source) {
    sections_.push_back({});
    std::string key;
    bool in_code = false;
    for (const std::string_view row : split(text, '\n')) {
      ++line_;
      const std::string_view line = trim(in_code ? row : row.substr(0, row.find('#')));
      if (line == "```") {
        if (key.empty()) fail("expected a key before a code block");
        in_code = !in_code;
      } else if (in_code) {
        if (!line.empty()) sections_.back().codes[lower_case(key)].emplace_back(line);
      } else if (line == "}") {
        sections_.push_back({});
      } else if (!line.empty() && line != "{") {
        key = add_entry(line);
      }
    }
    if (in_code) fail("expected the end of a code block");
  }

  const std::vector<Section>& sections() const { return sections_; }

  const std::string& value(std::string_view kind, std::string_view name,
                           const std::string& key) const {
    for (const Section& s : sections_) {
      if (s.kind != kind || s.name != name) continue;
      if (const auto found = s.values.find(lower_case(key));
          found != s.values.end() && !found->second.empty())
        return found->second;
    }
    throw std::invalid_argument(fmt::format("{}: {}{}: not there", source_, of(kind, name), key));
  }

  bool has(const Section& s, const std::string& key) const {
    return s.values.contains(lower_case(key));
  }

  const Code& code(const Section& s, const std::string& key) const {
    const auto found = s.codes.find(lower_case(key));
    if (found == s.codes.end()) fail_value(s, key, "", "GLSL between lines of three backticks");
    return found->second;
  }

  double quantity(std::string_view kind, std::string_view name, const std::string& key,
                  const std::map<std::string, double>& units) const {
    const std::string& text = value(kind, name, key);
    char* end = nullptr;
    const double number = std::strtod(text.c_str(), &end);
    const auto unit = units.find(std::string(trim(end)));
    if (end == text.c_str() || unit == units.end() || !std::isfinite(number)) {
      std::vector<std::string> names;
      for (const auto& [unit_name, factor] : units) names.push_back(unit_name);
      throw std::invalid_argument(
          fmt::format("{}: {}{} = {}: expected a number with one of the units {}", source_,
                      of(kind, name), key, printable(text), fmt::join(names, ", ")));
    }
    return number * unit->second;
  }

  std::vector<double> spectrum(std::string_view kind, std::string_view name, const std::string& key,
                               std::size_t count) const {
    const std::string& text = value(kind, name, key);
    std::vector<double> values;
    for (const std::string_view part : split(text, ',')) {
      const std::string one(trim(part));
      char* end = nullptr;
      const double v = std::strtod(one.c_str(), &end);
      if (one.empty() || *end != '\0' || !(v >= 0) || !std::isfinite(v)) {
        throw std::invalid_argument(fmt::format("{}: {}{}: {}: expected numbers >= 0 with commas",
                                                source_, of(kind, name), key, in_quotes(one)));
      }
      values.push_back(v);
    }
    if (values.size() != count) {
      throw std::invalid_argument(fmt::format("{}: {}{}: {} values, expected {}, one a wavelength",
                                              source_, of(kind, name), key, values.size(), count));
    }
    return values;
  }

  [[noreturn]] void fail_value(const Section& s, std::string_view key, std::string_view shown,
                               std::string_view expected) const {
    throw std::invalid_argument(fmt::format("{}: {}{}{}: expected {}", source_, of(s.kind, s.name),
                                            key, shown.empty() ? "" : " = " + excerpt(shown),
                                            expected));
  }

 private:
  static std::string of(std::string_view kind, std::string_view name) {
    return kind.empty() ? "" : fmt::format("{} \"{}\": ", kind, name);
  }

  [[noreturn]] void fail(std::string_view expected) const {
    throw std::invalid_argument(fmt::format("{}:{}: {}", source_, line_, expected));
  }

  // The key of the entry.
  std::string add_entry(std::string_view line) {
    const std::size_t colon = line.find(':');
    if (colon == line.npos) fail(in_quotes(line) + ": expected KEY: VALUE");
    std::string key(trim(line.substr(0, colon)));
    for (const std::string_view kind : {"Scatterer", "Absorber"}) {
      if (!lower_case(key).starts_with(lower_case(kind))) continue;
      const std::size_t open = key.find('"'), close = key.rfind('"');
      if (open == key.npos || close <= open) fail(in_quotes(key) + ": expected a name in quotes");
      sections_.push_back({std::string(kind), key.substr(open + 1, close - open - 1), {}, {}});
      return key;
    }
    sections_.back().values[lower_case(key)] = std::string(trim(line.substr(colon + 1)));
    return key;
  }

  std::string source_;
  int line_ = 0;
  std::vector<Section> sections_;
};

constexpr std::string_view kOurForm = "the form that `skyfit export --to calcmysky` writes";

struct ReadDensity {
  VerticalProfile<double> profile;
  double factor = 0;
};

ReadDensity read_density(const AtmoReader& reader, const Section& s) {
  const Code& code = reader.code(s, "number density");
  ReadDensity read;
  double a, b, c;
  int length = 0;
  const auto whole = [&] { return length > 0 && length == static_cast<int>(code[0].size()); };
  if (code.size() == 1 &&
      std::sscanf(code[0].c_str(), "return %lf*exp(-altitude/%lf);%n", &a, &b, &length) == 2 &&
      whole()) {
    read.factor = a;
    read.profile.scale_height_m = b;
    return read;
  }
  if (code.size() == 1 &&
      std::sscanf(code[0].c_str(), "return %lf*max(0.0,1.0-abs(altitude-%lf)/%lf);%n", &a, &b, &c,
                  &length) == 3 &&
      whole()) {
    read.factor = a;
    set_tent(b, c, read.profile);
    return read;
  }
  double low_edge, edge;
  if (code.size() == 1 &&
      std::sscanf(code[0].c_str(),
                  "return %lf*clamp((altitude-%lf)/%lf+0.5,0.0,1.0)*clamp((%lf-altitude)/%lf+0.5,"
                  "0.0,1.0);%n",
                  &a, &b, &low_edge, &c, &edge, &length) == 5 &&
      whole() && std::abs(edge / (kLayerEdge * (c - b)) - 1) < 1e-6) {
    read.factor = a;
    read.profile.type = ProfileType::kLayer;
    read.profile.base_m = b;
    read.profile.top_m = c;
    return read;
  }
  TwoColumns table;
  for (std::size_t i = 0; i < code.size(); ++i) {
    double top, low, high, bottom, height;
    if (std::sscanf(code[i].c_str(), "if(altitude<%lf) return %lf*mix(%lf,%lf,(altitude-%lf)/%lf);",
                    &top, &read.factor, &low, &high, &bottom, &height) != 6) {
      if (i + 1 == code.size() && i > 0 && code[i] == "return 0.0;") break;
      reader.fail_value(s, "number density", code[i], kOurForm);
    }
    if (table.x.empty()) {
      table.x.push_back(bottom);
      table.y.push_back(low);
    }
    table.x.push_back(top);
    table.y.push_back(high);
  }
  if (table.x.empty()) reader.fail_value(s, "number density", "", kOurForm);
  read.profile.type = ProfileType::kTabulated;
  read.profile.table = std::make_shared<const LinearProfile>(table);
  return read;
}

bool same_shape(const VerticalProfile<double>& a, const VerticalProfile<double>& b) {
  if (a.type != ProfileType::kTabulated || b.type != ProfileType::kTabulated) return a == b;
  return a.table->heights() == b.table->heights() && a.table->densities() == b.table->densities();
}

PhaseFunction<double> read_phase(const AtmoReader& reader, const Section& s) {
  const Code& code = reader.code(s, "phase function");
  if (code.empty()) reader.fail_value(s, "phase function", "", kOurForm);
  PhaseFunction<double> phase;
  if (code[0] == kAngleLine) {
    TwoColumns table;
    for (std::size_t i = 1; i < code.size(); ++i) {
      double to, low, high, from, width;
      if (std::sscanf(code[i].c_str(), "if(angle<=%lf) return vec4(exp(mix(%lf,%lf,(angle-%lf)/%lf",
                      &to, &low, &high, &from, &width) != 5) {
        if (i + 1 == code.size() && i > 1) break;
        reader.fail_value(s, "phase function", code[i], kOurForm);
      }
      if (table.x.empty()) {
        table.x.push_back(from);
        table.y.push_back(std::exp(low));
      }
      table.x.push_back(to);
      table.y.push_back(std::exp(high));
    }
    phase.type = PhaseType::kTabulated;
    phase.table = std::make_shared<const TabulatedPhase>(table);
    return phase;
  }
  std::map<std::string, double> constants;
  for (std::size_t i = 0; i + 1 < code.size(); ++i) {
    char name[16];
    double value;
    if (std::sscanf(code[i].c_str(), "CONST float %15[a-z0-9]=%lf;", name, &value) != 2)
      reader.fail_value(s, "phase function", code[i], kOurForm);
    constants[name] = value;
  }
  const auto of = [&](const char* name) {
    const auto found = constants.find(name);
    if (found == constants.end()) reader.fail_value(s, "phase function", name, "a CONST float");
    return found->second;
  };
  if (code.back() == kRayleighLine) {
    phase.type = PhaseType::kRayleigh;
    phase.depolarisation = of("rho");
    return phase;
  }
  for (const PhaseType type : kLobes) {
    if (code.back() == one_lobe(type)) {
      phase.type = type;
      phase.g = of("g");
      return phase;
    }
    if (code.back() != two_lobes(type)) continue;
    phase.type = PhaseType::kTwoLobe;
    phase.lobe = type;
    phase.g1 = of("g1");
    phase.g2 = of("g2");
    phase.weight = of("weight");
    return phase;
  }
  reader.fail_value(s, "phase function", code.back(), kOurForm);
}

const std::map<std::string, double> kLengths = {{"nm", 1e-9}, {"um", 1e-6}, {"mm", 1e-3},
                                                {"m", 1},     {"km", 1e3},  {"Mm", 1e6},
                                                {"Gm", 1e9},  {"AU", kAu_m}};
const std::map<std::string, double> kAreas = {{"am^2", 1e-36}, {"fm^2", 1e-30}, {"pm^2", 1e-24},
                                              {"nm^2", 1e-18}, {"um^2", 1e-12}, {"mm^2", 1e-6},
                                              {"cm^2", 1e-4},  {"m^2", 1},      {"km^2", 1e6},
                                              {"Mm^2", 1e12},  {"Gm^2", 1e18}};
const std::map<std::string, double> kPure = {{"", 1}};

std::vector<double> read_wavelengths(const AtmoReader& reader) {
  std::string text = reader.value("", "", "wavelengths");
  std::erase(text, ' ');
  double first, last;
  int count = 0, length = 0;
  if (std::sscanf(text.c_str(), "min=%lfnm,max=%lfnm,count=%d%n", &first, &last, &count, &length) !=
          3 ||
      length != static_cast<int>(text.size()) || !(first > 0 && last > first) || count < 4 ||
      count > 1000)
    reader.fail_value({}, "wavelengths", text, "min=NUMBERnm,max=NUMBERnm,count=4 .. 1000");
  std::vector<double> list;
  for (int k = 0; k < count; ++k) list.push_back(first + (last - first) * k / (count - 1));
  return list;
}

}  // namespace

std::optional<Atmosphere<double>> read_calcmysky(std::string_view text, std::string_view source,
                                                 std::vector<std::string>& notes) {
  if (text.find("cross section at 1 um") == text.npos &&
      text.find("scattering texture size for") == text.npos)
    return {};
  const AtmoReader reader(text, source);
  const std::vector<double> nm = read_wavelengths(reader);
  Atmosphere<double> a;
  a.constituents.clear();
  a.bottom_radius_m = reader.quantity("", "", "Earth radius", kLengths);
  a.top_radius_m = a.bottom_radius_m + reader.quantity("", "", "atmosphere height", kLengths);
  a.star.angular_diameter_deg = 2 * kDegreesPerRadian * kSunRadius_m /
                                reader.quantity("", "", "Earth-Sun distance", kLengths);
  const std::vector<double> albedo = reader.spectrum("", "", "ground albedo", nm.size());
  a.ground_albedo = clamped_interpolation({nm, albedo}, GroundSpectrum::kWavelengthNm);
  if (a.ground_albedo > 0 && std::ranges::max(albedo) > std::ranges::min(albedo))
    a.ground_spectrum = std::make_shared<const GroundSpectrum>(TwoColumns{nm, albedo});
  std::map<std::string, std::size_t> absorption_of;  // "mie_abs": the place of "mie"
  for (const Section& s : reader.sections()) {
    if (s.kind.empty()) continue;
    Constituent<double> c;
    c.name = s.name;
    const ReadDensity density = read_density(reader, s);
    c.profile = density.profile;
    if (s.kind == "Scatterer") {
      c.wavelength_nm = 1000;
      c.amount = density.factor * reader.quantity(s.kind, s.name, "cross section at 1 um", kAreas);
      c.angstrom_exponent = reader.quantity(s.kind, s.name, "angstrom exponent", kPure);
      c.phase = read_phase(reader, s);
      if (const std::string key = "single scattering albedo"; reader.has(s, key)) {
        for (const double share : reader.spectrum(s.kind, s.name, key, nm.size())) {
          if (share != 1)
            reader.fail_value(s, key, reader.value(s.kind, s.name, key),
                              "1 at every wavelength; absorption is an Absorber's");
        }
      }
      absorption_of[s.name + std::string(kAbsorption)] = a.constituents.size();
      a.constituents.push_back(c);
      continue;
    }
    std::vector<double> section = reader.spectrum(s.kind, s.name, "cross section", nm.size());
    const auto scatterer = absorption_of.find(s.name);
    if (scatterer != absorption_of.end() &&
        same_shape(c.profile, a.constituents[scatterer->second].profile)) {
      Constituent<double>& owner = a.constituents[scatterer->second];
      for (std::size_t k = 0; k < nm.size(); ++k) {
        const double scattering =
            owner.amount * std::pow(nm[k] / owner.wavelength_nm, -owner.angstrom_exponent);
        section[k] = scattering / (scattering + density.factor * section[k]);
      }
      owner.single_scattering_albedo =
          clamped_interpolation({nm, section}, GroundSpectrum::kWavelengthNm);
      owner.albedo_spectrum =
          std::make_shared<const SpectrumTable>(TwoColumns{nm, section}, kAlbedoFormat);
      continue;
    }
    const auto largest = std::ranges::max_element(section);
    if (*largest <= 0) continue;
    c.amount_type = AmountType::kExtinction;
    c.single_scattering_albedo = 0;
    c.amount = density.factor * *largest;
    c.wavelength_nm = nm[static_cast<std::size_t>(largest - section.begin())];
    c.spectrum = std::make_shared<const SpectrumTable>(TwoColumns{nm, section}, kShapeFormat);
    a.constituents.push_back(c);
  }
  notes.push_back("solar irradiance at TOA is not read: the star is skyfit's sun");
  return a;
}

Exported export_calcmysky(const ExportRequest& request) {
  const Atmosphere<double>& truth = request.preset.atmosphere;
  expect_within_format(truth);
  std::vector<std::string> notes;
  Atmosphere<double> shown = *read_calcmysky(atmo_text(request, ""), request.file.string(), notes);
  shown.star = truth.star;  // whose irradiance is in the file
  const std::string loss = loss_text(sky_loss(request.models, request.spectra, truth, shown));
  return {{{request.file, atmo_text(request, loss)}}, {}, loss};
}

}  // namespace skyfit::fit
