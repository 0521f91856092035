#pragma once
/// What a benchmark is made of. Every bench/STEM.cpp defines `BenchmarkDefinition
/// benchmark_STEM();` and is then listed and run by `tessera_bench STEM`.

#include <functional>
#include <initializer_list>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include <nlohmann/json.hpp>

namespace tessera {

/// One line of a benchmark's table: values under column names in lower_snake_case with the unit as
/// suffix (`tessera_s`, `peak_bytes`, `ratio`), in the order they are to be shown.
struct BenchmarkRow {
  std::string case_name;
  std::vector<std::pair<std::string, double>> columns;
};

/// What a benchmark is told, and where it puts its rows.
class BenchmarkContext {
 public:
  using Columns = std::vector<std::pair<std::string, double>>;

  /// `is_quick`: less work, same rows; the whole benchmark within 50 s on two cores.
  explicit BenchmarkContext(bool is_quick, std::vector<std::string> given_arguments = {})
      : quick(is_quick), arguments(std::move(given_arguments)) {}

  const bool quick;
  /// In the order of BenchmarkDefinition::arguments; as many as were given.
  const std::vector<std::string> arguments;

  /// `many` or, in a quick run, `few`: for sizes and repeat counts.
  int scaled(int many, int few) const { return quick ? few : many; }

  /// Throws Error when a column name is not lower_snake_case or the value is not finite.
  void add_row(const std::string& case_name, Columns columns);

  const std::vector<BenchmarkRow>& rows() const { return rows_; }

 private:
  std::vector<BenchmarkRow> rows_;
};

struct BenchmarkDefinition {
  std::string name;  ///< the STEM of its file
  std::string help;  ///< one line: what is measured against what
  std::function<void(BenchmarkContext&)> run;
  /// Names of the arguments that may follow the benchmark's own name, all of them optional.
  std::vector<std::string> arguments{};
};

/// `name` for people, with the arguments that the benchmark takes: "dicing [SCENE.rib]".
std::string usage_of(const BenchmarkDefinition& benchmark);

/// Throws Error when there are more than the benchmark takes.
void check_arguments(const BenchmarkDefinition& benchmark,
                     const std::vector<std::string>& arguments);

/// Every benchmark, by name. Generated from the files of bench/.
std::span<const BenchmarkDefinition> benchmark_registry();

/// One of several ways of doing the same work. `run` does it once.
struct Contestant {
  std::string name;
  std::function<void()> run;
};

/// Wall-clock seconds of one contestant over the repeats.
struct Timing {
  std::string name;
  std::vector<double> seconds;  ///< one per repeat, in the order they were run

  double median_s() const;
  double min_s() const;
  double max_s() const;
  /// (max - min) / median.
  double spread() const;
};

/// Runs the contestants in turn, `repeats` times (A B A B ...) after one uncounted warm-up round,
/// so that a change of the machine's load falls on all alike. Each round starts with the next
/// contestant. Returns one Timing per contestant, in the order given.
std::vector<Timing> interleave(const std::vector<Contestant>& contestants, int repeats);

/// Median over the rounds of a's time divided by b's in the same round: how many times faster b is.
/// Both must come from one call of interleave().
double median_ratio(const Timing& a, const Timing& b);

/// Median of a copy of `values`; the mean of the middle two for an even count. Throws when empty.
double median(std::vector<double> values);

/// Seconds that `work` takes on the wall clock, once.
double seconds_of(const std::function<void()>& work);

/// Keeps the optimiser from dropping the computation of `value`.
template <class T>
inline void keep(const T& value) {
  asm volatile("" : : "r,m"(value) : "memory");
}

/// Where this program lies; the renderer is beside it.
std::string program_folder();

/// Table of rows, columns aligned, for people. Rows may have different columns.
std::string format_table(const std::vector<BenchmarkRow>& rows);

/// {"machine": {...}, "command": "...", "rows": [{"case": "...", column: number, ...}]}.
nlohmann::ordered_json benchmark_json(const std::vector<BenchmarkRow>& rows,
                                      const std::string& command);

}  // namespace tessera
