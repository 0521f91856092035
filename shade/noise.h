#pragma once
/// Procedural patterns that can be filtered: each takes the size of a shading cell and fades what
/// the cell cannot hold.

#include <glm/glm.hpp>

namespace tessera {

/// Gradient noise with lattice period 1: zero at lattice points, within [-1, 1], twice
/// differentiable. Zero for coordinates beyond 1e8, where a float no longer resolves the lattice.
float gradient_noise(const glm::vec3& p);

/// Share of an octave of noise at `frequency` that a cell of size `footprint` can show: 1 while the
/// cell is below a quarter of the octave's period, 0 once it is above three quarters.
float octave_share(float footprint, float frequency);

/// Whole octaves of a number asked for, between 0 and 16; none where it is NaN.
int octave_count(float asked);

/// Sum over `octaves` (at most 16) of 2^-k noise(2^k p), band-limited to `footprint` (0: not
/// filtered).
float fractal_noise(const glm::vec3& p, float footprint, int octaves);

/// Sum over `octaves` (at most 16) of 2^-k |noise(2^k p)|. An octave too fine for `footprint` fades
/// to the mean of |noise|, so that a far pattern keeps its colour.
float turbulence(const glm::vec3& p, float footprint, int octaves);

/// The mean over [x - width / 2, x + width / 2] of the square wave of period 2 that is 1 on [0, 1)
/// and -1 on [1, 2).
float filtered_square_wave(float x, float width);

/// The share of white, in [0, 1], in a box of size `width` around (s, t) of a checkerboard of unit
/// squares, white where floor(s) + floor(t) is even. Exact for the axis-aligned box: the board is a
/// product of square waves.
float filtered_checker(glm::vec2 st, glm::vec2 width);

/// The share of white around (s, t) in the parallelogram with edges `x` and `y`, which hold the
/// footprint of a shading cell. Exact along the axes of s and t; otherwise the box that holds the
/// parallelogram, or where it is long and oblique, up to 16 boxes along it.
float checker_over_cell(glm::vec2 st, glm::vec2 x, glm::vec2 y);

}  // namespace tessera
