#pragma once
/// A plain radix-2 fast Fourier transform and shares of energy, as an oracle for band limits.

#include <algorithm>
#include <cmath>
#include <complex>
#include <functional>
#include <numbers>
#include <vector>

namespace tessera::test {

using Complex = std::complex<double>;

/// In-place transform of `count` (a power of two) elements `stride` apart, unnormalised.
inline void fourier_transform(Complex* data, size_t count, size_t stride = 1) {
  std::vector<Complex> line(count), twiddle(count / 2);
  size_t bits = 0;
  while ((size_t(1) << bits) < count) ++bits;
  for (size_t i = 0; i < count; ++i) {
    size_t reversed = 0;
    for (size_t b = 0; b < bits; ++b) reversed |= ((i >> b) & 1) << (bits - 1 - b);
    line[reversed] = data[i * stride];
  }
  for (size_t i = 0; i < count / 2; ++i)
    twiddle[i] = std::polar(1.0, -2.0 * std::numbers::pi * double(i) / double(count));
  for (size_t half = 1; half < count; half *= 2) {
    for (size_t start = 0; start < count; start += 2 * half) {
      for (size_t i = 0; i < half; ++i) {
        const Complex a = line[start + i], t = twiddle[i * (count / 2 / half)];
        const Complex b = line[start + half + i];
        const Complex turned(b.real() * t.real() - b.imag() * t.imag(),
                             b.real() * t.imag() + b.imag() * t.real());
        line[start + i] = a + turned, line[start + half + i] = a - turned;
      }
    }
  }
  for (size_t i = 0; i < count; ++i) data[i * stride] = line[i];
}

/// Frequency of bin k of `count` over a period of `period` units, cycles per unit, negative in the
/// upper half.
inline double bin_frequency(size_t k, size_t count, double period) {
  return (k < count / 2 ? double(k) : double(k) - double(count)) / period;
}

/// How much of a bin (`width` wide) at distance `distance` lies within `limit`: a ramp, so that a
/// sum over bins comes near to the integral.
inline double bin_within(double distance, double limit, double width) {
  return std::clamp((limit - distance) / width + 0.5, 0.0, 1.0);
}

/// Power spectrum of a function of [-period / 2, period / 2) at count x count points, [y][x].
class PowerSpectrum {
 public:
  PowerSpectrum(size_t count, double period, std::vector<Complex> values)
      : count_(count), period_(period) {
    for (size_t row = 0; row < count; ++row) fourier_transform(&values[row * count], count);
    for (size_t column = 0; column < count; ++column)
      fourier_transform(&values[column], count, count);
    for (const Complex& v : values) power_.push_back(std::norm(v));
  }

  /// Share of the energy for which within(f_x, f_y), in [0, 1], says so.
  double share(const std::function<double(double, double)>& within) const {
    double total = 0.0, inside = 0.0;
    for (size_t j = 0; j < count_; ++j) {
      for (size_t i = 0; i < count_; ++i) {
        const double power = power_[j * count_ + i];
        total += power;
        inside +=
            power * within(bin_frequency(i, count_, period_), bin_frequency(j, count_, period_));
      }
    }
    return inside / total;
  }

  double share_of_disc(double radius) const {
    return share(
        [&](double x, double y) { return bin_within(std::hypot(x, y), radius, 1.0 / period_); });
  }

 private:
  size_t count_;
  double period_;
  std::vector<double> power_;
};

}  // namespace tessera::test
