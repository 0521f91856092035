#pragma once
/// A hider on an extreme case: against long double rays, and against the brute-force hider.

#include "tests/hide/extreme_cases.h"
#include "tests/hide/ray_oracle.h"

namespace tessera {

struct ExtremeTally {
  size_t samples = 0;
  size_t oracle_hits = 0;        ///< samples at which the rays meet something
  size_t doubtful = 0;           ///< samples at which rounding decides; not compared
  size_t disagreements = 0;      ///< of the hider with the rays, among the others
  size_t hider_differences = 0;  ///< samples at which two hiders' fragments are not the same bits
  double worst_depth_error = 0;  ///< relative, among the compared
  int first_disagreement = -1, first_difference = -1;  ///< variant of the case; -1: none
};

/// Samples at which two fragment lists are not equal bit for bit.
inline size_t count_differences(const FragmentList& a, const FragmentList& b) {
  size_t count = 0;
  for (size_t s = 0; s + 1 < a.first_of_sample.size(); ++s) {
    const size_t i = a.first_of_sample[s], j = b.first_of_sample[s];
    const size_t length = a.first_of_sample[s + 1] - i;
    bool same = b.first_of_sample[s + 1] - j == length;
    for (size_t k = 0; same && k < length; ++k)
      same = a.grid[i + k] == b.grid[j + k] && a.triangle[i + k] == b.triangle[j + k] &&
             a.z[i + k] == b.z[j + k] && a.b1[i + k] == b.b1[j + k] && a.b2[i + k] == b.b2[j + k];
    count += !same;
  }
  return count;
}

/// How extreme cases are run.
struct ExtremeRun {
  std::vector<const char*> hiders;
  const char* other = nullptr;  ///< compared bit for bit; null: none
  /// Other samples than free ones; buckets with a closed lens are left out then.
  SampleTuples tuples;
  int rounds = 1;  ///< of all variants
};

inline void tally_bucket(const TestBucket& bucket, int variant, const ExtremeRun& run,
                         std::vector<ExtremeTally>& tallies) {
  std::vector<RayHit> rays;
  for (size_t s = 0; s < bucket.samples.size(); ++s) rays.push_back(trace(bucket, s));
  const FragmentList other = run.other ? bucket.hide(run.other) : FragmentList{};
  for (size_t h = 0; h < run.hiders.size(); ++h) {
    ExtremeTally& tally = tallies[h];
    const FragmentList list = bucket.hide(run.hiders[h]);
    tally.samples += rays.size();
    for (size_t s = 0; s < rays.size(); ++s) {
      tally.oracle_hits += rays[s].layers > 0, tally.doubtful += rays[s].doubtful;
      if (rays[s].doubtful) continue;
      const Comparison c = compare(rays[s], list, s);
      if (!c.agrees && tally.disagreements++ == 0) tally.first_disagreement = variant;
      tally.worst_depth_error = std::max(tally.worst_depth_error, double(c.depth_error));
    }
    const size_t differences = run.other ? count_differences(list, other) : 0;
    if (differences > 0 && tally.hider_differences == 0) tally.first_difference = variant;
    tally.hider_differences += differences;
  }
}

/// One tally for each hider.
inline std::vector<ExtremeTally> tally_extremes(const ExtremeCase& extreme, const ExtremeRun& run) {
  std::vector<ExtremeTally> tallies(run.hiders.size());
  for (int k = 0; k < run.rounds * extreme.count; ++k) {
    TestBucket bucket = extreme.make(k);
    if (run.tuples.kind != SampleTuples::Kind::free) {
      if (!bucket.lens) continue;
      const SampleBlock& samples = bucket.samples;
      bucket.make_samples(samples.rect, samples.samples_per_pixel, uint32_t(k), run.tuples);
    }
    tally_bucket(bucket, k, run, tallies);
  }
  return tallies;
}

}  // namespace tessera
