#include "report/report.h"

#include <fstream>

#include <nlohmann/json.hpp>

#include "base/error.h"
#include "images/atomic_file.h"
#include "report/embedding.h"
#include "report/page_template.h"

namespace tessera {
namespace {

using Json = nlohmann::ordered_json;

Json describe(const Embedding& embedding, size_t budget_bytes) {
  Json embedded = Json::object(), left_out = Json::array();
  int number = 0;
  for (const ReportImage& image : embedding.images)
    embedded[image.key] = {{"element", fmt::format("pixels-{}", number++)},
                           {"width", image.encoded.width},
                           {"height", image.encoded.height},
                           {"reduction", image.reduction},
                           {"kind", image.measure.empty() ? "colour" : "scalar"}};
  for (const ReportImage& image : embedding.left_out)
    left_out.push_back({{"key", image.key}, {"what", image.what}});
  return {{"budget_bytes", budget_bytes},
          {"bytes", embedding.bytes},
          {"images", std::move(embedded)},
          {"left_out", std::move(left_out)}};
}

void write_data(std::ostream& out, const Json& table, const Embedding& embedding,
                size_t budget_bytes) {
  out << "<script type=\"application/json\" id=\"trade-table\">" << script_json(table)
      << "</script>\n<script type=\"application/json\" id=\"trade-images\">"
      << script_json(describe(embedding, budget_bytes)) << "</script>\n";
  int number = 0;
  for (const ReportImage& image : embedding.images)
    out << "<script type=\"text/plain\" id=\"pixels-" << number++ << "\">" << image.encoded.text
        << "</script>\n";
}

}  // namespace

std::string script_json(const Json& value) {
  // "<" occurs in JSON inside strings only, where it may be written as an escape. Without it
  // neither
  // "</script" nor "<!--" can be read as HTML.
  const std::string json = value.dump(-1, ' ', false, Json::error_handler_t::replace);
  std::string text;
  text.reserve(json.size());
  for (const char c : json) {
    if (c == '<')
      text += "\\u003c";
    else
      text += c;
  }
  return text;
}

void write_report(const Json& table, const std::filesystem::path& folder,
                  const std::filesystem::path& page, size_t image_bytes) {
  const Embedding embedding = embed_images(table, folder, image_bytes);
  const std::string_view html = report_page_template();
  const size_t marker = html.find(report_data_marker);
  if (marker == std::string_view::npos) throw Error("the built page has no place for its data");

  AtomicFile file(page.string());
  std::ofstream out(file.temporary_path(), std::ios::binary);
  out << html.substr(0, marker);
  write_data(out, table, embedding, image_bytes);
  out << html.substr(marker + report_data_marker.size());
  out.close();
  if (!out) throw Error(fmt::format("cannot write {}: is the disc full?", page.string()));
  file.commit();
}

}  // namespace tessera
