/// Methods against the exact images of random flatland scenes.

#include <catch2/catch.hpp>

#include <map>

#include "tests/reconstruct/flatland.h"
#include "tests/reconstruct/one_axis_wiener.h"

using namespace tessera;
using namespace tessera::flatland;

namespace {

constexpr int sample_counts[] = {1, 4, 16, 64, 256};

/// Mean square errors over three scenes, by samples a pixel.
std::map<int, Errors> errors_of(const ReconstructionMethod& method, const AxisWedge& wedge) {
  std::map<int, Errors> errors;
  for (uint32_t seed : {1u, 2u, 3u}) {
    const Scene scene = make_scene(wedge, 256, seed);
    std::vector<double> exact;
    for (int x = 0; x < scene.pixels; ++x) exact.push_back(scene.exact_pixel(x));
    for (int samples : sample_counts) {
      const Errors e = measure(scene, exact, method, samples, 17 * seed + uint32_t(samples));
      errors[samples].filtered += e.filtered / 3;
      errors[samples].unfiltered += e.unfiltered / 3;
    }
  }
  return errors;
}

const AxisWedge test_wedges[] = {{1, 2},  {4, 8},   {10, 12},   {6, 24}, {15, 40},
                                 {-6, 6}, {-2, 10}, {-30, -18}, {50, 60}};

}  // namespace

TEST_CASE("the exact image is the mean of many samples", "[method][flatland]") {
  const Scene scene = make_scene({-3, 9}, 64, 5);
  for (double x : {3.3, 20.0, 41.7}) {
    double sum = 0.0;
    for (int i = 0; i < 20000; ++i) sum += scene.visible(x, (i + 0.5) / 10000 - 1.0);
    CHECK(scene.exact(x) == Approx(sum / 20000).margin(5e-4));
  }
}

TEST_CASE("wiener beats the bare samples at every count, and has no floor", "[method][flatland]") {
  const OneAxisWiener three(3), one(1);
  for (const ReconstructionMethod* method :
       {(const ReconstructionMethod*)&three, (const ReconstructionMethod*)&one}) {
    for (const AxisWedge& wedge : test_wedges) {
      const auto errors = errors_of(*method, wedge);
      for (int samples : sample_counts) {
        INFO(method->basis_count()
             << " components, " << wedge.low << " " << wedge.high << ", " << samples << " samples");
        CHECK(errors.at(samples).filtered <= errors.at(samples).unfiltered);
      }
      INFO(method->basis_count() << " components, " << wedge.low << " " << wedge.high);
      CHECK(errors.at(16).filtered < errors.at(4).filtered);
      CHECK(errors.at(64).filtered < errors.at(16).filtered);
      CHECK(errors.at(256).filtered < errors.at(64).filtered);
      // 64 times the samples: a floor would keep most of the error.
      CHECK(errors.at(256).filtered < 0.08 * errors.at(4).filtered);
    }
  }
}

TEST_CASE("wiener does no harm where there is hardly any blur", "[method][flatland]") {
  const OneAxisWiener three(3);
  for (const AxisWedge& wedge : {AxisWedge{0, 0}, {0, 0.4f}, {0.2f, 0.6f}, {0, 1.5f}}) {
    const auto errors = errors_of(three, wedge);
    for (int samples : sample_counts) {
      INFO(wedge.low << " " << wedge.high << ", " << samples << " samples");
      // Some forty edges make the error, so that its mean is known to a tenth or so.
      CHECK(errors.at(samples).filtered <= 1.15 * errors.at(samples).unfiltered);
    }
  }
}

TEST_CASE("wiener halves the error of aaf where slopes are known well", "[method][flatland]") {
  const OneAxisWiener wiener(3);
  const auto aaf = make_method("aaf");
  for (const AxisWedge& wedge : {AxisWedge{4, 8}, {10, 12}, {6, 24}}) {
    const auto of_wiener = errors_of(wiener, wedge), of_aaf = errors_of(*aaf, wedge);
    for (int samples : {1, 4, 16}) {
      INFO(wedge.low << " " << wedge.high << ", " << samples << " samples");
      CHECK(of_wiener.at(samples).filtered < 0.75 * of_aaf.at(samples).filtered);
    }
  }
}

TEST_CASE("three components do better than one", "[method][flatland]") {
  const OneAxisWiener three(3), one(1);
  for (const AxisWedge& wedge : {AxisWedge{4, 8}, {10, 12}, {-30, -18}}) {
    const auto of_three = errors_of(three, wedge), of_one = errors_of(one, wedge);
    for (int samples : {4, 16, 64}) {
      INFO(wedge.low << " " << wedge.high << ", " << samples << " samples");
      CHECK(of_three.at(samples).filtered < 0.9 * of_one.at(samples).filtered);
    }
  }
}

TEST_CASE("Gaussian filters help at few samples; the literal MAAF and FSF have floors",
          "[method][flatland]") {
  for (const char* name : {"aaf", "fsf", "maaf"}) {
    const auto method = make_method(name);
    for (const AxisWedge& wedge : {AxisWedge{4, 8}, {10, 12}, {-24, -6}}) {
      auto errors = errors_of(*method, wedge);
      // MAAF's first moment is not the bare mean.
      const auto bare = errors_of(*make_method("aaf"), wedge);
      for (int samples : sample_counts) errors[samples].unfiltered = bare.at(samples).unfiltered;
      INFO(name << " " << wedge.low << " " << wedge.high);
      CHECK(errors.at(1).filtered < 0.5 * errors.at(1).unfiltered);
      CHECK(errors.at(4).filtered < 0.5 * errors.at(4).unfiltered);
      const bool has_floor = std::string_view(name) != "aaf";
      CHECK((errors.at(256).filtered > errors.at(256).unfiltered) == has_floor);
    }
  }
}
