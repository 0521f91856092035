#include "dice/subdivision.h"

#include "dice/bezier.h"
#include "dice/bicubic.h"
#include "dice/subdivision_topology.h"

namespace tessera {

namespace {

using BfrSurface = SubdivisionTopology::BfrSurface;
using PointDescriptor = BfrSurface::PointDescriptor;

// A face, or a corner's part of one, that is not a single bicubic patch.
class BfrPatch final : public Patch {
 public:
  /// `points` holds each patch point at all keys: [point][key][xyz].
  BfrPatch(const SubdivisionTopology& topology, uint32_t index, const BfrSurface& surface,
           std::vector<float> points, int keys)
      : topology_(topology),
        index_(index),
        surface_(surface),
        points_(std::move(points)),
        keys_(keys) {}

  void points(int key, std::span<const float> u, std::span<const float> v,
              const PatchOutput& out) const override {
    const float* first = points_.data() + 3 * key;
    const PointDescriptor layout(3, 3 * keys_);
    for (size_t i = 0; i < u.size(); ++i) {
      float uv[2];
      glm::vec3 P, Du, Dv;
      topology_.face_parameters(index_, u[i], v[i], uv);
      if (out.wants_normals()) {
        surface_.Evaluate(uv, first, layout, &P.x, &Du.x, &Dv.x);
        const glm::vec3 N = glm::cross(Du, Dv);
        for (int axis = 0; axis < 3; ++axis) out.N[axis][i] = N[axis];
      } else {
        surface_.Evaluate(uv, first, layout, &P.x);
      }
      for (int axis = 0; axis < 3; ++axis) out.P[axis][i] = P[axis];
    }
  }

  void tensor(int key, std::span<const float> u, std::span<const float> v, size_t row_stride,
              const PatchOutput& out) const override {
    std::vector<float> row_v(u.size());
    for (size_t j = 0; j < v.size(); ++j) {
      row_v.assign(u.size(), v[j]);
      points(key, u, row_v, out.from(j * row_stride));
    }
  }

  void append_hull(int key, const ParameterRect&, std::vector<glm::vec3>& hull) const override {
    // The limit surface lies in the hull of the control points around the face.
    for (int i = 0; i < surface_.GetNumControlPoints(); ++i) {
      const float* p = points_.data() + (size_t(i) * size_t(keys_) + size_t(key)) * 3;
      hull.emplace_back(p[0], p[1], p[2]);
    }
  }

  int sample_segments() const override { return 4; }

 private:
  const SubdivisionTopology& topology_;
  uint32_t index_;
  BfrSurface surface_;
  std::vector<float> points_;
  int keys_;
};

// Control points outside a boundary are absent from Bfr's regular patches, which give them no
// weight: they are the mirror images that make the edge curve the boundary's own B-spline.
void add_phantom_points(const BfrSurface& surface, glm::vec3 (&p)[16]) {
  const float centre[2] = {0.5f, 0.5f};
  float weights[16];
  surface.EvaluateStencil(centre, weights);
  const auto is_absent = [&](int first, int step) {
    for (int k = 0; k < 4; ++k) {
      if (weights[first + k * step] != 0) return false;
    }
    return true;
  };
  const auto mirror = [&](int row, int step, int towards) {
    for (int k = 0; k < 4; ++k) {
      const int i = row + k * step;
      p[i] = 2.0f * p[i + towards] - p[i + 2 * towards];
    }
  };
  const bool low_v = is_absent(0, 1), high_v = is_absent(12, 1);
  const bool low_u = is_absent(0, 4), high_u = is_absent(3, 4);
  if (low_v) mirror(0, 1, 4);
  if (high_v) mirror(12, 1, -4);
  if (low_u) mirror(0, 4, 1);
  if (high_u) mirror(3, 4, -1);
}

class SubdivisionPatchSet final : public PatchSet {
 public:
  SubdivisionPatchSet(const Surface& surface, const MovingPoints& points,
                      std::shared_ptr<const SubdivisionTopology> topology)
      : surface_(surface), points_(points), topology_(std::move(topology)) {}

  uint32_t patch_count() const override { return topology_->patch_count(); }

