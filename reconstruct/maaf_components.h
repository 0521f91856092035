#pragma once
/// The components of MAAF in frequency space (L. Wu et al., "Multiple axis-aligned filters for
/// rendering of combined distribution effects", EGSR 2017, equations 6 to 8 and 24).

#include <algorithm>

namespace tessera {

/// A Gaussian along one frequency axis, radians per unit.
struct Band {
  double centre = 0, deviation = 0;
};

/// One of the components p = 0, 1, .. N - 1 of M = 2 N - 1; those of -p are point mirrored. Slopes
/// 0 < s_min <= s_max; `band`: W, the end of the spectrum along y.
struct MaafComponent {
  int p, count;
  double band;

  /// The strip of y frequencies that the component covers, W (2 p -+ 1) / M (equations 6 and 8).
  double y_begin() const { return band * (2 * p - 1) / count; }
  double y_end() const { return band * (2 * p + 1) / count; }

  Band along_y() const { return {band * 2 * p / count, band / count}; }

  /// The x frequencies of the wedge in that strip (equations 7 and 8).
  Band along_x(double s_min, double s_max) const {
    return p == 0 ? Band{0.0, y_end() / s_min} : between(y_begin() / s_max, y_end() / s_min);
  }

  /// What a second effect with slopes u_min to u_max shows at the x frequencies of the first
  /// effect's component, up to that effect's own band W. Equation 24 prints s_u_min / s_u_max; the
  /// x frequencies run from y_begin / s_max to y_end / s_min, with the slopes of the first effect.
  Band along_u(double s_min, double s_max, double u_min, double u_max) const {
    const double end = std::min(band, y_end() * u_max / s_min);
    return p == 0 ? Band{0.0, end} : between(std::min(band, y_begin() * u_min / s_max), end);
  }

 private:
  static Band between(double begin, double end) {
    return {0.5 * (begin + end), 0.5 * (end - begin)};
  }
};

}  // namespace tessera
