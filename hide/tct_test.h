#pragma once
/// The coverage test of the `tct` hider: runs of samples against the time-dependent edge functions
/// of one micropolygon.

#include <span>

#include "hide/fragment_buffer.h"
#include "hide/tct_edges.h"

namespace tessera {

/// Samples [begin, end) of the arrays of a TctJob.
struct SampleRun {
  size_t begin, end;
};

/// One segment of a grid against samples, and where its hits go.
struct TctJob {
  CoverageFrame frame;
  SampleArrays samples;
  const uint32_t* index = nullptr;  ///< [sample]: index in the fragment buffer; null: its own
  FragmentBuffer* buffer = nullptr;
  bool motion = false, lens = false, opaque = true;
};

/// Tests every sample of the runs; the micropolygon's triangles are id0 and id0 + 1. Micropolygons
/// must come in order of their ids.
///
/// A triangle covers a sample if its three edge functions are all positive or all negative. One of
/// exactly zero counts as TimeEdges::tie says, so that two triangles that share an edge and compute
/// the same zero do not both have the sample, or neither; unlike the test of hide/coverage.h, two
/// micropolygons need not compute the same, as each rounds about its own reference point.
void test_time_edges(const TctJob& job, const TimeEdges& edges, uint32_t id0,
                     std::span<const SampleRun> runs, CoverageCounts& counts);

}  // namespace tessera
