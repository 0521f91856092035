// Patterns whose samples lie on fixed tuples or on lens lines.

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>
#include <vector>

#include "base/error.h"
#include "hide/samples.h"

using namespace tessera;
using Kind = SampleTuples::Kind;

namespace {

struct Profiles {
  std::unique_ptr<LensProfile> lens = make_lens_profile("disc", 6, 0);
  std::unique_ptr<ShutterProfile> shutter = make_shutter_profile("box");
};

SampleBlock samples(int spp, const SampleTuples& tuples, const PixelRect& rect, bool lens,
                    bool motion, uint32_t seed = 7) {
  static const Profiles p;
  const SamplePattern pattern(spp, seed, lens ? p.lens.get() : nullptr,
                              motion ? p.shutter.get() : nullptr, tuples);
  SampleBlock block;
  pattern.fill(rect, block);
  return block;
}

/// Calls visit(x, y, index of the pixel's first sample).
template <class Visit>
void for_each_pixel(const SampleBlock& block, const Visit& visit) {
  size_t first = 0;
  for (int y = block.rect.y0; y < block.rect.y1; ++y)
    for (int x = block.rect.x0; x < block.rect.x1; ++x, first += size_t(block.samples_per_pixel))
      visit(x, y, first);
}

constexpr PixelRect even_rect{-4, 2, 8, 10};

struct Case {
  SampleTuples tuples;
  int spp;
};
const Case cases[] = {
    {{Kind::interleaved, 64}, 16}, {{Kind::interleaved, 16}, 16}, {{Kind::interleaved, 1}, 4},
    {{Kind::interleaved, 12}, 3},  {{Kind::interleaved, 36}, 9},  {{Kind::interleaved, 4}, 1},
    {{Kind::accumulated, 16}, 16}, {{Kind::accumulated, 3}, 9},   {{Kind::accumulated, 1}, 1},
    {{Kind::lens_lines, 8}, 16},   {{Kind::lens_lines, 16}, 16},  {{Kind::lens_lines, 5}, 9},
    {{Kind::lens_lines, 7}, 3}};

}  // namespace

TEST_CASE("Every tuple occurs equally often in every tile of 2 x 2 pixels") {
  for (const auto& [tuples, spp] : cases) {
    if (tuples.kind != Kind::interleaved) continue;
    for (const bool lens : {false, true})
      for (const bool motion : {false, true}) {
        INFO(to_string(tuples) << " lens " << lens << " motion " << motion);
        const SampleBlock block = samples(spp, tuples, even_rect, lens, motion);
        std::map<std::pair<int, int>, std::vector<int>> counts;
        for_each_pixel(block, [&](int x, int y, size_t first) {
          auto& count = counts[{x >> 1, y >> 1}];
          count.resize(size_t(tuples.count), 0);
          for (int k = 0; k < spp; ++k) ++count.at(block.tuple[first + size_t(k)]);
        });
        REQUIRE(counts.size() == 6 * 4);
        for (const auto& [tile, count] : counts)
          for (const int n : count) REQUIRE(n == 4 * spp / tuples.count);
      }
  }
}

TEST_CASE("Tiles differ in their shuffle, and pixels of a tile in their tuples") {
  const SampleBlock block = samples(4, {Kind::interleaved, 16}, {0, 0, 32, 32}, false, false);
  std::map<std::vector<uint32_t>, int> seen;
  for_each_pixel(block, [&](int, int, size_t first) {
    ++seen[{block.tuple.begin() + long(first), block.tuple.begin() + long(first + 4)}];
  });
  // A pixel has one of 4 aligned blocks of 4 tuples in one of 2^3 nested orders; were tiles alike
  // there would be 4 sequences.
  REQUIRE(seen.size() == 32);
}

