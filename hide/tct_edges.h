#pragma once
/// Time-dependent edge functions: the setup of the `tct` hider's coverage test (after
/// Akenine-Moller, Munkberg and Hasselgren, "Stochastic Rasterization using Time-Continuous
/// Triangles", 2007).
///
/// Corner i as the sample (x, y, u, v, t) sees it is dx = X + u cx - x W, dy = Y + v cy - y W, with
/// X, Y, W and the circles of confusion cx, cy all linear in s = tau - 1/2, tau the time in the
/// segment. Multiplied out, the edge function e_ij = dx_i dy_j - dx_j dy_i is
///
///   K + v P + u Q - y (S + u T) - x (U + v V)
///
/// with seven quadratic polynomials in s, each of the form f_i g_j - f_j g_i:
///
///   K: X, Y    P: X, cy    Q: cx, Y    S: X, W    T: cx, W    U: W, Y    V: W, cy.
///
/// The eighth, of u v, is cx_i cy_j - cx_j cy_i. It is left out: a thin lens has cx and cy
/// proportional at every depth (cameras/camera.h), and what the rounding of their coefficients to
/// float leaves of it is the size of one rounding of u v cx cy.
///
/// **Accuracy.** On a raster of thousands of pixels K and x U are millions of times the area of a
/// micropolygon. Positions are therefore relative to a reference point near it, a whole pixel, so
/// that subtracting it from a sample rounds nothing; the coefficients are computed in double, where
/// the products still cancel, and only then rounded to float. Motion is counted from the middle of
/// the segment, which halves what is left.

#include "base/raster.h"
#include "hide/quad.h"

namespace tessera {

struct TimeEdges {
  static constexpr int edge_count = 5;  ///< ab, bd, da, dc, ca
  enum Term { K, S, U, P, Q, T, V, term_count };
  static constexpr int pinhole_term_count = 3;  ///< without a lens, the first three

  /// Of 1, s and s^2; the last two are set only if the segment moves. All edges of a micropolygon
  /// are scaled by one positive number that keeps them within the range of float.
  float coefficient[edge_count][term_count][3];
  /// Stands in for an edge function of exactly zero: smallest normal floats whose sign depends on
  /// the two corners alone and changes when they change places; 0 if the corners are equal.
  float tie[edge_count];
  float x_reference = 0, y_reference = 0;  ///< subtracted from the samples, pixels
  float z[4], dz[4];                       ///< camera depth of the corners at s = 0, and per s
};

/// `moves`: the segment has deltas. `lens`: the samples have u and v. `rect` is the bucket.
TimeEdges set_up_time_edges(const Quad& quad, const CoverageFrame& frame, bool moves, bool lens,
                            const PixelRect& rect);

}  // namespace tessera
