#pragma once
/// The extremes table, lights: extents from 1e-6 to 1e6, and receivers that touch them.

#include <cmath>
#include <numbers>

#include <glm/gtc/matrix_transform.hpp>

#include "bench/extremes_table.h"
#include "shade/extended_light.h"
#include "tests/shade/fixtures.h"

namespace tessera {

/// One light above a matte surface: the light's place is the origin, and it shines along +z.
class ExtremeLight {
 public:
  explicit ExtremeLight(const ShaderCall& call) {
    scene_.add_light(call);
    scene_.add_surface("matte");
    bindings_ = scene_.bind();
  }
  /// What the light adds, unblocked, at P: the mean over the places where it is summed.
  double received(const glm::vec3& P, const glm::vec3& N) const {
    return mean_over(light().places, P, N);
  }
  /// The same as samples at rate "sample" bring it: shares of the mean over the open places.
  double received_by_shares(const glm::vec3& P, const glm::vec3& N, int side) const {
    const double mean = mean_over(light().open_places, P, N);
    const Vec3Array at = repeated(P, side), normals = repeated(N, side);
    const Vec3Array means = repeated(glm::vec3(float(mean)), side);
    LightServices services = bindings_->light_services();
    services.mean_received = &means;
    double sum = 0;
    for (int j = 0; j < side; ++j) {
      std::vector<glm::vec2> xi;
      for (int i = 0; i < side; ++i)
        xi.emplace_back((float(i) + 0.5f) / float(side), (float(j) + 0.5f) / float(side));
      ShareSamples shares;
      light().definition->share_from(light(), points_of(at, normals), xi, services, shares);
      for (int i = 0; i < side; ++i) sum += double(shares.open[i].x);
    }
    return sum / side / side * mean;
  }

 private:
  const BoundLight& light() const {
    return *bindings_->of(*scene_.scene.surfaces.front().attributes).lights.at(0);
  }
  static Vec3Array repeated(const glm::vec3& value, int count) {
    Vec3Array array(count);
    for (int k = 0; k < count; ++k) array.set(k, value);
    return array;
  }
  static ShadingPoints points_of(const Vec3Array& P, const Vec3Array& N) {
    ShadingPoints points;
    points.count = P.count(), points.P = P, points.N = N;
    return points;
  }
  double mean_over(const std::vector<glm::vec2>& places, const glm::vec3& P,
                   const glm::vec3& N) const {
    const int count = int(places.size());
    const Vec3Array at = repeated(P, count), normals = repeated(N, count);
    PlaceSamples out;
    out.reset(count);
    light().definition->illuminate_from(light(), points_of(at, normals), places, out);
    double sum = 0;
    for (int k = 0; k < count; ++k)
      sum += double(out.arriving.Cl[k].x) * std::max(0.0, double(glm::dot(N, out.arriving.L[k])));
    return sum / count;
  }

