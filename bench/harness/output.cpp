/// Rows as a table for people and as JSON for programs.

#include <algorithm>
#include <cmath>
#include <fstream>
#include <thread>

#include <fmt/format.h>
#include <sys/utsname.h>

#include "bench/harness/benchmark.h"

namespace tessera {
namespace {

/// Whole counts in full, other numbers to four digits, words as they are.
std::string format_value(const BenchmarkValue& of) {
  if (of.words()) return *of.words();
  const double value = *of.number();
  if (value == std::floor(value) && std::abs(value) < 1e15) return fmt::format("{:.0f}", value);
  return fmt::format("{:.4g}", value);
}

/// The value of `key` ("model name") in /proc/cpuinfo or /proc/meminfo; empty when absent.
std::string system_value(const char* file, std::string_view key) {
  std::ifstream stream(file);
  for (std::string line; std::getline(stream, line);) {
    if (!line.starts_with(key)) continue;
    const size_t start = line.find_first_not_of(" \t", line.find(':') + 1);
    return start == line.npos ? "" : line.substr(start);
  }
  return "";
}

nlohmann::ordered_json describe_machine() {
  utsname system{};
  uname(&system);
  const std::string memory_kib = system_value("/proc/meminfo", "MemTotal");
  return {{"cpu", system_value("/proc/cpuinfo", "model name")},
          {"threads", std::thread::hardware_concurrency()},
          {"memory_bytes", std::strtoull(memory_kib.c_str(), nullptr, 10) * 1024},
          {"system", fmt::format("{} {}", system.sysname, system.release)},
          {"compiler", "g++ " __VERSION__}};
}

using Table = std::vector<std::vector<std::string>>;

size_t column_of(const std::vector<std::string>& header, const std::string& name) {
  return size_t(std::find(header.begin() + 1, header.end(), name) - header.begin());
}

/// Every cell as text, the header first. A row leaves the columns that it lacks empty.
Table lay_out(const std::vector<BenchmarkRow>& rows) {
  std::vector<std::string> header{"case"};
  for (const BenchmarkRow& row : rows) {
    for (const auto& column : row.columns) {
      if (column_of(header, column.first) == header.size()) header.push_back(column.first);
    }
  }
  Table table{header};
  for (const BenchmarkRow& row : rows) {
    std::vector<std::string>& cells = table.emplace_back(header.size());
    cells[0] = row.case_name;
    for (const auto& [name, value] : row.columns) {
      cells[column_of(header, name)] = format_value(value);
    }
  }
  return table;
}

}  // namespace

std::string format_row(const BenchmarkRow& row) {
  std::string text = row.case_name;
  for (const auto& [name, value] : row.columns)
    text += fmt::format("  {} {}", name, format_value(value));
  return text;
}

std::string format_table(const std::vector<BenchmarkRow>& rows) {
  const Table table = lay_out(rows);
  std::vector<size_t> widths(table.front().size());
  for (const auto& cells : table) {
    for (size_t i = 0; i < cells.size(); ++i) widths[i] = std::max(widths[i], cells[i].size());
  }
  // Words begin at the left of their column, numbers end at the right.
  std::vector<bool> of_words(widths.size());
  for (const BenchmarkRow& row : rows) {
    for (const auto& [name, value] : row.columns) {
      if (value.words()) of_words[column_of(table[0], name)] = true;
    }
  }
  std::string text;
  for (const auto& cells : table) {
    text += fmt::format("{:<{}}", cells[0], widths[0]);
    for (size_t i = 1; i < cells.size(); ++i) {
      text += of_words[i] ? fmt::format("  {:<{}}", cells[i], widths[i])
                          : fmt::format("  {:>{}}", cells[i], widths[i]);
    }
    text += '\n';
  }
  return text;
}

nlohmann::ordered_json benchmark_json(const std::vector<BenchmarkRow>& rows,
                                      const std::string& command) {
  nlohmann::ordered_json json{{"machine", describe_machine()},
                              {"command", command},
                              {"rows", nlohmann::ordered_json::array()}};
  for (const BenchmarkRow& row : rows) {
    nlohmann::ordered_json entry{{"case", row.case_name}};
    for (const auto& [name, value] : row.columns) {
      if (value.words())
        entry[name] = *value.words();
      else
        entry[name] = *value.number();
    }
    json["rows"].push_back(entry);
  }
  return json;
}

}  // namespace tessera
