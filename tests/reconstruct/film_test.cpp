#include <catch2/catch.hpp>

#include <atomic>
#include <bit>
#include <cmath>
#include <limits>
#include <random>
#include <thread>

#include "base/error.h"
#include "base/hash.h"
#include "reconstruct/pixel_filter.h"
#include "reconstruct/reconstruct.h"

using namespace tessera;

namespace {

const AovDefinition rgb{"rgb", "", {"R", "G", "B"}, ChannelFilter::filtered, 0.0f};
const AovDefinition alpha{"a", "", {"A"}, ChannelFilter::filtered, 0.0f};
const AovDefinition depth{"z", "", {"Z"}, ChannelFilter::closest, 1e30f};
const AovDefinition id{"id", "", {"id"}, ChannelFilter::closest, -1.0f};

/// A number in [0, 1) that depends on the sample alone, whatever bucket it comes in.
float random_of(int x, int y, int k, uint32_t salt) {
  const uint32_t pixel = hash_combine(hash_combine(uint32_t(x), uint32_t(y)), uint32_t(k));
  return float(hash_combine(pixel, salt) >> 8) * 0x1p-24f;
}

struct Frame {
  FilmSettings settings;
  int samples_per_pixel = 5;
  /// Value of a channel at sample k of pixel (x, y); replaceable.
  std::function<float(size_t group, size_t channel, int x, int y, int k)> value =
      [](size_t group, size_t channel, int x, int y, int k) {
        return random_of(x, y, k, uint32_t(10 + 4 * group + channel));
      };

  explicit Frame(const PixelRect& crop) {
    settings.display_window = {0, 0, 100, 100};
    settings.crop = crop;
    settings.groups = {&rgb, &alpha, &depth, &id};
  }

  int columns() const { return (settings.crop.width() - 1) / settings.bucket_size + 1; }
  int rows() const { return (settings.crop.height() - 1) / settings.bucket_size + 1; }

  static float sample_x(int x, int y, int k) { return float(x) + random_of(x, y, k, 1); }
  static float sample_y(int x, int y, int k) { return float(y) + random_of(x, y, k, 2); }

  SampleValues bucket(int i, int j) const {
    const int size = settings.bucket_size;
    const int x0 = settings.crop.x0 + i * size, y0 = settings.crop.y0 + j * size;
    SampleValues values;
    values.rect = PixelRect{x0, y0, x0 + size, y0 + size}.intersect(settings.crop);
    values.samples_per_pixel = samples_per_pixel;
    for_samples(values.rect, [&](int x, int y, int k) {
      values.x.push_back(sample_x(x, y, k));
      values.y.push_back(sample_y(x, y, k));
    });
    for (size_t g = 0; g < settings.groups.size(); ++g) {
      values.groups.emplace_back();
      for (size_t c = 0; c < settings.groups[g]->channels.size(); ++c)
        for_samples(values.rect,
                    [&](int x, int y, int k) { values.groups[g].push_back(value(g, c, x, y, k)); });
    }
    return values;
  }

  template <class Visit>
  void for_samples(const PixelRect& rect, Visit visit) const {
    for (int y = rect.y0; y < rect.y1; ++y)
      for (int x = rect.x0; x < rect.x1; ++x)
        for (int k = 0; k < samples_per_pixel; ++k) visit(x, y, k);
  }

  /// All buckets, in a shuffled order, from `threads` threads.
  Image render(uint32_t seed = 0, int threads = 1, FilmCounters* counters = nullptr) const {
    std::vector<int> order;
    for (int b = 0; b < columns() * rows(); ++b) order.push_back(b);
    if (seed != 0) std::shuffle(order.begin(), order.end(), std::mt19937(seed));
    Film film(settings);
    std::atomic<size_t> next{0};
    const auto work = [&] {
      for (size_t n; (n = next++) < order.size();) {
        const int i = order[n] % columns(), j = order[n] / columns();
        film.add_bucket(i, j, bucket(i, j));
      }
    };
    std::vector<std::thread> pool;
    for (int t = 1; t < threads; ++t) pool.emplace_back(work);
    work();
    for (auto& thread : pool) thread.join();
    Image image = film.finish();
    if (counters) *counters = film.counters();
    return image;
  }

