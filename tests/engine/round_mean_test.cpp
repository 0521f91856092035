// What two images tell of the error of their mean, against noise and bias that are known.

#include <array>
#include <cmath>
#include <random>

#include <catch2/catch.hpp>

#include "engine/round_mean.h"

using namespace tessera;

namespace {

constexpr int side = 96;
const PixelRect window{0, 0, side, side};

std::vector<const AovDefinition*> groups() {
  return {&find_aov("rgb"), &find_aov("a"), &find_aov("z")};
}

// R, G, B, A, Z; colours by value_of(pixel, colour).
template <class ValueOf>
Image image_of(ValueOf value_of, float z = 1) {
  Image image(window, window);
  for (int c = 0; c < 3; ++c) {
    Image::Channel& channel = image.add_channel(std::string(1, "RGB"[c]));
    for (size_t p = 0; p < channel.values.size(); ++p) channel.values[p] = float(value_of(p, c));
  }
  image.add_channel("A", PixelType::float32, 1.0f);
  image.add_channel("Z", PixelType::float32, z);
  return image;
}

class Noise {
 public:
  explicit Noise(unsigned seed) : random_(seed) {}
  double operator()(double deviation) { return deviation * normal_(random_); }

 private:
  std::mt19937 random_;
  std::normal_distribution<double> normal_;
};

RoundImages noisy_round(unsigned seed, double value, double deviation) {
  Noise noise(seed);
  RoundImages round;
  round.a = image_of([&](size_t, int) { return value + noise(deviation); });
  round.b = image_of([&](size_t, int) { return value + noise(deviation); });
  return round;
}

double relative(double squared, double value) { return squared / (value * value + 0.01); }

}  // namespace

TEST_CASE("the error of a mean of two noisy images is found from their difference") {
  RoundMean mean(groups());
  mean.add(noisy_round(1, 0.5, 0.02), even_allocation(window, 2));
  // Variance of the mean of two: a half. 27648 values: their sum of squares is good to 0.9 %.
  CHECK(mean.error_squared() == Approx(relative(0.0002, 0.5)).epsilon(0.035));
  CHECK(mean.mean_samples() == 8.0);
  CHECK(mean.rounds() == 1);
  // With one sample in each of two passes it would be four times that.
  double noise = 0;
  for (const double v : mean.noise().variance) noise += v / (side * side);
  CHECK(noise == Approx(4 * relative(0.0002, 0.5)).epsilon(0.035));
}

TEST_CASE("rounds count by the inverse of their squared errors") {
  RoundMean mean(groups());
  mean.add(noisy_round(1, 0.5, 0.03), even_allocation(window, 0));
  mean.add(noisy_round(2, 0.5, 0.01), even_allocation(window, 3));
  const double a = 0.03 * 0.03 / 2, b = 0.01 * 0.01 / 2;
  CHECK(mean.error_squared() == Approx(relative(1 / (1 / a + 1 / b), 0.5)).epsilon(0.035));
  double real = 0;
  for (const float v : mean.image().find_channel("G")->values)
    real += (double(v) - 0.5) * (double(v) - 0.5) / (side * side);
  CHECK(real == Approx(1 / (1 / a + 1 / b)).epsilon(0.06));
  CHECK(mean.mean_samples() == 2.0 + 16.0);
}

TEST_CASE("bias that both halves share is found with the plain image") {
  // The filtered image keeps 0.3 of the plain one's noise, and is off by a tenth of the value.
  for (const double bias : {0.0, 0.02, 0.05}) {
    Noise noise(3);
    std::vector<std::array<double, 6>> plain(side * side);
    for (auto& values : plain)
      for (double& value : values) value = noise(0.04);
    const auto filtered = [&](int half) {
      return image_of([&](size_t p, int c) {
        return 0.5 + bias * (p % 2 ? 1 : -1) + 0.3 * plain[p][size_t(3 * half + c)];
      });
    };
    const auto unfiltered = [&](int half) {
      return image_of([&](size_t p, int c) { return 0.5 + plain[p][size_t(3 * half + c)]; });
    };
    RoundMean mean(groups());
    RoundImages round{filtered(0), filtered(1), unfiltered(0), unfiltered(1)};
    mean.add(std::move(round), even_allocation(window, 2));
    const double variance = 0.09 * 0.0016 / 2;
    // value^2 differs a little from pixel to pixel.
    CHECK(mean.variance() == Approx(relative(variance, 0.5)).epsilon(0.08));
    CHECK(mean.error_squared() == Approx(relative(variance + bias * bias, 0.5)).epsilon(0.08));
  }
}

TEST_CASE("a round with less bias takes the place of one with more") {
  const auto round_of = [](unsigned seed, double bias) {
    RoundImages round = noisy_round(seed, 0.5 + bias, 0.001);
    RoundImages plain = noisy_round(seed + 1, 0.5, 0.01);
    round.plain_a = std::move(plain.a), round.plain_b = std::move(plain.b);
    return round;
  };
  RoundMean mean(groups());
  mean.add(round_of(5, 0.05), even_allocation(window, 2));
  CHECK(std::sqrt(mean.error_squared() * 0.26) == Approx(0.05).epsilon(0.1));
  mean.add(round_of(7, 0.001), even_allocation(window, 5));
  CHECK(std::sqrt(mean.error_squared() * 0.26) < 0.003);
  CHECK(mean.image().find_channel("R")->values[100] == Approx(0.501).margin(0.005));
}

TEST_CASE("depths are those of the pass that saw the nearest surface") {
  const auto grey = [](size_t, int) { return 0.25; };
  RoundMean mean(groups());
  RoundImages first;
  first.a = image_of(grey, 5), first.b = image_of(grey, 3);
  mean.add(std::move(first), even_allocation(window, 0));
  CHECK(mean.image().find_channel("Z")->values[7] == 3.0f);
  RoundImages second;
  second.a = image_of(grey, 4), second.b = image_of(grey, 2);
  mean.add(std::move(second), even_allocation(window, 0));
  CHECK(mean.image().find_channel("Z")->values[7] == 2.0f);
  CHECK(mean.image().find_channel("A")->values[7] == 1.0f);
}

TEST_CASE("black images have no error, and bright ones a finite one") {
  RoundMean black(groups());
  black.add(noisy_round(1, 0, 0), even_allocation(window, 0));
  black.add(noisy_round(1, 0, 0), even_allocation(window, 3));
  CHECK(black.error_squared() == 0.0);
  CHECK(black.image().find_channel("R")->values[5] == 0.0f);
  RoundMean bright(groups());
  bright.add(noisy_round(1, 1e30, 1e28), even_allocation(window, 0));
  CHECK(bright.error_squared() == Approx(0.5e-4).epsilon(0.04));
}
