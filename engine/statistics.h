#pragma once
/// What a frame cost: seconds by stage, counts, memory, the plan and every option in force.

#include <cstdint>
#include <iosfwd>
#include <string>
#include <utility>
#include <vector>

#include <nlohmann/json_fwd.hpp>

namespace tessera {

/// How near a frame is known to be to its limit of many samples. Empty unless the settings ask for
/// an error or a time.
struct AccuracyStatistics {
  std::vector<std::pair<std::string, double>> numbers;
  std::vector<std::pair<std::string, std::string>> words;
};

/// Sections of (name, value) in the order they are to be read. Names are lower_snake_case with the
/// unit as suffix.
struct Statistics {
  std::vector<std::pair<std::string, double>> times_s;  ///< stage times are summed over threads
  std::vector<std::pair<std::string, uint64_t>> counts;
  std::vector<std::pair<std::string, double>> ratios;
  std::vector<std::pair<std::string, uint64_t>> memory_bytes;
  AccuracyStatistics accuracy;
  std::vector<std::pair<std::string, double>> heatmap;  ///< per pixel; empty unless asked for
  std::vector<std::pair<std::string, std::string>> plan, options;
  std::vector<std::string> warnings;

  nlohmann::ordered_json json() const;
  /// One line for people.
  std::string summary() const;
  /// Every entry, for --verbose.
  std::string report() const;
};

/// Resident memory high-water mark of this process, bytes.
uint64_t peak_resident_bytes();

}  // namespace tessera
