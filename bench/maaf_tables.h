#pragma once
/// Tables 1 and 2 of L. Wu et al., "Multiple axis-aligned filters for rendering of combined
/// distribution effects", EGSR 2017: how tightly filters fit the wedge. No renderer runs.

#include <algorithm>
#include <functional>
#include <random>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "bench/harness/benchmark.h"
#include "bench/maaf_boxes.h"
#include "bench/maaf_flatland.h"
#include "reconstruct/wedge_spectrum.h"

namespace tessera {

/// 50 wedges uniform in 0 < s_min < s_max < 10. Always the same.
inline std::vector<DoubleWedge> table_wedges() {
  std::mt19937 random(2017);
  const auto uniform = [&] { return (random() + 0.5) / 4294967296.0; };
  std::vector<DoubleWedge> wedges;
  while (wedges.size() < 50) {
    const double a = 10.0 * uniform(), b = 10.0 * uniform();
    wedges.push_back({std::min(a, b), std::max(a, b)});
  }
  return wedges;
}

using WedgeSpectrum = std::function<std::vector<SpectrumGaussian>(const DoubleWedge&)>;

/// Table 1: boxes instead of Gaussians, averages over table_wedges().
inline void add_box_table(BenchmarkContext& context) {
  const std::vector<DoubleWedge> wedges = table_wedges();
  const auto add = [&](const std::string& name, const WedgeSpectrum& boxes) {
    double sum = 0.0;
    for (const DoubleWedge& wedge : wedges) sum += summed_box_coverage(wedge, boxes(wedge));
    context.add_row("table1/" + name,
                    {{"coverage", sum / double(wedges.size())}, {"accuracy", 1.0}});
  };
  add("AAF", aaf_spectrum);
  add("FSF", fsf_spectrum);
  for (int components : {3, 5, 7, 25, 75, 125})
    add(fmt::format("MAAF{}", components),
        [&](const DoubleWedge& wedge) { return maaf_spectrum(wedge, components); });
}

/// Table 2: Gaussians, averages over table_wedges() and the three wedges of the paper.
inline void add_gaussian_table(BenchmarkContext& context) {
  const auto add = [&](const std::string& name, const WedgeSpectrum& spectrum) {
    WedgeFit mean{0.0, 0.0};
    const std::vector<DoubleWedge> wedges = table_wedges();
    for (const DoubleWedge& wedge : wedges) {
      const WedgeFit fit = gaussian_fit(wedge, spectrum(wedge));
      mean.coverage += fit.coverage / double(wedges.size());
      mean.accuracy += fit.accuracy / double(wedges.size());
    }
    const auto add_row = [&](const std::string& shape, const WedgeFit& fit) {
      context.add_row(fmt::format("table2/{}/{}", name, shape),
                      {{"coverage", fit.coverage}, {"accuracy", fit.accuracy}});
    };
    add_row("average", mean);
    for (const DoubleWedge& wedge : {DoubleWedge{0.5, 0.8}, {1.5, 2.0}, {0.7, 2.2}})
      add_row(fmt::format("{:.1f}-{:.1f}", wedge.s_min, wedge.s_max),
              gaussian_fit(wedge, spectrum(wedge)));
  };
  add("AAF", aaf_spectrum);
  add("FSF", fsf_spectrum);
  for (int components : {3, 5, 7})
    add(fmt::format("MAAF{}", components),
        [&](const DoubleWedge& wedge) { return maaf_spectrum(wedge, components); });
}

/// Rows `table1/NAME`, `table2/NAME/SHAPE` and, for what the fits are worth, `flatland/...`.
inline void add_maaf_tables(BenchmarkContext& context) {
  add_box_table(context);
  add_gaussian_table(context);
  add_maaf_flatland(context);
}

}  // namespace tessera
