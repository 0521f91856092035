#pragma once
/// The extremes table, shade: bands of 0 and without end, blur of all sizes, filters over nothing
/// and over everything.

#include <cmath>
#include <numbers>
#include <random>

#include "bench/extremes_known_frames.h"
#include "shade/noise.h"
#include "shade/normal_spread.h"
#include "shade/shading_extents.h"
#include "tests/hide/hide_fixture.h"

namespace tessera {

/// The box of frequencies by 2 r cos(max(0, acos(o / r) - theta)) in long double.
inline void add_band_extremes(ExtremesTable& table) {
  const float sizes[] = {0,
                         0x1p-149f,
                         1e-30f,
                         1e-6f,
                         0.3f,
                         1,
                         17,
                         1e4f,
                         1e7f,
                         1e30f,
                         std::numeric_limits<float>::max()};
  WorstError along, across;
  for (const double pixel : {0.5, 0.1, 1e-8}) {
    for (const float speed : sizes) {
      for (const float coc : sizes) {
        for (const float theta : {0.0f, 1e-6f, 0.3f, 1.5f, float(std::numbers::pi / 2)}) {
          BlurBounds blur;
          blur.min_speed = speed, blur.half_span_radians = theta, blur.min_coc = coc;
          const ShadingExtents found = shading_extents(blur, {0.7, 0.45, pixel});
          const long double r = coc > 0 ? std::min<long double>(pixel, 0.7L / coc) : pixel;
          const long double o = speed > 0 ? 0.45L / speed : r;
          const long double angle = o < r ? std::acos(o / r) - theta : 0;
          const auto width = [&](long double half) {
            return std::min<long double>(std::max(2 * half, 1 / (long double)(widest_cell_pixels)),
                                         2 * pixel);
          };
          along.see(found.d_mu, width(r * std::cos(std::max(0.0L, angle))), width(r));
          across.see(found.d_perp, width(r), width(r));
        }
      }
    }
  }
  table.add({"shade", "cells along motion, blur 0 to 3e38", "r cos(acos(o / r) - theta)", along,
             "of the band", 1e-6});
  table.add({"shade", "cells across motion, blur 0 to 3e38", "min(pixel, lens / coc)", across,
             "of the band", 1e-6});
}

/// Energy within the band that is said to hold a share: of the disc 1 - J0^2 - J1^2 (Rayleigh), of
/// the box 2 / pi (Si(2 pi f) - sin^2(pi f) / (pi f)).
inline void add_limit_extremes(ExtremesTable& table) {
  const auto lens = make_lens_profile("disc", 6, 0);
  const auto shutter = make_shutter_profile("box");
  WorstError of_lens, of_shutter;
  for (const double share : {1e-6, 1e-3, 0.5, 0.99, 0.999, 0.9999}) {
    const double radius = 2 * std::numbers::pi * lens->band_limit(share);
    const double j0 = ::j0(radius), j1 = ::j1(radius);
    of_lens.see(std::abs(1 - j0 * j0 - j1 * j1 - share));
    const double f = shutter->band_limit(share), x = 2 * std::numbers::pi * f;
    const int steps = 2 * int(std::min(4e6, 1e3 + 200 * f));
    long double si = 0;
    for (int k = 0; k <= steps; ++k) {
      const double at = x * k / steps;
      si += (k % steps == 0 ? 1 : k % 2 ? 4 : 2) * (at > 0 ? std::sin(at) / at : 1.0);
    }
    si *= x / (3.0L * steps);
    const long double sine = std::sin(x / 2);
    of_shutter.see(std::abs(
        double(2 / std::numbers::pi_v<long double> * (si - sine * sine / (x / 2)) - share)));
  }
  table.add({"shade", "band of a disc, shares 1e-6 to 0.9999", "1 - J0^2 - J1^2", of_lens,
             "of the energy", 1e-5});
  table.add({"shade", "band of a box shutter, shares 1e-6 to 0.9999", "sine integral", of_shutter,
             "of the energy", 1e-5});
}

/// Raster velocity of a vertex at share `f` of the way between the keys, but for the raster's
/// scale.
inline glm::vec<2, long double> velocity_of(const Grid& grid, int k, long double f) {
  const auto at = [&](int axis) { return (1 - f) * grid.P(0, axis)[k] + f * grid.P(1, axis)[k]; };
  const auto change = [&](int axis) {
    return (long double)(grid.P(1, axis)[k]) - grid.P(0, axis)[k];
  };
  const long double w = at(2), dw = change(2);
  return {(change(0) * w - at(0) * dw) / (w * w), -(change(1) * w - at(1) * dw) / (w * w)};
}

/// Bounds of the blur of random grids against their vertices at many times.
inline void add_blur_extremes(ExtremesTable& table) {
  struct Case {
    const char* name;
    float scale, step;
  };
  for (const Case& c : {Case{"paths 1e-6 pixels long", 1, 1e-8f},
                        {"paths 1e5 pixels long", 1, 1e3f},
                        {"coordinates 1e-6", 1e-6f, 0.1f},
                        {"coordinates 1e7", 1e7f, 0.1f}}) {
    std::mt19937 random(4);
    std::uniform_real_distribution<float> unit(-1, 1);
    WorstError error;
    for (int n = 0; n < table.scaled(2000, 200); ++n) {
      CameraSettings settings = perspective_settings(640, 480);
      settings.lens = CameraSettings::ThinLens{1, 0.1 * double(c.scale), 3.0 * double(c.scale)};
      const Camera camera(settings);
      const glm::vec3 shift = c.step * glm::vec3(unit(random), unit(random), 0.2f * unit(random));
      const auto grid = make_grid(3, 3, {0, 1}, [&](float u, float v, int key) {
        const glm::vec3 wobble = 0.1f * c.step * glm::vec3(unit(random), unit(random), 0);
        glm::vec3 P = glm::vec3(u, v, 4 + 0.3f * u * v) + float(key) * (shift + wobble);
        P.z = std::max(P.z, 0.5f);
        return c.scale * P;
      });
      const BlurBounds bounds = blur_bounds(*grid, camera, true, true);
      const long double pixels = camera.raster_clip().x_scale;
      for (int k = 0; k < grid->vertex_count(); ++k) {
        for (int step = 0; step <= 8; ++step) {
          const auto v = pixels * velocity_of(*grid, k, step / 8.0L);
          const long double speed = glm::length(v);
          // No velocity falls short of the bound, nor does its part along the middle direction.
          const glm::vec<2, long double> e(bounds.direction);
          if (bounds.min_speed > 0) {
            error.see(double(std::max(0.0L, bounds.min_speed / speed - 1)));
            const long double angle =
                std::atan2(std::abs(e.x * v.y - e.y * v.x), e.x * v.x + e.y * v.y);
            error.see(double(std::max(0.0L, angle - bounds.half_span_radians)));
          }
          const long double z =
              (1 - step / 8.0L) * grid->P(0, 2)[k] + step / 8.0L * grid->P(1, 2)[k];
          const long double radius =
              pixels * 0.05L * c.scale * std::abs(1 / (3.0L * c.scale) - 1 / z);
          error.see(double(std::max(0.0L, (bounds.min_coc - radius) / (radius + 1e-6L))));
        }
      }
    }
    table.add({"shade", fmt::format("bounds of blur, {}", c.name), "velocities, long double", error,
               "relative; radians", 1e-6});
  }
}

/// Means of patterns and of cosines over cells of no size to cells without end.
inline void add_filter_extremes(ExtremesTable& table) {
  const float widths[] = {0, 0x1p-149f, 1e-30f, 1e-6f, 1e-3f, 0.7f, 2, 31.7f, 1e4f, 1e7f, 1e30f};
  std::mt19937 random(6);
  WorstError wave, cosine;
  for (const float reach : {1.0f, 1e3f, 1e6f}) {
    std::uniform_real_distribution<float> place(-reach, reach);
    for (int n = 0; n < table.scaled(20000, 2000); ++n) {
      const float x = place(random);
      for (const float w : widths) {
        // The integral of the wave is a triangle; a jump within rounding of the box may go either
        // way.
        const auto integral = [](long double at) {
          const long double in_period = at - 2 * std::floor(at / 2);
          return in_period < 1 ? in_period : 2 - in_period;
        };
        const long double low = x - w / 2.0L, high = x + w / 2.0L;
        const long double rounding = 4 * 0x1p-24L * (std::abs(x) + 1);
        const long double to_jump = std::abs((long double)(x)-std::round((long double)(x)));
        if (w <= 1e-3f && to_jump < w / 2.0L + rounding) continue;
        const long double expected =
            w <= 1e-3f  ? (std::fmod(std::floor((long double)(x)), 2.0L) == 0 ? 1 : -1)
            : w > 1e29f ? 0
                        : (integral(high) - integral(low)) / w;
        wave.see((long double)(filtered_square_wave(x, w)), expected);
      }
    }
  }
  table.add(
      {"shade", "checks over cells of 0 to 1e30", "integral in long double", wave, "of 2", 1e-3});
  for (const float part : {0.0f, 1e-30f, -1e-6f, 0.3f, -0.9f, 1.0f}) {
    for (const float p : {1e-30f, 1e-20f, 1e-6f, 0.5f, 3.0f, 1e7f}) {
      for (const float q : {0.0f, 1e-30f, 1e-6f, 0.5f, 3.0f, 1e7f}) {
        // Over the longer edge in closed form, over the shorter by midpoints.
        // (Where all of the cell faces one way there is nothing to average, and nobody asks.)
        const long double a = std::max(p, q), b = std::min(p, q);
        const float x = part * 0.5f * (p + q);
        const int steps = 2000;
        long double sum = 0;
        for (int k = 0; k < steps; ++k) {
          const long double c = x + b * ((k + 0.5L) / steps - 0.5L), top = c + a / 2,
                            low = c - a / 2;
          sum += low >= 0 ? c : top <= 0 ? 0 : top * top / (2 * a);
        }
        cosine.see((long double)(mean_positive_part(x, p, q)), sum / steps,
                   std::max({(long double)(std::abs(x)), a, b}));
      }
    }
  }
  table.add({"shade", "cosines over normals 0 to 1e7 wide", "integral in long double", cosine,
             "of the width", 1e-5});
}

inline void add_shade_extremes(ExtremesTable& table) {
  add_band_extremes(table);
  add_limit_extremes(table);
  add_blur_extremes(table);
  add_filter_extremes(table);
  add_known_frames(table);
  add_layers(table);
}

}  // namespace tessera
