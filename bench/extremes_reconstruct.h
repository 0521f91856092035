#pragma once
/// The extremes table, reconstruction: what the methods' weights come to where formulas break.

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "bench/extremes_table.h"
#include "reconstruct/method.h"

namespace tessera {

/// Worst of all wedges and sample counts of one method.
struct ReconstructionTally {
  int filters = 0, nonfinite = 0;
  double worst_weight = 0;        ///< largest |A_k(dx)|
  double worst_sum_error = 0;     ///< what the filter makes of f = 1, less 1
  double worst_mirror_error = 0;  ///< against the weights of the mirrored wedge
};

/// Means over y of the basis functions, by midpoints: what the moments of f = 1 tend to.
inline std::vector<double> mean_basis(const ReconstructionMethod& method) {
  constexpr int steps = 2000;
  std::vector<float> values(static_cast<size_t>(method.basis_count()));
  std::vector<double> means(values.size());
  for (int i = 0; i < steps; ++i) {
    BasisPoint at;
    at.y = float((2.0 * i + 1.0) / steps - 1.0);
    method.basis(at, values.data());
    for (size_t k = 0; k < values.size(); ++k) means[k] += double(values[k]) / steps;
  }
  return means;
}

inline void tally_filter(const ReconstructionMethod& method, const std::vector<double>& means,
                         const AxisWedge& wedge, float samples, ReconstructionTally& tally) {
  const size_t row = size_t(2 * method.reach() + 1);
  std::vector<float> weights(means.size() * row), mirrored(weights.size());
  method.weights(wedge, samples, weights.data());
  method.weights({-wedge.high, -wedge.low}, samples, mirrored.data());
  double sum = 0.0;
  ++tally.filters;
  for (size_t i = 0; i < weights.size(); ++i) {
    if (!std::isfinite(weights[i])) {
      ++tally.nonfinite;
      return;
    }
    const size_t k = i / row, other = k * row + (row - 1 - i % row);
    sum += weights[i] * means[k];
    tally.worst_weight = std::max(tally.worst_weight, std::abs(double(weights[i])));
    tally.worst_mirror_error =
        std::max(tally.worst_mirror_error, std::abs(double(weights[i]) - mirrored[other]));
  }
  tally.worst_sum_error = std::max(tally.worst_sum_error, std::abs(sum - 1.0));
}

/// Equal slopes, slopes of both signs, none, and numbers from 1e-30 to 1e30, with 1 to 65536
/// samples. Held against what a filter is: its weights are finite, add up to 1, and are those of
/// the mirrored wedge mirrored.
inline void add_reconstruction_extremes(ExtremesTable& table) {
  constexpr float infinity = std::numeric_limits<float>::infinity();
  const float sizes[] = {0.0f,  1e-30f, 1e-6f, 0.3f,  1.0f,    5.0f,
                         24.0f, 64.0f,  1e7f,  1e30f, infinity};
  const std::pair<const char*, const char*> methods[] = {
      {"aaf", ""}, {"fsf", ""}, {"maaf", ""}, {"maaf", "125"}, {"wiener", ""}};
  for (const auto& [name, arguments] : methods) {
    for (const ReconstructionMethodDefinition& definition : reconstruction_method_registry()) {
      if (definition.name != std::string(name)) continue;
      const auto method = definition.make(arguments);
      const std::vector<double> means = mean_basis(*method);
      ReconstructionTally tally;
      for (float low : sizes) {
        for (float high : sizes) {
          for (float samples : {1.0f, 16.0f, 65536.0f}) {
            tally_filter(*method, means, {-low, high}, samples, tally);
            tally_filter(*method, means, {std::min(low, high), std::max(low, high)}, samples,
                         tally);
          }
        }
      }
      WorstError error{0, double(tally.filters)};
      error.worst = std::max(tally.worst_sum_error, tally.worst_mirror_error);
      if (tally.nonfinite > 0) error.worst = infinity;
      table.add({"reconstruct", fmt::format("{}{}, slopes 0 to infinity", name, arguments),
                 "weights of f = 1, mirrored wedges", error, "of 1", 1e-4,
                 fmt::format("{} not finite, largest weight {:.3g}, sums to {:.2g}, mirrors {:.2g}",
                             tally.nonfinite, tally.worst_weight, tally.worst_sum_error,
                             tally.worst_mirror_error)});
    }
  }
}

}  // namespace tessera
