/// What the box of shading_extents() promises, against the spectra of the blur kernels themselves:
/// lens, shutter and pixel filter, drawn on a plane as samples fall and transformed.
///
/// The band limits hold a share s of the energy of each factor alone. The other factors weigh what
/// lies within a limit more than what lies beyond, because they fall with frequency but for their
/// side lobes, so the product holds at least s within the disc of radius r and at least s within
/// the bands of the shutter. Outside the box lies no more than what either leaves out: at least
/// 2 s - 1 is within. With an open lens it is s in all of these cases.

#include <catch2/catch.hpp>

#include <string>

#include "cameras/camera.h"
#include "reconstruct/pixel_filter.h"
#include "shade/blur_bounds.h"
#include "shade/shading_extents.h"
#include "tests/cameras/fourier.h"
#include "tests/hide/hide_fixture.h"

using namespace tessera;
using namespace tessera::test;

namespace {

/// 1/2 pixel a point, 256 pixels across: frequencies up to 1, beyond which the filters let hardly
/// anything through, in steps of 1/256.
constexpr size_t count = 512;
constexpr double period = 256.0, spacing = period / double(count);

struct Kernel {
  const LensProfile* lens = nullptr;
  const ShutterProfile* shutter = nullptr;
  const PixelFilterDefinition* filter = nullptr;
  glm::dvec2 velocity{0.0};  ///< pixels per shutter
  double coc = 0.0;          ///< pixels per unit lens coordinate
};

/// Adds the filter (widths 2) about `p`, in points of the plane.
void add_filter(const PixelFilterDefinition& filter, glm::dvec2 p, std::vector<Complex>& plane) {
  constexpr int reach = int(1.0 / spacing);
  const glm::dvec2 first = glm::ceil(p) - double(reach);
  double x_weights[2 * reach], y_weights[2 * reach];
  for (int i = 0; i < 2 * reach; ++i) {
    x_weights[i] = filter.weight((first.x + i - p.x) * spacing, 2.0);
    y_weights[i] = filter.weight((first.y + i - p.y) * spacing, 2.0);
  }
  for (int j = 0; j < 2 * reach; ++j)
    for (int i = 0; i < 2 * reach; ++i)
      plane[size_t(first.y + j) * count + size_t(first.x + i)] += x_weights[i] * y_weights[j];
}

/// Spectrum of lens * shutter * filter, the first two drawn from their own samples.
PowerSpectrum spectrum_of(const Kernel& kernel) {
  const int lens_side = kernel.coc > 0.0 ? 24 : 1;
  const int times = glm::length(kernel.velocity) > 0.0 ? 256 : 1;
  std::vector<glm::dvec2> on_lens;
  for (int j = 0; j < lens_side; ++j)
    for (int i = 0; i < lens_side; ++i)
      on_lens.emplace_back(
          kernel.lens->sample((float(i) + 0.5f) / lens_side, (float(j) + 0.5f) / lens_side));
  std::vector<Complex> plane(count * count);
  for (int k = 0; k < times; ++k) {
    const double t = kernel.shutter->sample((float(k) + 0.5f) / times) - 0.5;
    for (const glm::dvec2& l : on_lens) {
      const glm::dvec2 pixel = kernel.velocity * t + kernel.coc * l + period / 2;
      add_filter(*kernel.filter, pixel / spacing, plane);
    }
  }
  return PowerSpectrum(count, period, std::move(plane));
}

double share_of_box(const PowerSpectrum& spectrum, const ShadingExtents& box) {
  const glm::dvec2 along(box.direction), across(-along.y, along.x);
  return spectrum.share([&](double x, double y) {
    const glm::dvec2 f(x, y);
    return bin_within(std::abs(glm::dot(f, along)), 0.5 * box.d_mu, 1 / period) *
           bin_within(std::abs(glm::dot(f, across)), 0.5 * box.d_perp, 1 / period);
  });
}

/// Not cut at half a cycle per pixel, as a renderer would: the promise is about the kernels.
BandLimits limits_of(const Kernel& kernel, double share) {
  return {kernel.lens->band_limit(share), kernel.shutter->band_limit(share),
          pixel_filter_band_limit(*kernel.filter, 2, 2, share)};
}

BlurBounds bounds_of(const Kernel& kernel) {
  BlurBounds bounds;
  bounds.min_speed = float(glm::length(kernel.velocity));
  if (bounds.min_speed > 0) bounds.direction = glm::vec2(glm::normalize(kernel.velocity));
  bounds.min_coc = float(kernel.coc);
  return bounds;
}

constexpr double shares[] = {0.8, 0.9, 0.95, 0.99};

}  // namespace

