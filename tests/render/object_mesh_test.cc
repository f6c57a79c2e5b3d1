// SPDX-License-Identifier: Apache-2.0
// OBJ files become triangles with normals and reflectances; a mesh stands upright at its place and
// faces its heading. What the file says wrongly is named with its line.
#include "render/gl/terrain/object_mesh.h"

#include <gmock/gmock.h>
#include <unistd.h>

#include <fstream>
#include <glm/glm.hpp>
#include <numbers>
#include <stdexcept>

#include "data_refs/spectra.h"
#include "model/base/temporary_directory.h"
#include "render/gl/terrain/color_reflectance.h"

namespace skyfit {
namespace {

namespace fs = std::filesystem;
using ::testing::EndsWith;
using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::StartsWith;

const ColorRule& rule() {
  static const ColorRule made = color_rule(refs::standard_spectral_data());
  return made;
}

class ObjFiles : public ::testing::Test {
 protected:
  fs::path write(const std::string& name, const std::string& text) const {
    std::ofstream(directory_ / name) << text;
    return directory_ / name;
  }
  ObjectMesh read(const std::string& text) const {
    return read_object_mesh(write("mesh.obj", text), 0.25, rule());
  }

  const TemporaryDirectory temporary_;
  const fs::path directory_ = temporary_.path();
};

// From -1 to 1, its faces quadrilaterals seen from outside.
const std::string kCube =
    "v -1 -1 -1\nv 1 -1 -1\nv 1 1 -1\nv -1 1 -1\nv -1 -1 1\nv 1 -1 1\nv 1 1 1\nv -1 1 1\n";
const std::string kCubeFaces =
    "f 4 3 2 1\nf 5 6 7 8\nf 1 2 6 5\nf 3 4 8 7\nf 2 3 7 6\nf -8 -4 -1 -5\n";

double volume(const ObjectMesh& mesh) {
  double sum = 0;
  for (std::size_t i = 0; i < mesh.indices.size(); i += 3) {
    const auto p = [&](std::size_t k) {
      return glm::dvec3(mesh.vertices[mesh.indices[i + k]].position);
    };
    sum += glm::dot(p(0), glm::cross(p(1), p(2))) / 6;
  }
  return sum;
}

TEST_F(ObjFiles, ACubeHasFlatFaces) {
  const ObjectMesh cube = read(kCube + kCubeFaces);
  EXPECT_EQ(cube.indices.size(), 12 * 3);
  EXPECT_NEAR(volume(cube), 8, 1e-12);
  for (std::size_t i = 0; i < cube.indices.size(); ++i) {
    const ObjectVertex& vertex = cube.vertices[cube.indices[i]];
    EXPECT_NEAR(glm::length(vertex.normal), 1, 1e-6);
    // Along one axis, outward.
    EXPECT_NEAR(glm::dot(vertex.normal, vertex.position), 1, 1e-6);
    for (const float value : vertex.reflectance) EXPECT_EQ(value, 0.25f);
  }
}

TEST_F(ObjFiles, ASmoothingGroupSharesItsVertices) {
  const ObjectMesh cube = read(kCube + "s 1\n" + kCubeFaces);
  EXPECT_EQ(cube.vertices.size(), 8);
  EXPECT_EQ(cube.indices.size(), 12 * 3);
  for (const ObjectVertex& vertex : cube.vertices) {
    // A corner's three faces weigh 1 or 2 triangles each.
    EXPECT_NEAR(glm::length(vertex.normal), 1, 1e-6);
    EXPECT_GT(glm::dot(vertex.normal, glm::normalize(vertex.position)), 0.9);
  }
}

TEST_F(ObjFiles, NormalsOfTheFileAreKept) {
  const ObjectMesh mesh =
      read("v 0 0 0\nv 1 0 0\nv 0 1 0\nvn 0 0 2\nvn 0 1 1\nvn 0 0 0\nf 1//1 2//2 3//3\n");
  ASSERT_EQ(mesh.vertices.size(), 3);
  EXPECT_NEAR(mesh.vertices[0].normal.z, 1, 1e-6);
  EXPECT_NEAR(mesh.vertices[1].normal.y, std::sqrt(0.5), 1e-6);
  EXPECT_NEAR(mesh.vertices[2].normal.z, 1, 1e-6);  // the face's: the file's points nowhere
}

TEST_F(ObjFiles, PolygonsBecomeTriangles) {
  // A concave pentagon of area 2.5: an arrow.
  const ObjectMesh mesh = read("v 0 0 0\nv 2 0 0\nv 2 2 0\nv 1 0.5 0\nv 0 2 0\nf 1 2 3 4 5\n");
  ASSERT_EQ(mesh.indices.size(), 9);
  double area = 0;
  for (std::size_t i = 0; i < 9; i += 3) {
    const auto p = [&](std::size_t k) { return mesh.vertices[mesh.indices[i + k]].position; };
    const glm::vec3 twice = glm::cross(p(1) - p(0), p(2) - p(0));
    EXPECT_GT(twice.z, 0);
    area += 0.5 * twice.z;
  }
  EXPECT_NEAR(area, 2.5, 1e-6);
}

TEST_F(ObjFiles, MaterialsHaveTheirColors) {
  write("paint.mtl", "newmtl red\nKd 0.5 0.1 0.1\nnewmtl white\nKd 2 2 2\n");
  const ObjectMesh mesh = read(
      "mtllib paint.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 2 3\nusemtl red\nf 1 2 4\n"
      "usemtl white\nf 1 3 4\n");
  const auto of_face = [&](std::size_t face) {
    const auto& r = mesh.vertices[mesh.indices[3 * face]].reflectance;
    return NodeValues{r[0], r[1], r[2], r[3]};
  };
  ASSERT_EQ(mesh.materials.size(), 3);
  for (const double value : of_face(0)) EXPECT_EQ(value, 0.25);
  const glm::dvec3 red = ColorReflectance(rule()).linear_srgb(of_face(1));
  EXPECT_LT(glm::length(red - glm::dvec3(0.5, 0.1, 0.1)), 1e-6);
  for (const double value : of_face(2)) EXPECT_NEAR(value, 1, 1e-6);  // no more than all light
}

TEST_F(ObjFiles, ABackslashJoinsALineToTheNext) {
  const std::string vertices = "v 0 0 \\\n0\nv 1 0 0\r\nv 0 1 0\n";
  EXPECT_EQ(read(vertices + "f 1 \\\r\n2 \\\n3\n").indices.size(), 3);
  EXPECT_EQ(read(vertices + "f 1 2 3\\").indices.size(), 3);
  try {  // lines count as those of the file
    read(vertices + "f 1 \\\n2 3\nf 1 2 x\n");
    FAIL();
  } catch (const std::runtime_error& error) {
    EXPECT_THAT(error.what(), HasSubstr("mesh.obj:7: "));
  }
}

TEST_F(ObjFiles, AByteOrderMarkIsNoPartOfTheFirstLine) {
  const ObjectMesh mesh = read("\xef\xbb\xbfv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  EXPECT_EQ(mesh.indices.size(), 3);
}

TEST_F(ObjFiles, TrianglesWithoutAreaAreLeftOut) {
  const ObjectMesh mesh = read("v 0 0 0\nv 1 0 0\nv 2 0 0\nv 0 1 0\nf 1 2 3\nf 1 2 4\n");
  EXPECT_EQ(mesh.indices.size(), 3);
  // Both sides of one sheet, smoothed: the normals cancel out.
  for (const ObjectVertex& vertex :
       read("v 0 0 0\nv 1 0 0\nv 0 1 0\ns 1\nf 1 2 3\nf 1 3 2\n").vertices)
    EXPECT_NEAR(std::abs(vertex.normal.z), 1, 1e-6);
}

TEST_F(ObjFiles, ErrorsNameTheFileAndTheLine) {
  const auto error_of = [&](const std::string& text) {
    try {
      read(text);
    } catch (const std::runtime_error& error) {
      const std::string message = error.what();
      EXPECT_THAT(message, StartsWith((directory_ / "mesh.obj").string() + ":"));
      EXPECT_THAT(message, Not(HasSubstr("\n")));
      return message.substr((directory_ / "mesh.obj").string().size());
    }
    return std::string("no error");
  };
  const std::string triangle = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
  EXPECT_EQ(error_of(""), ": no faces");
  EXPECT_EQ(error_of(triangle), ": no faces");
  EXPECT_EQ(error_of(triangle + "f 1 2 4\n"), ":4: vertex 4: the file has 3");
  EXPECT_EQ(error_of(triangle + "f 1 2 -4\n"), ":4: vertex -4: there are 3 before it");
  EXPECT_EQ(error_of(triangle + "vn 0 0 1\nf 1//1 2//1 3//2\n"), ":5: normal 2: the file has 1");
  EXPECT_EQ(error_of(triangle + "f 0 1 2\n"), ":4: expected a vertex from 1 on, got \"0\"");
  EXPECT_EQ(error_of(triangle + "f 1 2 x\n"), ":4: expected a vertex from 1 on, got \"x\"");
  EXPECT_EQ(error_of(triangle + "f 1 2\n"), ":4: a face of 2 corners: expected at least 3");
  EXPECT_EQ(error_of("# one\nv 0 nan 0\n"), ":2: expected three finite numbers, got \"nan\"");
  EXPECT_EQ(error_of("v 0 1e99 0\n"), ":1: expected three finite numbers, got \"1e99\"");
  EXPECT_EQ(error_of("v 0 1\n"), ":1: expected three finite numbers, got \"\"");
  EXPECT_EQ(error_of("v 0 0 0\nv 1 0 0\nv 2 0 0\nf 1 2 3\n"), ": no face has an area");
  EXPECT_THROW(read_object_mesh(directory_ / "missing.obj", 0.3, rule()), std::runtime_error);
  EXPECT_THROW(read_object_mesh(directory_, 0.3, rule()), std::runtime_error);
}

TEST_F(ObjFiles, CommentsStandBehindNumbersButNotInNames) {
  write("own.mtl", "newmtl wall#1\nKd 0.5 0.1 0.1\n");
  const ObjectMesh mesh = read(
      "mtllib own.mtl\nv 0 0 0 # a corner\nv 1 0 0\nv 0 1 0\nusemtl wall#1\nf 1 2 3 # a wall\n");
  EXPECT_EQ(mesh.warning, "");
  EXPECT_EQ(mesh.indices.size(), 3u);
}

TEST_F(ObjFiles, NamesMayHoldBlanks) {
  write("my paints.mtl", "newmtl dark red\nKd 0.5 0.1 0.1\nnewmtl dark blue \nKd 0.1 0.1 0.5\n");
  const ObjectMesh mesh = read(
      "mtllib my paints.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nusemtl dark red\nf 1 2 3\n"
      "usemtl dark blue\nf 1 2 4\nusemtl dark green\nf 1 3 4\n");
  ASSERT_EQ(mesh.materials.size(), 3u);
  EXPECT_EQ(mesh.materials[0].name, "dark red");
  EXPECT_EQ(mesh.materials[1].name, "dark blue");
  EXPECT_LT(mesh.vertices[0].reflectance[0], mesh.vertices[3].reflectance[0]);  // of blue light
  EXPECT_THAT(mesh.warning, HasSubstr("material \"dark green\" is in none of the files"));
}

TEST_F(ObjFiles, AColourIsThreeNumbers) {
  for (const char* wrong : {"Kd 0.5", "Kd 1 x 0", "Kd spectral leaf.rfl 1"}) {
    write("own.mtl", std::string("newmtl leaf\n") + wrong + "\n");
    EXPECT_THAT([&] { read("mtllib own.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl leaf\nf 1 2 3\n"); },
                ::testing::ThrowsMessage<std::runtime_error>(
                    HasSubstr("own.mtl:2: expected three finite numbers, got ")))
        << wrong;
  }
}

TEST_F(ObjFiles, AMaterialThatIsMissingIsGreyAndNamed) {
  const std::string triangle = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
  const std::string file = (directory_ / "mesh.obj").string();
  const ObjectMesh lost = read(triangle + "mtllib trees.mtl\nusemtl bark\nf 1 2 3\n");
  EXPECT_EQ(lost.warning, file +
                              ":5: material \"bark\" is not to be had, for trees.mtl is missing: "
                              "drawn grey, with the reflectance 0.25");
  for (const ObjectVertex& vertex : lost.vertices)
    for (const float value : vertex.reflectance) EXPECT_EQ(value, 0.25f);

  write("own.mtl", "newmtl leaf\nKd 0.1 0.5 0.1\n");
  const std::string own = "mtllib own.mtl\nusemtl leaf\nf 1 2 3\n";
  EXPECT_EQ(read(triangle + own).warning, "");
  const ObjectMesh mixed =
      read(triangle + own + "usemtl twig\nf 1 2 3\nusemtl bark\nf 1 2 3\nusemtl leaf\nf 1 2 3\n");
  EXPECT_EQ(mixed.warning, file +
                               ":7: material \"twig\" and 1 other are in none of the files of "
                               "mtllib: drawn grey, with the reflectance 0.25");
  EXPECT_NE(mixed.vertices[mixed.indices[0]].reflectance[1], 0.25f);
  EXPECT_EQ(mixed.vertices[mixed.indices[3]].reflectance[1], 0.25f);
}

TEST_F(ObjFiles, MoreThanFiftyMillionTrianglesAreTooMany) {
  std::string corners = "f";
  for (int i = 0; i < 500'002; ++i) corners += i % 2 ? " 1" : " 2";
  std::string text = "v 0 0 0\nv 1 0 0\n";
  for (int i = 0; i < 101; ++i) text += corners + "\n";
  try {
    read(text);
    FAIL();
  } catch (const std::runtime_error& error) {
    EXPECT_THAT(error.what(), EndsWith("mesh.obj: more than 50 million triangles"));
  }
}

// Columns: where the mesh's x, y and z axes point to.
void expect_axes(const PlacedMesh& mesh, const glm::dvec3& x, const glm::dvec3& y,
                 const glm::dvec3& z) {
  const glm::dmat3 axes = planet_from_mesh(mesh);
  EXPECT_LT(glm::length(axes[0] - x), 1e-12);
  EXPECT_LT(glm::length(axes[1] - y), 1e-12);
  EXPECT_LT(glm::length(axes[2] - z), 1e-12);
}

TEST(PlacedMesh, StandsUprightAndFacesItsHeading) {
  constexpr double kQuarter = 0.5 * std::numbers::pi;
  PlacedMesh mesh;
  // At latitude 0, longitude 0: up is +x, north +z, east +y.
  expect_axes(mesh, {0, 1, 0}, {1, 0, 0}, {0, 0, -1});
  mesh.heading = kQuarter;  // east
  expect_axes(mesh, {0, 0, -1}, {1, 0, 0}, {0, -1, 0});
  mesh = {};
  mesh.longitude = kQuarter;
  expect_axes(mesh, {-1, 0, 0}, {0, 1, 0}, {0, 0, -1});
  mesh = {};
  mesh.latitude = kQuarter;  // at the pole, coming along longitude 0: north goes on toward -x
  expect_axes(mesh, {0, 1, 0}, {0, 0, 1}, {1, 0, 0});
  mesh.scale = 3;
  expect_axes(mesh, {0, 3, 0}, {0, 0, 3}, {3, 0, 0});
}

TEST(PlacedMesh, IsTurnedNotMirrored) {
  PlacedMesh mesh;
  mesh.latitude = 0.7;
  mesh.longitude = -2.1;
  mesh.heading = 4;
  mesh.scale = 2;
  mesh.altitude_m = 1500;
  const glm::dmat3 axes = planet_from_mesh(mesh);
  EXPECT_NEAR(glm::determinant(axes), 8, 1e-12);
  EXPECT_NEAR(glm::dot(axes[0], axes[1]), 0, 1e-12);
  const glm::dvec3 origin = origin_of(mesh, 6360e3);
  EXPECT_NEAR(glm::length(origin), 6361500, 1e-6);
  EXPECT_NEAR(glm::dot(glm::normalize(origin), axes[1]), 2, 1e-12);
}

}  // namespace
}  // namespace skyfit
