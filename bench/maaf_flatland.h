#pragma once
/// Methods of reconstruction in flatland: mean square errors against exact images.

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "bench/harness/benchmark.h"
#include "tests/reconstruct/flatland.h"
#include "tests/reconstruct/one_axis_wiener.h"

namespace tessera {

/// Rows `flatland/LOW..HIGH/SAMPLES`: random blockers with shifts from LOW to HIGH pixels before a
/// uniform light, SAMPLES a pixel; mean squares of the differences from the exact image, of the
/// bare samples and of each method. Always the same scenes and samples.
inline void add_maaf_flatland(BenchmarkContext& context) {
  std::vector<std::pair<std::string, std::unique_ptr<ReconstructionMethod>>> methods;
  for (const char* name : {"aaf", "fsf", "maaf"})
    methods.emplace_back(fmt::format("{}_mse", name), flatland::make_method(name));
  methods.emplace_back("wiener_mse", std::make_unique<OneAxisWiener>(3));
  const uint32_t scenes = uint32_t(context.scaled(16, 4));

  for (const AxisWedge& wedge : {AxisWedge{1, 2}, {4, 8}, {10, 12}, {6, 24}, {15, 40}, {-6, 6}}) {
    std::vector<flatland::Scene> all;
    std::vector<std::vector<double>> exact(scenes);
    for (uint32_t s = 0; s < scenes; ++s) {
      all.push_back(flatland::make_scene(wedge, 512, 100 + s));
      for (int x = 0; x < all[s].pixels; ++x) exact[s].push_back(all[s].exact_pixel(x));
    }
    for (int samples : {1, 4, 16, 64, 256}) {
      BenchmarkContext::Columns columns = {{"bare_mse", 0.0}};
      for (const auto& [name, method] : methods) {
        double filtered = 0.0;
        for (uint32_t s = 0; s < scenes; ++s) {
          const auto errors =
              flatland::measure(all[s], exact[s], *method, samples, 7 + s + uint32_t(samples));
          filtered += errors.filtered / scenes;
          if (method == methods.front().second) columns[0].second += errors.unfiltered / scenes;
        }
        columns.push_back({name, filtered});
      }
      context.add_row(fmt::format("flatland/{}..{}/{}", wedge.low, wedge.high, samples), columns);
    }
  }
}

}  // namespace tessera