TEST_CASE("the box of a moving, defocused point holds the share that was asked for") {
  struct Blur {
    const char *lens, *shutter, *filter;
    glm::dvec2 velocity;
    double coc;
  };
  for (const Blur& blur : {Blur{"disc", "box", "gaussian", {12, 5}, 4},
                           Blur{"smooth", "gaussian", "gaussian", {-20, 30}, 8},
                           Blur{"polygon", "trapezoid", "mitchell", {3, -2}, 6},
                           Blur{"disc", "trapezoid", "blackman-harris", {0, 9}, 1},
                           Blur{"disc", "box", "gaussian", {30, 10}, 0},
                           Blur{"polygon", "box", "triangle", {0, 0}, 5}}) {
    const auto lens = make_lens_profile(blur.lens, 6, 10.0);
    const auto shutter = make_shutter_profile(blur.shutter);
    const Kernel kernel{lens.get(), shutter.get(), &find_pixel_filter(blur.filter), blur.velocity,
                        blur.coc};
    const PowerSpectrum spectrum = spectrum_of(kernel);
    for (double share : shares) {
      INFO(blur.lens << " " << blur.shutter << " " << blur.filter << " velocity " << blur.velocity.x
                     << " " << blur.velocity.y << " coc " << blur.coc << ": " << share);
      const BandLimits limits = limits_of(kernel, share);
      const ShadingExtents box = shading_extents(bounds_of(kernel), limits);
      // Bins of 1/256 cycle, against bands of 1/50.
      const double least = share - 4e-3, both = 2 * share - 1 - 4e-3;
      const double band = limits.shutter / std::max(glm::length(blur.velocity), 1e-9);
      CHECK(spectrum.share_of_disc(0.5 * box.d_perp) >= least);
      CHECK(spectrum.share([&](double x, double y) {
        const double along = glm::dot(glm::dvec2(x, y), glm::dvec2(box.direction));
        return bin_within(std::abs(along), band, 1 / period);
      }) >= least);
      CHECK(share_of_box(spectrum, box) >= (blur.coc > 0.0 ? least : both));
    }
  }
}

TEST_CASE("the box of a grid holds the share of each of its vertices") {
  CameraSettings settings = perspective_settings(640, 480, 50);
  settings.lens = CameraSettings::ThinLens{1.0, 0.12, 4.0};
  settings.shutter_profile = "trapezoid";
  const Camera camera(settings);
  const Kernel profiles{
      &camera.lens_profile(), &camera.shutter_profile(), &find_pixel_filter("gaussian"), {}, 0};
  const float pixels = std::abs(camera.raster_clip().x_scale) / 6.0f;
  // At depth 6, moving 20 pixels and turning: directions over an arc; and from depth 6 to 5.
  for (float spread : {0.1f, 0.4f, 0.9f}) {
    for (float approach : {0.0f, 1.0f}) {
      const auto grid = make_grid(2, 2, {0, 1}, [&](float u, float v, int key) {
        const float angle = 0.5f + spread * (v - 0.5f);
        const glm::vec3 way(std::cos(angle), std::sin(angle), 0);
        return glm::vec3(0.1f * u, 0.1f * v, 6) +
               float(key) * ((20.0f + 8.0f * u) / pixels * way - approach * glm::vec3(0, 0, 1));
      });
      const BlurBounds bounds = blur_bounds(*grid, camera, true, true);
      REQUIRE(bounds.min_speed > 0.0f);
      REQUIRE(bounds.half_span_radians >= 0.5f * spread - 0.1f);
      for (int vertex : {0, 8}) {
        Kernel kernel = profiles;
        const auto raster = [&](int key) {
          const glm::vec3 clip = camera.raster_clip_from_camera(
              {grid->P(key, 0)[vertex], grid->P(key, 1)[vertex], grid->P(key, 2)[vertex]});
          return glm::dvec2(clip) / double(clip.z);
        };
        kernel.velocity = raster(1) - raster(0);
        kernel.coc = std::abs(camera.coc_raster(grid->P(0, 2)[vertex]).x);
        const PowerSpectrum spectrum = spectrum_of(kernel);
        for (double share : shares) {
          INFO("spread " << spread << " approach " << approach << " vertex " << vertex << ": "
                         << share);
          const ShadingExtents box = shading_extents(bounds, limits_of(profiles, share));
          CHECK(share_of_box(spectrum, box) >= share);
          // What the spread of directions is for.
          BlurBounds straight = bounds;
          straight.half_span_radians = 0;
          const ShadingExtents narrow = shading_extents(straight, limits_of(profiles, share));
          if (spread > 0.5f && share < 0.99) CHECK(share_of_box(spectrum, narrow) < share);
        }
      }
    }
  }
}
