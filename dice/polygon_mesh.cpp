#include "dice/polygon_mesh.h"

#include <algorithm>
#include <map>
#include <numeric>

#include "dice/bilinear.h"
#include "dice/triangulate.h"

namespace tessera {

std::shared_ptr<const PolygonTopology> make_polygon_topology(const Geometry& geometry) {
  const PolygonMesh& mesh = std::get<PolygonMesh>(geometry.shape);
  auto topology = std::make_shared<PolygonTopology>();
  size_t loop_index = 0;
  int corner = 0;
  std::vector<glm::dvec3> points;
  for (size_t polygon = 0; polygon < mesh.loops_per_polygon.size(); ++polygon) {
    // Loops of indices into this polygon's own list of points, which starts at corner `first`.
    const int first = corner;
    points.clear();
    std::vector<std::vector<int>> loops;
    for (int l = 0; l < mesh.loops_per_polygon[polygon]; ++l, ++loop_index) {
      std::vector<int> loop(size_t(mesh.vertices_per_loop[loop_index]));
      std::iota(loop.begin(), loop.end(), corner - first);
      for (size_t k = 0; k < loop.size(); ++k, ++corner) {
        points.emplace_back(geometry.P_object[0][size_t(mesh.vertices[size_t(corner)])]);
      }
      loops.push_back(std::move(loop));
    }
    if (loops.size() == 1 && is_convex_quad(points, loops[0])) {
      topology->pieces.push_back({{first, first + 1, first + 3, first + 2}, int(polygon)});
      continue;
    }
    for (const auto& [a, b, c] : triangulate(points, loops)) {
      topology->pieces.push_back({{first + a, first + b, first + c, first + c}, int(polygon)});
    }
  }
  return topology;
}

namespace {

class PolygonPatchSet final : public PatchSet {
 public:
  PolygonPatchSet(const Surface& surface, const MovingPoints& points,
                  std::shared_ptr<const PolygonTopology> topology, bool smooth_normals)
      : geometry_(*surface.geometry),
        mesh_(std::get<PolygonMesh>(geometry_.shape)),
        points_(points),
        topology_(std::move(topology)) {
    if (smooth_normals) {
      compute_vertex_normals();
      find_owners();
    }
  }

  uint32_t patch_count() const override { return uint32_t(topology_->pieces.size()); }

  std::unique_ptr<Patch> patch(uint32_t index) const override {
    const size_t keys = size_t(points_.key_count());
    std::vector<BilinearPatch::Corners> corners(keys), normals(keys);
    for (size_t key = 0; key < keys; ++key) {
      for (size_t c = 0; c < 4; ++c) {
        const int v = vertex(index, c);
        corners[key][c] = points_.point(int(key), v);
        if (!vertex_normals_.empty()) normals[key][c] = vertex_normals_[key][size_t(v)];
      }
    }
    auto patch = std::make_unique<BilinearPatch>(std::move(corners));
    if (!vertex_normals_.empty()) patch->set_corner_normals(std::move(normals));
    return patch;
  }

  std::vector<PatchPrimvar> primvars(uint32_t index, const PrimvarFilter& wants) const override {
    const PolygonTopology::Piece& piece = topology_->pieces[index];
    return wanted_primvars(geometry_.primvars, wants, [&](const Parameter& p) {
      if (p.storage == StorageClass::constant) return constant_primvar(p, 0);
      if (p.storage == StorageClass::uniform) return constant_primvar(p, size_t(piece.polygon));
      const bool by_corner = p.storage == StorageClass::facevarying;
      size_t at[4];
      for (size_t c = 0; c < 4; ++c) at[c] = size_t(by_corner ? piece.corner[c] : vertex(index, c));
      return bilinear_primvar(p, at);
    });
  }

  SharedSide shared_side(uint32_t index, int side) const override {
    const auto owner = edge_owners_.find(edge_of(index, side));
    if (owner == edge_owners_.end()) return PatchSet::shared_side(index, side);
    SharedSide shared = PatchSet::shared_side(owner->second.piece, owner->second.at);
    shared.reversed = side_vertices(index, side).first !=
                      side_vertices(owner->second.piece, owner->second.at).first;
    return shared;
  }

