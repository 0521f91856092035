#pragma once
/// What a benchmark is made of. Every bench/STEM.cpp defines `BenchmarkDefinition
/// benchmark_STEM();` and is then listed and run by `tessera_bench STEM`.

#include <concepts>
#include <functional>
#include <span>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include <nlohmann/json.hpp>

namespace tessera {

/// A value is a number, or words where the table has to say something (a verdict, an oracle).
class BenchmarkValue {
 public:
  template <class Number>
  requires std::integral<Number> || std::floating_point<Number> BenchmarkValue(Number number)
      : value_(double(number)) {}
  BenchmarkValue(const char* words) : value_(std::string(words)) {}
  BenchmarkValue(std::string words) : value_(std::move(words)) {}

  /// The number; throws std::bad_variant_access when the value is words.
  explicit operator double() const { return std::get<double>(value_); }
  BenchmarkValue& operator+=(double more) { return *this = double(*this) + more; }
  /// Null when the value is words.
  const double* number() const { return std::get_if<double>(&value_); }
  /// Null when the value is a number.
  const std::string* words() const { return std::get_if<std::string>(&value_); }

 private:
  std::variant<double, std::string> value_;
};

/// One line of a benchmark's table: values under column names in lower_snake_case with the unit as
/// suffix (`tessera_s`, `peak_bytes`, `ratio`), in the order they are to be shown.
struct BenchmarkRow {
  std::string case_name;
  std::vector<std::pair<std::string, BenchmarkValue>> columns;
};

/// What a benchmark is told, and where it puts its rows.
class BenchmarkContext {
 public:
  using Columns = std::vector<std::pair<std::string, BenchmarkValue>>;

  /// `is_quick`: less work, same rows; the whole benchmark within 50 s on two cores.
  explicit BenchmarkContext(bool is_quick, std::vector<std::string> given_arguments = {})
      : quick(is_quick), arguments(std::move(given_arguments)) {}

  const bool quick;
  /// In the order of BenchmarkDefinition::arguments; as many as were given.
  const std::vector<std::string> arguments;

  /// `many` or, in a quick run, `few`: for sizes and repeat counts.
  int scaled(int many, int few) const { return quick ? few : many; }

  /// Throws Error when a column name is not lower_snake_case or a number is not finite.
  void add_row(const std::string& case_name, Columns columns);
  /// Something did not come out as it must: the program ends with an error that says `what`, after
  /// the table.
  void add_failure(const std::string& what) { failures_.push_back(what); }

  /// Told of every row as soon as it is there: long benchmarks show how far they are, and what they
  /// have measured if they are stopped. May be null.
  std::function<void(const BenchmarkRow&)> on_row{};

  const std::vector<BenchmarkRow>& rows() const { return rows_; }
  const std::vector<std::string>& failures() const { return failures_; }

 private:
  std::vector<BenchmarkRow> rows_;
  std::vector<std::string> failures_;
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

/// A row on a line of its own: the case, then "column value" after "column value".
std::string format_row(const BenchmarkRow& row);

/// Table of rows, columns aligned, for people. Rows may have different columns.
std::string format_table(const std::vector<BenchmarkRow>& rows);

/// {"machine": {...}, "command": "...", "rows": [{"case": "...", column: number or words, ...}]}.
nlohmann::ordered_json benchmark_json(const std::vector<BenchmarkRow>& rows,
                                      const std::string& command);

}  // namespace tessera
