/// The shear map against long double: its fit where the answer is known, the documented bounds on
/// real sightings, and what it is for. No code is shared with the kernels that use the map; what is
/// taken from it are its published coefficients.

#include <catch2/catch.hpp>

#include "hide/shear_map.h"
#include "hide/sheared_grid.h"
#include "tests/hide/extreme_shapes.h"
#include "tests/hide/ray_oracle.h"

using namespace tessera;

namespace {

/// Both ends of a grid's only segment, or the same positions twice.
struct VertexEnds {
  std::array<glm::dvec3, 2> P;
};

/// A vertex at the map's reference time, divided by its W; positions relative to the map's middle.
struct TrueVertex {
  Real x, y, W;
  std::array<Real, shear_fields> field;
  Real rounding[2];  ///< what the kernels may round x and y by, pixels
};

/// [x, y].
using Pair = std::array<Real, 2>;

/// A fit and all that is needed to judge it.
struct FitCase {
  const TestBucket& bucket;
  const Grid& grid;
  PixelRect rect;
  TimePiece piece;
  ClipGrid clip;
  SampleBox box;
  ShearMap map;
  ShearGain gain;
  float reach[2] = {0, 0};
  bool fitted = false;

  FitCase(const TestBucket& b, const Grid& g, const PixelRect& r, TimePiece p = {})
      : bucket(b), grid(g), rect(r), piece(p) {
    HideInput input;
    input.raster_clip = bucket.camera.raster_clip();
    input.near_clip = bucket.camera.near_clip(), input.far_clip = bucket.camera.far_clip();
    clip.set(grid, input.raster_clip);
    const ClipSegment& segment = clip.segments().front();
    box = SampleBox(rect, bucket.camera.lens_open() ? bucket.camera.lens_profile().extent() : 0.0f);
    fitted = fit_shear(segment, grid.u_count, coverage_frame(input, grid, segment), box,
                       {0, 0, grid.u_count, grid.v_count}, piece, map);
    for (int axis = 0; axis < 2; ++axis)
      reach[axis] = std::abs(box.middle[axis] - map.middle[axis]) + box.half[axis];
    if (fitted) gain = shear_gain(map, box.lens, reach);
  }
  bool usable() const { return fitted && gain.usable; }
  bool moves() const { return grid.key_count() > 1; }
  VertexEnds ends(int vertex) const { return {segment_ends(grid, vertex, 0.0)}; }
  TrueVertex see(const VertexEnds& ends) const;
  Real lens(int axis) const {
    return axis == 0 ? Real(box.lens) : Real(box.lens) * std::abs(Real(map.coc_ratio));
  }
};

TrueVertex FitCase::see(const VertexEnds& ends) const {
  const RasterClipMap& m = bucket.camera.raster_clip();
  const auto coc = [&](Real z) { return Real(m.coc_x.scale) * z + Real(m.coc_x.offset); };
  const Real sigma = moves() ? Real(map.tau) : 0;
  Real X[2], Y[2], W[2], C[2];
  for (size_t e = 0; e < 2; ++e) {
    const glm::dvec3& p = ends.P[e];
    W[e] = Real(m.w_from_z) * Real(p.z) + Real(m.w_constant);
    X[e] = Real(m.x_scale) * Real(p.x) + Real(m.x_from_w) * W[e];
    Y[e] = Real(m.y_scale) * Real(p.y) + Real(m.y_from_w) * W[e];
    C[e] = box.lens > 0 ? coc(Real(p.z)) : 0;
  }
  const auto at = [&](const Real(&a)[2]) { return a[0] + sigma * (a[1] - a[0]); };
  const Real w = at(W), dW = (W[1] - W[0]) / w;
  TrueVertex v{};
  v.W = w, v.x = at(X) / w - Real(map.middle[0]), v.y = at(Y) / w - Real(map.middle[1]);
  v.field = {(X[1] - X[0]) / w - Real(map.middle[0]) * dW,
             (Y[1] - Y[0]) / w - Real(map.middle[1]) * dW, dW, at(C) / w, (C[1] - C[0]) / w};
  const Real margin = Real(shear_rounding_margin) / w;
  const auto size = [](const Real(&a)[2]) { return std::abs(a[0]) + std::abs(a[1] - a[0]); };
  for (int axis = 0; axis < 2; ++axis)
    v.rounding[axis] = margin * (size(axis ? Y : X) + lens(axis) * size(C) +
                                 size(W) * Real(std::abs(box.middle[axis]) + box.half[axis]));
  return v;
}

Real value(const AffineField& f, Real x, Real y) {
  return Real(f.at_middle) + Real(f.per_x) * x + Real(f.per_y) * y;
}
Real value(const BendField& f, Real x, Real y) {
  return Real(f.constant) + Real(f.xx) * x * x + Real(f.xy) * x * y + Real(f.yy) * y * y;
}

/// What the fit leaves over of delta / W at a vertex, at most, over all samples: [x, y], by the
/// affine fit alone and with the bend.
struct LeftOver {
  Pair coarse, fine;
};

LeftOver left_over(const FitCase& c, const TrueVertex& v) {
  std::array<Real, shear_fields> coarse{}, fine{};
  for (size_t f = 0; f < shear_fields; ++f) {
    const Real rest = v.field[f] - value(c.map.fit[f], v.x, v.y);
    coarse[f] = std::abs(rest), fine[f] = std::abs(rest - value(c.map.bend[f], v.x, v.y));
  }
  const Real h = Real(c.map.half_duration);
  const auto sum = [&](const std::array<Real, shear_fields>& f, int axis) {
    return h * (f[axis == 0 ? field_rx : field_ry] + Real(c.reach[axis]) * f[field_q]) +
           c.lens(axis) * (f[field_c] + h * f[field_e]);
  };
  return {{sum(coarse, 0), sum(coarse, 1)}, {sum(fine, 0), sum(fine, 1)}};
}

/// The 2 x 2 system of a sample, x and y relative to the map's middle.
struct System {
  Real xx, xy, yx, yy, bx, by;
  Real x, y, u, v, sigma;

