#include "trade/curve.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

namespace tessera::trade {
namespace {

/// y at `x` on the straight line through two points in logarithms; where one is not above 0, as the
/// error of an image equal to the reference, y steps to that of the second.
double log_line(double x0, double y0, double x1, double y1, double x) {
  if (!(x0 > 0 && x1 > 0 && y0 > 0 && y1 > 0 && x > 0) || x0 == x1) return y1;
  const double share = std::log(x / x0) / std::log(x1 / x0);
  return y0 * std::exp(std::clamp(share, 0.0, 1.0) * std::log(y1 / y0));
}

/// The larger one; unknown when one is.
double larger(double a, double b) { return std::isnan(a) || a > b ? a : b; }

Reading ratio(const Reading& reading, double over) {
  return {over > 0 ? reading.value / over : unknown, reading.bound, reading.spread};
}

/// Geometric mean of readings that are exact; unknown without any.
class GeometricMean {
 public:
  void add(const Reading& reading) {
    if (reading.bound != Bound::exact || !(reading.value > 0)) return;
    sum_ += std::log(reading.value);
    ++count_;
  }
  Reading mean() const { return {count_ > 0 ? std::exp(sum_ / count_) : unknown, Bound::exact, 0}; }

 private:
  double sum_ = 0;
  int count_ = 0;
};

}  // namespace

std::string text_of(const Reading& reading) {
  if (!reading.known()) return "-";
  const char* bound = reading.bound == Bound::at_most    ? "at most "
                      : reading.bound == Bound::at_least ? "at least "
                                                         : "";
  return fmt::format("{}{:.3g}", bound, reading.value);
}

std::vector<CurvePoint> curve_of(const std::vector<Run>& runs, const Turn& turn) {
  std::vector<CurvePoint> curve;
  for (const Run& run : runs)
    if (run.ok() && run.configuration.turn == turn)
      curve.push_back(
          {double(run.configuration.spp), run.result.frame_s, run.result.rel_mse, run.spread()});
  std::stable_sort(curve.begin(), curve.end(),
                   [](const CurvePoint& a, const CurvePoint& b) { return a.spp < b.spp; });
  return curve;
}

Reading time_to_reach(std::span<const CurvePoint> curve, double rel_mse) {
  if (curve.empty()) return {};
  const CurvePoint &first = curve.front(), &last = curve.back();
  if (first.rel_mse == rel_mse) return {first.time_s, Bound::exact, first.spread};
  if (first.rel_mse < rel_mse) return {first.time_s, Bound::at_most, first.spread};
  for (size_t k = 1; k < curve.size(); ++k) {
    const CurvePoint &a = curve[k - 1], &b = curve[k];
    if (b.rel_mse <= rel_mse)
      return {log_line(a.rel_mse, a.time_s, b.rel_mse, b.time_s, rel_mse), Bound::exact,
              larger(a.spread, b.spread)};
  }
  return {last.time_s, Bound::at_least, last.spread};
}

Reading error_after(std::span<const CurvePoint> curve, double time_s) {
  if (curve.empty()) return {};
  const CurvePoint &first = curve.front(), &last = curve.back();
  if (time_s == first.time_s) return {first.rel_mse, Bound::exact};
  if (time_s < first.time_s) return {first.rel_mse, Bound::at_least};
  for (size_t k = 1; k < curve.size(); ++k) {
    const CurvePoint &a = curve[k - 1], &b = curve[k];
    if (time_s <= b.time_s)
      return {log_line(a.time_s, a.rel_mse, b.time_s, b.rel_mse, time_s), Bound::exact};
  }
  return {last.rel_mse, Bound::at_most};
}

bool Comparison::within_noise() const {
  return time_ratio.known() && time_ratio.bound == Bound::exact && time_ratio.value > 0 &&
         std::abs(std::log(time_ratio.value)) <= std::log1p(noise);
}

Comparison compare_curves(std::span<const CurvePoint> curve, std::span<const CurvePoint> other,
                          double pivot_spp) {
  const CurvePoint& pivot =
      *std::min_element(other.begin(), other.end(), [pivot_spp](auto& a, auto& b) {
        return std::abs(a.spp - pivot_spp) < std::abs(b.spp - pivot_spp);
      });
  Comparison comparison;
  comparison.pivot_spp = pivot.spp;
  comparison.time_ratio = ratio(time_to_reach(curve, pivot.rel_mse), pivot.time_s);
  comparison.error_ratio = ratio(error_after(curve, pivot.time_s), pivot.rel_mse);
  GeometricMean time_mean, error_mean;
  for (const CurvePoint& point : other) {
    time_mean.add(ratio(time_to_reach(curve, point.rel_mse), point.time_s));
    error_mean.add(ratio(error_after(curve, point.time_s), point.rel_mse));
  }
  comparison.time_ratio_ladder = time_mean.mean();
  comparison.error_ratio_ladder = error_mean.mean();
  comparison.noise = std::hypot(comparison.time_ratio.spread, pivot.spread);
  return comparison;
}

}  // namespace tessera::trade
