#include <catch2/catch.hpp>

#include "tests/reconstruct/distribution_scene.h"

using namespace tessera;
using namespace tessera::test;

namespace {

/// Samples with carried channels and more of them in some pixels.
struct CarryFrame {
  DistributionFrame frame{23, 17};
  static constexpr size_t carried = 7;

  CarryFrame() {
    frame.settings.film.bucket_size = 6;
    frame.settings.film.groups = {&rgb_group};
    frame.settings.film.filter = "gaussian";
    frame.settings.film.filter_x_width = 2, frame.settings.film.filter_y_width = 3;
    frame.settings.film.products = {{0, 2, 2, 5}, {3, 3, 1, 1}};
    frame.sample_count = [](int x, int y) { return (x + y) % 5 == 0 ? 11 : 3; };
    frame.samples_per_pixel = 3;
    frame.shade = [](SceneSample& s) { s.base[0] = s.u[0], s.base[1] = s.x; };
  }
  float channel(int x, int y, int k, size_t c) const {
    return frame.random(x, y, k, uint32_t(100 + c));
  }
  template <class Visit>
  void for_samples(const PixelRect& rect, Visit visit) const {
    for (int y = rect.y0; y < rect.y1; ++y)
      for (int x = rect.x0; x < rect.x1; ++x)
        for (int k = 0; k < frame.sample_count(x, y); ++k) visit(x, y, k);
  }
  SampleValues bucket(const PixelRect& rect) const {
    SampleValues values = frame.bucket(rect);
    for (size_t c = 0; c < carried; ++c)
      for_samples(rect,
                  [&](int x, int y, int k) { values.carried.push_back(channel(x, y, k, c)); });
    return values;
  }
  void fill(Film& film) const {
    const PixelRect all = frame.settings.film.crop;
    const int size = frame.settings.film.bucket_size;
    for (int j = 0; j * size < all.height(); ++j)
      for (int i = 0; i * size < all.width(); ++i)
        film.add_bucket(
            i, j,
            bucket(PixelRect{i * size, j * size, i * size + size, j * size + size}.intersect(all)));
  }
  /// The weighted mean of `value` at a pixel by the definition: each pixel's samples share a
  /// weight.
  template <class Value>
  double mean(int x, int y, Value value) const {
    long double sum = 0, weights = 0;
    for_samples(PixelRect{x - 3, y - 3, x + 4, y + 4}.intersect(frame.settings.film.crop),
                [&](int sx, int sy, int k) {
                  const SceneSample s = frame.sample(sx, sy, k);
                  const double dx = double(s.x) - (x + 0.5), dy = double(s.y) - (y + 0.5);
                  if (std::abs(dx) > 1 || std::abs(dy) > 1.5) return;
                  const double ry = dy / 1.5;
                  const double w = std::exp(-2 * (dx * dx + ry * ry)) / frame.sample_count(sx, sy);
                  weights += w, sum += w * value(sx, sy, k);
                });
    return double(sum / weights);
  }
};

}  // namespace

TEST_CASE("A pixel with more samples counts for no more than others", "[film]") {
  const CarryFrame carry;
  Film film(carry.frame.settings.film);
  carry.fill(film);
  const Image image = film.finish();
  for (int y = 0; y < 17; y += 2)
    for (int x = 0; x < 23; x += 3) {
      const double expected = carry.mean(
          x, y, [&](int sx, int sy, int k) { return double(carry.frame.sample(sx, sy, k).u[0]); });
      REQUIRE(image.channels[0].values[image.index(x, y)] == Approx(expected).margin(2e-5));
    }
}

TEST_CASE("Products are means of factor times value", "[film]") {
  CarryFrame carry;
  if (GENERATE(false, true)) carry.frame.sample_count = [](int, int) { return 3; };
  Film film(carry.frame.settings.film);
  carry.fill(film);
  const Image image = film.finish();
  const auto products = film.take_products();
  REQUIRE(products.size() == 2 * 5 + 3);
  for (int y = 0; y < 17; y += 3)
    for (int x = 0; x < 23; x += 4)
      for (size_t p = 0; p < products.size(); ++p) {
        const size_t factor = p < 10 ? p / 5 : 3 + (p - 10), value = p < 10 ? 2 + p % 5 : 1;
        const double expected = carry.mean(x, y, [&](int sx, int sy, int k) {
          return double(carry.channel(sx, sy, k, factor)) * carry.channel(sx, sy, k, value);
        });
        REQUIRE(products[p][image.index(x, y)] == Approx(expected).margin(2e-5));
      }
}

TEST_CASE("Bucket sizes change no product", "[film]") {
  CarryFrame carry;
  Film film(carry.frame.settings.film);
  carry.fill(film);
  film.finish();
  carry.frame.settings.film.bucket_size = 9;
  Film other(carry.frame.settings.film);
  carry.fill(other);
  other.finish();
  CHECK(film.take_products() == other.take_products());
}

TEST_CASE("Products of samples that are not finite are left out", "[film]") {
  CarryFrame carry;
  const PixelRect all = carry.frame.settings.film.crop;
  carry.frame.settings.film.bucket_size = 64;
  Film one_bucket(carry.frame.settings.film);
  SampleValues values = carry.bucket(all);
  values.carried[5] = std::numeric_limits<float>::infinity();
  for (size_t k = 200; k < 215; ++k) values.carried[values.x.size() * 3 + k] = 3e38f;
  for (size_t k = 200; k < 215; ++k) values.carried[values.x.size() * 1 + k] = 3e38f;
  one_bucket.add_bucket(0, 0, std::move(values));
  one_bucket.finish();
  CHECK(one_bucket.counters().nonfinite_samples_dropped == 1);
  for (const auto& plane : one_bucket.take_products())
    for (const float value : plane) REQUIRE(std::isfinite(value));
}