  System(const ShearMap& m, Real x_in, Real y_in, Real u_in, Real v_in, Real sigma_in)
      : x(x_in), y(y_in), u(u_in), v(v_in * Real(m.coc_ratio)), sigma(sigma_in) {
    const auto part = [&](const AffineField& r, float AffineField::*p, Real at, Real l) {
      return sigma * (Real(r.*p) - at * Real(m.fit[field_q].*p)) +
             l * (Real(m.fit[field_c].*p) + sigma * Real(m.fit[field_e].*p));
    };
    const AffineField &rx = m.fit[field_rx], &ry = m.fit[field_ry];
    xx = 1 + part(rx, &AffineField::per_x, x, u), xy = part(rx, &AffineField::per_y, x, u);
    yx = part(ry, &AffineField::per_x, y, v), yy = 1 + part(ry, &AffineField::per_y, y, v);
    bx = x - part(rx, &AffineField::at_middle, x, u);
    by = y - part(ry, &AffineField::at_middle, y, v);
  }
  Pair solve(Real ax, Real ay) const {
    const Real det = xx * yy - xy * yx;
    return {(yy * ax - xy * ay) / det, (xx * ay - yx * ax) / det};
  }
  Pair affine() const { return solve(bx, by); }
  /// p - A^-1 Q(p).
  Pair bent(const ShearMap& m, const Pair& p) const {
    const auto bend = [&](ShearField f) { return value(m.bend[f], p[0], p[1]); };
    const Real c = bend(field_c) + sigma * bend(field_e);
    const Pair step = solve(sigma * (bend(field_rx) - x * bend(field_q)) + u * c,
                            sigma * (bend(field_ry) - y * bend(field_q)) + v * c);
    return {p[0] - step[0], p[1] - step[1]};
  }
};

Pair amplified(const ShearGain& g, const Pair& p) {
  return {Real(g.xx) * p[0] + Real(g.xy) * p[1], Real(g.yx) * p[0] + Real(g.yy) * p[1]};
}

/// Bounds on where the map may put a sample that sees a triangle with these corners, relative to
/// the place of the point that is seen.
struct Allowed {
  Pair affine{}, bent{};
};

Allowed allowed(const FitCase& c, const std::array<TrueVertex, 3>& corners) {
  Pair coarse{}, fine{}, most{}, low{INFINITY, INFINITY}, high{-INFINITY, -INFINITY};
  for (const TrueVertex& v : corners) {
    const LeftOver left = left_over(c, v);
    const Real place[2] = {v.x, v.y};
    for (size_t axis = 0; axis < 2; ++axis) {
      coarse[axis] = std::max(coarse[axis], left.coarse[axis] + v.rounding[axis]);
      fine[axis] = std::max(fine[axis], left.fine[axis] + v.rounding[axis]);
      most[axis] = std::max(most[axis], std::abs(place[axis]));
      low[axis] = std::min(low[axis], place[axis]), high[axis] = std::max(high[axis], place[axis]);
    }
  }
  Allowed a;
  a.affine = amplified(c.gain, coarse);
  const BendBounds b = bend_bounds(c.map, c.box.lens, c.reach);
  const Real x = most[0] + a.affine[0], y = most[1] + a.affine[1];
  const Real w = high[0] - low[0], h = high[1] - low[1];
  Pair rest{};
  for (size_t axis = 0; axis < 2; ++axis) {
    const Real xx = Real(b.xx[axis]), xy = Real(b.xy[axis]), yy = Real(b.yy[axis]);
    const Real moved = (2 * xx * x + xy * y) * a.affine[0] + (2 * yy * y + xy * x) * a.affine[1];
    const Real gap = (xx * w * w + xy * w * h + yy * h * h) / 4;
    rest[axis] = fine[axis] + moved + gap;
  }
  a.bent = amplified(c.gain, rest);
  return a;
}

/// Coefficients of a smooth surface at one key: quadratic in (u, v).
struct Surface {
  glm::vec3 centre, u, v, uu, uv, vv;

