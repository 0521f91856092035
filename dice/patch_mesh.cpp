#include "dice/patch_mesh.h"

#include "dice/bezier.h"
#include "dice/bicubic.h"
#include "dice/bilinear.h"
#include "dice/rational.h"

namespace tessera {

std::function<void(std::span<const float>, std::span<const float>, float*, size_t)>
bezier_primvar_evaluator(int u_degree, int v_degree, int components, std::vector<double> values,
                         std::vector<double> weights) {
  return [=, values = std::move(values), weights = std::move(weights)](
             std::span<const float> u, std::span<const float> v, float* out, size_t stride) {
    const size_t width = size_t(u_degree) + 1, height = size_t(v_degree) + 1;
    std::vector<double> bu(width), bv(height), sum(size_t(components), 0.0);
    for (size_t n = 0; n < u.size(); ++n) {
      bernstein(u_degree, u[n], bu.data(), nullptr);
      bernstein(v_degree, v[n], bv.data(), nullptr);
      double total = 0;
      sum.assign(size_t(components), 0.0);
      for (size_t k = 0; k < width * height; ++k) {
        const double w = bu[k % width] * bv[k / width] * (weights.empty() ? 1.0 : weights[k]);
        total += w;
        for (size_t c = 0; c < sum.size(); ++c) sum[c] += w * values[k * sum.size() + c];
      }
      if (weights.empty()) total = 1;
      for (size_t c = 0; c < sum.size(); ++c) out[c * stride + n] = float(sum[c] / total);
    }
  };
}

namespace {

class PatchMeshPatchSet final : public PatchSet {
 public:
  PatchMeshPatchSet(const Surface& surface, const MovingPoints& points)
      : surface_(surface), points_(points), mesh_(std::get<PatchMesh>(surface.geometry->shape)) {
    array_ = {mesh_.u_patches(), mesh_.v_patches(), mesh_.u_periodic, mesh_.v_periodic};
    if (!mesh_.bicubic) return;
    u_matrix_ = bezier_from_basis(mesh_.u_basis);
    v_matrix_ = bezier_from_basis(mesh_.v_basis);
  }

  uint32_t patch_count() const override { return uint32_t(array_.u_patches * array_.v_patches); }

  std::unique_ptr<Patch> patch(uint32_t index) const override {
    const int keys = points_.key_count();
    if (!mesh_.bicubic) {
      std::vector<BilinearPatch::Corners> corners(static_cast<size_t>(keys));
      for (int key = 0; key < keys; ++key) {
        for (int c = 0; c < 4; ++c) {
          corners[size_t(key)][size_t(c)] = points_.point(key, vertex(index, c & 1, c >> 1));
        }
      }
      return std::make_unique<BilinearPatch>(std::move(corners));
    }
    std::vector<BicubicControl> controls;
    for (int key = 0; key < keys; ++key) {
      glm::vec3 p[16];
      for (int k = 0; k < 16; ++k) p[k] = points_.point(key, vertex(index, k % 4, k / 4));
      controls.push_back(bicubic_control(p, u_matrix_, v_matrix_));
    }
    return std::make_unique<BicubicPatch>(std::move(controls));
  }

  SharedSide shared_side(uint32_t patch, int side) const override {
    return array_.shared_side(patch, side);
  }
  Location shared_corner(uint32_t patch, int corner) const override {
    return array_.shared_corner(patch, corner);
  }
  ParameterRect surface_parameters(uint32_t patch) const override {
    return array_.surface_parameters(patch);
  }

  std::vector<PatchPrimvar> primvars(uint32_t index, const PrimvarFilter& wants) const override {
    return wanted_primvars(surface_.geometry->primvars, wants,
                           [&](const Parameter& p) { return primvar(p, index); });
  }

 private:
  /// Control point (i, j) of a patch.
  int vertex(uint32_t patch, int i, int j) const {
    const int u_step = mesh_.bicubic ? mesh_.u_step : 1, v_step = mesh_.bicubic ? mesh_.v_step : 1;
    const int u = int(patch) % array_.u_patches * u_step + i;
    const int v = int(patch) / array_.u_patches * v_step + j;
    return v % mesh_.v_vertices * mesh_.u_vertices + u % mesh_.u_vertices;
  }

  PatchPrimvar primvar(const Parameter& p, uint32_t index) const {
    const size_t patches = patch_count(), patch = index;
    switch (p.storage) {
      case StorageClass::constant:
        return constant_primvar(p, 0);
      case StorageClass::uniform:
        return constant_primvar(p, patch);
      case StorageClass::vertex:
        return vertex_primvar(p, index);
      case StorageClass::facevarying:
        if (p.value_count() == 4 * patches) {
          return bilinear_primvar(p, {4 * patch, 4 * patch + 1, 4 * patch + 2, 4 * patch + 3});
        }
        break;
      case StorageClass::varying:
        break;
    }
    const size_t width = size_t(array_.u_patches + (array_.u_wraps ? 0 : 1));
    const size_t height = size_t(array_.v_patches + (array_.v_wraps ? 0 : 1));
    const size_t i = patch % size_t(array_.u_patches), j = patch / size_t(array_.u_patches);
    const size_t right = (i + 1) % width, above = (j + 1) % height;
    return bilinear_primvar(
        p, {j * width + i, j * width + right, above * width + i, above * width + right});
  }

  PatchPrimvar vertex_primvar(const Parameter& p, uint32_t index) const {
    if (!mesh_.bicubic) {
      return bilinear_primvar(p, {size_t(vertex(index, 0, 0)), size_t(vertex(index, 1, 0)),
                                  size_t(vertex(index, 0, 1)), size_t(vertex(index, 1, 1))});
    }
    PatchPrimvar primvar;
    primvar.source = &p;
    primvar.components = p.floats_per_value();
    const size_t n = size_t(primvar.components);
    std::vector<double> bezier(16 * n, 0.0);
    for (int k = 0; k < 16; ++k) {
      for (int m = 0; m < 16; ++m) {
        const double weight =
            u_matrix_[size_t(k % 4 * 4 + m % 4)] * v_matrix_[size_t(k / 4 * 4 + m / 4)];
        if (weight == 0) continue;
        const float* value = p.numbers.data() + size_t(vertex(index, m % 4, m / 4)) * n;
        for (size_t c = 0; c < n; ++c) bezier[size_t(k) * n + c] += weight * double(value[c]);
      }
    }
    primvar.custom = bezier_primvar_evaluator(3, 3, primvar.components, std::move(bezier), {});
    return primvar;
  }

  const Surface& surface_;
  const MovingPoints& points_;
  const PatchMesh& mesh_;
  PatchArray array_;
  PatchMesh::Basis u_matrix_{}, v_matrix_{};
};

}  // namespace

std::unique_ptr<PatchSet> make_patch_mesh_patches(const Surface& surface,
                                                  const MovingPoints& points) {
  return std::make_unique<PatchMeshPatchSet>(surface, points);
}

}  // namespace tessera
