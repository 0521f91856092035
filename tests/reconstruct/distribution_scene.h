#pragma once
/// Made-up frames with distribution effects whose pixels have closed forms.

#include <algorithm>
#include <atomic>
#include <cmath>
#include <functional>
#include <limits>
#include <memory>
#include <numeric>
#include <random>
#include <thread>

#include "base/hash.h"
#include "reconstruct/reconstruction.h"

namespace tessera::test {

inline const AovDefinition rgb_group{"rgb", "", {"R", "G", "B"}, ChannelFilter::filtered, 0.0f};
inline const AovDefinition alpha_group{"a", "", {"A"}, ChannelFilter::filtered, 0.0f};
inline const AovDefinition depth_group{"z", "", {"Z"}, ChannelFilter::closest, 1e30f};
inline const AovDefinition direct_group{
    "direct", "", {"dR", "dG", "dB"}, ChannelFilter::filtered, 0.0f};
inline const AovDefinition indirect_group{
    "indirect", "", {"iR", "iG", "iB"}, ChannelFilter::filtered, 0.0f};

/// One sample as a scene makes it. Random numbers in [-1, 1] come in `y` of each effect, `u` and
/// `t`.
struct SceneSample {
  float x = 0, y = 0;  ///< raster
  struct Ray {
    float y[2] = {0, 0}, received[3] = {0, 0, 0}, unblocked[3] = {0, 0, 0}, extent[2] = {1, 1};
    float drawn[3] = {0, 0, 0};  ///< only of shadows, where DistributionFrame::has_drawn
    float slope = std::numeric_limits<float>::quiet_NaN();
  } rays[2];
  float u[2] = {0, 0}, t = 0;  ///< lens in [-1, 1], time in [0, 1]
  float coc[2] = {0, 0}, velocity[2] = {0, 0};
  float base[3] = {0, 0, 0}, N[3] = {0, 0, 1}, alpha = 1, z = 1;
  uint32_t surface = 1;
};

/// A Gaussian about half as wide as the blur that is sure: a plain method to test with.
class GaussianMethod : public ReconstructionMethod {
 public:
  explicit GaussianMethod(bool is_guarded = true, float width = 0.5f)
      : guarded_(is_guarded), width_(width) {}
  int basis_count() const override { return 1; }
  void basis(const BasisPoint&, float* out) const override { out[0] = 1; }
  int degree(int k) const override { return k; }
  int max_degree() const override { return 0; }
  int reach() const override { return 10; }
  bool guarded() const override { return guarded_; }
  void weights(const AxisWedge& wedge, float, float* out) const override {
    const float sigma = width_ * std::max({wedge.low, -wedge.high, 0.0f});
    float sum = 0;
    for (int d = -10; d <= 10; ++d) {
      const float z = float(d) / std::max(sigma, 1e-3f);
      sum += out[d + 10] = std::exp(-0.5f * z * z);
    }
    for (int d = 0; d <= 20; ++d) out[d] /= sum;
  }

 private:
  bool guarded_;
  float width_;
};

struct DistributionFrame {
  ReconstructionSettings settings;
  int samples_per_pixel = 4;
  uint32_t seed = 1;
  bool has_drawn = false;   ///< otherwise samples tell nothing of their own places
  bool stratified = false;  ///< first coordinates of a pixel's samples lie in strata of their own
  std::function<void(SceneSample&)> shade;  ///< fills the rest of a sample
  /// Samples of a pixel, where they differ from the others'.
  std::function<int(int x, int y)> sample_count;

  DistributionFrame(int width, int height) {
    settings.film.display_window = settings.film.crop = {0, 0, width, height};
    settings.film.groups = {&rgb_group, &alpha_group, &depth_group};
    settings.film.filter = "box";
    settings.film.filter_x_width = settings.film.filter_y_width = 1;
    settings.film.bucket_size = 16;
    settings.spreads.lens = 1;  // u and v are uniform over [-1, 1]
  }

  float random(int x, int y, int k, uint32_t salt) const {
    const uint32_t pixel = hash_combine(hash_combine(uint32_t(x), uint32_t(y)), uint32_t(k));
    return float(hash_combine(hash_combine(pixel, salt), seed) >> 8) * 0x1p-24f;
  }

  SceneSample sample(int x, int y, int k) const {
    SceneSample s;
    s.x = float(x) + random(x, y, k, 1), s.y = float(y) + random(x, y, k, 2);
    for (uint32_t a = 0; a < 2; ++a) {
      for (uint32_t e = 0; e < 2; ++e) s.rays[e].y[a] = 2 * random(x, y, k, 3 + 2 * e + a) - 1;
      s.u[a] = 2 * random(x, y, k, 7 + a) - 1;
    }
    s.t = random(x, y, k, 9);
    if (stratified) stratify(s, x, y, k);
    shade(s);
    return s;
  }

  void stratify(SceneSample& s, int x, int y, int k) const {
    const int n = samples_per_pixel, first = int(float(n) * random(x, y, 0, 20));
    const float stratum = float((k + first) % n) / float(n);
    for (auto& ray : s.rays) ray.y[0] = 2 * (stratum + 0.5f * (ray.y[0] + 1) / float(n)) - 1;
    s.u[0] = 2 * (stratum + 0.5f * (s.u[0] + 1) / float(n)) - 1;
    s.t = stratum + s.t / float(n);
  }