  glm::vec3 at(float s, float t) const {
    const float a = s - 0.5f, b = t - 0.5f;
    return centre + u * a + v * b + uu * (a * a) + uv * (a * b) + vv * (b * b);
  }
};

struct Blur {
  bool motion, lens;
};

/// A curved grid near the middle of the view that moves, turns, stretches and bends.
TestBucket curved_bucket(int k, const Blur& blur, const PixelRect& rect) {
  ExtremeRandom random(k);
  CameraSettings settings = perspective_settings(64, 48);
  if (blur.lens) open_lens(settings, random.between(0.3f, 1.0f), random.between(2.5f, 4.0f));
  TestBucket bucket(settings);
  const auto vector = [&](float half) { return random.in_box(glm::vec3(0.0f), glm::vec3(half)); };
  Surface keys[2];
  keys[0].centre = random.in_box({0, 0, 5}, {0.4f, 0.3f, 0.5f});
  keys[0].u = glm::vec3(1.4f, 0, 0) + vector(0.5f),
  keys[0].v = glm::vec3(0, 1.4f, 0) + vector(0.5f);
  keys[0].uu = vector(0.4f), keys[0].uv = vector(0.4f), keys[0].vv = vector(0.4f);
  keys[1] = keys[0];
  keys[1].centre += vector(0.8f);
  for (glm::vec3* part : {&keys[1].u, &keys[1].v, &keys[1].uu, &keys[1].uv, &keys[1].vv})
    *part += vector(0.3f);
  const std::vector<float> times = blur.motion ? std::vector{0.0f, 1.0f} : std::vector{0.0f};
  bucket.add(make_grid(6, 6, times, [&](float u, float v, int key) { return keys[key].at(u, v); }));
  bucket.make_samples(rect, 4, uint32_t(k));
  return bucket;
}

/// What the sightings of some cases came to.
struct Sightings {
  int count = 0;
  Real closest = 0;  ///< largest share of what is allowed, with the bend
  Real blur = 0;   ///< summed distances of samples from the points that they see, at the reference
  Real slack = 0;  ///< summed allowances
};

/// Every sure hit of every sample in the piece of time against the bounds.
void check_sightings(const FitCase& c, Sightings& total) {
  const TestBucket& bucket = c.bucket;
  SeenGrid seen;
  std::vector<TrueVertex> places;
  for (int i = 0; i < c.grid.vertex_count(); ++i) places.push_back(c.see(c.ends(i)));
  for (size_t s = 0; s < bucket.samples.size(); ++s) {
    const SampleRay r = sample_ray(bucket, s);
    if (c.moves() && (r.t < double(c.piece.begin) || r.t > double(c.piece.end))) continue;
    seen.see(bucket, s, r.t, c.grid);
    const SampleBlock& b = bucket.samples;
    const bool lens = !b.u.empty();
    const System system(c.map, Real(b.x[s]) - Real(c.map.middle[0]),
                        Real(b.y[s]) - Real(c.map.middle[1]), lens ? Real(b.u[s]) : 0,
                        lens ? Real(b.v[s]) : 0, c.moves() ? Real(r.t) - Real(c.map.tau) : 0);
    const Pair affine = system.affine(), bent = system.bent(c.map, affine);
    for (int k = 0; k < 2 * c.grid.micropolygon_count(); ++k) {
      const auto corners = triangle_vertices(c.grid, k);
      const Sighting sighting = sight(bucket.camera, r.ray, seen, corners);
      if (!sighting.inside || sighting.doubtful) continue;
      std::array<glm::dvec3, 3> p;
      std::array<TrueVertex, 3> v;
      for (size_t i = 0; i < 3; ++i)
        p[i] = seen.P[size_t(corners[i])], v[i] = places[size_t(corners[i])];
      // The point that is seen, at the reference time.
      const Meeting m = meet(r.ray, p);
      const Real weight[3] = {m.b0 * v[0].W, m.b1 * v[1].W, m.b2 * v[2].W};
      const Real W = weight[0] + weight[1] + weight[2];
      const Pair place{(weight[0] * v[0].x + weight[1] * v[1].x + weight[2] * v[2].x) / W,
                       (weight[0] * v[0].y + weight[1] * v[1].y + weight[2] * v[2].y) / W};
      const Allowed a = allowed(c, v);
      ++total.count;
      total.blur += std::abs(system.x - place[0]) + std::abs(system.y - place[1]);
      for (size_t axis = 0; axis < 2; ++axis) {
        INFO("sample " << s << ", triangle " << k << ", axis " << axis);
        REQUIRE(std::abs(affine[axis] - place[axis]) <= a.affine[axis]);
        REQUIRE(std::abs(bent[axis] - place[axis]) <= a.bent[axis]);
        total.closest = std::max(total.closest, std::abs(bent[axis] - place[axis]) / a.bent[axis]);
        total.slack += a.bent[axis];
      }
    }
  }
}

void require_field(const AffineField& f, double at_middle, double per_x, double per_y) {
  // Coefficients are floats, and so are the vertices that they are fitted to.
  const double size = std::abs(at_middle) + std::abs(per_x) + std::abs(per_y);
  CHECK(double(f.at_middle) == Approx(at_middle).margin(1e-5 * size + 1e-6));
  CHECK(double(f.per_x) == Approx(per_x).margin(1e-5 * size + 1e-6));
  CHECK(double(f.per_y) == Approx(per_y).margin(1e-5 * size + 1e-6));
}

/// Nothing is left over at any vertex, and there is no bend to speak of (pixels).
void require_exact(const FitCase& c) {
  REQUIRE(c.usable());
  for (int i = 0; i < c.grid.vertex_count(); ++i) {
    const TrueVertex v = c.see(c.ends(i));
    const LeftOver left = left_over(c, v);
    INFO("vertex " << i);
    for (size_t axis = 0; axis < 2; ++axis) {
      CHECK(left.coarse[axis] < 2e-3);
      CHECK(left.fine[axis] < 2e-3);
    }
  }
}

}  // namespace

