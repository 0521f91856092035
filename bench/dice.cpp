// Grid vertices (positions and normals) diced per second on one core, against OpenSubdiv's own
// evaluation of the same limit points.

#include <algorithm>
#include <cmath>
#include <vector>

#include <glm/gtc/matrix_transform.hpp>

#include "bench/harness/benchmark.h"
#include "dice/chunk.h"
#include "dice/subdivision_topology.h"

namespace tessera {

namespace {

constexpr float tau = 6.28318531f;

// A closed torus of m x n quadrangles: every vertex regular.
Geometry torus(int m, int n) {
  SubdivisionMesh mesh;
  Geometry geometry;
  geometry.P_object.resize(1);
  for (int j = 0; j < n; ++j) {
    for (int i = 0; i < m; ++i) {
      const int right = (i + 1) % m, above = (j + 1) % n;
      mesh.face_vertex_counts.push_back(4);
      for (int v : {j * m + i, j * m + right, above * m + right, above * m + i}) {
        mesh.face_vertices.push_back(v);
      }
      const float a = tau * float(i) / float(m), b = tau * float(j) / float(n);
      const float r = 1.0f + 0.5f * std::cos(b);
      geometry.P_object[0].emplace_back(r * std::cos(a), r * std::sin(a), 0.5f * std::sin(b));
    }
  }
  geometry.shape = mesh;
  return geometry;
}

// Many cubes: every vertex of valence three, so every face irregular.
Geometry cubes(int count) {
  constexpr int faces[24] = {0, 2, 3, 1, 4, 5, 7, 6, 0, 1, 5, 4,
                             2, 6, 7, 3, 0, 4, 6, 2, 1, 3, 7, 5};
  SubdivisionMesh mesh;
  Geometry geometry;
  geometry.P_object.resize(1);
  for (int c = 0; c < count; ++c) {
    for (int v : faces) mesh.face_vertices.push_back(8 * c + v);
    for (int f = 0; f < 6; ++f) mesh.face_vertex_counts.push_back(4);
    for (int k = 0; k < 8; ++k) {
      geometry.P_object[0].emplace_back(k & 1 ? 1.f : -1.f, k & 2 ? 1.f : -1.f, k & 4 ? 1.f : -1.f);
    }
  }
  geometry.shape = mesh;
  return geometry;
}

// A strip of bicubic Bezier patches.
Geometry bicubic_strip(int count) {
  PatchMesh mesh;
  mesh.bicubic = true;
  mesh.u_vertices = 3 * count + 1;
  mesh.v_vertices = 4;
  mesh.u_basis = mesh.v_basis = {-1, 3, -3, 1, 3, -6, 3, 0, -3, 3, 0, 0, 1, 0, 0, 0};
  Geometry geometry;
  geometry.P_object.resize(1);
  for (int j = 0; j < 4; ++j) {
    for (int i = 0; i < mesh.u_vertices; ++i) {
      const float a = tau * float(i) / float(mesh.u_vertices - 1);
      geometry.P_object[0].emplace_back(std::cos(a), std::sin(a), 0.5f * float(j) / 3.0f);
    }
  }
  geometry.shape = mesh;
  return geometry;
}

// One surface, its camera and its chunks, each patch of about one full grid.
class Workload {
 public:
  Workload(Geometry geometry, float shading_rate)
      : camera_(settings()), projection_(camera_, crop()) {
    auto attributes = std::make_shared<Attributes>();
    attributes->shading_rate = shading_rate;
    surface_.geometry = std::make_shared<Geometry>(std::move(geometry));
    surface_.attributes = attributes;
    surface_.world_from_object = MovingTransform(glm::rotate(
        glm::translate(glm::dmat4(1), glm::dvec3(0, 0, 5)), 0.7, glm::dvec3(1, 0.4, 0)));
    dice_settings_.crop = crop();
    context_ = make_surface_context(surface_, 0, camera_, projection_, dice_settings_, topologies_);
    DiceCounters counters;
    chunks_ = make_chunks(context_, 0, context_.patches->patch_count(), 32, counters, diagnostics_);
  }

  /// Dices everything once; returns the number of vertices.
  uint64_t run() {
    DiceCounters counters;
    for (const Chunk& chunk : chunks_) keep(dice(chunk, context_, counters, diagnostics_));
    return counters.vertices;
  }