  /// The filtered channel of pixel (x, y) by the definition, in long double, over all samples of
  /// the crop.
  double oracle(size_t group, size_t channel, int x, int y) const {
    const auto& filter = find_pixel_filter(settings.filter);
    const double x_width = settings.filter_x_width, y_width = settings.filter_y_width;
    long double sum = 0, weights = 0;
    for_samples(settings.crop, [&](int sx, int sy, int k) {
      const double dx = sample_x(sx, sy, k) - (x + 0.5), dy = sample_y(sx, sy, k) - (y + 0.5);
      if (std::abs(dx) > x_width / 2 || std::abs(dy) > y_width / 2) return;
      const long double w = (long double)(filter.weight(dx, x_width)) * filter.weight(dy, y_width);
      weights += w;
      sum += w * value(group, channel, sx, sy, k);
    });
    return double(sum / weights);
  }
};

bool same_bits(const Image& a, const Image& b) {
  if (a.channels.size() != b.channels.size()) return false;
  for (size_t c = 0; c < a.channels.size(); ++c) {
    const auto &va = a.channels[c].values, &vb = b.channels[c].values;
    if (a.channels[c].name != b.channels[c].name || va.size() != vb.size()) return false;
    for (size_t i = 0; i < va.size(); ++i)
      if (std::bit_cast<uint32_t>(va[i]) != std::bit_cast<uint32_t>(vb[i])) return false;
  }
  return true;
}

float at(const Image& image, const char* channel, int x, int y) {
  return image.find_channel(channel)->values[image.index(x, y)];
}

}  // namespace

TEST_CASE("pixels are the weighted means of the samples under the filter") {
  Frame frame({11, 7, 35, 26});
  frame.settings.bucket_size = 8;
  for (const auto& filter : pixel_filter_registry()) {
    for (auto [x_width, y_width] : {std::pair{2.0f, 2.0f}, std::pair{4.0f, 3.0f}}) {
      frame.settings.filter = filter.name;
      frame.settings.filter_x_width = x_width, frame.settings.filter_y_width = y_width;
      const Image image = frame.render();
      INFO(filter.name << " " << x_width << " x " << y_width);
      CHECK(image.data_window == frame.settings.crop);
      double worst = 0.0;
      for (int y = 7; y < 26; ++y)
        for (int x = 11; x < 35; ++x)
          for (size_t c = 0; c < 3; ++c)
            worst = std::max(worst, std::abs(double(at(image, rgb.channels[c].c_str(), x, y)) -
                                             frame.oracle(0, c, x, y)));
      // Float weights, from a table. Lobes leave a smaller sum to divide by at the corners.
      CHECK(worst < 5e-5);
    }
  }
}

TEST_CASE("the image is the same for any bucket size, order and number of threads") {
  Frame frame({3, 2, 40, 31});
  for (const char* filter : {"gaussian", "catmull-rom", "box"}) {
    frame.settings.filter = filter;
    frame.settings.filter_x_width = 4, frame.settings.filter_y_width = 2.5f;
    frame.settings.bucket_size = 64;
    const Image whole = frame.render();
    for (int size : {1, 2, 7, 16, 32}) {
      frame.settings.bucket_size = size;
      INFO(filter << " buckets of " << size);
      CHECK(same_bits(frame.render(), whole));
      for (uint32_t seed : {1u, 2u}) CHECK(same_bits(frame.render(seed), whole));
      for (int threads : {2, 4}) CHECK(same_bits(frame.render(3, threads), whole));
    }
  }
}

TEST_CASE("a constant stays constant up to the edges of the frame") {
  Frame frame({0, 0, 20, 20});
  frame.settings.bucket_size = 7;
  frame.value = [](auto...) { return 0.7f; };
  for (const auto& filter : pixel_filter_registry()) {
    frame.settings.filter = filter.name;
    frame.settings.filter_x_width = frame.settings.filter_y_width = 4;
    INFO(filter.name);
    const Image image = frame.render();
    for (float value : image.find_channel("G")->values)
      REQUIRE(value == Approx(0.7f).epsilon(1e-5));
  }
}

TEST_CASE("channels that must not be averaged come from the nearest sample of the pixel") {
  Frame frame({0, 0, 19, 13});
  frame.settings.bucket_size = 4;
  const Image image = frame.render();
  for (int y = 0; y < 13; ++y) {
    for (int x = 0; x < 19; ++x) {
      int nearest = 0;
      for (int k = 1; k < frame.samples_per_pixel; ++k)
        if (frame.value(2, 0, x, y, k) < frame.value(2, 0, x, y, nearest)) nearest = k;
      REQUIRE(at(image, "Z", x, y) == frame.value(2, 0, x, y, nearest));
      REQUIRE(at(image, "id", x, y) == frame.value(3, 0, x, y, nearest));
    }
  }
}

TEST_CASE("samples that are not finite are dropped and counted, and harm no pixel") {
  const float inf = std::numeric_limits<float>::infinity();
  for (float bad : {std::nanf(""), inf, -inf}) {
    Frame frame({0, 0, 16, 16});
    frame.settings.bucket_size = 5;
    const auto good = frame.value;
    // One sample of four pixels, and all samples of a fifth.
    const auto is_bad = [](int x, int y, int k) {
      return (x % 8 == 4 && y % 8 == 4 && k == 2) || (x == 9 && y == 2);
    };
    frame.value = [&](size_t g, size_t c, int x, int y, int k) {
      return g == 0 && c == 1 && is_bad(x, y, k) ? bad : good(g, c, x, y, k);
    };
    FilmCounters counters;
    const Image image = frame.render(0, 1, &counters);
    CHECK(counters.nonfinite_samples_dropped == 4 + 5);
    for (const auto& channel : image.channels)
      for (float value : channel.values) REQUIRE(std::isfinite(value));
    // The others count as if the dropped ones had never been.
    long double sum = 0, weights = 0;
    frame.for_samples({2, 2, 7, 7}, [&](int x, int y, int k) {
      if (is_bad(x, y, k)) return;
      const double dx = Frame::sample_x(x, y, k) - 4.5, dy = Frame::sample_y(x, y, k) - 4.5;
      if (std::abs(dx) > 1 || std::abs(dy) > 1) return;
      const double w = std::exp(-2 * (dx * dx + dy * dy));
      weights += w, sum += w * good(0, 0, x, y, k);
    });
    CHECK(at(image, "R", 4, 4) == Approx(double(sum / weights)).epsilon(1e-5));
  }
}