TEST_CASE("The fit of a plane that faces the camera and slides along x") {
  CameraSettings settings = perspective_settings(64, 48);
  open_lens(settings, 0.5, 3.0);
  TestBucket bucket(settings);
  bucket.add(make_grid(8, 4, {0, 1}, [](float u, float v, int key) {
    return glm::vec3(1.5f * u - 0.9f + 0.8f * float(key), 1.2f * v - 0.5f, 5.0f);
  }));
  const RasterClipMap m = bucket.camera.raster_clip();
  const FitCase c(bucket, *bucket.grids[0], {0, 0, 64, 48});
  require_exact(c);
  REQUIRE(c.map.tau == 0.5f);
  REQUIRE(c.map.half_duration == 0.5f);
  // W = z = 5: every point crosses 0.8 / 5 of the focal length in pixels, and no depth changes.
  require_field(c.map.fit[field_rx], double(m.x_scale) * 0.8 / 5, 0, 0);
  require_field(c.map.fit[field_ry], 0, 0, 0);
  require_field(c.map.fit[field_q], 0, 0, 0);
  require_field(c.map.fit[field_c], (5 * double(m.coc_x.scale) + double(m.coc_x.offset)) / 5, 0, 0);
  require_field(c.map.fit[field_e], 0, 0, 0);
  // Half way it has slid by 0.4: from the mean of -0.9 .. 0.6 to 0.25.
  REQUIRE(double(c.map.middle[0]) ==
          Approx(double(m.x_from_w) + double(m.x_scale) * 0.25 / 5).epsilon(1e-6));
}