TEST_CASE("A tuple has one lens position and one time all over the frame") {
  for (const auto& [tuples, spp] : cases) {
    if (tuples.kind == Kind::lens_lines) continue;
    INFO(to_string(tuples));
    const SampleBlock block = samples(spp, tuples, even_rect, true, true);
    std::vector<std::vector<float>> seen(size_t(tuples.count));
    for_each_pixel(block, [&](int x, int y, size_t first) {
      for (size_t i = first; i < first + size_t(spp); ++i) {
        std::vector<float> point{block.u[i], block.v[i], block.t[i]};
        if (tuples.kind == Kind::accumulated)
          for (const float p : {block.x[i] - float(x), block.y[i] - float(y)}) point.push_back(p);
        auto& first_seen = seen[block.tuple[i]];
        if (first_seen.empty()) first_seen = point;
        for (size_t k = 0; k < point.size(); ++k)
          REQUIRE(point[k] == Approx(first_seen[k]).margin(k < 3 ? 0.0 : 1e-6));
      }
    });
    for (size_t n = 1; n < seen.size(); ++n) REQUIRE(seen[n][2] > seen[n - 1][2]);
  }
}

TEST_CASE("Tuples are well distributed over lens and shutter") {
  const SampleBlock block = samples(16, {Kind::interleaved, 64}, {0, 0, 2, 2}, true, true);
  std::vector<int> ring(8, 0), slot(8, 0);
  for (size_t i = 0; i < 64; ++i) {
    // Equal areas of the disc; the concentric map turns strata of the square into such.
    const float r2 = block.u[i] * block.u[i] + block.v[i] * block.v[i];
    ++ring[std::min(size_t(r2 * 8), size_t(7))];
    ++slot[size_t(block.t[i] * 8)];
  }
  for (const int n : slot) CHECK(n == 8);
  for (const int n : ring) CHECK(std::abs(n - 8) <= 3);
  // A pixel's 16 of the 64 times are stratified as well.
  for (size_t p = 0; p < 4; ++p) {
    std::vector<int> quarter(4, 0);
    for (size_t k = 0; k < 16; ++k) ++quarter[size_t(block.t[p * 16 + k] * 4)];
    for (const int n : quarter) CHECK(n == 4);
  }
}

TEST_CASE("Samples of tuples and lines do not depend on the block, and are in order of time") {
  for (const auto& [tuples, spp] : cases)
    for (const bool lens : {false, true})
      for (const bool motion : {false, true}) {
        INFO(to_string(tuples) << " spp " << spp << " lens " << lens << " motion " << motion);
        const SampleBlock whole = samples(spp, tuples, even_rect, lens, motion);
        REQUIRE(whole.u.empty() != lens);
        REQUIRE(whole.t.empty() != motion);
        // Cuts tiles on all sides.
        const SampleBlock part = samples(spp, tuples, {-3, 3, 6, 6}, lens, motion);
        for_each_pixel(part, [&](int x, int y, size_t first) {
          const size_t other = size_t((y - 2) * 12 + x + 4) * size_t(spp);
          for (size_t k = 0; k < size_t(spp); ++k) {
            const size_t a = first + k, b = other + k;
            REQUIRE(part.x[a] == whole.x[b]);
            REQUIRE(part.y[a] == whole.y[b]);
            REQUIRE(part.tuple[a] == whole.tuple[b]);
            REQUIRE((part.x[a] >= float(x) && part.x[a] < float(x + 1)));
            if (lens) REQUIRE((part.u[a] == whole.u[b] && part.v[a] == whole.v[b]));
            if (motion) REQUIRE(part.t[a] == whole.t[b]);
            if (motion && k > 0) REQUIRE(part.t[a] >= part.t[a - 1]);
          }
        });
        REQUIRE(part.tuple.size() == part.x.size());
        for (size_t i = part.size(); i < part.x.size(); ++i) REQUIRE(std::isnan(part.x[i]));
      }
}

TEST_CASE("Interleaving moves lens and time only: positions are those of free samples") {
  const SampleBlock free = samples(16, {}, even_rect, false, false);
  const SampleBlock fixed = samples(16, {Kind::interleaved, 64}, even_rect, false, false);
  // In each pixel the same points; still pixels have theirs in order of y.
  const auto sorted = [](const SampleBlock& block, size_t first) {
    std::vector<std::pair<float, float>> points;
    for (size_t i = first; i < first + 16; ++i) points.emplace_back(block.y[i], block.x[i]);
    std::sort(points.begin(), points.end());
    return points;
  };
  for (size_t first = 0; first < free.size(); first += 16)
    REQUIRE(sorted(free, first) == sorted(fixed, first));
  REQUIRE(free.tuple.empty());
}

