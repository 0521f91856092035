#pragma once
/// The extremes table, hide: the cases of tests/hide/extreme_cases.h, and planes one behind the
/// other at equal or nearly equal depths and edge-on to the eye.

#include "bench/extremes_table.h"
#include "tests/hide/extreme_tally.h"

namespace tessera {

/// Planes through the eye but for `tilt` radians, standing and lying, moving or not.
inline TestBucket edge_on_bucket(int k, float tilt) {
  CameraSettings settings = extreme_settings();
  if (k % 2) open_lens(settings, 0.1, 2.5);
  TestBucket bucket(settings);
  ExtremeRandom random(k);
  QuadKeys keys(k / 2 % 2 ? 2 : 1);
  for (auto& corners : keys) {
    const float slope = random.between(-0.1f, 0.1f);
    for (int c = 0; c < 4; ++c) {
      const float z = c % 2 ? random.between(3.5f, 5.0f) : random.between(1.5f, 2.5f);
      const float across = z * (slope + tilt * random.between(-1, 1));
      const float along = (c / 2 ? 0.4f : -0.4f) * z;
      corners[size_t(c)] = k / 4 % 2 ? glm::vec3(along, across, z) : glm::vec3(across, along, z);
    }
  }
  add_quad(bucket, keys);
  return sampled(std::move(bucket), k);
}

inline void add_hide_case(ExtremesTable& table, const ExtremeCase& extreme, int rounds) {
  const ExtremeRun what{.hiders = {"shear"}, .other = "bbox", .tuples = {}, .rounds = rounds};
  const ExtremeTally t = tally_extremes(extreme, what).front();
  WorstError error{double(t.disagreements + t.hider_differences), double(t.samples)};
  table.add({"hide", extreme.name, "long double rays; bbox bit for bit", error, "samples", 0,
             fmt::format("{} hits, {} doubtful, {} differ from rays, {} from bbox, depth {:.2g}",
                         t.oracle_hits, t.doubtful, t.disagreements, t.hider_differences,
                         t.worst_depth_error)});
}

/// A facing square at each of `depths`, in that order; every sample must see square `first`, and
/// only it, at its depth.
inline WorstError see_stack(const std::vector<float>& depths, size_t first, int rounds) {
  WorstError error;
  for (int k = 0; k < rounds; ++k) {
    for (const char* hider : {"shear", "bbox"}) {
      CameraSettings settings = extreme_settings();
      if (k % 2) open_lens(settings, 0.05 * double(depths[0]), 0.8 * double(depths[0]));
      TestBucket bucket(settings);
      for (const float z : depths) {
        QuadKeys keys(k / 2 % 2 ? 2 : 1);
        for (size_t key = 0; key < keys.size(); ++key)
          for (int c = 0; c < 4; ++c)
            keys[key][size_t(c)] =
                glm::vec3((c % 2 ? z : -z) + 0.1f * z * float(key), c / 2 ? z : -z, z);
        add_quad(bucket, keys);
      }
      bucket = sampled(std::move(bucket), k);
      const FragmentList list = bucket.hide(hider);
      for (size_t s = 0; s < bucket.samples.size(); ++s) {
        const size_t f = list.first_of_sample[s];
        const bool one = list.first_of_sample[s + 1] == f + 1;
        error.see(one && list.grid[f] == first ? 0.0 : 1.0);
      }
    }
  }
  return error;
}

inline void add_hide_extremes(ExtremesTable& table) {
  for (const ExtremeCase& extreme : extreme_cases())
    add_hide_case(table, extreme, table.scaled(10, 1));
  for (const auto& [name, tilt] : {std::pair{"edge_on", 0.0f}, {"edge_on_1em6", 1e-6f}})
    add_hide_case(table, {name, 48, [tilt = tilt](int k) { return edge_on_bucket(k, tilt); }},
                  table.scaled(10, 1));
  const int rounds = table.scaled(200, 20);
  for (const float z : {1e-2f, 3.0f, 1e7f}) {
    table.add({"hide", fmt::format("coincident depths at {:g}", z), "the first grid is in front",
               see_stack({z, z, z}, 0, rounds), "of samples", 0});
    // Depth is interpolated in float: 16 roundings apart is told apart.
    const float behind = z * (1 + 16 * 0x1p-23f);
    table.add({"hide", fmt::format("depths 2e-6 apart at {:g}", z), "the nearer is in front",
               see_stack({behind, z, behind}, 1, rounds), "of samples", 0});
  }
}

}  // namespace tessera
