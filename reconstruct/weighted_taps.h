#pragma once
/// One pass along an axis with weights that differ from pixel to pixel, for a run of pixels.

#include <cstddef>

namespace tessera {

/// Pixels of a run. Weights and outputs hold this many.
inline constexpr size_t tap_run = 64;

/// Moments to step along, and which function's weights they take.
struct TapTerm {
  const float*
      first;  ///< the value for tap 0 of the run's first pixel; pixels lie next to each other
  size_t function;
};

/// Weights [function][tap][pixel of the run] over taps [tap_begin, tap_end) of `taps`.
struct TapWeights {
  const float* values;
  size_t taps, tap_begin, tap_end;
};

/// out[x] = sum over terms i and taps t of weights[function_i][t][x] * first_i[t * tap_stride + x],
/// in that order for each pixel whatever the vector width. Reads tap_run pixels of each tap.
void sum_taps(const TapTerm* terms, size_t term_count, const TapWeights& weights, size_t tap_stride,
              float* out);

}  // namespace tessera
