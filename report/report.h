#pragma once
/// A trade table as a page: one HTML file that opens in any browser without a network.
///
/// The page shows the summary, a plot of error against cost (log-log; axes to choose) with its
/// Pareto front, any two images laid over each other with a slider between them (zoom, exposure,
/// relative error in false colour, heat maps), all runs in a table that sorts, and the tables
/// besides. Its source is report/page/, bundled at build time and compiled into the program.
///
/// The data are in it as inert script elements, which no text inside them can end:
///   trade-table    the table as it came, JSON
///   trade-images   JSON: which images are embedded, their size, of how many pixels each way those
///                  of large ones are the means, which were left out
///   pixels-N       the text of an EncodedImage (report/encode.h)

#include <cstddef>
#include <filesystem>
#include <string>

#include <nlohmann/json_fwd.hpp>

namespace tessera {

/// Bytes of text that images may take in a page: about eighty of 480 x 270, or twenty of 1920 x
/// 1080, which are held at half their size.
inline constexpr size_t default_report_image_bytes = 32'000'000;

/// Writes one self-contained HTML page. `table`: a trade table; files in it are relative to
/// `folder`. Images beyond `image_bytes` are left out, the least important first, and named in the
/// page. Throws Error when an image is missing or `page` cannot be written, which then stays as it
/// was.
void write_report(const nlohmann::ordered_json& table, const std::filesystem::path& folder,
                  const std::filesystem::path& page,
                  size_t image_bytes = default_report_image_bytes);

/// JSON that may stand inside a script element: no '<' in it, and no byte that is not UTF-8.
std::string script_json(const nlohmann::ordered_json& value);

}  // namespace tessera
