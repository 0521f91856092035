#pragma once
/// What a row of the extremes table holds, and how errors become one number.

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include <fmt/format.h>

#include "bench/harness/benchmark.h"

namespace tessera {

/// The largest of many errors. One that is not a number counts as infinite.
struct WorstError {
  double worst = 0, count = 0;

  void see(double error) {
    ++count;
    worst = std::max(worst, std::isnan(error) ? std::numeric_limits<double>::infinity() : error);
  }
  /// |found - expected| / scale.
  void see(long double found, long double expected, long double scale = 1) {
    see(double(std::abs(found - expected) / scale));
  }
};

/// One case of one stage against one oracle.
struct ExtremeRow {
  std::string stage, name;
  std::string oracle;  ///< what the stage's answers are held against
  WorstError error;
  std::string unit;    ///< of the error and the bound
  double bound = 0;    ///< the largest error that the stage claims
  std::string seen{};  ///< more of what was seen, for people
};

/// Collects rows, all with the same columns. A row passes if something was compared and the worst
/// error is within the bound.
class ExtremesTable {
 public:
  explicit ExtremesTable(BenchmarkContext& context) : context_(context) {}

  /// `many` or, in a quick run, `few`.
  int scaled(int many, int few) const { return context_.scaled(many, few); }
  bool quick() const { return context_.quick; }

  void add(const ExtremeRow& row) {
    const bool passes = row.error.count > 0 && row.error.worst <= row.bound;
    const std::string name = row.stage + "/" + row.name;
    // Numbers in a table are finite.
    const double worst = std::min(row.error.worst, std::numeric_limits<double>::max());
    context_.add_row(name, {{"compared", row.error.count},
                            {"worst_error", worst},
                            {"bound", row.bound},
                            {"unit", row.unit},
                            {"verdict", passes ? "pass" : "fail"},
                            {"oracle", row.oracle},
                            {"seen", row.seen}});
    if (!passes) {
      context_.add_failure(fmt::format("{}: {} compared, worst error {:.4g} {}, bound {:.4g}", name,
                                       row.error.count, row.error.worst, row.unit, row.bound));
    }
  }

 private:
  BenchmarkContext& context_;
};

}  // namespace tessera
