// SPDX-License-Identifier: Apache-2.0
// Almucantars of ARM are the samples that the same lines of AERONET are; what is another NetCDF
// file is named with the variable that it lacks.
#include "data_refs/arm_csphot.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <stdexcept>

#include "data_refs/measured_formats.h"
#include "fit/exchange/netcdf/netcdf_module.h"
#include "model/base/module_file.h"
#include "model/base/temporary_directory.h"
#include "model/base/whole_file.h"

namespace skyfit::refs {
namespace {

using fit::NetcdfFile;
using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::StartsWith;

// One line at 2024-05-15 06:30 UTC of three azimuths.
NetcdfFile small() {
  const std::vector<std::string> time = {"time"}, azimuth = {"azimuth"}, both = {"time", "azimuth"};
  const auto doubles = [](std::initializer_list<double> values) {
    return std::vector<double>(values);
  };
  return {{{"time", 1}, {"azimuth", 3}},
          {{"base_time", {}, std::vector<int>{1715754600}, "", ""},
           {"time_offset", time, doubles({0}), "", ""},
           {"wavelength", time, doubles({0.5}), "", "um"},
           {"zenith", time, doubles({63.11}), "", "degree"},
           {"azimuth", azimuth, doubles({-30, 30, 60}), "", "degree"},
           {"alm_rad", both, doubles({8.5, -999, 5}), "", "microWatt/(cm^2 * nm * ster)"},
           {"lat", {}, doubles({47.5}), "", "degree_N"},
           {"lon", {}, doubles({11}), "", "degree_E"},
           {"alt", {}, doubles({700}), "", "m"}},
          {}};
}

class ArmFiles : public ::testing::Test {
 protected:
  Reference read(const NetcdfFile& content) const {
    write_file(file_,
               module_named<fit::NetcdfModule>("skyfit_netcdf_module").bytes(file_, content));
    return load_measured_sky(file_, {});
  }
  std::string error_of(const NetcdfFile& content) const {
    try {
      read(content);
    } catch (const std::invalid_argument& error) {
      const std::string message = error.what();
      EXPECT_THAT(message, StartsWith(file_.string() + ": "));
      EXPECT_THAT(message, Not(HasSubstr("\n")));
      return message.substr(file_.string().size() + 2);
    }
    return "no error";
  }

  const TemporaryDirectory directory_;
  const std::filesystem::path file_ = directory_.path() / "arm.nc";
};

TEST_F(ArmFiles, AreWhatTheSameLinesOfAeronetAre) {
  const std::string examples = SKYFIT_EXAMPLES;
  const Reference arm = load_measured_sky(examples + "arm_csphotalm.nc", {});
  const Reference aeronet = load_measured_sky(examples + "aeronet_almucantar.csv", {});
  ASSERT_EQ(arm.samples.size(), aeronet.samples.size());
  constexpr double kSingle = 1e-6;  // relative; angles and radiances of 32 bits
  for (std::size_t i = 0; i < arm.samples.size(); ++i) {
    const Sample &a = arm.samples[i], &b = aeronet.samples[i];
    EXPECT_NEAR(a.value, b.value, kSingle * b.value);
    EXPECT_EQ(a.wavelength_nm, b.wavelength_nm);
    EXPECT_NEAR(a.sun_zenith, b.sun_zenith, kSingle);
    EXPECT_NEAR(a.view_zenith, b.view_zenith, kSingle);
    EXPECT_NEAR(std::remainder(a.relative_azimuth - b.relative_azimuth, 2 * M_PI), 0, kSingle);
    EXPECT_EQ(a.scan, b.scan);
    EXPECT_EQ(a.zero_weight_reason, b.zero_weight_reason);
  }
}

TEST_F(ArmFiles, MayBeNetcdf4AndLackValues) {
  const Reference sky = read(small());
  ASSERT_EQ(sky.samples.size(), 3);
  EXPECT_EQ(sky.quantity, Quantity::kSpectralRadiance);
  EXPECT_NEAR(sky.samples[0].value, 0.085, 1e-12);  // uW cm-2 = 0.01 W m-2
  EXPECT_EQ(sky.samples[0].wavelength_nm, 500);
  EXPECT_EQ(sky.samples[1].zero_weight_reason, "missing");
  EXPECT_NEAR(std::abs(sky.samples[2].relative_azimuth), M_PI / 3, 1e-9);
}

TEST_F(ArmFiles, OthersAreNamed) {
  NetcdfFile file = small();
  std::erase_if(file.variables, [](const auto& variable) { return variable.name == "alm_rad"; });
  EXPECT_EQ(error_of(file), "no variable alm_rad: expected almucantars of ARM (csphotalm)");
  file = small();
  file.variables[5].units = "W/m^2";
  EXPECT_EQ(error_of(file), "alm_rad in \"W/m^2\": expected microWatt/(cm^2 * nm * ster)");
  file = small();
  file.variables[5].dimensions = {"azimuth", "time"};
  EXPECT_EQ(error_of(file), "alm_rad(azimuth, time): expected alm_rad(time, azimuth)");
  file = small();
  file.variables[1].values = std::vector<double>{1e12};
  EXPECT_THAT(error_of(file), HasSubstr("s since 1970: expected a time before 2100"));
  file = small();
  file.variables[3].values = std::vector<double>{40};  // where the sun is not
  EXPECT_THAT(error_of(file), StartsWith("time 0: "));
}

TEST_F(ArmFiles, UnitsOfTimeAndPlaceAreRead) {
  NetcdfFile file = small();
  file.variables[0].units = "seconds since 2000-1-1";
  EXPECT_EQ(error_of(file),
            "base_time in \"seconds since 2000-1-1\": expected seconds since 1970-01-01");
  file = small();
  file.variables[1].units = "hours since 2024-05-15";
  EXPECT_EQ(error_of(file), "time_offset in \"hours since 2024-05-15\": expected seconds");
  file = small();
  file.variables[6].units = "radian";
  EXPECT_EQ(error_of(file), "lat in \"radian\": expected degrees");
  file = small();
  file.variables[6].values = std::vector<double>{std::nan("")};
  EXPECT_EQ(error_of(file), "lat = nan: expected a latitude in degrees from -90 to 90");
}

TEST_F(ArmFiles, AHeightThatIsNotKnownIsLeftOut) {
  NetcdfFile file = small();
  EXPECT_EQ(read(file).scans.at(0).elevation_m, 700);
  for (const double none : {-9999.0, -999.0, std::nan("")}) {
    file.variables[8].values = std::vector<double>{none};
    EXPECT_FALSE(read(file).scans.at(0).elevation_m.has_value()) << none;
  }
  file.variables[8].values = std::vector<double>{70000};
  EXPECT_EQ(error_of(file), "alt = 70000: expected a height in m from -500 to 9000");
}

TEST_F(ArmFiles, ADamagedOneIsAnError) {
  std::ofstream(file_, std::ios::binary) << "CDF\1 and nothing more";
  EXPECT_THROW(load_measured_sky(file_, {}), std::invalid_argument);
  std::ofstream(file_, std::ios::binary) << "\x89HDF";
  EXPECT_THROW(load_measured_sky(file_, {}), std::runtime_error);
}

}  // namespace
}  // namespace skyfit::refs
