#pragma once
/// The places where formulas break (docs and design call them the extremes): one list of cases, for
/// the tests and for the table of `tessera bench extremes`.

#include <functional>
#include <string>

#include "tests/hide/extreme_shapes.h"

namespace tessera {

/// A kind of trouble. make(k) gives variant k with its samples: `count` of them go through all
/// combinations the case has, and higher k through the same again with other random numbers.
struct ExtremeCase {
  std::string name;
  int count = 1;
  std::function<TestBucket(int)> make;
};

/// Every pattern of signs of W over 4 corners and 2 keys, and over 4 corners that stay, but those
/// of one sign; then the same through a lens.
inline constexpr int eye_plane_variants = 2 * (254 + 14);

/// `zero` puts corners at W = 0 instead of behind the eye.
inline TestBucket eye_plane_bucket(int k, bool zero) {
  CameraSettings settings = extreme_settings(90);
  if (k / 268 % 2) open_lens(settings, 0.3, 1.0);
  TestBucket bucket(settings);
  ExtremeRandom random(k);
  const bool moves = k % 268 < 254;
  const int pattern = 1 + (moves ? k % 268 : k % 268 - 254);
  QuadKeys keys;
  for (int key = 0; key < 1 + int(moves); ++key) {
    auto& corners = keys.emplace_back(square(random, 1.0f, 0.0f));
    for (int c = 0; c < 4; ++c) {
      const float depth = random.between(0.3f, 2.0f);
      const bool behind = pattern >> (4 * key + c) & 1;
      corners[size_t(c)].z = !behind ? depth : zero ? 0.0f : -depth;
      // The eye itself, once in a while.
      if (zero && behind && k % 5 == 0) corners[size_t(c)] = glm::vec3(0.0f);
    }
  }
  add_quad(bucket, keys);
  return sampled(std::move(bucket), k);
}

inline TestBucket frustum_side_bucket(int k) {
  CameraSettings settings = extreme_settings();
  if (k % 2) open_lens(settings, 0.1, 3.0);
  TestBucket bucket(settings);
  ExtremeRandom random(k);
  QuadKeys keys(k % 3 ? 2 : 1);
  // Corners up to ten times as far out as the view goes.
  for (auto& corners : keys)
    for (auto& p : corners) p = random.in_box({0, 0, 2.0f}, {12.0f, 9.0f, 1.5f});
  add_quad(bucket, keys);
  return sampled(std::move(bucket), k);
}

/// Equal corners, corners on a line, and all in one point, at one key or at all.
inline TestBucket zero_area_bucket(int k) {
  TestBucket bucket(extreme_settings());
  ExtremeRandom random(k);
  QuadKeys keys(k % 2 ? 2 : 1);
  for (size_t key = 0; key < keys.size(); ++key) {
    auto& p = keys[key] = square(random, 1.0f, 3.0f);
    if (key > 0 && k % 4 == 1) continue;
    switch (k / 4 % 6) {
      case 0:
        p[1] = p[0];
        break;
      case 1:
        p[3] = p[0];
        break;
      case 2:
        p[2] = p[3];
        break;
      case 3:
        p[1] = p[2] = p[3] = p[0];
        break;
      case 4:
        p[3] = 0.5f * (p[0] + p[1]);
        break;
      default:
        for (int c = 0; c < 4; ++c) p[size_t(c)] = glm::vec3(float(c) - 1.5f, 0.25f, 3.0f);
    }
  }
  add_quad(bucket, keys);
  return sampled(std::move(bucket), k);
}

/// Inside out, folded along an edge or the diagonal, and turned over between keys.
inline TestBucket folded_bucket(int k) {
  CameraSettings settings = extreme_settings();
  if (k % 2) open_lens(settings, 0.1, 2.5);
  TestBucket bucket(settings);
  ExtremeRandom random(k);
  QuadKeys keys(k % 3 ? 2 : 1);
  for (size_t key = 0; key < keys.size(); ++key) {
    auto& p = keys[key] = square(random, 1.0f, 3.0f);
    if (key == 1 && k % 3 == 2) continue;
    switch (k / 6 % 4) {
      case 0:
        std::swap(p[1], p[2]);
        break;
      case 1:
        std::swap(p[2], p[3]);
        break;
      case 2:
        std::swap(p[0], p[1]);
        break;
      default:
        p[3] = p[0] - 0.5f * (p[3] - p[0]);
    }
  }
  add_quad(bucket, keys);
  return sampled(std::move(bucket), k);
}

/// Half a turn about an axis between two keys: everything meets on the axis half way.
inline TestBucket half_turn_bucket(int k) {
  CameraSettings settings = extreme_settings();
  if (k % 2) open_lens(settings, 0.1, 2.5);
  TestBucket bucket(settings);
  ExtremeRandom random(k);
  const glm::vec3 centre(0, 0, 3);
  QuadKeys keys{square(random, 1.0f, 3.0f)};
  keys.push_back(keys[0]);
  const glm::vec3 turn = k / 2 % 3 == 0   ? glm::vec3(-1, -1, 1)
                         : k / 2 % 3 == 1 ? glm::vec3(-1, 1, -1)
                                          : glm::vec3(1, -1, -1);
  for (auto& p : keys[1]) p = centre + turn * (p - centre);
  add_quad(bucket, keys);
  return sampled(std::move(bucket), k);
}

/// A path of `pixels` over the shutter, in several directions; centred, so that it passes the view.
/// Half of the variants are a quarter as long themselves, to be seen at all when the path is long.
inline TestBucket motion_bucket(int k, double pixels) {
  CameraSettings settings = extreme_settings();
  if (k % 2) open_lens(settings, 0.1, 2.5);
  TestBucket bucket(settings);
  ExtremeRandom random(k);
  const double per_pixel = 3 / double(bucket.camera.raster_clip().x_scale), angle = k;
  const float half_size = k % 4 < 2 ? 1.0f : std::max(1.0f, float(0.25 * pixels * per_pixel));
  QuadKeys keys{square(random, half_size, 3.0f)};
  for (auto& p : keys[0]) p.z = 3.0f;
  keys[0][0] = {0, 0, 3};  // where a denormal shift is not lost
  keys.push_back(keys[0]);
  const glm::vec3 half(glm::dvec3(std::cos(angle), std::sin(angle), 0.0) * pixels * per_pixel /
                       2.0);
  for (auto& p : keys[0]) p -= half;
  for (auto& p : keys[1]) p += half;
  add_quad(bucket, keys);
  return sampled(std::move(bucket), k);
}

/// A slanted micropolygon through the plane of focus, so that its circle of confusion changes sign.
inline TestBucket focus_bucket(int k, float depth, float size, double lens_radius) {
  CameraSettings settings = extreme_settings();
  open_lens(settings, lens_radius, depth);
  TestBucket bucket(settings);
  ExtremeRandom random(k);
  QuadKeys keys(k % 2 ? 2 : 1);
  for (auto& corners : keys)
    for (int c = 0; c < 4; ++c)
      corners[size_t(c)] =
          glm::vec3(c % 2 ? 1 : -1, c / 2 ? 1 : -1, 0) * 0.7f +
          random.in_box({0, 0, depth + (c % 2 ? size : -size)}, glm::vec3(0.5f * size));
  add_quad(bucket, keys);
  return sampled(std::move(bucket), k);
}

/// Three random grids of a scene whose lengths are all of the order of `scale`.
inline TestBucket scaled_bucket(int k, float scale, double fov_degrees, float width) {
  CameraSettings settings = extreme_settings(fov_degrees);
  settings.near_clip = 1e-3 * double(scale);
  if (k % 2) open_lens(settings, 0.05 * double(width * scale), double(scale) * 1.2);
  TestBucket bucket(settings);
  ExtremeRandom random(k);
  const RandomOptions o{.motion = k % 4 < 2,
                        .reach = 0.2f * width * scale,
                        .depth_min = 0.8f * scale,
                        .depth_max = 1.5f * scale,
                        .speed = 0.2f * width * scale,
                        .grid_size = width * scale};
  for (int g = 0; g < 3; ++g) {
    auto grid = random_grid(random.generator(), o);
    // Wide views are wide, not deep: edge-on planes through the eye have cases of their own.
    for (int key = 0; key < grid->key_count(); ++key)
      for (int i = 0; i < grid->vertex_count(); ++i)
        grid->P(key, 2)[i] = scale + (grid->P(key, 2)[i] - scale) / std::max(1.0f, width);
    bucket.add(std::move(grid));
  }
  bucket.motion = o.motion;
  return sampled(std::move(bucket), k);
}

/// 2 to 7 keys at uneven times.
inline TestBucket many_keys_bucket(int k) {
  CameraSettings settings = extreme_settings();
  if (k % 2) open_lens(settings, 0.1, 2.5);
  TestBucket bucket(settings);
  ExtremeRandom random(k);
  const int count = 2 + k / 2 % 6;
  QuadKeys keys;
  std::vector<float> times;
  for (int key = 0; key < count; ++key) {
    keys.push_back(square(random, 0.5f, 3.0f));
    const glm::vec3 shift = random.in_box(glm::vec3(0.0f), glm::vec3(0.4f));
    for (auto& p : keys.back()) p += shift;
    const float share = float(key) / float(count - 1);
    times.push_back(k % 4 < 2 ? share * share * share : std::sqrt(share));
  }
  add_quad(bucket, keys, times);
  return sampled(std::move(bucket), k);
}

/// An image of width x 1 pixels, filled by grids twice as wide as the view.
inline TestBucket strip_bucket(int k, int width) {
  CameraSettings settings = perspective_settings(width, 1, 60);
  if (k % 2) open_lens(settings, 0.1, 2.5);
  TestBucket bucket(settings);
  ExtremeRandom random(k);
  QuadKeys keys{square(random, 1.0f, 3.0f)};
  keys.push_back(square(random, 1.0f, 3.0f));
  for (auto& corners : keys)
    for (auto& p : corners) p.x *= 2.0f * float(width);
  if (k % 4 < 2) keys.pop_back();
  add_quad(bucket, keys);
  bucket.make_samples({0, 0, width, 1}, width > 1 ? 1 : 16, uint32_t(k));
  return bucket;
}

/// Sizes, distances, speeds and apertures over many orders of magnitude, eyes among the grids.
inline TestBucket random_extreme_bucket(int k) {
  ExtremeRandom random(1000 + k);
  const float scale = random.log_between(1e-5f, 1e6f);
  CameraSettings settings = extreme_settings(double(random.log_between(0.1f, 170.0f)));
  settings.near_clip = double(scale) * double(random.log_between(1e-6f, 1e-1f));
  if (k % 2)
    open_lens(settings, double(scale * random.log_between(1e-3f, 10.0f)),
              double(scale * random.log_between(0.1f, 10.0f)));
  TestBucket bucket(settings);
  const RandomOptions o{.motion = k % 4 < 2,
                        .keys = 2 + k % 3,
                        .reach = scale * random.log_between(1e-3f, 1.0f),
                        .depth_min = scale * random.between(-1.0f, 1.0f),
                        .depth_max = scale * random.between(1.0f, 2.0f),
                        .speed = scale * random.log_between(1e-4f, 10.0f),
                        .roughness = random.log_between(1e-2f, 4.0f),
                        .grid_size = scale * random.log_between(1e-1f, 10.0f)};
  for (int g = 0; g < 2; ++g) bucket.add(random_grid(random.generator(), o));
  bucket.motion = o.motion;
  bucket.make_samples({13, 9, 19, 15}, 4, uint32_t(k));
  return bucket;
}

inline std::vector<ExtremeCase> extreme_cases() {
  std::vector<ExtremeCase> cases{
      {"eye_plane_all_signs", eye_plane_variants, [](int k) { return eye_plane_bucket(k, false); }},
      {"w_exactly_zero", eye_plane_variants, [](int k) { return eye_plane_bucket(k, true); }},
      {"frustum_sides", 60, frustum_side_bucket},
      {"zero_area", 48, zero_area_bucket},
      {"folded_inverted", 48, folded_bucket},
      {"half_turn", 18, half_turn_bucket},
      {"many_uneven_keys", 48, many_keys_bucket},
      {"focus_inside", 24, [](int k) { return focus_bucket(k, 4.5f, 2.0f, 0.5); }},
      {"lens_beyond_scene", 24, [](int k) { return focus_bucket(k, 4.5f, 1e-3f, 1e3); }}};
  const std::pair<const char*, double> paths[] = {
      {"0", 0}, {"denormal", 1e-39}, {"1em6", 1e-6}, {"1em3", 1e-3},
      {"1", 1}, {"1e2", 1e2},        {"1e3", 1e3},   {"1e5", 1e5}};
  for (const auto& [name, pixels] : paths)
    cases.push_back({std::string("motion_px_") + name, 12,
                     [pixels = pixels](int k) { return motion_bucket(k, pixels); }});
  const auto scaled = [&](const char* name, float scale, double fov, float width) {
    cases.push_back({name, 16, [=](int k) { return scaled_bucket(k, scale, fov, width); }});
  };
  scaled("fov_0_001_degrees", 1e4f, 0.001, 2e-5f);
  scaled("fov_179_degrees", 1, 179, 200);
  scaled("coordinates_1em6", 1e-6f, 60, 1);
  scaled("coordinates_1e7", 1e7f, 60, 1);
  cases.push_back({"image_1x1", 32, [](int k) { return strip_bucket(k, 1); }});
  cases.push_back({"image_16384x1", 4, [](int k) { return strip_bucket(k, 16384); }});
  cases.push_back({"random", 200, random_extreme_bucket});
  return cases;
}

}  // namespace tessera
