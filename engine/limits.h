#pragma once
/// How much may be asked for: by options, by Settings and by scene files alike.

#include <cstddef>

namespace tessera {

inline constexpr int max_samples_per_pixel = 1 << 16;
inline constexpr int max_extra_samples = 4096;
inline constexpr double max_error = 1e6;
inline constexpr double max_time_s = 1e7;
inline constexpr int max_resolution = 1 << 15;  ///< of an option; pixels along a side
/// Beyond this side a bucket's samples outgrow any cache for no gain.
inline constexpr int max_bucket_size = 4096;
inline constexpr int max_grid_size = 256;  ///< micropolygons along a side
inline constexpr int max_threads = 1024;
inline constexpr size_t max_memory_mib = size_t(1) << 24;

}  // namespace tessera
