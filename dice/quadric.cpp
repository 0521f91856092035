#include "dice/quadric.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace tessera {

namespace {

using Kind = Quadric::Kind;
using Parameters = std::array<double, 7>;

struct Profile {
  double x = 0, y = 0, z = 0;     // at sweep angle 0
  double dx = 0, dy = 0, dz = 0;  // along d/dv, up to a positive factor
};

double radians(double degrees) { return degrees * (std::numbers::pi / 180.0); }

bool is_full_turn(double degrees) { return std::abs(std::abs(degrees) - 360.0) < 1e-9; }

// cos and sin, exact at quarter turns.
std::pair<double, double> cos_sin_degrees(double degrees) {
  const double turns = degrees / 90.0;
  if (turns == std::floor(turns) && std::abs(turns) < 1e6) {
    constexpr int cosine[4] = {1, 0, -1, 0}, sine[4] = {0, 1, 0, -1};
    const int quarter = int(((long(turns) % 4) + 4) % 4);
    return {cosine[quarter], sine[quarter]};
  }
  return {std::cos(radians(degrees)), std::sin(radians(degrees))};
}

// Latitude in degrees of height z on a sphere; exactly +-90 at and beyond the poles.
double latitude(double z, double radius) {
  const double ratio = std::clamp(z / std::abs(radius), -1.0, 1.0);
  if (std::abs(ratio) == 1.0) return 90.0 * ratio;
  return std::asin(ratio) * (180.0 / std::numbers::pi);
}

Profile arc(double centre, double radius, double from_degrees, double to_degrees, double v) {
  const auto [c, s] = cos_sin_degrees(from_degrees + (to_degrees - from_degrees) * v);
  const double turn = to_degrees >= from_degrees ? 1.0 : -1.0;
  return {centre + radius * c, 0, radius * s, -radius * s * turn, 0, radius * c * turn};
}

Profile profile_at(Kind kind, const Parameters& p, double v) {
  const auto mix = [v](double a, double b) { return (1.0 - v) * a + v * b; };
  switch (kind) {
    case Kind::sphere:
      return arc(0, p[0], latitude(p[1], p[0]), latitude(p[2], p[0]), v);
    case Kind::cone:
      return {p[1] * (1.0 - v), 0, p[0] * v, -p[1], 0, p[0]};
    case Kind::cylinder:
      return {p[0], 0, mix(p[1], p[2]), 0, 0, p[2] - p[1]};
    case Kind::hyperboloid:
      return {mix(p[0], p[3]), mix(p[1], p[4]), mix(p[2], p[5]),
              p[3] - p[0],     p[4] - p[1],     p[5] - p[2]};
    case Kind::paraboloid: {
      // The derivative of sqrt(z) is scaled by 2 sqrt(z zmax): finite at the vertex.
      const double z = mix(p[1], p[2]), dz = p[2] - p[1], root = std::sqrt(std::max(z / p[2], 0.0));
      return {p[0] * root, 0,
              z,           p[0] * dz * (p[2] < 0 ? -1.0 : 1.0),
              0,           2.0 * root * std::abs(p[2]) * dz};
    }
    case Kind::disk:
      return {p[1] * (1.0 - v), 0, p[0], -p[1], 0, 0};
    case Kind::torus:
      return arc(p[0], p[1], p[2], p[3], v);
  }
  return {};
}

double sweep_degrees(Kind kind, const Parameters& p) {
  switch (kind) {
    case Kind::cone:
    case Kind::disk:
      return p[2];
    case Kind::hyperboloid:
      return p[6];
    case Kind::torus:
      return p[4];
    default:
      return p[3];
  }
}

struct QuadricKey {
  Parameters parameters{};
  glm::dmat4 camera_from_object{1.0};
  glm::dmat3 normal_from_object{1.0};  // cofactors: maps cross products
};

class QuadricPatch final : public Patch {
 public:
  QuadricPatch(Kind kind, const std::vector<QuadricKey>& keys, bool u_wraps, bool v_wraps)
      : kind_(kind), keys_(keys), u_wraps_(u_wraps), v_wraps_(v_wraps) {}

