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
    if (!benchmark.arguments.empty()) fmt::print("{:<12} {}\n", "", usage_of(benchmark));
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

struct Request {
  std::string name, json_file;
  std::vector<std::string> arguments;
  bool quick = false;

  std::string command() const {
    std::string text = "./tessera bench " + name;
    for (const std::string& argument : arguments) text += " " + argument;
    return text + (quick ? " --quick" : "");
  }
};

void run_benchmark(const Request& request) {
  const BenchmarkDefinition& benchmark = find_benchmark(request.name);
  check_arguments(benchmark, request.arguments);
  if (!request.json_file.empty()) check_writable(request.json_file);
  BenchmarkContext context(request.quick, request.arguments);
  // Not to stdout, which takes the whole table; stderr is not held back.
  context.on_row = [](const BenchmarkRow& row) { fmt::print(stderr, "{}\n", format_row(row)); };
  const double total_s = seconds_of([&] { benchmark.run(context); });
  fmt::print("{}: {}\n\n{}\n{:.1f} s in all\n", benchmark.name, benchmark.help,
             format_table(context.rows()), total_s);
  if (!request.json_file.empty()) {
    write_text_file(request.json_file,
                    benchmark_json(context.rows(), request.command()).dump(2) + "\n");
  }
  if (!context.failures().empty())
    throw Error(
        fmt::format("{} failed:\n  {}", request.name, fmt::join(context.failures(), "\n  ")));
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("Measures Tessera against its peers and its own oracles.", "tessera_bench");
  Request request;
  app.add_option("name", request.name, "the benchmark to run; without it, they are listed");
  app.add_option("arguments", request.arguments, "what the benchmark takes, as listed");
  app.add_flag("--quick", request.quick, "the same rows from less work, within 50 s on two cores");
  app.add_option("--json", request.json_file, "also write the rows as JSON")->type_name("FILE");
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : 2;
  }
  try {
    if (request.name.empty()) return list_benchmarks();
    run_benchmark(request);
    return 0;
  } catch (const std::exception& error) {
    fmt::print(stderr, "error: {}\n", error.what());
    return 1;
  }
}