  std::unique_ptr<Patch> patch(uint32_t index) const override {
    const int face = topology_->face_of(index);
    BfrSurface surface;
    if (!topology_->has_limit(face) || !topology_->factory().InitVertexSurface(face, &surface)) {
      return nullptr;
    }
    const int keys = points_.key_count(), count = surface.GetNumControlPoints();
    std::vector<int> indices(static_cast<size_t>(count));
    surface.GetControlPointIndices(indices.data());
    if (surface.IsRegular() && !topology_->is_loop()) return regular_patch(surface, indices);

    std::vector<float> points(size_t(surface.GetNumPatchPoints()) * size_t(keys) * 3);
    for (size_t i = 0; i < indices.size(); ++i) {
      for (int key = 0; key < keys; ++key) {
        const glm::vec3 p = points_.point(key, indices[i]);
        for (int axis = 0; axis < 3; ++axis) {
          points[(i * size_t(keys) + size_t(key)) * 3 + size_t(axis)] = p[axis];
        }
      }
    }
    surface.ComputePatchPoints(points.data(), PointDescriptor(3 * keys));
    return std::make_unique<BfrPatch>(*topology_, index, surface, std::move(points), keys);
  }

  SharedSide shared_side(uint32_t patch, int side) const override {
    return topology_->shared_side(patch, side);
  }
  Location shared_corner(uint32_t patch, int corner) const override {
    return topology_->shared_corner(patch, corner);
  }

  std::vector<PatchPrimvar> primvars(uint32_t index, const PrimvarFilter& wants) const override {
    return wanted_primvars(surface_.geometry->primvars, wants,
                           [&](const Parameter& p) { return primvar(p, index); });
  }

 private:
  std::unique_ptr<Patch> regular_patch(const BfrSurface& surface,
                                       const std::vector<int>& indices) const {
    std::vector<BicubicControl> controls;
    for (int key = 0; key < points_.key_count(); ++key) {
      glm::vec3 p[16];
      for (size_t i = 0; i < 16; ++i) p[i] = points_.point(key, indices[i]);
      add_phantom_points(surface, p);
      controls.push_back(bicubic_control(p, bezier_from_bspline(), bezier_from_bspline()));
    }
    return std::make_unique<BicubicPatch>(std::move(controls));
  }

  PatchPrimvar primvar(const Parameter& p, uint32_t index) const {
    const int face = topology_->face_of(index);
    if (p.storage == StorageClass::constant) return constant_primvar(p, 0);
    if (p.storage == StorageClass::uniform) return constant_primvar(p, size_t(face));
    BfrSurface surface;
    const float* values = p.numbers.data();
    bool found = false;
    if (p.storage == StorageClass::facevarying) {
      int id = 0;
      const SubdivisionTopology::Channel* channel = topology_->channel_of(p, id);
      if (channel) {
        values = channel->values.data();
        found = topology_->factory().InitFaceVaryingSurface(face, &surface, id);
      }
    } else if (p.storage == StorageClass::varying) {
      found = topology_->factory().InitVaryingSurface(face, &surface);
    } else {
      found = topology_->factory().InitVertexSurface(face, &surface);
    }
    if (!found) return constant_primvar(p, 0);

    PatchPrimvar primvar;
    primvar.source = &p;
    primvar.components = p.floats_per_value();
    const PointDescriptor layout(primvar.components);
    std::vector<float> points(size_t(surface.GetNumPatchPoints()) * size_t(primvar.components));
    surface.PreparePatchPoints(values, layout, points.data(), layout);
    primvar.custom = [topology = topology_, index, surface, layout, points = std::move(points)](
                         std::span<const float> u, std::span<const float> v, float* out,
                         size_t stride) {
      std::vector<float> value(size_t(layout.size));
      for (size_t i = 0; i < u.size(); ++i) {
        float uv[2];
        topology->face_parameters(index, u[i], v[i], uv);
        surface.Evaluate(uv, points.data(), layout, value.data());
        for (size_t c = 0; c < value.size(); ++c) out[c * stride + i] = value[c];
      }
    };
    return primvar;
  }

  const Surface& surface_;
  const MovingPoints& points_;
  std::shared_ptr<const SubdivisionTopology> topology_;
};

}  // namespace

std::unique_ptr<PatchSet> make_subdivision_patches(
    const Surface& surface, const MovingPoints& points,
    std::shared_ptr<const SubdivisionTopology> topology) {
  return std::make_unique<SubdivisionPatchSet>(surface, points, std::move(topology));
}

}  // namespace tessera
