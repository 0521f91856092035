#include "images/perceptual.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "base/error.h"

namespace tessera {
namespace {

/// Bands of spatial frequency, an octave each, and the levels of blur that they lie between.
constexpr int bands = 6, levels = bands + 2;
constexpr float least_luminance = 1e-5f;  // cd/m^2: total darkness

using Plane = std::vector<float>;
using Color = std::array<float, 3>;

bool same(float a, float b) { return a == b || (std::isnan(a) && std::isnan(b)); }

Color xyz_of_linear_srgb(const Color& c) {
  return {0.4124f * c[0] + 0.3576f * c[1] + 0.1805f * c[2],
          0.2126f * c[0] + 0.7152f * c[1] + 0.0722f * c[2],
          0.0193f * c[0] + 0.1192f * c[1] + 0.9505f * c[2]};
}

/// CIE 1976, for the white of xyz_of_linear_srgb(1, 1, 1).
std::array<float, 2> ab_of_xyz(const Color& xyz) {
  const Color white = xyz_of_linear_srgb({1, 1, 1});
  Color f;
  for (size_t i = 0; i < 3; ++i) {
    const float r = xyz[i] / white[i];
    f[i] = r > 216.0f / 24389.0f ? std::cbrt(r) : (24389.0f / 27.0f * r + 16.0f) / 116.0f;
  }
  return {500.0f * (f[0] - f[1]), 200.0f * (f[1] - f[2])};
}

/// What the metric sees of an image.
struct Seen {
  Plane luminance;                       // cd/m^2
  std::vector<std::array<float, 2>> ab;  // CIELAB
};

std::array<const Plane*, 3> colors_of(const Image& image) {
  std::array<const Plane*, 3> result{};
  constexpr const char* names[] = {"R", "G", "B"};
  for (size_t c = 0; c < 3; ++c) {
    const Image::Channel* channel = image.find_channel(names[c]);
    if (!channel)
      throw Error(
          fmt::format("visible differences are those of R, G and B; an image lacks {}", names[c]));
    result[c] = &channel->values;
  }
  return result;
}

/// Two images seen. Where either is not finite both are black: a blur would spread the value.
struct SeenPair {
  Seen a, b;
  size_t nonfinite_mismatches = 0;  ///< pixels

  SeenPair(const Image& image_a, const Image& image_b, float white_cd_per_m2) {
    const auto from_a = colors_of(image_a), from_b = colors_of(image_b);
    for (size_t i = 0; i < from_a[0]->size(); ++i) {
      Color color_a, color_b;
      bool finite = true, equal = true;
      for (size_t c = 0; c < 3; ++c) {
        color_a[c] = (*from_a[c])[i], color_b[c] = (*from_b[c])[i];
        finite = finite && std::isfinite(color_a[c]) && std::isfinite(color_b[c]);
        equal = equal && same(color_a[c], color_b[c]);
      }
      nonfinite_mismatches += !finite && !equal;
      if (!finite) color_a = color_b = Color{};
      add(color_a, white_cd_per_m2, a);
      add(color_b, white_cd_per_m2, b);
    }
  }