  SampleValues bucket(const PixelRect& rect) const;
  Image render(std::unique_ptr<ReconstructionMethod> method, uint32_t shuffle = 0, int threads = 1,
               FilmCounters* counters = nullptr) const;
};

inline void append(SampleValues& values, const SceneSample& s, const DistributionFeatures& has,
                   bool has_drawn) {
  values.x.push_back(s.x), values.y.push_back(s.y);
  DistributionSamples& d = values.distribution;
  const bool rays[2] = {has.shadow, has.bounce};
  for (size_t e = 0; e < 2; ++e) {
    if (!rays[e]) continue;
    for (size_t c = 0; c < 3; ++c) {
      d.effects[e].received[c].push_back(s.rays[e].received[c]);
      d.effects[e].unblocked[c].push_back(s.rays[e].unblocked[c]);
      if (e == 0 && has_drawn) d.effects[e].drawn[c].push_back(s.rays[e].drawn[c]);
    }
    for (size_t a = 0; a < 2; ++a) {
      d.effects[e].y[a].push_back(s.rays[e].y[a]);
      d.effects[e].extent[a].push_back(s.rays[e].extent[a]);
    }
    d.effects[e].slope.push_back(s.rays[e].slope);
  }
  for (size_t a = 0; a < 2; ++a) {
    if (has.lens) d.surfaces.coc[a].push_back(s.coc[a]);
    if (has.motion) d.surfaces.velocity[a].push_back(s.velocity[a]);
  }
  for (size_t a = 0; a < 3; ++a) d.surfaces.N[a].push_back(s.surface ? s.N[a] : 0.0f);
  d.surfaces.surface.push_back(s.surface);
  if (has.lens) d.u.push_back(s.u[0]), d.v.push_back(s.u[1]);
  if (has.motion) d.t.push_back(s.t);
}

inline SampleValues DistributionFrame::bucket(const PixelRect& rect) const {
  SampleValues values;
  values.rect = rect;
  values.samples_per_pixel = samples_per_pixel;
  std::vector<SceneSample> samples;
  for (int y = rect.y0; y < rect.y1; ++y)
    for (int x = rect.x0; x < rect.x1; ++x) {
      if (sample_count) values.first_of_pixel.push_back(uint32_t(samples.size()));
      const int count = sample_count ? sample_count(x, y) : samples_per_pixel;
      for (int k = 0; k < count; ++k) samples.push_back(sample(x, y, k));
    }
  if (sample_count) values.first_of_pixel.push_back(uint32_t(samples.size()));
  for (const SceneSample& s : samples) append(values, s, settings.features, has_drawn);
  const auto rgb_of = [&](const SceneSample& s, size_t c) {
    return s.base[c] + (settings.features.shadow ? s.rays[0].received[c] : 0.0f) +
           (settings.features.bounce ? s.rays[1].received[c] : 0.0f);
  };
  for (const AovDefinition* group : settings.film.groups) {
    std::vector<float>& out = values.groups.emplace_back();
    for (size_t c = 0; c < group->channels.size(); ++c)
      for (const SceneSample& s : samples) {
        const std::string_view name = group->name;
        out.push_back(name == "a" ? s.alpha : name == "z" ? s.z : rgb_of(s, c));
      }
  }
  return values;
}

inline Image DistributionFrame::render(std::unique_ptr<ReconstructionMethod> method,
                                       uint32_t shuffle, int threads,
                                       FilmCounters* counters) const {
  ReconstructionSettings s = settings;
  s.threads = threads;
  s.method = std::move(method);
  const auto reconstruction = make_reconstruction(s);
  const PixelRect all = s.film.sampled.empty() ? s.film.crop : s.film.sampled;
  const int size = s.film.bucket_size, columns = (all.width() + size - 1) / size;
  std::vector<int> order(size_t(columns * ((all.height() + size - 1) / size)));
  std::iota(order.begin(), order.end(), 0);
  if (shuffle) std::shuffle(order.begin(), order.end(), std::mt19937(shuffle));
  std::atomic<size_t> next{0};
  const auto work = [&] {
    for (size_t n; (n = next++) < order.size();) {
      const int i = order[n] % columns, j = order[n] / columns;
      const int x = all.x0 + i * size, y = all.y0 + j * size;
      reconstruction->add_bucket(i, j, bucket(PixelRect{x, y, x + size, y + size}.intersect(all)));
    }
  };
  std::vector<std::thread> pool;
  for (int t = 1; t < threads; ++t) pool.emplace_back(work);
  work();
  for (std::thread& thread : pool) thread.join();
  Image image = reconstruction->finish();
  if (counters) *counters = reconstruction->counters();
  return image;
}

/// Mean of clamp(position / half_width, -1, 1) / 2 + 1/2 over positions within half a pixel of
/// `centre`: what is lit of a pixel in the penumbra of a straight edge, or covered by an edge out
/// of focus. From the second integral of the step.
inline double mean_ramp(double centre, double half_width) {
  const auto integral = [&](double p) {
    if (p <= -half_width) return 0.0;
    if (p >= half_width) return p;
    return (p + half_width) * (p + half_width) / (4 * half_width);
  };
  return integral(centre + 0.5) - integral(centre - 0.5);
}

/// Root of the mean squared error of channel 0 over the pixels `margin` inside the frame.
inline double rms_error(const Image& image, const std::function<double(int x, int y)>& truth) {
  double sum = 0;
  for (int y = image.data_window.y0; y < image.data_window.y1; ++y)
    for (int x = image.data_window.x0; x < image.data_window.x1; ++x) {
      const double e = double(image.channels[0].values[image.index(x, y)]) - truth(x, y);
      sum += e * e;
    }
  return std::sqrt(sum / double(image.data_window.pixel_count()));
}

}  // namespace tessera::test