  void tensor(int key, std::span<const float> u, std::span<const float> v, size_t row_stride,
              const PatchOutput& out) const override {
    std::vector<std::pair<double, double>> turns;
    for (float a : u) turns.push_back(turn(key, a));
    for (size_t j = 0; j < v.size(); ++j) {
      const Profile profile = profile_of(key, v[j]);
      for (size_t i = 0; i < u.size(); ++i) {
        write(key, profile, v[j], turns[i], out, j * row_stride + i);
      }
    }
  }

  void points(int key, std::span<const float> u, std::span<const float> v,
              const PatchOutput& out) const override {
    for (size_t i = 0; i < u.size(); ++i) {
      write(key, profile_of(key, v[i]), v[i], turn(key, u[i]), out, i);
    }
  }

  void append_hull(int key, const ParameterRect& rect, std::vector<glm::vec3>& hull) const override;

 private:
  // The seam of a full turn is evaluated at parameter 0 on both sides.
  std::pair<double, double> turn(int key, double u) const {
    if (u_wraps_ && u == 1.0) u = 0.0;
    return cos_sin_degrees(u * sweep_degrees(kind_, keys_[size_t(key)].parameters));
  }
  Profile profile_of(int key, double v) const {
    return profile_at(kind_, keys_[size_t(key)].parameters, v_wraps_ && v == 1.0 ? 0.0 : v);
  }
  void write(int key, const Profile& p, double v, std::pair<double, double> turn,
             const PatchOutput& out, size_t at) const;