  /// Largest distance, in camera units, of a diced vertex from Bfr's point at its parameters.
  double max_difference() {
    double largest = 0;
    DiceCounters counters;
    for (const Chunk& chunk : chunks_) {
      for (const auto& grid : dice(chunk, context_, counters, diagnostics_)) {
        const Face face = face_of(int(grid->id.face));
        for (int k = 0; k < grid->vertex_count(); ++k) {
          const float uv[2] = {grid->uv[size_t(k)], grid->uv[grid->stride() + size_t(k)]};
          glm::vec3 P;
          face.surface.Evaluate(uv, face.points.data(), 3, &P.x);
          const glm::vec3 Q(grid->P(0, 0)[k], grid->P(0, 1)[k], grid->P(0, 2)[k]);
          largest = std::max(largest, double(glm::distance(P, Q)));
        }
      }
    }
    return largest;
  }

  /// Bfr::Surface::Evaluate with unit normals at 33 x 33 points of every face; returns their
  /// number.
  uint64_t run_bfr() {
    uint64_t points = 0;
    for (uint32_t index = 0; index < context_.patches->patch_count(); ++index) {
      const Face face = face_of(int(index));
      for (int j = 0; j <= 32; ++j) {
        for (int i = 0; i <= 32; ++i) {
          const float uv[2] = {float(i) / 32.0f, float(j) / 32.0f};
          glm::vec3 P, Du, Dv;
          face.surface.Evaluate(uv, face.points.data(), 3, &P.x, &Du.x, &Dv.x);
          keep(P);
          keep(glm::normalize(glm::cross(Du, Dv)));
          ++points;
        }
      }
    }
    return points;
  }

 private:
  struct Face {
    SubdivisionTopology::BfrSurface surface;
    std::vector<float> points;
  };
  Face face_of(int index) {
    Face face;
    const auto topology = topologies_.subdivision(*surface_.geometry);
    topology->factory().InitVertexSurface(index, &face.surface);
    if (mesh_points_.empty()) {
      for (int v = 0; v < int(surface_.geometry->P_object[0].size()); ++v) {
        const glm::vec3 p = context_.points->point(0, v);
        for (int axis = 0; axis < 3; ++axis) mesh_points_.push_back(p[axis]);
      }
    }
    face.points.resize(size_t(face.surface.GetNumPatchPoints()) * 3);
    face.surface.PreparePatchPoints(mesh_points_.data(), 3, face.points.data(), 3);
    return face;
  }

  static CameraSettings settings() {
    CameraSettings camera;
    camera.projection = Projection::perspective;
    camera.fov_degrees = 40;
    camera.x_resolution = camera.y_resolution = 800;
    return camera;
  }
  static PixelRect crop() { return {0, 0, 800, 800}; }

  Camera camera_;
  RasterProjection projection_;
  DiceSettings dice_settings_;
  Diagnostics diagnostics_;
  TopologyCache topologies_;
  Surface surface_;
  SurfaceContext context_;
  std::vector<Chunk> chunks_;
  std::vector<float> mesh_points_;
};

void run(BenchmarkContext& context) {
  const int scale = context.scaled(8, 2), repeats = context.scaled(7, 5);
  // Rates that give grids of nearly 32 x 32 micropolygons.
  Workload bicubic(bicubic_strip(24 * scale), 0.05f);
  Workload regular(torus(16 * scale, 12), 1.2f / float(scale));
  Workload irregular(cubes(2 * scale), 40.0f);
  uint64_t vertices[4] = {};
  const std::vector<Timing> timings =
      interleave({{"bicubic", [&] { vertices[0] = bicubic.run(); }},
                  {"regular", [&] { vertices[1] = regular.run(); }},
                  {"irregular", [&] { vertices[2] = irregular.run(); }},
                  {"bfr_evaluate", [&] { vertices[3] = regular.run_bfr(); }}},
                 repeats);
  const double bfr_rate = double(vertices[3]) / timings[3].median_s();
  const double difference[4] = {0, regular.max_difference(), irregular.max_difference(), 0};
  for (size_t k = 0; k < timings.size(); ++k) {
    const double rate = double(vertices[k]) / timings[k].median_s();
    BenchmarkContext::Columns columns{
        {"vertices_per_s", rate}, {"ratio", rate / bfr_rate}, {"spread", timings[k].spread()}};
    if (k == 1 || k == 2) columns.emplace_back("max_difference", difference[k]);
    context.add_row(timings[k].name, std::move(columns));
  }
}

}  // namespace

BenchmarkDefinition benchmark_dice() {
  return {"dice",
          "grid vertices (P and N) diced per second and core, against Bfr::Surface::Evaluate", run};
}

}  // namespace tessera
