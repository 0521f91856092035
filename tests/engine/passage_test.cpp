// Whole frames of what is out of the frame at every motion key and passes through it in between.

#include <cmath>

#include <catch2/catch.hpp>

#include "tests/engine/render_text.h"

using namespace tessera;

TEST_CASE("a disc that passes the frame covers each row for its width over the way") {
  // 900 wide and 1.2 high at depth 4, where the frame is 4.4 by 3.3: at height y it covers
  // 900 sqrt(1 - (y / 1.2)^2) of `reach`, the ways of both having twice that length.
  const double high = 1.2, per_pixel = 4 * std::tan(M_PI / 8) / 18;
  for (const double reach : {2000.0, 5000.0}) {
    for (const char* mode : {"aas", "reyes"}) {
      INFO("reach " << reach << ", " << mode);
      Settings settings;
      settings.shading = mode;
      const Image image = render_text(fmt::format(R"(
        Format 48 36 1  PixelSamples 6 6  PixelFilter "box" 1 1  Shutter 0 1
        Projection "perspective" "fov" [45]
        WorldBegin
          Translate 0 0 4
          Surface "constant"
          MotionBegin [0 1]
            Translate -{0} 0 0
            Translate {0} 0 0
          MotionEnd
          Scale 900 {1} 1
          Disk 0 1 360
        WorldEnd)",
                                                  reach, high),
                                      settings);
      double found = 0, expected = 0;
      for (int y = 0; y < 36; ++y) {
        double row = 0;
        for (int x = 0; x < 48; ++x) row += double(channel_at(image, "A", x, y)) / 48;
        // The mean over the row's height.
        double of_row = 0;
        for (int k = 0; k < 64; ++k) {
          const double height = (18 - y - (k + 0.5) / 64) * per_pixel / high;
          of_row += 900 / reach * std::sqrt(std::max(0.0, 1 - height * height)) / 64;
        }
        INFO("row " << y);
        // 1728 samples, of which by chance not as many as expected are in time.
        CHECK(row == Approx(of_row).margin(0.03));
        found += row / 36, expected += of_row / 36;
      }
      CHECK(found == Approx(expected).margin(0.005));
    }
  }
}
