#include "bench/harness/benchmark.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <numeric>

#include <fmt/format.h>

#include "base/error.h"

namespace tessera {
namespace {

bool is_lower_snake_case(const std::string& name) {
  const auto allowed = [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '_';
  };
  return !name.empty() && name.front() >= 'a' && name.front() <= 'z' &&
         std::all_of(name.begin(), name.end(), allowed);
}

}  // namespace

void BenchmarkContext::add_row(const std::string& case_name, Columns columns) {
  for (const auto& [name, value] : columns) {
    if (!is_lower_snake_case(name)) {
      throw Error(fmt::format("benchmark column '{}': expected lower_snake_case", name));
    }
    const double* number = value.number();
    if (number && !std::isfinite(*number)) {
      throw Error(fmt::format("benchmark case {}: column {} is {}", case_name, name, *number));
    }
  }
  rows_.push_back({case_name, std::move(columns)});
  if (on_row) on_row(rows_.back());
}

std::string usage_of(const BenchmarkDefinition& benchmark) {
  std::string usage = benchmark.name;
  for (const std::string& argument : benchmark.arguments) usage += fmt::format(" [{}]", argument);
  return usage;
}

void check_arguments(const BenchmarkDefinition& benchmark,
                     const std::vector<std::string>& arguments) {
  if (arguments.size() <= benchmark.arguments.size()) return;
  throw Error(fmt::format("unexpected argument '{}': expected {}{}",
                          arguments[benchmark.arguments.size()], usage_of(benchmark),
                          benchmark.arguments.empty() ? ", which takes no arguments" : ""));
}

double median(std::vector<double> values) {
  if (values.empty()) throw Error("median of no values");
  std::sort(values.begin(), values.end());
  const size_t middle = values.size() / 2;
  return values.size() % 2 ? values[middle] : 0.5 * (values[middle - 1] + values[middle]);
}

double Timing::median_s() const { return median(seconds); }
double Timing::min_s() const { return *std::min_element(seconds.begin(), seconds.end()); }
double Timing::max_s() const { return *std::max_element(seconds.begin(), seconds.end()); }
double Timing::spread() const { return (max_s() - min_s()) / median_s(); }

double seconds_of(const std::function<void()>& work) {
  const auto start = std::chrono::steady_clock::now();
  work();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

std::vector<Timing> interleave(const std::vector<Contestant>& contestants, int repeats) {
  if (repeats < 1) throw Error(fmt::format("{} repeats: expected at least 1", repeats));
  std::vector<Timing> timings;
  for (const Contestant& contestant : contestants) {
    timings.push_back({contestant.name, {}});
    contestant.run();
  }
  const size_t count = contestants.size();
  for (size_t round = 0; round < size_t(repeats); ++round) {
    for (size_t turn = 0; turn < count; ++turn) {
      const size_t i = (round + turn) % count;
      timings[i].seconds.push_back(seconds_of(contestants[i].run));
    }
  }
  return timings;
}

double median_ratio(const Timing& a, const Timing& b) {
  if (a.seconds.size() != b.seconds.size()) {
    throw Error(fmt::format("{} and {} were not run together", a.name, b.name));
  }
  std::vector<double> ratios;
  for (size_t i = 0; i < a.seconds.size(); ++i) ratios.push_back(a.seconds[i] / b.seconds[i]);
  return median(ratios);
}

std::string program_folder() {
  return std::filesystem::read_symlink("/proc/self/exe").parent_path().string();
}

}  // namespace tessera
