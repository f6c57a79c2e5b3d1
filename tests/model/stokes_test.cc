// SPDX-License-Identifier: Apache-2.0
// The reference model's polarised light agrees with Monte Carlo; its neutral points are where the
// literature has them; single scattering has the closed form of Rayleigh's matrix.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <iostream>
#include <map>
#include <numbers>

#include "data_refs/spectra.h"
#include "model/polarisation.h"
#include "model/solver/reference_model.h"
#include "tests/model/truth.h"

namespace skyfit::truth {
namespace {

std::shared_ptr<const TabulatedPhase> mie_fine() {
  TwoColumns table;
  for (const Row& row : read_rows("mie_fine_550nm.csv")) {
    table.x.push_back(row.number(0));
    table.y.push_back(row.number(1) / (4 * std::numbers::pi));
  }
  return std::make_shared<TabulatedPhase>(table);
}

struct StokesCase {
  Atmosphere<double> atmosphere;
  double altitude_m = 0;
};

// The cases of stokes.csv; the coefficients are those of the case's wavelength.
StokesCase stokes_case(const std::string& name) {
  StokesCase c;
  Atmosphere<double>& a = c.atmosphere;
  a.at("ozone").amount = 0;
  a.at("rayleigh").phase.depolarisation = 0;
  set_scattering(a.at("rayleigh"), 550, 0.01216e-3, 0);
  set_scattering(a.at("mie"), 550, 0, 0);
  a.ground_albedo = 0.1;
  if (name.starts_with("rayleigh400")) {
    a.at("rayleigh").amount = 0.045e-3;
    a.ground_albedo = 0.3;
    if (name.ends_with("10km_down")) c.altitude_m = 10e3;
    return c;
  }
  a.at("mie").single_scattering_albedo = 0.9;
  a.at("mie").phase.g = 0.76;
  if (name == "miefine550") {
    a.at("mie").amount = 0.157380e-3;
    a.at("mie").single_scattering_albedo = 0.944282;
    a.at("mie").phase.type = PhaseType::kTabulated;
    a.at("mie").phase.table = mie_fine();
    return c;
  }
  a.top_radius_m = a.bottom_radius_m + 60e3;
  a.at("mie").amount = name == "haze550_depol" ? 0.15e-3 : 0.004e-3;
  if (name == "clear440_depol") a.at("rayleigh").amount = 0.032959e-3;
  return c;
}

constexpr WavelengthNode kNode{550, 0};

// Root mean squares and largest values of errors that count within suns.
struct Sum {
  int count = 0;
  double squares = 0, worst = 0;
  void add(double error) {
    ++count;
    squares += error * error;
    worst = std::max(worst, std::abs(error));
  }
  double rms() const { return std::sqrt(squares / count); }
};

struct StokesErrors {
  Sum i, q, u;  // relative, and shares of I
};
StokesErrors stokes_errors(const std::vector<Row>& rows, const StokesValues& model,
                           double largest_sun_deg) {
  StokesErrors e;
  for (std::size_t k = 0; k < rows.size(); ++k) {
    if (rows[k].number(1) > largest_sun_deg) continue;
    const double i = rows[k].number(4);
    e.i.add(model.i.value[k] / i - 1);
    e.q.add((model.q.value[k] - rows[k].number(5)) / i);
    e.u.add((model.u.value[k] - rows[k].number(6)) / i);
  }
  return e;
}

TEST(Stokes, AgreesWithMonteCarlo) {
  std::map<std::string, std::vector<Row>> cases;
  for (const Row& row : read_rows("stokes.csv")) cases[row.field[0]].push_back(row);
  ASSERT_EQ(cases.size(), 5u);
  struct Limits {
    double sun_deg, rms, worst, polarised_rms;
  };
  // The truth's own noise is 0.2 % of I at most.
  constexpr Limits kLimits[] = {{80, 0.004, 0.015, 0.005}, {88, 0.008, 0.03, 0.005}};
  for (const auto& [name, rows] : cases) {
    const StokesCase c = stokes_case(name);
    std::vector<SkyPoint> points;
    for (const Row& row : rows) {
      points.push_back({c.altitude_m, row.number(1) * kDegree, row.number(2) * kDegree,
                        row.number(3) * kDegree});
    }
    const StokesValues model = ReferenceModel({}).stokes(c.atmosphere, {&kNode, 1}, points, {});
    for (const Limits& limits : kLimits) {
      const StokesErrors e = stokes_errors(rows, model, limits.sun_deg);
      std::cout << name << ", suns to " << limits.sun_deg << ": I rms " << 100 * e.i.rms()
                << " % worst " << 100 * e.i.worst << " %, Q/I rms " << 100 * e.q.rms()
                << " % worst " << 100 * e.q.worst << " %, U/I rms " << 100 * e.u.rms()
                << " % worst " << 100 * e.u.worst << " %\n";
      EXPECT_LT(e.i.rms(), limits.rms) << name;
      EXPECT_LT(e.i.worst, limits.worst) << name;
      if (name == "miefine550") continue;  // Q and U of the aerosol are left out
      EXPECT_LT(e.q.rms(), limits.polarised_rms) << name;
      EXPECT_LT(e.u.rms(), limits.polarised_rms) << name;
    }
  }
}

// The fine aerosol of stokes.csv as particles: its sizes alone make its albedo, phase function and
// scattering matrix.
void set_particles(Constituent<double>& aerosol, double radius_um, double width) {
  aerosol.phase.type = PhaseType::kSizeDistribution;
  SizeDistribution<double>& particles = aerosol.phase.particles;
  particles.radius_um = radius_um;
  particles.width = width;
  particles.index_real = 1.45;
  particles.index_imaginary = 0.01;
  particles.tables = std::make_shared<const ParticleTables>();
}

StokesCase fine_particles() {
  StokesCase c = stokes_case("miefine550");
  const double width = std::log(1.6);
  set_particles(c.atmosphere.at("mie"), 0.2 * std::exp(0.5 * width * width), width);
  return c;
}

TEST(Stokes, OfParticlesAgreesWithMonteCarlo) {
  const StokesCase c = fine_particles();
  std::vector<Row> rows;
  std::vector<SkyPoint> points;
  for (const Row& row : read_rows("stokes.csv")) {
    if (row.field[0] != "miefine550") continue;
    rows.push_back(row);
    points.push_back(
        {0, row.number(1) * kDegree, row.number(2) * kDegree, row.number(3) * kDegree});
  }
  const StokesValues model = ReferenceModel({}).stokes(c.atmosphere, {&kNode, 1}, points, {});
  for (const double sun_deg : {80.0, 88.0}) {
    const StokesErrors e = stokes_errors(rows, model, sun_deg);
    std::cout << "particles, suns to " << sun_deg << ": I rms " << 100 * e.i.rms() << " % worst "
              << 100 * e.i.worst << " %, Q/I rms " << 100 * e.q.rms() << " % worst "
              << 100 * e.q.worst << " %, U/I rms " << 100 * e.u.rms() << " % worst "
              << 100 * e.u.worst << " %\n";
    EXPECT_LT(e.i.rms(), 0.003);
    EXPECT_LT(e.i.worst, 0.015);
    EXPECT_LT(e.q.rms(), 0.0015);
    EXPECT_LT(e.u.rms(), 0.001);
  }
}

// Thin air: P11 and P12 of Rayleigh's matrix, turned from the scattering plane.
TEST(Stokes, OfThinAirIsTheClosedForm) {
  StokesCase c = stokes_case("rayleigh400");
  Atmosphere<double>& a = c.atmosphere;
  a.ground_albedo = 0;
  a.at("rayleigh").amount = 1e-9;
  a.at("rayleigh").phase.depolarisation = 0.03;
  for (const double view : {0.0, 40.0, 75.0}) {
    for (const double azimuth : {0.0, 50.0, 130.0, 180.0, 250.0}) {
      const SkyPoint p{0, 60 * kDegree, view * kDegree, azimuth * kDegree};
      const StokesValues s = ReferenceModel({}).stokes(a, {&kNode, 1}, {&p, 1}, {});
      const double nu =
          std::cos(p.view_zenith) * std::cos(p.sun_zenith) +
          std::sin(p.view_zenith) * std::sin(p.sun_zenith) * std::cos(p.relative_azimuth);
      const double degree = 0.97 * (1 - nu * nu) / (1.03 + 0.97 * nu * nu);
      constexpr double kSecondOrder = 1e-4;  // optical depth 8e-6, 3e-5 along the ray
      EXPECT_NEAR(std::hypot(s.q.value[0], s.u.value[0]) / s.i.value[0], degree, kSecondOrder);
    }
  }
}

TEST(Stokes, IsSymmetricAboutTheSunsVertical) {
  const StokesCase c = stokes_case("haze550_depol");
  const auto at = [&](double azimuth) {
    const SkyPoint p{0, 65 * kDegree, 50 * kDegree, azimuth * kDegree};
    return ReferenceModel({}).stokes(c.atmosphere, {&kNode, 1}, {&p, 1}, {});
  };
  const StokesValues left = at(70), right = at(-70);
  constexpr double kRounding = 1e-12;
  EXPECT_NEAR(left.q.value[0], right.q.value[0], kRounding);
  EXPECT_NEAR(left.u.value[0], -right.u.value[0], kRounding);
  EXPECT_GT(std::abs(left.u.value[0]), 1e-4);
}

// Coulson 1988, Polarization and Intensity of Light in the Atmosphere, chapters 5 and 6: Babinet's
// and Brewster's points lie 10 to 25 deg above and below the sun at middle heights, Arago's 18 to
// 25 deg above the antisolar point when the sun is low.
TEST(Stokes, HasTheNeutralPoints) {
  Atmosphere<double> a = stokes_case("rayleigh400").atmosphere;
  a.at("rayleigh").amount = 0.02e-3;  // 490 nm, optical depth 0.16
  const auto points_under = [&](double sun_deg) {
    std::map<NeutralPointKind, double> deg;
    for (const NeutralPoint& point :
         neutral_points(ReferenceModel({}), a, kNode, 0, sun_deg * kDegree)) {
      std::cout << "sun zenith " << sun_deg << ": " << neutral_point_name(point.kind) << " "
                << point.distance / kDegree << " deg\n";
      EXPECT_TRUE(deg.emplace(point.kind, point.distance / kDegree).second);
    }
    return deg;
  };
  const auto middle = points_under(50);
  ASSERT_EQ(middle.size(), 2u);
  for (const auto kind : {NeutralPointKind::kBabinet, NeutralPointKind::kBrewster}) {
    EXPECT_GT(middle.at(kind), 10);
    EXPECT_LT(middle.at(kind), 25);
  }
  const auto low = points_under(85);  // Brewster's is below the horizon
  ASSERT_EQ(low.size(), 2u);
  EXPECT_GT(low.at(NeutralPointKind::kBabinet), 10);
  EXPECT_LT(low.at(NeutralPointKind::kBabinet), 25);
  EXPECT_GT(low.at(NeutralPointKind::kArago), 18);
  EXPECT_LT(low.at(NeutralPointKind::kArago), 25);
}

// Between the directions that are computed, Q vanishes where neutral_points() says.
TEST(Stokes, NeutralPointsHaveNoPolarisation) {
  const Atmosphere<double> a = stokes_case("clear440_depol").atmosphere;
  const ReferenceModel model({});
  const double sun = 62 * kDegree;
  const auto points = neutral_points(model, a, kNode, 0, sun);
  ASSERT_GE(points.size(), 2u);
  for (const NeutralPoint& point : points) {
    const SkyPoint at{0, sun, point.view_zenith, point.relative_azimuth};
    const StokesValues light = model.stokes(a, {&kNode, 1}, {&at, 1}, {});
    constexpr double kQuarterDegree = 1e-4;  // of Q linear between directions, of I
    EXPECT_LT(linear_polarisation(light.i.value[0], light.q.value[0], light.u.value[0]).degree,
              kQuarterDegree)
        << neutral_point_name(point.kind);
  }
}

TEST(Stokes, OfScalarTransferIsRefused) {
  ReferenceOptions options;
  options.transfer = Transfer::kScalar;
  const SkyPoint p{};
  EXPECT_THROW(ReferenceModel(options).stokes({}, {&kNode, 1}, {&p, 1}, {}), std::invalid_argument);
}

// Spheres much smaller than the wavelength have Rayleigh's matrix: half of the air as such spheres
// is as polarised as air, by day and in twilight, in every order of scattering.
TEST(Stokes, SmallParticlesPolariseAsAir) {
  const Atmosphere<double> air = stokes_case("rayleigh400").atmosphere;
  Atmosphere<double> half = air;
  half.at("rayleigh").amount *= 0.5;
  Constituent<double>& spheres = half.at("mie");
  set_particles(spheres, 1e-3, 0.1);
  spheres.phase.particles.absorbs = false;
  spheres.profile.scale_height_m = half.at("rayleigh").profile.scale_height_m;
  set_scattering(spheres, kNode.wavelength_nm, half.at("rayleigh").amount, 0);
  std::vector<SkyPoint> points;
  for (const double sun : {20.0, 75.0, 92.0, 96.0}) {
    for (const double view : {5.0, 60.0, 88.0, 130.0}) {
      for (const double azimuth : {0.0, 100.0}) {
        points.push_back({2e3, sun * kDegree, view * kDegree, azimuth * kDegree});
      }
    }
  }
  for (const int order : {0, 2, 3}) {
    ReferenceOptions options;
    options.order = order;
    const ReferenceModel model(options);
    const StokesValues a = model.stokes(air, {&kNode, 1}, points, {}),
                       b = model.stokes(half, {&kNode, 1}, points, {});
    for (std::size_t k = 0; k < points.size(); ++k) {
      constexpr double kSmall = 1e-4;  // of I: the spheres' size, and the steps of the iteration
      EXPECT_NEAR(b.i.value[k] / a.i.value[k], 1, kSmall) << order << " " << k;
      EXPECT_NEAR(b.q.value[k] / a.i.value[k], a.q.value[k] / a.i.value[k], kSmall);
      EXPECT_NEAR(b.u.value[k] / a.i.value[k], a.u.value[k] / a.i.value[k], kSmall);
    }
  }
}

// Particles as two constituents of half the amount are one.
TEST(Stokes, OfParticlesInTwoPartsIsTheSame) {
  const Atmosphere<double> one = fine_particles().atmosphere;
  Atmosphere<double> two = one;
  two.at("mie").amount *= 0.5;
  two.constituents.push_back(two.at("mie"));
  two.constituents.back().name = "other";
  std::vector<SkyPoint> points;
  for (const double sun : {30.0, 85.0, 93.0})
    points.push_back({0, sun * kDegree, 50 * kDegree, 70 * kDegree});
  const StokesValues a = ReferenceModel({}).stokes(one, {&kNode, 1}, points, {}),
                     b = ReferenceModel({}).stokes(two, {&kNode, 1}, points, {});
  constexpr double kRounding = 1e-10;  // of I
  for (const auto which : {&StokesValues::i, &StokesValues::q, &StokesValues::u}) {
    for (std::size_t k = 0; k < points.size(); ++k)
      EXPECT_NEAR((a.*which).value[k], (b.*which).value[k], kRounding * a.i.value[k]);
  }
}

// Derivatives of I, Q and U equal central differences.
void expect_exact_derivatives(const Atmosphere<double>& atmosphere,
                              const std::vector<Parameter>& parameters,
                              const std::vector<double>& suns_deg, double accuracy) {
  std::vector<SkyPoint> points;
  for (const double sun : suns_deg) {
    for (const double view : {20.0, 80.0, 100.0})
      points.push_back({3e3, sun * kDegree, view * kDegree, 1.2});
  }
  const ReferenceModel model({});
  for (const Parameter& parameter : parameters) {
    const StokesValues exact = model.stokes(atmosphere, {&kNode, 1}, points, {&parameter, 1});
    const double middle = get_parameter(atmosphere, parameter), step = 2e-5 * middle;
    const auto at = [&](double value) {
      Atmosphere<double> b = atmosphere;
      set_parameter(b, parameter, value);
      return model.stokes(b, {&kNode, 1}, points, {});
    };
    const StokesValues more = at(middle + step), less = at(middle - step);
    for (const auto which : {&StokesValues::i, &StokesValues::q, &StokesValues::u}) {
      for (std::size_t k = 0; k < points.size(); ++k) {
        const double difference = ((more.*which).value[k] - (less.*which).value[k]) / (2 * step);
        EXPECT_NEAR((exact.*which).derivative[k], difference,
                    accuracy * std::max(std::abs(difference), exact.i.value[k] / middle))
            << parameter_info(parameter).name << " at point " << k;
      }
    }
  }
}

TEST(Stokes, DerivativesAreExact) {
  expect_exact_derivatives(
      stokes_case("haze550_depol").atmosphere,
      {Parameter::kRayleighScattering, Parameter::kMieScattering, Parameter::kMiePhaseG,
       Parameter::kGroundAlbedo, Parameter::kRayleighScaleHeight},
      {30, 80, 91}, 1e-5);
}

TEST(Stokes, DerivativesOfParticlesAreExact) {
  const Atmosphere<double> a = fine_particles().atmosphere;
  expect_exact_derivatives(a, {Parameter::kMieScattering}, {91}, 1e-5);
  expect_exact_derivatives(a, {{"mie", Quantity::kRadius}, {"mie", Quantity::kWidth}}, {30}, 1e-5);
  // The difference is that of spheres which are kept in single precision.
  expect_exact_derivatives(a, {{"mie", Quantity::kIndexReal}}, {30}, 1e-4);
}

}  // namespace
}  // namespace skyfit::truth
