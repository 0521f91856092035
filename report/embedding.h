#pragma once
/// Which images of a trade table go into its page.

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "report/encode.h"

namespace tessera {

/// An image that a trade table names.
struct ReportImage {
  std::string key;      ///< how the page asks for it: FILE, or FILE#MEASURE for a heat map
  std::string file;     ///< as the table has it
  std::string what;     ///< for people: "reference", "run 0007", "tests of run 0007"
  std::string measure;  ///< of a heat map: tests, shading, extra; empty for a colour image
  EncodedImage encoded;
  int reduction = 1;  ///< n: each pixel encoded is the mean of n x n of the file's
};

/// What goes into a page, and what was left out because it would have grown too large.
struct Embedding {
  std::vector<ReportImage> images, left_out;
  size_t bytes = 0;  ///< of the text of `images`
};

/// Images of the table in the order in which a page wants them: the reference; runs of which only
/// the number of samples was set; the Pareto front; heat maps of those; all other runs; their heat
/// maps. Not read yet.
std::vector<ReportImage> images_by_importance(const nlohmann::ordered_json& table);

/// Reads and encodes them in that order, large ones made smaller (report/scale_down.h), up to
/// `budget_bytes` of text. The first image of a size
/// that no longer fits ends the images in colour; heat maps, which are smaller, may go on, and end
/// in the same way. Throws Error when a file is missing, left out or not, or is no readable image.
Embedding embed_images(const nlohmann::ordered_json& table, const std::filesystem::path& folder,
                       size_t budget_bytes);

}  // namespace tessera