TEST_CASE("a depth or id that is not finite never reaches a pixel") {
  Frame frame({0, 0, 8, 8});
  const auto good = frame.value;
  frame.value = [&](size_t g, size_t c, int x, int y, int k) {
    return g == 2 && k == 0 ? std::nanf("") : good(g, c, x, y, k);
  };
  const Image image = frame.render();
  for (float value : image.find_channel("Z")->values) REQUIRE(std::isfinite(value));
}

TEST_CASE("values of 1e30 keep their precision") {
  Frame frame({0, 0, 12, 12});
  frame.settings.bucket_size = 5;
  const auto unit = frame.value;
  const Image small = frame.render();
  frame.value = [&](size_t g, size_t c, int x, int y, int k) {
    return 1e30f * unit(g, c, x, y, k);
  };
  const Image large = frame.render();
  for (size_t i = 0; i < small.channels[0].values.size(); ++i)
    CHECK(large.channels[0].values[i] / 1e30f == Approx(small.channels[0].values[i]).epsilon(1e-6));
}

TEST_CASE("a frame cut short shows the buckets that arrived") {
  Frame frame({0, 0, 30, 20});
  frame.settings.bucket_size = 10;
  Film film(frame.settings);
  film.add_bucket(0, 0, frame.bucket(0, 0));
  film.add_bucket(2, 1, frame.bucket(2, 1));
  const Image cut = film.finish(), whole = frame.render();
  for (int y = 0; y < 20; ++y) {
    for (int x = 0; x < 30; ++x) {
      INFO(x << " " << y);
      const bool arrived = (x < 10 && y < 10) || (x >= 20 && y >= 10);
      if (!arrived) {
        CHECK(at(cut, "R", x, y) == 0.0f);
        CHECK(at(cut, "A", x, y) == 0.0f);
        CHECK(at(cut, "id", x, y) == -1.0f);
      } else if ((x < 9 && y < 9) || (x > 20 && y > 10)) {
        CHECK(at(cut, "R", x, y) == at(whole, "R", x, y));  // its footprint lacks nothing
      } else {
        CHECK(at(cut, "A", x, y) > 0.0f);
      }
    }
  }
}

TEST_CASE("exposure acts on colours alone, after filtering") {
  Frame frame({0, 0, 6, 6});
  const Image plain = frame.render();
  frame.settings.exposure_gain = 2.0f, frame.settings.exposure_gamma = 2.2f;
  const Image exposed = frame.render();
  for (size_t i = 0; i < 36; ++i) {
    const double expected = std::pow(2.0 * double(plain.channels[1].values[i]), 1 / 2.2);
    CHECK(exposed.channels[1].values[i] == Approx(expected).epsilon(1e-5));
    CHECK(exposed.find_channel("A")->values[i] == plain.find_channel("A")->values[i]);
    CHECK(exposed.find_channel("Z")->values[i] == plain.find_channel("Z")->values[i]);
  }
}

TEST_CASE("memory is bounded by the frontier of buckets") {
  Frame frame({0, 0, 100, 100});
  frame.settings.bucket_size = 5;
  frame.samples_per_pixel = 1;
  Film film(frame.settings);
  for (int j = 0; j < 20; ++j)
    for (int i = 0; i < 20; ++i) film.add_bucket(i, j, frame.bucket(i, j));
  // Row by row, with a reach of one bucket: two rows and a little.
  CHECK(film.peak_blocks() <= 2 * 20 + 3);
  CHECK(film.counters().pixels == 10000);
}

TEST_CASE("films of impossible settings are refused") {
  Frame frame({0, 0, 8, 8});
  const auto refused = [](FilmSettings settings, auto change) {
    change(settings);
    CHECK_THROWS_AS(Film(settings), Error);
  };
  refused(frame.settings, [](FilmSettings& s) { s.filter = "none"; });
  for (float width : {0.0f, -1.0f, 65.0f, std::nanf("")}) {
    refused(frame.settings, [&](FilmSettings& s) { s.filter_x_width = width; });
    refused(frame.settings, [&](FilmSettings& s) { s.filter_y_width = width; });
  }
}
