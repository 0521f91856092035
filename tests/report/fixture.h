#pragma once
/// A small trade table with images in closed form, for the tests of the report and of its page.

#include <filesystem>

#include <nlohmann/json.hpp>

#include "images/image.h"

namespace tessera::fixture {

inline constexpr int width = 64, height = 36;
inline constexpr int large_width = 1282, large_height = 4;

/// R = gain (x + 1/2) / columns, G = gain (y + 1/2) / rows, B = gain / 4.
Image gradient(double gain, int columns = width, int rows = height);

/// Thirteen runs and their reference (gain 1). Run k, from 1, has gain 1 + k / 16; run 5 has
/// besides NaN at (10, 5), 1e30 at (20, 5), infinity in R at (30, 5) and -1 at (40, 5); run 8's
/// label is HTML; run 11's image is larger than a page holds; run 12 failed with a message that is
/// HTML; run 13 was left out. Runs 1 and 4 have heat maps "tests": pixel (x, y) holds x and 4 x.
nlohmann::ordered_json table();

/// Writes the table (trade.json) and its images into `folder`, which is made.
void write(const std::filesystem::path& folder);

/// A folder that is deleted with its content at the end.
class TemporaryFolder {
 public:
  TemporaryFolder();
  ~TemporaryFolder();
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;
  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

}  // namespace tessera::fixture
