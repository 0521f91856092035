// The table as text and as CSV.

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "trade/table.h"

namespace tessera::trade {
namespace {

using Cells = std::vector<std::string>;

std::string number(double value, int digits = 3) {
  return std::isnan(value) ? "-" : fmt::format("{:.{}g}", value, digits);
}

std::string csv_number(double value) {
  return std::isfinite(value) ? fmt::format("{:.9g}", value) : std::string();
}

std::string quoted(const std::string& text) {
  std::string all = "\"";
  for (const char letter : text)
    all += letter == '"' ? std::string("\"\"") : std::string(1, letter);
  return all + "\"";
}

/// Columns as wide as their widest cell: the first two to the left, numbers to the right.
std::string aligned(const std::vector<Cells>& rows, size_t left_columns) {
  std::vector<size_t> widths;
  for (const Cells& row : rows) {
    widths.resize(std::max(widths.size(), row.size()));
    for (size_t i = 0; i < row.size(); ++i) widths[i] = std::max(widths[i], row[i].size());
  }
  std::string text;
  for (const Cells& row : rows) {
    std::string line;
    for (size_t i = 0; i < row.size(); ++i)
      line += i < left_columns ? fmt::format("{:<{}}  ", row[i], widths[i])
                               : fmt::format("{:>{}}  ", row[i], widths[i]);
    line.erase(line.find_last_not_of(' ') + 1);
    text += line + "\n";
  }
  return text;
}

Cells run_cells(const Run& run) {
  const Measurement& r = run.result;
  const std::string spread =
      run.frame_s_all.size() < 2 ? std::string("-") : fmt::format("{:.0f}%", 100 * run.spread());
  return {fmt::format("{}{}", run.pareto ? "*" : "", run.limited ? "~" : ""),
          run.configuration.label(),
          number(r.rel_mse),
          number(r.rmse),
          fmt::format("{:.3g}%", 100 * r.visible),
          fmt::format("{:.3f}", r.frame_s),
          spread,
          fmt::format("{:.3f}", r.wall_s),
          fmt::format("{:.3f}", r.cpu_s),
          fmt::format("{:.0f}", double(r.peak_bytes) / (1024.0 * 1024.0)),
          std::to_string(r.samples),
          std::to_string(r.shaded_points),
          std::to_string(r.rays),
          std::isnan(r.ste) ? "-" : fmt::format("{:.1f}%", 100 * r.ste)};
}

std::vector<const Run*> by_error(const std::vector<Run>& runs) {
  std::vector<const Run*> order;
  for (const Run& run : runs)
    if (run.ok()) order.push_back(&run);
  std::stable_sort(order.begin(), order.end(), [](const Run* a, const Run* b) {
    const double x = a->result.rel_mse, y = b->result.rel_mse;
    return x != y ? x < y : a->result.frame_s < b->result.frame_s;
  });
  return order;
}

const char* state_of(const Run& run) {
  if (!run.measured) return "not run";
  return run.ok() ? "ok" : "failed";
}

std::string cell_text(const nlohmann::ordered_json& cell) {
  if (cell.is_null()) return "-";
  return cell.is_number() ? number(cell.get<double>(), 4) : cell.get<std::string>();
}

}  // namespace

std::string csv_of(const std::vector<Run>& runs) {
  std::string text =
      "id,label,state,ok,error,frame_s,frame_s_spread,repeats,wall_s,cpu_s,peak_bytes,rays,shaded_"
      "points,"
      "samples,ste,rmse,rel_mse,visible,pareto,limited_by_reference,options\n";
  for (const Run& run : runs) {
    const Measurement& r = run.result;
    text +=
        fmt::format("{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{}\n",
                    run.configuration.id, quoted(run.configuration.label()), state_of(run),
                    int(run.ok()), quoted(r.error), csv_number(r.frame_s), csv_number(run.spread()),
                    run.frame_s_all.size(), csv_number(r.wall_s), csv_number(r.cpu_s), r.peak_bytes,
                    r.rays, r.shaded_points, r.samples, csv_number(r.ste), csv_number(r.rmse),
                    csv_number(r.rel_mse), csv_number(r.visible), int(run.pareto), int(run.limited),
                    quoted(fmt::format("{}", fmt::join(run.configuration.options, " "))));
  }
  return text;
}

std::string text_of(const TradeTable& table) {
  std::vector<Cells> rows{{"", "run", "relMSE", "RMSE", "visible", "frame s", "spread", "wall s",
                           "cpu s", "peak MiB", "samples", "shaded", "rays", "STE"}};
  for (const Run* run : by_error(table.runs)) rows.push_back(run_cells(*run));
  std::string text =
      fmt::format("{}, errors against {}\n\n", table.scene,
                  table.reference.spp > 0
                      ? fmt::format("a reference of {} samples per pixel", table.reference.spp)
                      : "the given reference");
  text += aligned(rows, 2);
  text += "\n*: on the front of frame time against relMSE.  ~: limited by the reference";
  text += std::isnan(table.reference.rel_mse)
              ? ", of which nothing is known here.\n"
              : fmt::format(", whose own relMSE is {:.2g}.\n", table.reference.rel_mse);
  text +=
      "spread: half of what the repeats' frame times span, of their median.  STE: samples covered "
      "over "
      "samples tested.\n";
  for (const Run& run : table.runs)
    if (run.measured && !run.ok())
      text += fmt::format("failed: {}: {}\n", run.configuration.label(), run.result.error);
  for (const std::string& note : table.list.notes) text += fmt::format("{}\n", note);
  return text;
}

std::string text_of_extra(const nlohmann::ordered_json& table) {
  std::vector<Cells> rows;
  Cells& header = rows.emplace_back();
  for (const auto& column : table.at("columns")) {
    std::string name = column.at("name");
    if (column.contains("unit")) name += " [" + column.at("unit").get<std::string>() + "]";
    header.push_back(name);
  }
  for (const auto& row : table.at("rows")) {
    Cells& cells = rows.emplace_back();
    for (const auto& cell : row) cells.push_back(cell_text(cell));
  }
  std::string text =
      fmt::format("{}\n\n{}\n", table.at("title").get<std::string>(), aligned(rows, 1));
  for (const auto& note : table.at("notes")) text += note.get<std::string>() + "\n";
  return text;
}

}  // namespace tessera::trade