TEST_CASE("The fit of a plane that leans along x and moves in depth too") {
  CameraSettings settings = perspective_settings(64, 48);
  open_lens(settings, 0.5, 3.0);
  TestBucket bucket(settings);
  const double slope = 0.6, z0 = 5, dx = 0.8, dz = -0.7;
  bucket.add(make_grid(6, 8, {0, 1}, [&](float u, float v, int key) {
    const double x = 1.6 * double(u) - 0.8, y = 1.2 * double(v) - 0.5;
    return glm::vec3(x + key * dx, y, z0 + slope * x + key * dz);
  }));
  const RasterClipMap m = bucket.camera.raster_clip();
  const FitCase c(bucket, *bucket.grids[0], {0, 0, 64, 48});
  require_exact(c);
  // At the reference time, half way, the plane is z = z1 + slope x with z1 as below. With the
  // raster position xi = s x / z from the optical axis, x = xi z / s, so z (1 - slope xi / s) = z1:
  // 1 / z is affine in xi, and so is everything that is constant before it is divided by W = z.
  const double s = double(m.x_scale), axis = double(m.x_from_w);
  const double z1 = z0 + 0.5 * dz - slope * 0.5 * dx;
  const double from_axis = double(c.map.middle[0]) - axis;
  const double inverse_z = (1 - slope * from_axis / s) / z1, inverse_z_per_x = -slope / (s * z1);
  // dX - middle dW with dX = s dx + axis dz, dW = dz.
  const double velocity_x = s * dx - from_axis * dz;
  const double velocity_y = (double(m.y_from_w) - double(c.map.middle[1])) * dz;
  require_field(c.map.fit[field_rx], velocity_x * inverse_z, velocity_x * inverse_z_per_x, 0);
  require_field(c.map.fit[field_ry], velocity_y * inverse_z, velocity_y * inverse_z_per_x, 0);
  require_field(c.map.fit[field_q], dz * inverse_z, dz * inverse_z_per_x, 0);
  const double scale = double(m.coc_x.scale), offset = double(m.coc_x.offset);
  require_field(c.map.fit[field_c], scale + offset * inverse_z, offset * inverse_z_per_x, 0);
  require_field(c.map.fit[field_e], scale * dz * inverse_z, scale * dz * inverse_z_per_x, 0);
}

TEST_CASE("Of any plane patch whose points move as an affine map does, nothing is left over") {
  for (int k = 0; k < 30; ++k) {
    ExtremeRandom random(k);
    CameraSettings settings = perspective_settings(64, 48);
    open_lens(settings, random.between(0.1f, 1.0f), random.between(2.0f, 8.0f));
    TestBucket bucket(settings);
    const auto vector = [&](float half) { return random.in_box(glm::vec3(0.0f), glm::vec3(half)); };
    const glm::vec3 centre[2] = {glm::vec3(0, 0, 5) + vector(0.5f),
                                 glm::vec3(0, 0, 5) + vector(0.5f)};
    const glm::vec3 u = glm::vec3(1, 0, 0) + vector(0.4f), v = glm::vec3(0, 1, 0) + vector(0.4f);
    const glm::vec3 along_u[2] = {u, u + vector(0.2f)}, along_v[2] = {v, v + vector(0.2f)};
    bucket.add(make_grid(5, 7, {0, 1}, [&](float s, float t, int key) {
      return centre[key] + along_u[key] * (s - 0.5f) + along_v[key] * (t - 0.5f);
    }));
    INFO("plane " << k);
    require_exact({bucket, *bucket.grids[0], {0, 0, 64, 48}, {0.25f, 1.0f}});
  }
}