  Location shared_corner(uint32_t index, int corner) const override {
    if (corner_owners_.empty()) return own_corner(index, corner);
    const Owner& owner = corner_owners_[size_t(vertex(index, size_t(corner)))];
    return own_corner(owner.piece, owner.at);
  }

  std::optional<PatchPrimvar> default_st(uint32_t index) const override {
    // The RenderMan interface: s, t of polygons are x, y in object space.
    PatchPrimvar st;
    st.components = 2;
    for (size_t c = 0; c < 4; ++c) {
      const glm::vec3 p = geometry_.P_object[0][size_t(vertex(index, c))];
      st.values.push_back(p.x);
      st.values.push_back(p.y);
    }
    return st;
  }

 private:
  int vertex(uint32_t piece, size_t corner) const {
    return mesh_.vertices[size_t(topology_->pieces[piece].corner[corner])];
  }

  struct Owner {
    uint32_t piece = 0;
    int at = -1;  // side or corner
  };

  std::pair<int, int> side_vertices(uint32_t index, int side) const {
    constexpr size_t corners[4][2] = {{0, 1}, {1, 3}, {2, 3}, {0, 2}};
    return {vertex(index, corners[side][0]), vertex(index, corners[side][1])};
  }
  std::pair<int, int> edge_of(uint32_t index, int side) const {
    const auto [a, b] = side_vertices(index, side);
    return {std::min(a, b), std::max(a, b)};
  }

  // Positions agree along edges whoever evaluates them; what displaces them (normals, texture
  // coordinates) is interpolated from one of the polygons for all.
  void find_owners() {
    corner_owners_.resize(geometry_.P_object[0].size());
    for (uint32_t i = 0; i < patch_count(); ++i) {
      for (int k = 0; k < 4; ++k) {
        edge_owners_.try_emplace(edge_of(i, k), Owner{i, k});
        Owner& corner = corner_owners_[size_t(vertex(i, size_t(k)))];
        if (corner.at < 0) corner = {i, k};
      }
    }
  }

  void compute_vertex_normals() {
    for (int key = 0; key < points_.key_count(); ++key) {
      std::vector<glm::dvec3> sums(geometry_.P_object[0].size(), glm::dvec3(0));
      for (uint32_t i = 0; i < patch_count(); ++i) {
        const glm::dvec3 a(points_.point(key, vertex(i, 0))), b(points_.point(key, vertex(i, 1)));
        const glm::dvec3 c(points_.point(key, vertex(i, 3))), d(points_.point(key, vertex(i, 2)));
        const glm::dvec3 area = glm::cross(c - a, d - b);
        const bool triangle = topology_->pieces[i].corner[2] == topology_->pieces[i].corner[3];
        const glm::dvec3 normal = triangle ? glm::cross(b - a, c - a) : area;
        for (size_t k = 0; k < (triangle ? 3u : 4u); ++k) sums[size_t(vertex(i, k))] += normal;
      }
      std::vector<glm::vec3> normals;
      for (const glm::dvec3& sum : sums) {
        const double length = glm::length(sum);
        normals.emplace_back(length > 0 ? sum / length : glm::dvec3(0));
      }
      vertex_normals_.push_back(std::move(normals));
    }
  }

  const Geometry& geometry_;
  const PolygonMesh& mesh_;
  const MovingPoints& points_;
  std::shared_ptr<const PolygonTopology> topology_;
  // Only for meshes to be displaced:
  std::vector<std::vector<glm::vec3>> vertex_normals_;  // [key][vertex]
  std::map<std::pair<int, int>, Owner> edge_owners_;
  std::vector<Owner> corner_owners_;  // [vertex]
};

}  // namespace

std::unique_ptr<PatchSet> make_polygon_patches(const Surface& surface, const MovingPoints& points,
                                               std::shared_ptr<const PolygonTopology> topology,
                                               bool smooth_normals) {
  return std::make_unique<PolygonPatchSet>(surface, points, std::move(topology), smooth_normals);
}

}  // namespace tessera
