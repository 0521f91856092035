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

/// `hider` against the rays, and if `other` is not null against that hider, on `rounds` rounds of
/// variants.
inline ExtremeTally tally_extremes(const ExtremeCase& extreme, const char* hider, const char* other,
                                   int rounds = 1) {
  ExtremeTally tally;
  for (int k = 0; k < rounds * extreme.count; ++k) {
    const TestBucket bucket = extreme.make(k);
    const FragmentList list = bucket.hide(hider);
    tally.samples += bucket.samples.size();
    for (size_t s = 0; s < bucket.samples.size(); ++s) {
      const Comparison c = compare(bucket, s, list);
      tally.oracle_hits += c.hit, tally.doubtful += c.doubtful;
      if (!c.agrees && tally.disagreements++ == 0) tally.first_disagreement = k;
      tally.worst_depth_error = std::max(tally.worst_depth_error, double(c.depth_error));
    }
    if (!other) continue;
    const size_t differences = count_differences(list, bucket.hide(other));
    if (differences > 0 && tally.hider_differences == 0) tally.first_difference = k;
    tally.hider_differences += differences;
  }
  return tally;
}

}  // namespace tessera