TEST_CASE("Samples are mapped to the point that they see, but for what is documented") {
  const PixelRect rect{16, 10, 48, 38};
  for (const Blur& blur : {Blur{true, false}, Blur{false, true}, Blur{true, true}}) {
    Sightings total;
    int usable = 0;
    constexpr int cases = 12;
    for (int k = 0; k < cases; ++k) {
      const TestBucket bucket = curved_bucket(k, blur, rect);
      const TimePiece piece = k % 3 == 0   ? TimePiece{}
                              : k % 3 == 1 ? TimePiece{0.0f, 0.5f}
                                           : TimePiece{0.25f, 1.0f};
      const FitCase c(bucket, *bucket.grids[0], rect, piece);
      if (!c.usable()) continue;
      ++usable;
      INFO("motion " << blur.motion << " lens " << blur.lens << " case " << k);
      check_sightings(c, total);
    }
    INFO("motion " << blur.motion << " lens " << blur.lens << ": " << total.count << " sightings, "
                   << usable << " usable fits; closest " << double(total.closest) << ", blur "
                   << double(total.blur / total.count) << ", slack "
                   << double(total.slack / total.count));
    CHECK(usable > cases / 2);
    CHECK(total.count > 1000);
    // The bounds are worth something, and the sightings come near to them.
    CHECK(total.slack < 0.2 * total.blur);
    CHECK(total.closest > 0.3);
  }
}

TEST_CASE("The gain bounds the inverse of every sample's system, and is attained") {
  Real most = 0;
  int usable = 0;
  for (int k = 0; k < 200; ++k) {
    ExtremeRandom random(k);
    ShearMap map;
    map.half_duration = 0.5f, map.coc_ratio = random.between(-2.0f, 2.0f);
    const float size = random.log_between(1e-3f, 0.5f), reach[2] = {24, 40}, lens = 1;
    for (const ShearField f : {field_rx, field_ry, field_q, field_c, field_e}) {
      const float s = f == field_q ? size / 40 : size;
      map.fit[f] = {random.between(-9, 9), random.between(-s, s), random.between(-s, s)};
    }
    const ShearGain gain = shear_gain(map, lens, reach);
    if (!gain.usable) continue;
    ++usable;
    for (int corner = 0; corner < 32; ++corner) {
      const auto end = [&](int bit) { return corner >> bit & 1 ? Real(1) : Real(-1); };
      // Mostly the ends of the range, where the inverse is largest; now and then within.
      const Real inside = k % 4 ? 1 : Real(random.between(0, 1));
      const System s(map, end(0) * Real(reach[0]) * inside, end(1) * Real(reach[1]) * inside,
                     end(2), end(3), end(4) * Real(map.half_duration));
      const Pair column_x = s.solve(1, 0), column_y = s.solve(0, 1);
      CHECK(std::abs(column_x[0]) <= Real(gain.xx));
      CHECK(std::abs(column_x[1]) <= Real(gain.yx));
      CHECK(std::abs(column_y[0]) <= Real(gain.xy));
      CHECK(std::abs(column_y[1]) <= Real(gain.yy));
      if (gain.xx > 1.2f) most = std::max(most, std::abs(column_x[0]) / Real(gain.xx));
    }
  }
  CHECK(usable > 50);
  CHECK(most > 0.9);
}