 private:
  static void add(Color color, float white_cd_per_m2, Seen& seen) {
    for (float& value : color) value = std::max(value, 0.0f);
    const Color xyz = xyz_of_linear_srgb(color);
    seen.luminance.push_back(white_cd_per_m2 * xyz[1]);
    seen.ab.push_back(ab_of_xyz(xyz));
  }
};

/// One direction of a blur by the 5-tap kernel of Burt and Adelson, "The Laplacian Pyramid as a
/// Compact Image Code" (1983), its taps `step` pixels apart. Borders are continued.
void blur_lines(const Plane& in, int lines, int length, size_t line_stride, size_t stride, int step,
                Plane& out) {
  constexpr float taps[] = {0.05f, 0.25f, 0.4f, 0.25f, 0.05f};
  for (int line = 0; line < lines; ++line)
    for (int i = 0; i < length; ++i) {
      float sum = 0;
      for (int k = 0; k < 5; ++k) {
        const int from = std::clamp(i + (k - 2) * step, 0, length - 1);
        sum += taps[k] * in[size_t(line) * line_stride + size_t(from) * stride];
      }
      out[size_t(line) * line_stride + size_t(i) * stride] = sum;
    }
}

using Pyramid = std::array<Plane, levels>;

/// The plane, and blurs of it by twice as much each, all at full resolution.
Pyramid pyramid_of(Plane plane, int width, int height) {
  Pyramid result;
  result[0] = std::move(plane);
  Plane across(result[0].size());
  for (size_t k = 1; k < levels; ++k) {
    result[k].resize(across.size());
    blur_lines(result[k - 1], height, width, size_t(width), 1, 1 << (k - 1), across);
    blur_lines(across, width, height, 1, size_t(width), 1 << (k - 1), result[k]);
  }
  return result;
}

/// 1 / contrast that is just seen, by frequency and luminance of adaptation (Barten).
float contrast_sensitivity(float cycles_per_degree, float cd_per_m2) {
  const float a = 440.0f * std::pow(1.0f + 0.7f / cd_per_m2, -0.2f);
  const float b = 0.3f * std::pow(1.0f + 100.0f / cd_per_m2, 0.15f);
  const float f = cycles_per_degree;
  return a * f * std::exp(-b * f) * std::sqrt(1.0f + 0.06f * std::exp(b * f));
}

/// By how much contrast, in multiples of what is just seen, raises the threshold (Daly).
float masking(float contrast) {
  const float a = std::pow(392.498f * contrast, 0.7f);
  return std::pow(1.0f + std::pow(0.0153f * a, 4.0f), 0.25f);
}

/// Difference that is just seen, cd/m^2, by luminance of adaptation (Ward Larson et al.).
float threshold_cd_per_m2(float adaptation_cd_per_m2) {
  const float x = std::log10(adaptation_cd_per_m2);
  if (x < -3.94f) return std::pow(10.0f, -2.86f);
  if (x < -1.44f) return std::pow(10.0f, std::pow(0.405f * x + 1.6f, 2.18f) - 2.86f);
  if (x < -0.0184f) return std::pow(10.0f, x - 0.395f);
  if (x < 1.9f) return std::pow(10.0f, std::pow(0.249f * x + 0.65f, 2.7f) - 0.72f);
  return std::pow(10.0f, x - 1.255f);
}

class Viewer {
 public:
  Viewer(int width, float width_degrees) {
    constexpr float degrees = 180.0f / std::numbers::pi_v<float>;
    const float pixels_per_degree =
        float(width) / (2.0f * std::tan(0.5f * width_degrees / degrees) * degrees);
    // What the eye adapts to: the level whose blur is about a degree wide.
    while (adaptation_level_ < levels - 1 && float(1 << adaptation_level_) < pixels_per_degree)
      ++adaptation_level_;
    // The finest band ends at half a cycle a pixel. Sensitivity is greatest at 3.248 cycles.
    const float best = contrast_sensitivity(3.248f, 100.0f);
    for (int i = 0; i < bands; ++i) {
      frequency_[i] = 0.5f * pixels_per_degree / float(1 << i);
      insensitivity_[i] = best / contrast_sensitivity(frequency_[i], 100.0f);
    }
  }

  bool sees(const SeenPair& pair, const Pyramid& a, const Pyramid& b, size_t i) const {
    const size_t level = size_t(adaptation_level_);
    const float adaptation = std::max(0.5f * (a[level][i] + b[level][i]), least_luminance);
    const float elevation = elevation_of(a, b, i, adaptation);
    if (std::abs(a[0][i] - b[0][i]) > elevation * threshold_cd_per_m2(adaptation)) return true;
    const float da = pair.a.ab[i][0] - pair.b.ab[i][0], db = pair.a.ab[i][1] - pair.b.ab[i][1];
    // In dim light colours are less told apart.
    const float color_scale = adaptation < 10.0f ? 0.01f : 1.0f;
    return color_scale * (da * da + db * db) > elevation;
  }

 private:
  /// What thresholds are multiplied by at pixel i: the mean over the bands, by their contrast.
  float elevation_of(const Pyramid& a, const Pyramid& b, size_t i, float adaptation) const {
    float sum = 0, weights = 0;
    for (size_t k = 0; k < bands; ++k) {
      const float band = std::max(std::abs(a[k][i] - a[k + 1][i]), std::abs(b[k][i] - b[k + 1][i]));
      const float mean = std::max({a[k + 2][i], b[k + 2][i], least_luminance});
      const float contrast = band / mean;
      sum += contrast * insensitivity_[k] *
             masking(contrast * contrast_sensitivity(frequency_[k], adaptation));
      weights += contrast;
    }
    return weights > 1e-5f ? std::clamp(sum / weights, 1.0f, 10.0f) : 1.0f;
  }

  int adaptation_level_ = 0;
  std::array<float, bands> frequency_{};      // cycles per degree
  std::array<float, bands> insensitivity_{};  // multiples of the least contrast that is seen
};

}  // namespace

bool have_colors(const Image& a, const Image& b) {
  return std::ranges::all_of(std::array{"R", "G", "B"}, [&](const char* name) {
    return a.find_channel(name) && b.find_channel(name);
  });
}

double visible_share(const Image& image_a, const Image& image_b, const ViewingConditions& viewing) {
  if (!(image_a.data_window == image_b.data_window) || image_a.data_window.empty())
    throw Error("visible differences need two images of the same pixels");
  SeenPair pair(image_a, image_b, viewing.white_cd_per_m2);
  const int width = image_a.width(), height = image_a.height();
  const Pyramid a = pyramid_of(std::move(pair.a.luminance), width, height);
  const Pyramid b = pyramid_of(std::move(pair.b.luminance), width, height);
  const Viewer viewer(width, viewing.width_degrees);
  size_t seen = pair.nonfinite_mismatches;
  for (size_t i = 0; i < a[0].size(); ++i) seen += viewer.sees(pair, a, b, i);
  return double(seen) / double(a[0].size());
}

}  // namespace tessera
