// SPDX-License-Identifier: Apache-2.0
// NetCDF files hold what was put into them, say so when they cannot be written or read, and a fit's
// result is in them with names and units.
#include <gmock/gmock.h>

#include <cmath>
#include <filesystem>
#include <limits>

#include "data_refs/references.h"
#include "data_refs/spectra.h"
#include "fit/exchange/result_netcdf.h"
#include "fit/fit.h"
#include "model/base/temporary_directory.h"
#include "model/base/whole_file.h"
#include "model/registry.h"

namespace skyfit::fit {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

TEST(Netcdf, HoldsWhatWasPutIntoIt) {
  const TemporaryDirectory directory;
  const auto path = directory.path() / "a.nc";
  NetcdfFile file = netcdf_file("A test");
  file.dimensions = {{"row", 2}, {"column", 3}};
  const double missing = std::numeric_limits<double>::quiet_NaN();
  file.variables = {
      {"numbers", {"row", "column"}, std::vector<double>{1, missing, 3, 4, 5, 6.5}, "n", "m"},
      {"counts", {"row"}, std::vector<int>{-1, 7}, "c", "1"},
      {"row", {"row"}, std::vector<std::string>{"\xc3\xa9 one", ""}, "texts", ""}};
  set_coordinates(file, "row", {"counts", "missing"});
  write_netcdf(path, file);
  const NetcdfFile read = read_netcdf(path);
  EXPECT_EQ(read.dimensions, file.dimensions);
  const auto& numbers = netcdf_values<std::vector<double>>(read, "numbers", "a");
  EXPECT_TRUE(std::isnan(numbers[1]));
  EXPECT_EQ(numbers[5], 6.5);
  EXPECT_THAT(netcdf_values<std::vector<int>>(read, "counts", "a"), ElementsAre(-1, 7));
  EXPECT_THAT(netcdf_values<std::vector<std::string>>(read, "row", "a"),
              ElementsAre("\xc3\xa9 one", ""));
  EXPECT_EQ(read.variables[0].units, "m");
  EXPECT_EQ(read.variables[0].coordinates, "counts");
  EXPECT_EQ(read.attributes, file.attributes);
  EXPECT_THROW(netcdf_values<std::vector<int>>(read, "numbers", "a"), std::runtime_error);
}

TEST(Netcdf, SaysWhatCannotBeDone) {
  const TemporaryDirectory directory;
  NetcdfFile file = netcdf_file("A test");
  file.dimensions = {{"row", 2}};
  file.variables = {{"numbers", {"row"}, std::vector<double>{1}, "n", "m"}};
  const auto complaint = [](const auto& what) {
    try {
      what();
    } catch (const std::runtime_error& error) {
      return std::string(error.what());
    }
    return std::string("none");
  };
  EXPECT_THAT(complaint([&] { write_netcdf(directory.path() / "a.nc", file); }),
              HasSubstr("a.nc: cannot be written: numbers has not 2 values"));
  EXPECT_FALSE(std::filesystem::exists(directory.path() / "a.nc"));
  write_file(directory.path() / "b.nc", "no such file");
  EXPECT_THAT(complaint([&] { read_netcdf(directory.path() / "b.nc"); }),
              HasSubstr("b.nc: cannot be read: "));
}

TEST(Netcdf, OfAFitHasItsUnknownsAndSamples) {
  constexpr double kSun = 0.7;
  const refs::Reference reference =
      refs::load_reference("cie:12", {kSun}, refs::Sampling::kPrincipalPlane);
  const SpectralData& spectra = refs::standard_spectral_data();
  FitOptions options;
  options.starts = 1;
  options.max_iterations = 3;
  options.free = {Parameter::kMieScattering};
  const Result result =
      fit_atmosphere(reference, spectra, *make_sky_model("preetham", spectra, 1), options);
  const NetcdfFile file = netcdf_of(result);
  EXPECT_EQ(netcdf_values<std::vector<double>>(file, "reference_value", "fit").size(),
            reference.samples.size());
  EXPECT_EQ(netcdf_values<std::vector<double>>(file, "model", "fit"), result.model);
  EXPECT_EQ(netcdf_values<std::vector<std::string>>(file, "parameter", "fit").size(),
            result.unknowns.size());
  EXPECT_EQ(netcdf_values<std::vector<double>>(file, "parameter_value", "fit")[0],
            result.unknowns[0].fitted);
  const TemporaryDirectory directory;
  write_netcdf(directory.path() / "fit.nc", file);
  EXPECT_EQ(read_netcdf(directory.path() / "fit.nc").variables.size(), file.variables.size());
}

}  // namespace
}  // namespace skyfit::fit
