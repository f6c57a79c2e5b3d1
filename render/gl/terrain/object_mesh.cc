// SPDX-License-Identifier: Apache-2.0
#include "render/gl/terrain/object_mesh.h"

#include <fmt/format.h>
#include <tiny_obj_loader.h>

#include <algorithm>
#include <cmath>
#include <glm/glm.hpp>
#include <map>
#include <sstream>
#include <stdexcept>
#include <utility>

#include "model/base/text.h"
#include "render/gl/terrain/color_reflectance.h"
#include "render/gl/terrain/obj_syntax.h"

namespace skyfit {
namespace {

namespace fs = std::filesystem;

struct ObjFile {
  tinyobj::attrib_t elements;
  std::vector<tinyobj::shape_t> shapes;
  std::vector<tinyobj::material_t> materials;
  std::string warning;
};

// Reads the files of mtllib as tinyobj names them, which are those that it found in the line.
class MaterialFiles : public tinyobj::MaterialReader {
 public:
  MaterialFiles(const fs::path& mesh, NamedFiles named) : mesh_(mesh), named_(named) {}

  bool operator()(const std::string& joined, std::vector<tinyobj::material_t>* materials,
                  std::map<std::string, int>* numbers, std::string* warning,
                  std::string* error) override {
    const std::string name = with_blanks(joined);
    const auto file = named_file(mesh_.parent_path(), name, named_);
    if (!file)
      throw std::runtime_error(
          fmt::format("{}: mtllib {}: expected {}", mesh_.string(), in_quotes(name), kNamedFile));
    if (!fs::exists(*file)) {
      missing_.push_back(excerpt(name));
      return false;
    }
    const std::string materials_text = read_text_file(*file, "a file of materials");
    check_mtl(*file, materials_text);
    std::istringstream text(with_joined_names(materials_text));
    tinyobj::LoadMtl(numbers, materials, &text, warning, error);
    return true;
  }

  // Those that there are not.
  const std::vector<std::string>& missing() const { return missing_; }

 private:
  const fs::path& mesh_;
  NamedFiles named_;
  std::vector<std::string> missing_;
};

// Of the materials that are in none of the files, in one line; empty where all are.
std::string missing_materials(const fs::path& mesh, const MaterialUses& uses, const ObjFile& obj,
                              const std::vector<std::string>& missing_files, double reflectance) {
  const std::pair<const std::string, int>* first = nullptr;
  int count = 0;
  for (const auto& use : uses) {
    if (std::ranges::find(obj.materials, use.first, &tinyobj::material_t::name) !=
        obj.materials.end())
      continue;
    if (first == nullptr || use.second < first->second) first = &use;
    ++count;
  }
  if (count == 0) return {};
  const std::string others =
      count == 1 ? " is" : fmt::format(" and {} other{} are", count - 1, count == 2 ? "" : "s");
  const std::string files = missing_files.empty() ? "in none of the files of mtllib"
                                                  : fmt::format("not to be had, for {} is missing",
                                                                fmt::join(missing_files, ", "));
  return fmt::format("{}:{}: material {}{} {}: drawn grey, with the reflectance {:.6g}",
                     mesh.string(), first->second, in_quotes(with_blanks(first->first)), others,
                     files, reflectance);
}

ObjFile parsed(const fs::path& file, double reflectance, NamedFiles named) {
  std::string joined = with_joined_lines(read_text_file(file, "a mesh", kMostMeshBytes));
  const MaterialUses uses = check_obj(file, joined);
  ObjFile obj;
  std::string warning, error;
  MaterialFiles material_files(file, named);
  std::istringstream text(std::move(joined));
  if (!tinyobj::LoadObj(&obj.elements, &obj.shapes, &obj.materials, &warning, &error, &text,
                        &material_files, true, false)) {
    throw std::runtime_error(
        fmt::format("{}: cannot be read: {}", file.string(), error.substr(0, error.find('\n'))));
  }
  obj.warning = missing_materials(file, uses, obj, material_files.missing(), reflectance);
  return obj;
}

glm::dvec3 vector_of(const std::vector<double>& numbers, int index) {
  const std::size_t i = 3 * static_cast<std::size_t>(index);
  return {numbers[i], numbers[i + 1], numbers[i + 2]};
}

// Turns corners into vertices: corners at one position that share their normal and material become
// one.
class MeshBuilder {
 public:
  MeshBuilder(const ObjFile& obj, ObjectMesh& mesh)
      : obj_(obj), mesh_(mesh), last_at_(obj.elements.vertices.size() / 3, kNone) {}

  void add(const tinyobj::mesh_t& faces) {
    for (std::size_t face = 0; face < faces.material_ids.size(); ++face) {
      const tinyobj::index_t* corners = &faces.indices[3 * face];
      std::array<glm::dvec3, 3> p;
      for (std::size_t k = 0; k < 3; ++k)
        p[k] = vector_of(obj_.elements.vertices, corners[k].vertex_index);
      const glm::dvec3 area = glm::cross(p[1] - p[0], p[2] - p[0]);
      if (glm::length(area) <= 0) continue;
      for (std::size_t k = 0; k < 3; ++k) {
        const Sharing sharing = {normal_index(corners[k]), faces.smoothing_group_ids[face],
                                 faces.material_ids[face]};
        mesh_.indices.push_back(vertex(corners[k].vertex_index, p[k], sharing, area));
      }
    }
  }

