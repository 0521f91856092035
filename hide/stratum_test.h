#pragma once
/// Testing a micropolygon against the samples of strata, each within its own box of pixels.

#include <span>

#include "hide/pixel_test_job.h"
#include "hide/stratified_samples.h"

namespace tessera {

/// Pixels of a stratum, relative to the bucket's first.
struct StratumBox {
  int stratum = 0;
  PixelRect pixels;
};

/// Tests the samples of `boxes` and returns their number. job.samples are those of `strata`.
uint64_t test_strata(const PixelTestJob& job, const StratifiedSamples& strata, const Quad& quad,
                     uint32_t id0, std::span<const StratumBox> boxes, CoverageCounts& counts);

}  // namespace tessera
