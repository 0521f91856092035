#pragma once
/// The extremes table, cameras: fields of view near 0 and 180 degrees, lenses from closed to wider
/// than the scene, and the ends of lens and shutter profiles.

#include <numbers>
#include <random>

#include "base/error.h"
#include "bench/extremes_table.h"
#include "cameras/camera.h"

namespace tessera {

inline CameraSettings extreme_camera(double fov_degrees) {
  CameraSettings settings;
  settings.projection = Projection::perspective;
  settings.fov_degrees = fov_degrees;
  settings.x_resolution = 1920, settings.y_resolution = 1080;
  return settings;
}

/// Where a camera of extreme_camera() sees P through the lens centre: projected onto the plane at
/// distance 1, whose height of 2 tan(fov / 2) fills the raster.
inline glm::vec<2, long double> projected(const CameraSettings& s, glm::vec<3, long double> P) {
  const long double half = std::tan(std::numbers::pi_v<long double> * s.fov_degrees / 360);
  const long double pixels = s.y_resolution / (2 * half);
  return {s.x_resolution / 2.0L + pixels * P.x / P.z, s.y_resolution / 2.0L - pixels * P.y / P.z};
}

/// A point in view, at a depth between e^-14 and e^14.
inline glm::vec3 point_in_view(const CameraSettings& s, std::mt19937& random) {
  std::uniform_real_distribution<double> unit(-1, 1);
  const double z = std::exp(14 * unit(random));
  const double reach = z * std::tan(std::numbers::pi * s.fov_degrees / 360);
  const double x = 1.7 * reach * unit(random), y = reach * unit(random);
  return {float(x), float(y), float(z)};
}

inline void add_projection_extremes(ExtremesTable& table) {
  for (const double fov : {1e-6, 1e-3, 179.0, 179.999, 180 - 1e-6}) {
    const CameraSettings s = extreme_camera(fov);
    const Camera camera(s);
    std::mt19937 random(1);
    WorstError error;
    for (int k = 0; k < 100000; ++k) {
      const glm::vec3 P = point_in_view(s, random), clip = camera.raster_clip_from_camera(P);
      const auto expected = projected(s, P);
      error.see((long double)(clip.x) / clip.z, expected.x);
      error.see((long double)(clip.y) / clip.z, expected.y);
    }
    // Four roundings of a raster position each.
    table.add({"cameras", fmt::format("field of view 180 - {:g}", 180 - fov),
               "projection in long double", error, "pixels", 4 * 1920 * 0x1p-24});
  }
}

/// A point seen through a place of the lens lies where the line through both meets the plane of
/// focus.
inline void add_lens_extremes(ExtremesTable& table) {
  struct Lens {
    const char* name;
    CameraSettings::ThinLens lens;
  };
  const Lens lenses[] = {{"lens 1e-30 wide", {1, 1e-30, 5}},
                         {"lens 1e4 wide", {1, 1e4, 5}},
                         {"focus at 1e-6", {8, 0.5, 1e-6}},
                         {"focus at 1e30", {8, 0.5, 1e30}},
                         {"f-stop 1e30", {1e30, 0.5, 5}}};
  for (const Lens& l : lenses) {
    CameraSettings s = extreme_camera(45);
    s.lens = l.lens;
    const Camera camera(s);
    const long double radius = l.lens.focal_length / (2.0L * l.lens.f_stop);
    std::mt19937 random(2);
    std::uniform_real_distribution<float> unit(-1, 1);
    WorstError error;
    for (int k = 0; k < 100000; ++k) {
      glm::vec3 P = point_in_view(s, random);
      if (k % 4 == 0) P.z = float(std::min(l.lens.focal_distance, 1e7));  // in focus
      // On the axis at P.z, seen from (lens_x, 0, 0): the line crosses the plane of focus here.
      const long double f = l.lens.focal_distance, lens_x = radius * unit(random);
      const long double half = std::tan(std::numbers::pi_v<long double> * 45 / 360);
      const long double pixels = s.y_resolution / (2 * half);
      const long double expected = pixels * (lens_x - lens_x * (f / P.z)) / f;
      const long double found = (long double)(camera.coc_raster(P.z).x) * (lens_x / radius);
      // The circle is a difference: what it rounds by is relative to its larger part.
      const long double part = pixels * radius / std::min<long double>(f, P.z);
      error.see(found, expected, part);
    }
    table.add({"cameras", l.name, "thin lens in long double", error, "of the larger part", 1e-6});
  }
}

/// E |p|^2 over the aperture, by the closed form; and no sample beyond the extent.
inline void add_profile_extremes(ExtremesTable& table) {
  const long double pi = std::numbers::pi_v<long double>;
  const auto compare = [&](const std::string& name, const LensProfile& lens, long double moment) {
    const int side = table.scaled(2048, 512);
    long double sum = 0;
    WorstError error;
    const float last = std::nextafter(1.0f, 0.0f);
    for (int k = 0; k < side * side; ++k) {
      const glm::vec2 p = lens.sample((float(k % side) + 0.5f) / float(side),
                                      (float(k / side) + 0.5f) / float(side));
      sum += (long double)(p.x) * p.x + (long double)(p.y) * p.y;
    }
    error.see(sum / side / side, moment);
    for (const float a : {0.0f, 0x1p-149f, 0.5f, last})
      for (const float b : {0.0f, 0x1p-149f, 0.5f, last}) {
        const glm::vec2 p = lens.sample(a, b);
        error.see(std::max(0.0, double(std::max(std::abs(p.x), std::abs(p.y)) - lens.extent())));
      }
    table.add({"cameras", name, "second moment, extent", error, "lens radii^2",
               table.quick() ? 1e-5 : 1e-6});
  };
  compare("lens disc", *make_lens_profile("disc", 6, 0), 0.5L);
  for (const int blades : {3, 64})
    compare(fmt::format("lens of {} blades turned by 1e9", blades),
            *make_lens_profile("polygon", blades, 1e9), (2 + std::cos(2 * pi / blades)) / 6);
  for (const char* name : {"box", "trapezoid", "gaussian"}) {
    const auto shutter = make_shutter_profile(name);
    WorstError error;
    // The share of light until sample(a) is a. Simpson's rule from the nearer end.
    for (const double a : {0.0, 1e-30, 1e-6, 1e-3, 0.3, 0.5, 1 - 1e-3, 1 - 0x1p-24}) {
      const double t = double(shutter->sample(float(a)));
      const double from = a < 0.5 ? 0 : t, to = a < 0.5 ? t : 1;
      const int steps = 200000;
      long double share = 0;
      for (int k = 0; k <= steps; ++k)
        share += (k % steps == 0 ? 1
                  : k % 2        ? 4
                                 : 2) *
                 shutter->response(from + (to - from) * k / double(steps));
      share *= (to - from) / (3.0L * steps);
      error.see(share, a < 0.5 ? a : 1 - a);
    }
    table.add({"cameras", fmt::format("shutter {}, its ends", name), "integral of the response",
               error, "share of the light", 1e-6});
  }
}

/// Settings without a meaning must be refused, as must what no float holds.
inline void add_refusals(ExtremesTable& table) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  WorstError error;
  const auto refuse = [&](const CameraSettings& s) {
    bool refused = false;
    try {
      const Camera camera(s);
    } catch (const Error&) {
      refused = true;
    }
    error.see(refused ? 0.0 : 1.0);
  };
  for (const double fov : {0.0, -1.0, 180.0, 1e-42, nan}) refuse(extreme_camera(fov));
  for (const CameraSettings::ThinLens& lens :
       {CameraSettings::ThinLens{0, 1, 1}, {1, 0, 1}, {1, 1, 0}, {nan, 1, 1}, {1, nan, 1}}) {
    CameraSettings s = extreme_camera(45);
    s.lens = lens;
    refuse(s);
  }
  table.add(
      {"cameras", "settings without a meaning", "refused with an error", error, "accepted", 0});
}

inline void add_camera_extremes(ExtremesTable& table) {
  add_projection_extremes(table);
  add_lens_extremes(table);
  add_profile_extremes(table);
  add_refusals(table);
}

}  // namespace tessera