TEST_CASE("Lens lines: samples lie on their lines, shared out evenly") {
  for (const auto& [tuples, spp] : cases) {
    if (tuples.kind != Kind::lens_lines) continue;
    INFO(to_string(tuples));
    const SampleBlock block = samples(spp, tuples, even_rect, true, true);
    std::vector<int> total(size_t(tuples.count), 0);
    for_each_pixel(block, [&](int, int, size_t first) {
      std::vector<int> count(size_t(tuples.count), 0);
      for (size_t i = first; i < first + size_t(spp); ++i) {
        const glm::vec2 along = lens_line_direction(int(block.tuple[i]), tuples.count);
        REQUIRE(block.u[i] * along.y - block.v[i] * along.x == Approx(0).margin(1e-7));
        REQUIRE(block.u[i] * block.u[i] + block.v[i] * block.v[i] <= 1.0f);
        ++count[block.tuple[i]], ++total[block.tuple[i]];
      }
      for (const int n : count)
        REQUIRE((n == spp / tuples.count || n == (spp + tuples.count - 1) / tuples.count));
    });
    for (const int n : total) REQUIRE(n > 0);
  }
  CHECK(lens_line_direction(2, 4).y == Approx(1.0));
}

TEST_CASE("Lens lines sample the disc uniformly by area") {
  // r^2 of a point that is uniform over the unit disc is uniform over [0, 1].
  for (const int lines : {1, 4, 16}) {
    const SampleBlock block = samples(16, {Kind::lens_lines, lines}, {0, 0, 32, 32}, true, false);
    std::vector<int> ring(8, 0), octant(8, 0);
    double sum = 0;
    for (size_t i = 0; i < block.size(); ++i) {
      const double r2 = double(block.u[i]) * block.u[i] + double(block.v[i]) * block.v[i];
      sum += r2, ++ring[std::min(size_t(r2 * 8), size_t(7))];
      const double angle = std::atan2(-block.v[i], -block.u[i]) / M_PI + 1.0;
      ++octant[size_t(angle * 4 + 0.1) % 8];  // no line on the border of an octant
    }
    const double n = double(block.size());
    // Deviation of the mean of n = 16384 uniforms: sqrt(1 / 12 / n) = 0.0023; stratified, so less.
    CHECK(sum / n == Approx(0.5).margin(0.005));
    for (const int count : ring) CHECK(count / n == Approx(1.0 / 8).margin(0.01));
    if (lines == 16)
      for (const int count : octant) CHECK(count / n == Approx(1.0 / 8).margin(0.01));
  }
  // Another profile gives its disc of the same extent.
  const auto smooth = make_lens_profile("smooth", 6, 0);
  const SamplePattern pattern(16, 1, smooth.get(), nullptr, {Kind::lens_lines, 4});
  SampleBlock block;
  pattern.fill({0, 0, 16, 16}, block);
  float most = 0;
  for (size_t i = 0; i < block.size(); ++i)
    most = std::max(most, std::hypot(block.u[i], block.v[i]));
  CHECK(most == Approx(smooth->extent()).margin(0.01));
}

TEST_CASE("Numbers of tuples that do not come out even are refused with those that do") {
  const auto message = [](int spp, const SampleTuples& tuples) -> std::string {
    try {
      samples(spp, tuples, {0, 0, 1, 1}, true, true);
    } catch (const Error& error) {
      return error.what();
    }
    return "";
  };
  using Catch::Contains;
  CHECK_THAT(message(3, {Kind::interleaved, 5}),
             Contains("interleaved:5") && Contains("12") && Contains("1, 2, 3, 4, 6, 12"));
  CHECK_THAT(message(4, {Kind::interleaved, 32}), Contains("1, 2, 4, 8, 16"));
  CHECK_THAT(message(4, {Kind::interleaved, 0}), Contains("1, 2, 4, 8, 16"));
  CHECK_THAT(message(16, {Kind::accumulated, 3}), Contains("1, 2, 4, 8, 16"));
  CHECK_THAT(message(16, {Kind::accumulated, 32}), Contains("accumulated:32"));
  CHECK_THAT(message(16, {Kind::lens_lines, 0}), Contains("lines"));
  CHECK(message(16, {Kind::lens_lines, 40}).empty());
}
