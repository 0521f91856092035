/// tessera info: what scene files hold and how their frames would be rendered.

#include <memory>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "engine/command.h"
#include "engine/console.h"
#include "engine/frame.h"
#include "engine/overrides.h"
#include "engine/scene_description.h"
#include "engine/settings_options.h"
#include "scenes/rib/rib_reader.h"
#include "scenes/scene_sink.h"

namespace tessera {
namespace {

struct InfoOptions {
  std::vector<std::string> scenes;
  Settings settings;
};

/// Prints each frame as it is read.
class InfoSink : public SceneSink {
 public:
  InfoSink(const Settings& settings, Console& console, Diagnostics& diagnostics)
      : settings_(settings), console_(console), diagnostics_(diagnostics) {}

  bool frame(std::unique_ptr<const Scene> scene) override {
    std::string text = describe_scene(apply_overrides(*scene, settings_)) + "  plan\n";
    const FramePlan plan = plan_frame(*scene, settings_, diagnostics_);
    for (const auto& [name, value] : plan.entries()) {
      text += fmt::format("    {:<20} {}\n", name, value);
    }
    console_.print(text);
    ++frames_;
    return true;
  }

  int frames() const { return frames_; }

 private:
  const Settings& settings_;
  Console& console_;
  Diagnostics& diagnostics_;
  int frames_ = 0;
};

int run(const InfoOptions& options) {
  Console console(Verbosity::normal);
  int failed = 0;
  for (const std::string& file : options.scenes) {
    Diagnostics diagnostics([&](const std::string& line) { console.note(line); });
    InfoSink sink(options.settings, console, diagnostics);
    try {
      read_rib(file, sink, diagnostics);
      if (sink.frames() == 0) {
        throw Error(SourceLocation{file}, "no frame found, expected WorldBegin ... WorldEnd");
      }
    } catch (const Error& error) {
      console.error(error.what());
      ++failed;
    }
  }
  return failed == 0 ? exit_success : exit_failure;
}

std::function<int()> set_up(CLI::App& app) {
  const auto options = std::make_shared<InfoOptions>();
  app.add_option("scene", options->scenes, "scene files")->required()->type_name("SCENE.rib");
  add_settings_options(app, options->settings);
  app.footer(list_choices);
  return [options] { return run(*options); };
}

}  // namespace

CommandDefinition command_info() {
  return {"info", "Print what a scene holds and its frame plan, without rendering", set_up};
}

}  // namespace tessera
