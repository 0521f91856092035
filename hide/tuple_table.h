#pragma once
/// Which tuples a frame has, and whether they suit its samples.

#include "hide/samples.h"

namespace tessera {

/// More tuples than this have no points in the table of the Sobol sequence.
inline constexpr int max_tuples = 1 << 17;

/// Throws Error, naming the counts that would do, unless `tuples` come out even over so many
/// samples a pixel.
void check_tuples(const SampleTuples& tuples, int samples_per_pixel);

/// The tuples of interleaved and accumulated samples, numbered in order of time; empty for other
/// kinds.
TupleTable make_tuple_table(const SampleTuples& tuples, uint32_t seed, const SampleWarps& warps);

}  // namespace tessera
