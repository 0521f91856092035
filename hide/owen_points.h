#pragma once
/// SIMD part of the sample pattern: scrambled coordinates and the disc lens.

#include <cstddef>
#include <cstdint>

namespace tessera {

/// out[k] = owen-scrambled coordinate of sobol[k] (reversed digits, see sobol.h) in [0, 1), a
/// multiple of 2^-24. Reads and writes whole vectors.
void scramble_points(const uint32_t* sobol, size_t count, uint32_t seed, float* out);

/// out[k] = pixel + owen-scrambled coordinate, kept below pixel + 1 where the sum would round to
/// it.
void scramble_positions(const uint32_t* sobol, size_t count, uint32_t seed, float pixel,
                        float* out);

/// The concentric map of the square to the unit disc, in place: (u, v) <- disc(u, v). The same
/// distribution and orientation as the "disc" lens profile, within a few units in the last place.
void warp_to_disc(float* u, float* v, size_t count);

}  // namespace tessera
