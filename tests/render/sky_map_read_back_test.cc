// SPDX-License-Identifier: Apache-2.0
// A map that is written in any projection is read back as the same measured sky as the panorama,
// whose reader (data_refs/panorama.h) shares no geometry with the writer.
#include <gtest/gtest.h>

#include <cmath>

#include "data_refs/sky_image.h"
#include "data_refs/spectra.h"
#include "model/numerics/angles.h"
#include "model/registry.h"
#include "render/sky_map/sky_map.h"

namespace skyfit {
namespace {

constexpr double kSunZenith_deg = 50, kSunAzimuth_deg = 140;

refs::Reference read_back(std::string_view projection, int size) {
  const SpectralData& spectra = refs::standard_spectral_data();
  SkyMapOptions options;
  options.sun_zenith = kSunZenith_deg * kRadiansPerDegree;
  options.sun_azimuth = kSunAzimuth_deg * kRadiansPerDegree;
  options.sun_disc = false;
  const SkyMap map =
      sky_map(*make_sky_model("reference", spectra, 2), Atmosphere<double>{}, xyz_channels(spectra),
              *make_map_projection(projection, size), options);
  refs::ImportOptions facts;
  facts.projection = projection == "fisheye" ? "equidistant" : projection;
  facts.unit = "cd m-2";
  facts.sun_zenith_deg = kSunZenith_deg;
  facts.sun_azimuth_deg = kSunAzimuth_deg;
  facts.bin_deg = 12;
  const refs::Image image{map.width, map.height, {"X", "Y", "Z"}, map.pixels};
  return refs::sky_image_reference(image, nullptr, false, "sky.exr", facts);
}

TEST(SkyMapReadBack, BinsAreThoseOfThePanorama) {
  constexpr double kPixelsAtEdges = 0.01;  // of bins, which fall to one side or the other
  const refs::Reference panorama = read_back("equirectangular", 720);
  for (const auto& [projection, size] :
       {std::pair{"angular", 1080}, {"cube", 360}, {"octahedral", 720}, {"fisheye", 720}}) {
    const refs::Reference sky = read_back(projection, size);
    ASSERT_EQ(sky.samples.size(), 145u);
    double worst = 0;
    for (std::size_t i = 0; i < sky.samples.size(); ++i) {
      const double error = sky.samples[i].value / panorama.samples[i].value - 1;
      worst = std::max(worst, std::abs(error));
      EXPECT_NEAR(error, 0, kPixelsAtEdges) << projection << ", bin " << sky.samples[i].direction;
    }
    std::printf("[  worst ] %s %.2e\n", projection, worst);
  }
}

}  // namespace
}  // namespace skyfit
