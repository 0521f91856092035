/// What a scene that holds nothing costs: the whole process, from start to written image.

#include <cstdlib>
#include <filesystem>
#include <fstream>

#include <fcntl.h>
#include <fmt/format.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include "base/error.h"
#include "bench/harness/benchmark.h"

namespace tessera {
namespace {

namespace fs = std::filesystem;

/// A folder that goes with its contents.
class TemporaryFolder {
 public:
  TemporaryFolder() {
    std::string name = (fs::temp_directory_path() / "tessera-startup-XXXXXX").string();
    if (!mkdtemp(name.data())) throw Error("cannot make a temporary folder");
    path_ = name;
  }
  ~TemporaryFolder() {
    std::error_code ignored;
    fs::remove_all(path_, ignored);
  }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;
  std::string file(const char* name) const { return (path_ / name).string(); }

 private:
  fs::path path_;
};

/// Runs a program to its end, its standard output thrown away. Throws Error unless it exits with 0.
void run_program(std::vector<std::string> arguments) {
  std::vector<char*> argv;
  for (std::string& argument : arguments) argv.push_back(argument.data());
  argv.push_back(nullptr);
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
  pid_t child = 0;
  const int error = posix_spawn(&child, argv[0], &actions, nullptr, argv.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  if (error != 0) throw Error(fmt::format("cannot start {}", arguments[0]));
  int status = 0;
  waitpid(child, &status, 0);
  if (status != 0) throw Error(fmt::format("{} failed", fmt::join(arguments, " ")));
}

void run(BenchmarkContext& context) {
  const TemporaryFolder folder;
  const std::string scene = folder.file("empty.rib"), image = folder.file("empty.exr");
  std::ofstream(scene) << "Format 640 480 1\nPixelSamples 4 4\nProjection \"perspective\"\n"
                          "WorldBegin\nWorldEnd\n";
  const std::string tessera = program_folder() + "/tessera";
  const std::vector<Timing> timings =
      interleave({{"empty_scene",
                   [&] {
                     run_program({tessera, "render", scene, "-o", image, "--quiet"});
                   }},
                  {"help",
                   [&] {
                     run_program({tessera, "--help"});
                   }}},
                 context.scaled(101, 21));
  for (const Timing& timing : timings) {
    context.add_row(timing.name, {{"tessera_ms", 1e3 * timing.median_s()},
                                  {"min_ms", 1e3 * timing.min_s()},
                                  {"spread", timing.spread()}});
  }
}

}  // namespace

BenchmarkDefinition benchmark_startup() {
  return {"startup", "whole process on a scene that holds nothing, 640 x 480; and printing help",
          run};
}

}  // namespace tessera