  // Where faces of one smoothing group cancel out, there is no better normal than a face's.
  void finish() {
    for (std::size_t i = 0; i < mesh_.indices.size(); ++i) {
      glm::vec3& normal = mesh_.vertices[mesh_.indices[i]].normal;
      if (glm::length(normal) > 0) continue;
      const std::size_t face = i - i % 3;
      const auto p = [&](std::size_t k) {
        return glm::dvec3(mesh_.vertices[mesh_.indices[face + k]].position);
      };
      normal = glm::normalize(glm::cross(p(1) - p(0), p(2) - p(0)));
    }
    for (ObjectVertex& vertex : mesh_.vertices) vertex.normal = glm::normalize(vertex.normal);
  }

 private:
  static constexpr std::uint32_t kNone = ~0u;

  struct Sharing {
    int normal;          // index, or -1
    unsigned int group;  // of smoothing; 0: every face for itself
    int material;
    bool operator==(const Sharing&) const = default;
  };

  // -1 for a normal that points nowhere.
  int normal_index(const tinyobj::index_t& corner) const {
    if (corner.normal_index < 0) return -1;
    const bool points = glm::length(vector_of(obj_.elements.normals, corner.normal_index)) > 0;
    return points ? corner.normal_index : -1;
  }

  std::uint32_t vertex(int position, const glm::dvec3& p, const Sharing& sharing,
                       const glm::dvec3& area) {
    std::uint32_t& last = last_at_[static_cast<std::size_t>(position)];
    const bool alone = sharing.normal < 0 && sharing.group == 0;
    for (std::uint32_t i = alone ? kNone : last; i != kNone; i = before_[i]) {
      if (sharing_[i] != sharing) continue;
      if (sharing.normal < 0) mesh_.vertices[i].normal += glm::vec3(area);
      return i;
    }
    const auto material = static_cast<std::size_t>(
        sharing.material < 0 ? static_cast<int>(mesh_.materials.size()) - 1 : sharing.material);
    ObjectVertex made{glm::vec3(p), glm::vec3(area), {}};
    if (sharing.normal >= 0)
      made.normal = glm::normalize(vector_of(obj_.elements.normals, sharing.normal));
    for (std::size_t k = 0; k < 4; ++k)
      made.reflectance[k] = static_cast<float>(mesh_.materials[material].reflectance[k]);
    mesh_.vertices.push_back(made);
    sharing_.push_back(sharing);
    before_.push_back(last);
    last = static_cast<std::uint32_t>(mesh_.vertices.size() - 1);
    return last;
  }

  const ObjFile& obj_;
  ObjectMesh& mesh_;
  std::vector<std::uint32_t> last_at_;  // [position] its last vertex
  std::vector<std::uint32_t> before_;   // [vertex] another one at the same position
  std::vector<Sharing> sharing_;        // [vertex]
};

}  // namespace

ObjectMesh read_object_mesh(const fs::path& file, double reflectance, const ColorRule& rule,
                            NamedFiles named) {
  const ObjFile obj = parsed(file, reflectance, named);
  const ColorReflectance colors(rule);
  ObjectMesh mesh;
  mesh.warning = obj.warning;
  for (const tinyobj::material_t& material : obj.materials) {
    const glm::dvec3 color(material.diffuse[0], material.diffuse[1], material.diffuse[2]);
    mesh.materials.push_back({with_blanks(material.name), colors.at(glm::clamp(color, 0.0, 1.0))});
  }
  mesh.materials.push_back({"", {reflectance, reflectance, reflectance, reflectance}});
  MeshBuilder builder(obj, mesh);
  for (const tinyobj::shape_t& shape : obj.shapes) builder.add(shape.mesh);
  if (mesh.indices.empty())
    throw std::runtime_error(fmt::format("{}: no face has an area", file.string()));
  builder.finish();
  return mesh;
}

glm::dmat3 planet_from_mesh(const PlacedMesh& mesh) {
  const double sp = std::sin(mesh.latitude), cp = std::cos(mesh.latitude);
  const double sl = std::sin(mesh.longitude), cl = std::cos(mesh.longitude);
  const glm::dvec3 up(cp * cl, cp * sl, sp), north(-sp * cl, -sp * sl, cp), east(-sl, cl, 0);
  const glm::dvec3 forward = std::cos(mesh.heading) * north + std::sin(mesh.heading) * east;
  return mesh.scale * glm::dmat3(glm::cross(forward, up), up, -forward);
}

glm::dvec3 origin_of(const PlacedMesh& mesh, double bottom_radius_m) {
  const double sp = std::sin(mesh.latitude), cp = std::cos(mesh.latitude);
  return (bottom_radius_m + mesh.altitude_m) *
         glm::dvec3(cp * std::cos(mesh.longitude), cp * std::sin(mesh.longitude), sp);
}

}  // namespace skyfit
