#pragma once
// Runs made up for tests, and folders.

#include <stdlib.h>

#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include "trade/measurement.h"

namespace tessera::trade {

class TestFolder {
 public:
  TestFolder() {
    std::string name = (std::filesystem::temp_directory_path() / "tessera_trade_XXXXXX").string();
    path_ = mkdtemp(name.data());
  }
  ~TestFolder() { std::filesystem::remove_all(path_); }
  TestFolder(const TestFolder&) = delete;
  TestFolder& operator=(const TestFolder&) = delete;

  std::string operator/(const std::string& name) const { return (path_ / name).string(); }
  std::string write(const std::string& name, const std::string& text) const {
    std::filesystem::create_directories((path_ / name).parent_path());
    std::ofstream(path_ / name, std::ios::binary) << text;
    return *this / name;
  }

 private:
  std::filesystem::path path_;
};

inline std::string text_in(const std::string& path) {
  std::ostringstream text;
  text << std::ifstream(path, std::ios::binary).rdbuf();
  return text.str();
}

inline Configuration configuration(const Turn& turn, int spp) {
  Configuration result;
  result.turn = turn;
  result.spp = spp;
  return result;
}

inline Measurement measurement(const std::string& label, int round, double frame_s,
                               double rel_mse) {
  Measurement result;
  result.label = label;
  result.id = "0001";
  result.round = round;
  result.ok = true;
  result.frame_s = result.wall_s = result.cpu_s = frame_s;
  result.rel_mse = rel_mse;
  result.rmse = rel_mse;
  result.visible = 0;
  result.ste = 0.5;
  result.pixels = "same";
  return result;
}

// A run timed twice, with times that span 2 `half_span` of their median.
inline Run run(const Turn& turn, int spp, double frame_s, double rel_mse, double half_span = 0) {
  Run result;
  result.configuration = configuration(turn, spp);
  result.measured = true;
  result.result = measurement(result.configuration.label(), 0, frame_s, rel_mse);
  result.frame_s_all = {frame_s * (1 - half_span), frame_s * (1 + half_span)};
  return result;
}

}  // namespace tessera::trade
