#pragma once
// Scenes made in code for the tests of dicing, and the grids they give.

#include <map>
#include <memory>
#include <string>
#include <vector>

#include "dice/dice.h"

namespace tessera::test {

using Grids = std::vector<std::shared_ptr<const Grid>>;

inline Geometry geometry(Shape shape, std::vector<glm::vec3> points = {}) {
  Geometry g;
  g.shape = std::move(shape);
  if (!points.empty()) g.P_object.push_back(std::move(points));
  return g;
}

/// A scene seen by a perspective camera at the origin looking along z, unless changed.
struct DiceScene {
  Scene scene;
  DiceSettings settings;
  Diagnostics diagnostics;

  explicit DiceScene(int width = 160, int height = 120) {
    CameraSettings& camera = scene.camera;
    camera.projection = Projection::perspective;
    camera.fov_degrees = 60;
    camera.x_resolution = width;
    camera.y_resolution = height;
    camera.near_clip = 0.01;
    settings.crop = {0, 0, width, height};
  }

  Surface& add(Geometry g, const glm::dmat4& world_from_object = glm::dmat4(1.0),
               Attributes attributes = {}) {
    Surface surface;
    surface.id = int(scene.surfaces.size());
    surface.geometry = std::make_shared<Geometry>(std::move(g));
    surface.attributes = std::make_shared<Attributes>(std::move(attributes));
    surface.world_from_object = MovingTransform(world_from_object);
    scene.surfaces.push_back(std::move(surface));
    return scene.surfaces.back();
  }

  std::unique_ptr<GridSource> source(const Camera& camera) {
    return make_grid_source(scene, camera, settings, diagnostics);
  }

  int columns() const {
    return (settings.crop.width() + settings.bucket_size - 1) / settings.bucket_size;
  }
  int rows() const {
    return (settings.crop.height() + settings.bucket_size - 1) / settings.bucket_size;
  }

  /// Every grid of every bucket, once, by id.
  Grids all_grids(DiceCounters* counters = nullptr) {
    const Camera camera(scene.camera);
    const auto grids = source(camera);
    std::map<GridId, std::shared_ptr<const Grid>> by_id;
    for (int j = 0; j < rows(); ++j) {
      for (int i = 0; i < columns(); ++i) {
        for (auto& grid : grids->grids_of_bucket(i, j)) by_id.emplace(grid->id, grid);
      }
    }
    if (counters) *counters = grids->counters();
    Grids found;
    for (auto& entry : by_id) found.push_back(entry.second);
    return found;
  }
};

/// Row-major 4 x 4 basis matrices as RIB has them.
inline constexpr PatchMesh::Basis bezier_basis{-1, 3, -3, 1, 3, -6, 3, 0, -3, 3, 0, 0, 1, 0, 0, 0};
inline PatchMesh::Basis bspline_basis() {
  PatchMesh::Basis basis{-1, 3, -3, 1, 3, -6, 3, 0, -3, 0, 3, 0, 1, 4, 1, 0};
  for (double& b : basis) b /= 6.0;
  return basis;
}

inline PatchMesh bicubic_mesh(int u_vertices = 4, int v_vertices = 4) {
  PatchMesh mesh;
  mesh.bicubic = true;
  mesh.u_vertices = u_vertices;
  mesh.v_vertices = v_vertices;
  mesh.u_basis = mesh.v_basis = bezier_basis;
  return mesh;
}

/// All knots are one: no surface. Takes four points.
inline NurbsPatch nurbs_without_spans() {
  NurbsPatch patch;
  patch.u_vertices = patch.v_vertices = patch.u_order = patch.v_order = 2;
  patch.u_knots = patch.v_knots = {0, 0, 0, 0};
  return patch;
}

inline std::vector<glm::vec3> cube_points() {
  std::vector<glm::vec3> p;
  for (int k = 0; k < 8; ++k) {
    p.emplace_back(k & 1 ? 1.f : -1.f, k & 2 ? 1.f : -1.f, k & 4 ? 1.f : -1.f);
  }
  return p;
}

/// Faces of cube_points(), counterclockwise seen from outside in right-handed coordinates.
inline const std::vector<int> cube_faces{0, 2, 3, 1, 4, 5, 7, 6, 0, 1, 5, 4,
                                         2, 6, 7, 3, 0, 4, 6, 2, 1, 3, 7, 5};

inline SubdivisionMesh cube_cage() {
  SubdivisionMesh mesh;
  mesh.face_vertex_counts.assign(6, 4);
  mesh.face_vertices = cube_faces;
  return mesh;
}

/// A torus of m x n quadrangles as a closed cage; vertex (i, j) has index j * m + i.
inline SubdivisionMesh torus_cage(int m, int n) {
  SubdivisionMesh mesh;
  for (int j = 0; j < n; ++j) {
    for (int i = 0; i < m; ++i) {
      const int a = j * m + i, b = j * m + (i + 1) % m;
      const int c = (j + 1) % n * m + i, d = (j + 1) % n * m + (i + 1) % m;
      mesh.face_vertex_counts.push_back(4);
      mesh.face_vertices.insert(mesh.face_vertices.end(), {a, b, d, c});
    }
  }
  return mesh;
}

inline std::vector<glm::vec3> torus_points(int m, int n, float major = 1.0f, float minor = 0.4f) {
  std::vector<glm::vec3> p;
  for (int j = 0; j < n; ++j) {
    for (int i = 0; i < m; ++i) {
      const float a = 6.2831853f * float(i) / float(m), b = 6.2831853f * float(j) / float(n);
      const float r = major + minor * std::cos(b);
      p.emplace_back(r * std::cos(a), r * std::sin(a), minor * std::sin(b));
    }
  }
  return p;
}

}  // namespace tessera::test
