/// tessera render: scene files become images.

#include <csignal>
#include <filesystem>
#include <memory>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "engine/batch.h"
#include "engine/command.h"
#include "engine/frame_numbers.h"
#include "engine/interrupt.h"
#include "engine/settings_options.h"

namespace tessera {
namespace {

struct RenderOptions {
  BatchRequest request;
  std::string frames;
  bool quiet = false, verbose = false;
};

/// The scene that is rendered when none is named. Lies in the checkout that the program was built
/// in, one level below its top.
std::string example_scene() {
  const auto program = std::filesystem::read_symlink("/proc/self/exe");
  const auto scene = program.parent_path().parent_path() / "scenes/examples/first_light.rib";
  if (!std::filesystem::exists(scene)) {
    throw UsageError(
        fmt::format("no scene given, and the example {} is not there", scene.string()));
  }
  return scene.string();
}

void complete(RenderOptions& options) {
  BatchRequest& request = options.request;
  if (request.scenes.empty()) {
    request.scenes = {example_scene()};
    if (request.output.empty()) request.output = "first_light.exr";
    if (request.preview.empty()) request.preview = "first_light.png";
  }
  try {
    if (!options.frames.empty()) request.frames = parse_frame_range(options.frames);
    expand_scenes(request.scenes, request.frames);
  } catch (const Error& error) {
    throw UsageError(error.what());
  }
}

/// What there is to say after the last frame of a batch of several.
void print_outcome(const BatchResult& result, Console& console) {
  const size_t failed = result.failures.size();
  if (result.rendered + result.skipped + failed > 1) {
    console.print(
        fmt::format("{} rendered, {} skipped, {} failed", result.rendered, result.skipped, failed));
    for (const BatchFailure& failure : result.failures) {
      console.error(fmt::format("{} failed: {}", failure.name, failure.message));
    }
  }
  if (result.cancelled) console.note("interrupted");
}

int run(RenderOptions& options) {
  complete(options);
  // Whoever reads what is printed may go away; the images are still wanted.
  std::signal(SIGPIPE, SIG_IGN);
  // Before anything that starts threads.
  const InterruptWatch interrupt;
  Console console(options.quiet     ? Verbosity::quiet
                  : options.verbose ? Verbosity::verbose
                                    : Verbosity::normal);
  const BatchResult result = Batch(options.request, console, interrupt.interrupted()).run();
  print_outcome(result, console);
  if (result.cancelled) return exit_cancelled;
  return result.failures.empty() ? exit_success : exit_failure;
}

std::function<int()> set_up(CLI::App& app) {
  const auto options = std::make_shared<RenderOptions>();
  BatchRequest& request = options->request;
  app.add_option(
         "scene", request.scenes,
         "scene files; '####' in a name stands for the numbers of --frames. Without any, the "
         "built-in example")
      ->type_name("SCENE.rib");
  app.add_option("-o,--output", request.output,
                 "image to write; '####' takes the frame number. A folder: a file for each scene. "
                 "Default: as the scene's Displays say, or SCENE.exr")
      ->type_name("OUT.exr");
  app.add_option("--preview", request.preview, "8-bit picture to look at")->type_name("FILE.png");
  app.add_option("--stats", request.statistics, "statistics as JSON")->type_name("FILE.json");
  app.add_option("--frames", options->frames, "frames to render, every S-th from A to B")
      ->type_name("A-B[xS]");
  app.add_flag("--skip-existing", request.skip_existing, "leave out frames that are there already");
  add_settings_options(app, request.settings);
  CLI::Option* verbose =
      app.add_flag("--verbose", options->verbose, "print the plan and every statistic");
  app.add_flag("--quiet", options->quiet, "print errors only")->excludes(verbose);
  app.footer(list_choices);
  return [options] { return run(*options); };
}

}  // namespace

CommandDefinition command_render() {
  return {"render", "Render scene files; options override what the scene says", set_up};
}

}  // namespace tessera