  Kind kind_;
  const std::vector<QuadricKey>& keys_;
  bool u_wraps_, v_wraps_;
};

// With R the turn by theta, P = R (x, y, z), dP/dtheta = R (-y, x, 0) and dP/dv = R (x', y', z'):
// the normal is R (x z', y z', -(x x' + y y')), signed as dtheta/du.
void QuadricPatch::write(int key, const Profile& p, double v, std::pair<double, double> turn,
                         const PatchOutput& out, size_t at) const {
  const QuadricKey& k = keys_[size_t(key)];
  const auto [c, s] = turn;
  const glm::dvec3 P(k.camera_from_object *
                     glm::dvec4(c * p.x - s * p.y, s * p.x + c * p.y, p.z, 1.0));
  for (int axis = 0; axis < 3; ++axis) out.P[axis][at] = float(P[axis]);
  if (!out.wants_normals()) return;
  Profile q = p;
  // On the axis the sweep has no derivative; the normal's limit is that of a neighbour's.
  if (q.x * q.x + q.y * q.y < 1e-18 * (q.dx * q.dx + q.dy * q.dy + q.dz * q.dz)) {
    q = profile_of(key, v + 1e-5 * (0.5 - v));
  }
  const glm::dvec3 n(q.x * q.dz, q.y * q.dz, -(q.x * q.dx + q.y * q.dy));
  const double sign = sweep_degrees(kind_, k.parameters) < 0 ? -1.0 : 1.0;
  glm::dvec3 N =
      k.normal_from_object * (sign * glm::dvec3(c * n.x - s * n.y, s * n.x + c * n.y, n.z));
  const double length = glm::length(N);
  if (length > 0) N /= length;
  for (int axis = 0; axis < 3; ++axis) out.N[axis][at] = float(N[axis]);
}

// A box in the frame turned to the middle of the sweep.
void QuadricPatch::append_hull(int key, const ParameterRect& rect,
                               std::vector<glm::vec3>& hull) const {
  const QuadricKey& k = keys_[size_t(key)];
  constexpr int steps = 8;
  double r_min = 1e300, r_max = 0, z_min = 1e300, z_max = -1e300;
  bool on_one_side = kind_ != Kind::hyperboloid;
  for (int i = 0; i <= steps; ++i) {
    const double v = rect.v0 + (rect.v1 - rect.v0) * i / steps;
    const Profile p = profile_at(kind_, k.parameters, v);
    const double r = std::hypot(p.x, p.y);
    r_min = std::min(r_min, r), r_max = std::max(r_max, r);
    z_min = std::min(z_min, p.z), z_max = std::max(z_max, p.z);
    on_one_side = on_one_side && p.x >= 0;
  }
  if (kind_ == Kind::sphere || kind_ == Kind::torus) {
    // Between samples an arc leaves its chord by at most its sagitta.
    const Parameters& p = k.parameters;
    const double degrees = kind_ == Kind::torus ? p[3] - p[2] : 180.0;
    const double step = radians(std::abs(degrees)) * (rect.v1 - rect.v0) / steps;
    const double radius = std::abs(kind_ == Kind::torus ? p[1] : p[0]);
    const double sagitta = radius * (1.0 - std::cos(std::min(step / 2, std::numbers::pi)));
    r_min = std::max(0.0, r_min - sagitta), r_max += sagitta;
    z_min -= sagitta, z_max += sagitta;
  }
  if (kind_ == Kind::hyperboloid) r_min = 0;
  const double sweep = radians(sweep_degrees(kind_, k.parameters));
  const double middle = sweep * 0.5 * (rect.u0 + rect.u1);
  const double half = on_one_side
                          ? std::min(std::abs(sweep) * 0.5 * (rect.u1 - rect.u0), std::numbers::pi)
                          : std::numbers::pi;
  const double x_min = std::cos(half) >= 0 ? r_min * std::cos(half) : r_max * std::cos(half);
  const double y_max = half < std::numbers::pi / 2 ? r_max * std::sin(half) : r_max;
  for (int corner = 0; corner < 8; ++corner) {
    const double x = corner & 1 ? r_max : x_min, y = corner & 2 ? y_max : -y_max;
    const double c = std::cos(middle), s = std::sin(middle);
    hull.emplace_back(k.camera_from_object *
                      glm::dvec4(c * x - s * y, s * x + c * y, corner & 4 ? z_max : z_min, 1.0));
  }
}

class QuadricPatchSet final : public PatchSet {
 public:
  QuadricPatchSet(const Surface& surface, const MovingPoints& points) : surface_(surface) {
    const Quadric& quadric = std::get<Quadric>(surface.geometry->shape);
    kind_ = quadric.kind;
    array_.u_wraps = true;
    array_.v_wraps = kind_ == Kind::torus;
    for (int key = 0; key < points.key_count(); ++key) {
      QuadricKey k;
      k.camera_from_object = points.camera_from_object(key);
      const glm::dmat3 linear(k.camera_from_object);
      for (int axis = 0; axis < 3; ++axis) {
        k.normal_from_object[axis] = glm::cross(linear[(axis + 1) % 3], linear[(axis + 2) % 3]);
      }
      const size_t count = std::min(k.parameters.size(), quadric.parameters[0].size());
      for (size_t i = 0; i < count; ++i) {
        k.parameters[i] = points.interpolate(
            key, [&](size_t geometry_key) { return quadric.parameters[geometry_key][i]; });
      }
      array_.u_wraps &= is_full_turn(sweep_degrees(kind_, k.parameters));
      array_.v_wraps &= is_full_turn(k.parameters[3] - k.parameters[2]);
      keys_.push_back(k);
    }
  }

  uint32_t patch_count() const override { return 1; }
  std::unique_ptr<Patch> patch(uint32_t) const override {
    return std::make_unique<QuadricPatch>(kind_, keys_, array_.u_wraps, array_.v_wraps);
  }
  SharedSide shared_side(uint32_t patch, int side) const override {
    return array_.shared_side(patch, side);
  }
  Location shared_corner(uint32_t patch, int corner) const override {
    return array_.shared_corner(patch, corner);
  }
  std::vector<PatchPrimvar> primvars(uint32_t, const PrimvarFilter& wants) const override {
    return wanted_primvars(surface_.geometry->primvars, wants, [](const Parameter& p) {
      return p.value_count() >= 4 ? bilinear_primvar(p, {0, 1, 2, 3}) : constant_primvar(p, 0);
    });
  }

 private:
  const Surface& surface_;
  Kind kind_ = Kind::sphere;
  std::vector<QuadricKey> keys_;
  PatchArray array_;
};

}  // namespace

std::unique_ptr<PatchSet> make_quadric_patches(const Surface& surface, const MovingPoints& points) {
  return std::make_unique<QuadricPatchSet>(surface, points);
}

}  // namespace tessera