namespace {

/// 32 x 32 micropolygons of a pixel, on a plane that leans or on a surface as gently curved as a
/// sphere of radius 460 pixels, that cross `motion` pixels while they come nearer, with circles of
/// confusion of about `coc` pixels radius.
TestBucket one_pixel_grid(bool curved, double motion, double coc) {
  constexpr double depth = 5;
  CameraSettings settings = perspective_settings(256, 256);
  const double scale = std::abs(double(Camera(settings).raster_clip().x_scale));
  // Focused at twice the depth, the radius is scale * aperture radius / (2 depth).
  if (coc > 0) open_lens(settings, coc * 2 * depth / scale, 2 * depth);
  TestBucket bucket(settings);
  const RasterClipMap m = bucket.camera.raster_clip();
  const std::vector<float> keys = motion > 0 ? std::vector{0.0f, 1.0f} : std::vector{0.0f};
  const glm::dvec3 shift =
      depth * motion / scale * glm::dvec3(std::sqrt(0.5), -std::sqrt(0.5), -0.3);
  bucket.add(make_grid(32, 32, keys, [&](float u, float v, int key) {
    const double a = double(u) - 0.5, b = double(v) - 0.5;
    // Of a plane, 1 / z is affine on the raster.
    const double bulge = curved ? 0.005 * (a * a + b * b) : 0.0;
    const double z = depth / (1 - 0.06 * a - 0.02 * b - bulge);
    const double x = 112.3 - 0.35 * motion + 32 * a, y = 112.1 - 0.35 * motion + 32 * b;
    const glm::dvec3 p((x - double(m.x_from_w)) * z / double(m.x_scale),
                       (y - double(m.y_from_w)) * z / double(m.y_scale), z);
    return glm::vec3(p + double(key) * shift);
  }));
  bucket.make_samples({0, 0, 256, 256}, 16, 3);
  return bucket;
}

double efficiency(const TestBucket& bucket, const char* hider) {
  HideCounters counters;
  bucket.hide(hider, &counters);
  return double(counters.samples_covered) / double(counters.samples_tested);
}

}  // namespace

TEST_CASE("Sample test efficiency under motion and defocus at once is that of the still grid") {
  for (const bool curved : {false, true}) {
    const double still = efficiency(one_pixel_grid(curved, 0, 0), "shear");
    for (const double times : {1.0, 2.0}) {
      const TestBucket bucket = one_pixel_grid(curved, 50 * times, 20 * times);
      const double shear = efficiency(bucket, "shear"), dual = efficiency(bucket, "dual");
      INFO("curved " << curved << ", blur times " << times << ": still " << still << " shear "
                     << shear << " dual " << dual);
      CHECK(shear >= 0.9 * still);
      CHECK(dual < 0.5 * still);
    }
  }
}

namespace {

/// Grids that no single map serves, moving, and every other one through a lens.
TestBucket refused_bucket(int kind, int k) {
  CameraSettings settings = perspective_settings(64, 48);
  settings.near_clip = 0.05;
  if (k % 2) open_lens(settings, 0.2, 3.0);
  TestBucket bucket(settings);
  ExtremeRandom random(k);
  const glm::vec3 shift = random.in_box(glm::vec3(0.0f), {0.5f, 0.5f, 0.2f});
  bucket.add(make_grid(12, 12, {0, 1}, [&](float u, float v, int key) -> glm::vec3 {
    const float a = 2 * u - 1, b = 2 * v - 1, along = float(key);
    // A little rough, so that some of it can be seen edge-on through a pinhole.
    const float rough = 0.02f * a * a;
    switch (kind) {
      case 0:  // from behind the eye to in front of it
        return glm::vec3(a, 0.6f * b + 0.2f, 1.0f + 2.0f * b) + along * shift;
      case 1:  // half a turn about the axis of view: all meet half way
        return glm::vec3((1 - 2 * along) * a, (1 - 2 * along) * b, 4.0f + 0.2f * a) + along * shift;
      default:  // its plane passes through the eye at both keys
        return glm::vec3(0.05f * (4 + 2 * b) + rough, a, 4 + 2 * b) * (1 + 0.3f * along);
    }
  }));
  bucket.make_samples({8, 6, 56, 42}, 4, uint32_t(k));
  return bucket;
}

}  // namespace

TEST_CASE("Where the map is refused the fragments are still those of bbox") {
  const char* const kinds[] = {"through the eye plane", "half a turn", "edge-on"};
  for (int kind = 0; kind < 3; ++kind)
    for (int k = 0; k < 6; ++k) {
      const TestBucket bucket = refused_bucket(kind, k);
      INFO(kinds[kind] << ", variant " << k);
      const FitCase whole(bucket, *bucket.grids[0], bucket.samples.rect);
      // Edge-on through a pinhole it is not: what little is seen keeps its shape.
      CHECK(whole.usable() == (kind == 2 && k % 2 == 0));
      const FragmentList expected = bucket.hide("bbox");
      CHECK(expected.size() > 0);
      CHECK(same_fragments(expected, bucket.hide("shear")));
      CHECK(same_fragments(expected, bucket.hide("shear:1")));
    }
}
