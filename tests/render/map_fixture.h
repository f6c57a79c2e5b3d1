// SPDX-License-Identifier: Apache-2.0
// Small maps of a planet, written into a directory of their own.
#pragma once

#include <OpenImageIO/imageio.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <glm/glm.hpp>
#include <numbers>
#include <random>
#include <string>
#include <vector>

#include "model/base/temporary_directory.h"
#include "render/gl/terrain/map_layout.h"

namespace skyfit {

class MapFiles : public ::testing::Test {
 protected:
  std::filesystem::path write(const std::string& name, int width, int height, int channels,
                              OIIO::TypeDesc type, const std::vector<float>& values) const {
    const std::filesystem::path file = directory_ / name;
    const auto output = OIIO::ImageOutput::create(file.string());
    EXPECT_TRUE(output &&
                output->open(file.string(), OIIO::ImageSpec(width, height, channels, type)) &&
                output->write_image(OIIO::TypeDesc::FLOAT, values.data()) && output->close());
    return file;
  }

  // A picture of value(direction) at the centres of the texels.
  template <class F>
  std::filesystem::path write_globe(const std::string& name, int rows, bool cube,
                                    OIIO::TypeDesc type, F&& value) const {
    const int columns = rows * (cube ? 6 : 2);
    std::vector<float> values;
    for (int y = 0; y < rows; ++y) {
      for (int x = 0; x < columns; ++x) {
        const glm::dvec3 direction =
            cube ? CubeLayout::direction_of(x / rows, x % rows + 0.5, y + 0.5, rows)
                 : at(std::numbers::pi * (0.5 - (y + 0.5) / rows),
                      std::numbers::pi * ((x + 0.5) / rows - 1));
        values.push_back(static_cast<float>(value(direction)));
      }
    }
    return write(name, columns, rows, 1, type, values);
  }

  static glm::dvec3 at(double latitude, double longitude) {
    return {std::cos(latitude) * std::cos(longitude), std::cos(latitude) * std::sin(longitude),
            std::sin(latitude)};
  }

  static std::vector<float> noise(std::size_t count) {
    std::mt19937 random(1);
    std::uniform_real_distribution<float> uniform(0, 1);
    std::vector<float> values(count);
    for (float& value : values) value = uniform(random);
    return values;
  }

  const TemporaryDirectory temporary_;
  const std::filesystem::path directory_ = temporary_.path();
};

}  // namespace skyfit
