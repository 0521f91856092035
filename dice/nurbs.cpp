#include "dice/nurbs.h"

#include <algorithm>
#include <cmath>

#include "dice/bicubic.h"
#include "dice/patch_mesh.h"
#include "dice/rational.h"

namespace tessera {

std::vector<KnotSpan> knot_spans(std::span<const double> knots, int vertices, int order,
                                 double t_min, double t_max) {
  std::vector<KnotSpan> spans;
  const int p = order - 1;
  for (int k = p; k < vertices; ++k) {
    KnotSpan span;
    span.first = k - p;
    span.t0 = std::max(knots[size_t(k)], t_min);
    span.t1 = std::min(knots[size_t(k) + 1], t_max);
    if (!(span.t0 < span.t1)) continue;
    span.matrix.assign(size_t(order) * size_t(order), 0.0);
    for (int m = 0; m <= p; ++m) {
      for (int j = 0; j <= p; ++j) {
        // De Boor's recursion on unit control point j.
        std::vector<double> d(size_t(order), 0.0);
        d[size_t(j)] = 1;
        for (int r = 1; r <= p; ++r) {
          const double t = r <= p - m ? span.t0 : span.t1;
          for (int i = p; i >= r; --i) {
            const double low = knots[size_t(k - p + i)], high = knots[size_t(i + 1 + k - r)];
            const double alpha = (t - low) / (high - low);
            d[size_t(i)] = (1 - alpha) * d[size_t(i) - 1] + alpha * d[size_t(i)];
          }
        }
        span.matrix[size_t(m) * size_t(order) + size_t(j)] = d[size_t(p)];
      }
    }
    spans.push_back(std::move(span));
  }
  return spans;
}

namespace {

class NurbsPatchSet final : public PatchSet {
 public:
  NurbsPatchSet(const Surface& surface, const MovingPoints& points)
      : surface_(surface), points_(points), nurbs_(std::get<NurbsPatch>(surface.geometry->shape)) {
    u_spans_ =
        knot_spans(nurbs_.u_knots, nurbs_.u_vertices, nurbs_.u_order, nurbs_.u_min, nurbs_.u_max);
    v_spans_ =
        knot_spans(nurbs_.v_knots, nurbs_.v_vertices, nurbs_.v_order, nurbs_.v_min, nurbs_.v_max);
    if (u_spans_.empty() || v_spans_.empty()) {
      throw Error(
          surface.geometry->where,
          "NuPatch has no knot span between its parameter limits; expected min < max within "
          "the knots");
    }
    array_ = {int(u_spans_.size()), int(v_spans_.size()), false, false};
    polynomial_ = nurbs_.weights.empty();
    const bool u_wraps = is_closed(1, 3), v_wraps = is_closed(2, 0);
    array_.u_wraps = u_wraps;
    array_.v_wraps = v_wraps;
  }

  uint32_t patch_count() const override { return uint32_t(array_.u_patches * array_.v_patches); }

