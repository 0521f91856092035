/// The benchmark program: lists the benchmarks, or runs one and prints its rows.

#include <cstdio>
#include <exception>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "base/error.h"
#include "bench/harness/benchmark.h"
#include "engine/frame_files.h"

namespace {

using namespace tessera;

int list_benchmarks() {
  for (const BenchmarkDefinition& benchmark : benchmark_registry()) {
    fmt::print("{:<12} {}\n", benchmark.name, benchmark.help);
  }
  return 0;
}

const BenchmarkDefinition& find_benchmark(const std::string& name) {
  std::string choices;
  for (const BenchmarkDefinition& benchmark : benchmark_registry()) {
    if (benchmark.name == name) return benchmark;
    choices += " " + benchmark.name;
  }
  throw Error(fmt::format("no benchmark '{}'; there is{}", name, choices));
}

void run_benchmark(const std::string& name, bool quick, const std::string& json_file) {
  const BenchmarkDefinition& benchmark = find_benchmark(name);
  if (!json_file.empty()) check_writable(json_file);
  BenchmarkContext context(quick);
  const double total_s = seconds_of([&] { benchmark.run(context); });
  fmt::print("{}: {}\n\n{}\n{:.1f} s in all\n", benchmark.name, benchmark.help,
             format_table(context.rows()), total_s);
  if (json_file.empty()) return;
  const std::string command = fmt::format("./tessera bench {}{}", name, quick ? " --quick" : "");
  write_text_file(json_file, benchmark_json(context.rows(), command).dump(2) + "\n");
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("Measures Tessera against its peers and its own oracles.", "tessera_bench");
  std::string name, json_file;
  bool quick = false;
  app.add_option("name", name, "the benchmark to run; without it, they are listed");
  app.add_flag("--quick", quick, "the same rows from less work, within 50 s on two cores");
  app.add_option("--json", json_file, "also write the rows as JSON")->type_name("FILE");
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : 2;
  }
  try {
    if (name.empty()) return list_benchmarks();
    run_benchmark(name, quick, json_file);
    return 0;
  } catch (const std::exception& error) {
    fmt::print(stderr, "error: {}\n", error.what());
    return 1;
  }
}
