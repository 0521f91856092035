#pragma once
/// Frames that several tests of reconstruction render, and what they look at.

#include <bit>

#include "tests/reconstruct/distribution_scene.h"

namespace tessera::test {

inline constexpr float inf = std::numeric_limits<float>::infinity();

inline float checks(float x, float y) { return (int(x) / 3 + int(y) / 3) % 2 ? 1.0f : 0.3f; }

inline void set(float (&channels)[3], float value) {
  for (float& channel : channels) channel = value;
}

/// The penumbra of a straight edge, `half_width` pixels to either side of `edge`, over checks.
inline void shade_penumbra(SceneSample& s, float edge, float half_width) {
  SceneSample::Ray& ray = s.rays[0];
  const bool lit = s.x + half_width * ray.y[0] < edge;
  set(s.base, 0.1f);
  set(ray.unblocked, checks(s.x, s.y));
  set(ray.received, lit ? checks(s.x, s.y) : 0.0f);
  ray.extent[0] = ray.extent[1] = 2 * half_width;
  if (!lit) ray.slope = 0.5f;
}
inline double penumbra_truth(int x, int y, double edge, double half_width) {
  return 0.1 + mean_ramp(edge - (x + 0.5), half_width) * checks(float(x), float(y));
}
inline DistributionFrame penumbra_frame(int width = 96, int height = 48) {
  DistributionFrame frame(width, height);
  frame.settings.features.shadow = true;
  frame.shade = [](SceneSample& s) { shade_penumbra(s, 48, 12); };
  return frame;
}

/// Everything at once: a penumbra and a bounce on surfaces that are out of focus and move.
inline DistributionFrame busy_frame(int width, int height) {
  DistributionFrame frame(width, height);
  frame.settings.features = {true, true, true, true};
  frame.settings.film.filter = "gaussian";
  frame.settings.film.filter_x_width = frame.settings.film.filter_y_width = 2;
  frame.shade = [](SceneSample& s) {
    shade_penumbra(s, 40, 6);
    s.coc[0] = s.coc[1] = 0.1f * s.y + 0.04f * s.x, s.velocity[0] = 0.2f * s.x, s.velocity[1] = 3;
    SceneSample::Ray& ray = s.rays[1];
    set(ray.unblocked, 0.5f);
    set(ray.received, 0.25f + 0.25f * std::sin(0.3f * (s.x + 8 * ray.y[0])));
    ray.slope = s.y < 10 ? std::numeric_limits<float>::quiet_NaN() : 1;
    ray.extent[0] = 8 + 0.05f * s.x, ray.extent[1] = 6;
    s.surface = s.x - 0.1f * s.y * s.u[0] < 50 ? 1 : 2;
    s.N[0] = s.surface == 2 ? 0.8f : 0.0f, s.N[2] = s.surface == 2 ? 0.6f : 1.0f;
  };
  return frame;
}

inline bool same_pixels(const Image& part, const Image& whole) {
  if (part.channels.size() != whole.channels.size()) return false;
  const PixelRect& r = part.data_window;
  for (size_t c = 0; c < part.channels.size(); ++c)
    for (int y = r.y0; y < r.y1; ++y)
      for (int x = r.x0; x < r.x1; ++x)
        if (std::bit_cast<uint32_t>(part.channels[c].values[part.index(x, y)]) !=
            std::bit_cast<uint32_t>(whole.channels[c].values[whole.index(x, y)]))
          return false;
  return true;
}

inline bool all_finite(const Image& image) {
  for (const Image::Channel& channel : image.channels)
    for (const float value : channel.values)
      if (!std::isfinite(value)) return false;
  return true;
}

inline double mean_of(const Image& image, size_t channel = 0) {
  double sum = 0;
  for (const float value : image.channels[channel].values) sum += value;
  return sum / double(image.channels[channel].values.size());
}

inline std::unique_ptr<ReconstructionMethod> gaussian(bool guarded = true) {
  return std::make_unique<GaussianMethod>(guarded);
}

}  // namespace tessera::test