  test::TestScene scene_;
  std::shared_ptr<const ShaderBindings> bindings_;
};

inline ShaderCall sized_light(const char* name, const char* size, double value, float samples) {
  std::vector<Parameter> parameters{test::number("samples", samples)};
  if (*size) parameters.push_back(test::number(size, float(value)));
  if (size == std::string("width")) parameters.push_back(test::number("height", float(value)));
  return test::call(name, std::move(parameters));
}

/// What a square of side w and radiance 1 adds on its axis at distance d, facing it (the form
/// factor of four corner rectangles).
inline long double under_square(long double w, long double d) {
  const long double a = w / 2 / d, root = std::sqrt(1 + a * a);
  return 4 / std::numbers::pi_v<long double> * a / root * std::atan(a / root);
}

/// What is received against what arrives: at most `too_much` brighter, and at most `missed` darker.
/// Where all may be missed the row would say nothing, and is left out.
inline void add_near_rows(ExtremesTable& table, const std::string& name, double received,
                          long double expected, double too_much, double missed) {
  WorstError above, below;
  above.see(double(std::max(0.0L, received - expected)));
  below.see(double(std::max(0.0L, expected - received)));
  table.add({"lights", name + ", too much", "form factor in long double", above, "of the radiance",
             too_much, fmt::format("{:.3g} missing", below.worst)});
  if (missed < 1)
    table.add({"lights", name + ", missing", "form factor in long double", below, "of the radiance",
               missed});
}

inline void add_square_lights(ExtremesTable& table) {
  const glm::vec3 N(0, 0, -1);
  for (const double w : {1e-6, 1.0, 1e6}) {
    for (const auto& [samples, bound] : {std::pair{16.0f, 0.02}, {1024.0f, 6e-4}}) {
      const ExtremeLight light(sized_light("rectanglelight", "width", w, samples));
      WorstError error;
      for (const double away : {1.0, 3.0, 1e3, 1e6}) {
        const float d = float(away * w);
        const long double expected = under_square(float(w), d);
        error.see((long double)(light.received({0, 0, d}, N)), expected, expected);
      }
      table.add({"lights", fmt::format("square {:g} wide, {} places", w, samples),
                 "form factor in long double", error, "of the light", bound});
    }
  }
  // Nearer than it is wide: one of the fixed places may count for 2 at most, until it is so near
  // that none lies over it.
  struct Gap {
    double size, too_much, missed;
  };
  for (const auto& [gap, too_much, missed] :
       {Gap{1e-1, 0.005, 0.005}, {1e-3, 0.001, 1}, {1e-6, 0.001, 1}}) {
    const ExtremeLight light(sized_light("rectanglelight", "width", 1, 1024));
    add_near_rows(table, fmt::format("{:g} from a square of 1, fixed places", gap),
                  light.received({0, 0, float(gap)}, N), under_square(1, float(gap)), too_much,
                  missed);
  }
  // Shares make up for what the fixed places miss, down to where a place would count for more than
  // it may.
  struct Near {
    float samples, gap;
    double missed;
  };
  for (const Near& c :
       {Near{1, 0.5f, 1e-3}, {16, 0.15f, 1e-3}, {1, 0.03f, 0.95}, {16, 0.03f, 0.65}}) {
    const ExtremeLight light(sized_light("rectanglelight", "width", 1, c.samples));
    add_near_rows(table,
                  fmt::format("{:g} from a square of 1, shares, {} places", c.gap, c.samples),
                  light.received_by_shares({0, 0, c.gap}, N, table.scaled(512, 256)),
                  under_square(1, c.gap), 1e-3, c.missed);
  }
}

inline void add_round_lights(ExtremesTable& table) {
  const glm::vec3 N(0, 0, -1);
  for (const double r : {1e-6, 1.0, 1e6}) {
    const ExtremeLight ball(sized_light("spherelight", "radius", r, 256));
    const ExtremeLight disc(sized_light("disclight", "radius", r, 1024));
    WorstError of_ball, touched, of_disc;
    for (const double away : {1 + 1e-6, 1 + 1e-3, 2.0, 1e3, 1e6}) {
      const float d = float(away * r);
      const long double x = (long double)(float(r)) / d;
      (away < 2 ? touched : of_ball).see((long double)(ball.received({0, 0, d}, N)), x * x, x * x);
      if (away < 2) continue;
      const long double flat = x * x / (1 + x * x);
      of_disc.see((long double)(disc.received({0, 0, d}, N)), flat, flat);
    }
    table.add({"lights", fmt::format("ball of {:g} from afar", r), "(r / d)^2", of_ball,
               "of the light", 1e-3});
    table.add({"lights", fmt::format("ball of {:g}, touched", r), "(r / d)^2", touched,
               "of the light", 0.02});
    table.add({"lights", fmt::format("disc of {:g}", r), "r^2 / (r^2 + d^2)", of_disc,
               "of the light", 6e-4});
  }
}

/// What stands on a light, or in its plane, or inside a ball, gets nothing from it; a dome gives
/// its radiance to all.
inline void add_touching_receivers(ExtremesTable& table) {
  WorstError nothing, all;
  for (const float samples : {1.0f, 16.0f, 1024.0f}) {
    const ExtremeLight square(sized_light("rectanglelight", "width", 1, samples));
    const ExtremeLight disc(sized_light("disclight", "radius", 1, samples));
    const ExtremeLight ball(sized_light("spherelight", "radius", 1, samples));
    for (const glm::vec3& P : {glm::vec3(0.0f), {0.5f, 0.5f, 0}, {7, 0, 0}, {1e30f, 0, 0}}) {
      nothing.see(square.received(P, {0, 0, -1})), nothing.see(disc.received(P, {0, 0, -1}));
    }
    for (const glm::vec3& P : {glm::vec3(0.0f), {0.5f, 0.5f, 0}, {0, 0, 0.999f}})
      nothing.see(ball.received(P, {0, 0, -1}));
    const ExtremeLight dome(sized_light("domelight", "", 0, samples));
    for (const glm::vec3& P : {glm::vec3(0.0f), {1e-30f, 0, 0}, {1e7f, 0, -1e7f}, {0, 1e30f, 0}})
      for (const glm::vec3& N : {glm::vec3(0, 0, -1), {0, 0, 1}, {1, 0, 0}})
        all.see((long double)(dome.received(P, N)), 1);
  }
  table.add({"lights", "on a light, in its plane, inside a ball", "nothing arrives", nothing,
             "of the radiance", 0});
  table.add(
      {"lights", "dome, receivers 0 to 1e30 away", "radiance 1", all, "of the radiance", 1e-5});
}

inline void add_light_extremes(ExtremesTable& table) {
  add_square_lights(table);
  add_round_lights(table);
  add_touching_receivers(table);
}

}  // namespace tessera