  std::unique_ptr<Patch> patch(uint32_t index) const override {
    std::vector<std::vector<glm::dvec4>> keys;
    for (int key = 0; key < points_.key_count(); ++key) keys.push_back(bezier_points(index, key));
    const bool bicubic = polynomial_ && nurbs_.u_order == 4 && nurbs_.v_order == 4;
    if (!bicubic) {
      return std::make_unique<RationalPatch>(nurbs_.u_order - 1, nurbs_.v_order - 1,
                                             std::move(keys));
    }
    std::vector<BicubicControl> controls(keys.size());
    for (size_t key = 0; key < keys.size(); ++key) {
      for (int axis = 0; axis < 3; ++axis) {
        for (size_t k = 0; k < 16; ++k) controls[key].c[axis][k] = float(keys[key][k][axis]);
      }
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
    const auto fraction = [](const std::vector<KnotSpan>& spans, double t) {
      return (t - spans.front().t0) / (spans.back().t1 - spans.front().t0);
    };
    const KnotSpan &u = u_span(patch), &v = v_span(patch);
    return {fraction(u_spans_, u.t0), fraction(u_spans_, u.t1), fraction(v_spans_, v.t0),
            fraction(v_spans_, v.t1)};
  }

  std::vector<PatchPrimvar> primvars(uint32_t index, const PrimvarFilter& wants) const override {
    return wanted_primvars(surface_.geometry->primvars, wants,
                           [&](const Parameter& p) { return primvar(p, index); });
  }

 private:
  const KnotSpan& u_span(uint32_t patch) const {
    return u_spans_[patch % uint32_t(array_.u_patches)];
  }
  const KnotSpan& v_span(uint32_t patch) const {
    return v_spans_[patch / uint32_t(array_.u_patches)];
  }

  /// Sums value(control point index), over the control points of a patch, into Bezier point k.
  template <class Value, class Function>
  Value blend(uint32_t patch, size_t k, Value sum, const Function& value) const {
    const KnotSpan &u = u_span(patch), &v = v_span(patch);
    const size_t nu = size_t(nurbs_.u_order), nv = size_t(nurbs_.v_order);
    for (size_t j = 0; j < nv; ++j) {
      for (size_t i = 0; i < nu; ++i) {
        const double weight = v.matrix[k / nu * nv + j] * u.matrix[k % nu * nu + i];
        if (weight != 0) {
          sum += weight * value((v.first + int(j)) * nurbs_.u_vertices + u.first + int(i));
        }
      }
    }
    return sum;
  }

  double weight(int key, int vertex) const {
    if (polynomial_) return 1;
    return points_.interpolate(key, [&](size_t k) {
      return nurbs_.weights[std::min(k, nurbs_.weights.size() - 1)][size_t(vertex)];
    });
  }

  std::vector<glm::dvec4> bezier_points(uint32_t index, int key) const {
    std::vector<glm::dvec4> bezier;
    for (size_t k = 0; k < size_t(nurbs_.u_order * nurbs_.v_order); ++k) {
      bezier.push_back(blend(index, k, glm::dvec4(0), [&](int vertex) {
        return glm::dvec4(glm::dvec3(points_.point(key, vertex)), 1.0) * weight(key, vertex);
      }));
    }
    return bezier;
  }

  /// Whether the patches' sides `high` (on the last row) and `low` (on the first) are one curve at
  /// every key, up to rounding.
  bool is_closed(int high, int low) const {
    const bool in_u = high == 1;
    const int count = in_u ? array_.v_patches : array_.u_patches;
    for (int n = 0; n < count; ++n) {
      const auto last = patch(in_u ? array_.index(array_.u_patches - 1, n)
                                   : array_.index(n, array_.v_patches - 1));
      const auto first = patch(in_u ? array_.index(0, n) : array_.index(n, 0));
      for (int key = 0; key < points_.key_count(); ++key) {
        alignas(64) float t[16] = {0.0f, 0.2f, 0.4f, 0.6f, 0.8f, 1.0f}, a[48], b[48];
        const PatchOutput to_a{{a, a + 16, a + 32}, {}}, to_b{{b, b + 16, b + 32}, {}};
        last->side(key, high, false, {t, 6}, to_a);
        first->side(key, low, false, {t, 6}, to_b);
        float largest = 0, apart = 0;
        for (int i = 0; i < 48; ++i) {
          if (i % 16 >= 6) continue;
          largest = std::max(largest, std::abs(a[i]));
          apart = std::max(apart, std::abs(a[i] - b[i]));
        }
        if (!(apart <= 1e-6f * largest)) return false;
      }
    }
    return true;
  }

  PatchPrimvar primvar(const Parameter& p, uint32_t index) const {
    if (p.storage == StorageClass::constant) return constant_primvar(p, 0);
    // Values follow the spans of the knot vector, empty ones included.
    const size_t width = size_t(2 + nurbs_.u_vertices - nurbs_.u_order);
    const size_t i = size_t(u_span(index).first), j = size_t(v_span(index).first);
    if (p.storage == StorageClass::uniform) return constant_primvar(p, j * (width - 1) + i);
    if (p.storage != StorageClass::vertex) {
      return bilinear_primvar(
          p, {j * width + i, j * width + i + 1, (j + 1) * width + i, (j + 1) * width + i + 1});
    }
    PatchPrimvar primvar;
    primvar.source = &p;
    primvar.components = p.floats_per_value();
    std::vector<double> values, weights;
    const size_t n = size_t(primvar.components);
    for (size_t k = 0; k < size_t(nurbs_.u_order * nurbs_.v_order); ++k) {
      const double w = blend(index, k, 0.0, [&](int vertex) { return weight(0, vertex); });
      weights.push_back(w);
      for (size_t c = 0; c < n; ++c) {
        const double sum = blend(index, k, 0.0, [&](int vertex) {
          return weight(0, vertex) * double(p.numbers[size_t(vertex) * n + c]);
        });
        values.push_back(sum / w);
      }
    }
    primvar.custom =
        bezier_primvar_evaluator(nurbs_.u_order - 1, nurbs_.v_order - 1, primvar.components,
                                 std::move(values), std::move(weights));
    return primvar;
  }

  const Surface& surface_;
  const MovingPoints& points_;
  const NurbsPatch& nurbs_;
  std::vector<KnotSpan> u_spans_, v_spans_;
  PatchArray array_;
  bool polynomial_ = true;
};

}  // namespace

std::unique_ptr<PatchSet> make_nurbs_patches(const Surface& surface, const MovingPoints& points) {
  return std::make_unique<NurbsPatchSet>(surface, points);
}

}  // namespace tessera
