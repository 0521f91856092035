#include "trade/command_line.h"

#include <algorithm>
#include <cstdlib>
#include <filesystem>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "base/error.h"
#include "engine/command.h"
#include "engine/settings_options.h"

namespace tessera::trade {

namespace fs = std::filesystem;

namespace {

/// What is said before it is understood.
struct Spoken {
  std::string knobs, ladder = "4,16,64", baselines, format;
  std::vector<std::string> crop;
  std::optional<int> threads;
  std::optional<double> budget_minutes;
};

std::string footer() {
  std::string text = "\nKnobs (--knobs), and the values swept unless others are given:\n";
  for (const Knob& knob : knob_table())
    text += fmt::format(
        "  {:<15} {}{}\n", knob.name, knob.what,
        knob.values.empty() ? std::string() : fmt::format(": {}", fmt::join(knob.values, " ")));
  text += "\nBaselines (--against):\n";
  for (const Baseline& baseline : baseline_table())
    text += fmt::format("  {:<15} {}: {}\n", baseline.name, baseline.turn.name(), baseline.what);
  return text +
         "\nWhat follows '--' is given to every `tessera render`, the reference included:\n  "
         "tessera trade scene.rib --format 480x270 -- --filter box:1x1 --motion-factor 0\n"
         "\nEvery run is a process of its own, `tessera render` with the options of its row. "
         "Errors "
         "are\nof R, G and B against the reference; relMSE is the mean of (a - b)^2 / (b^2 + "
         "0.01).\ndocs/trade.md says how everything is measured and what the words mean.\n\n"
         "Exit codes: 0 done, with what failed as a row of the table; 1 there is no table, or no "
         "run in\n"
         "it went well; 2 the command line was not understood; 130 interrupted, what was finished "
         "is kept and --resume goes on.\n";
}

void add_what(CLI::App& app, TradeOptions& options, Spoken& spoken) {
  app.add_option("scene", options.scene, "scene file of one frame")
      ->required()
      ->type_name("SCENE.rib");
  app.add_option("-o,--output", options.output,
                 "folder for the table, the ledger and the images (SCENE.trade)")
      ->type_name("DIR");
  app.add_option("--knobs", spoken.knobs,
                 "knobs to sweep, separated by commas, each with or without values of its own: "
                 "spp,hider=shear:dual. Default: all")
      ->type_name("LIST");
  app.add_option("--spp", spoken.ladder,
                 "samples per pixel of every knob's value; the default configuration has a step "
                 "between each two besides, and the scene's own count if it lies within (4,16,64)")
      ->type_name("LIST");
  app.add_option("--against", spoken.baselines,
                 "baselines to compare the default with, separated by commas, in a table of their "
                 "own")
      ->type_name("LIST");
  app.add_flag("--qualities", options.qualities,
               "besides, the renderer's presets: --quality draft, preview, final");
}

void add_how(CLI::App& app, TradeOptions& options, Spoken& spoken) {
  app.add_option("--repeats", options.repeats, "times that each configuration is run (3)")
      ->check(CLI::Range(1, 1000))
      ->type_name("N");
  app.add_option("--budget", spoken.budget_minutes,
                 "minutes in which all is to be over, the reference included: first everything "
                 "once, the cheap before the dear, then repeats")
      ->type_name("MINUTES");
  app.add_option("--timeout", options.timeout_s, "seconds that one run may take (600)")
      ->check(CLI::PositiveNumber)
      ->type_name("SECONDS");
  CLI::Option* resume = app.add_flag("--resume", options.resume,
                                     "go on with the runs in the folder; those finished are kept");
  app.add_flag("--fresh", options.fresh, "forget the runs in the folder")->excludes(resume);
  app.add_option("--format", spoken.format, "resolution of every run")->type_name("WxH");
  app.add_option("--crop", spoken.crop, "part of the frame that every run renders")
      ->expected(4)
      ->type_name("X0 X1 Y0 Y1");
  app.add_option("--threads", spoken.threads, "threads of every run, 0: every core (0)")
      ->check(CLI::Range(0, 1024))
      ->type_name("N");
}

void add_reference(CLI::App& app, TradeOptions& options) {
  CLI::Option* given =
      app.add_option("--reference", options.reference, "take this image instead of rendering one")
          ->type_name("FILE.exr");
  app.add_option("--reference-spp", options.reference_spp,
                 "samples per pixel of the reference (16 times the most of --spp)")
      ->check(CLI::Range(2, 1 << 17))
      ->excludes(given)
      ->type_name("N");
  app.add_option("--cache", options.cache,
                 "folder where references are kept for other sweeps (" + default_cache() + ")")
      ->type_name("DIR");
  CLI::Option* report =
      app.add_option("--report", options.report, "write a page that shows it all, DIR/index.html")
          ->type_name("DIR");
  app.add_option("--tables", options.tables,
                 "what ./tessera bench NAME --json wrote (extremes, needs, ...), to show on the "
                 "page, too")
      ->needs(report)
      ->type_name("FILE.json ...");
}

/// Options of every run: those of this program that the renderer has too, and those after "--".
void complete_common(const Spoken& spoken, TradeOptions& options) {
  std::vector<std::string> common;
  if (!spoken.format.empty()) common.insert(common.end(), {"--format", spoken.format});
  if (!spoken.crop.empty()) {
    common.push_back("--crop");
    common.insert(common.end(), spoken.crop.begin(), spoken.crop.end());
  }
  if (spoken.threads) common.insert(common.end(), {"--threads", std::to_string(*spoken.threads)});
  for (const std::string& word : options.common) {
    // "--name=value" as two words, so that knobs are recognised.
    const size_t equals = word.starts_with("--") ? word.find('=') : word.npos;
    common.push_back(word.substr(0, equals));
    if (equals != word.npos) common.push_back(word.substr(equals + 1));
  }
  for (const char* taken :
       {"-o", "--output", "--stats", "--spp", "--seed", "--heatmap", "--error", "--time"})
    if (std::find(common.begin(), common.end(), taken) != common.end())
      throw Error(fmt::format("{} cannot be given to every run: the sweep sets it itself", taken));
  options.common = std::move(common);
}

/// Throws Error unless the renderer understands every value of the knobs: a run of each would fail.
void check_values(const std::vector<KnobChoice>& knobs) {
  for (const KnobChoice& choice : knobs) {
    if (choice.knob->name == "spp") continue;  // parse_ladder() checks it
    for (const std::string& value : choice.values) {
      CLI::App renderer;
      Settings settings;
      add_settings_options(renderer, settings);
      std::vector<std::string> words = options_of({choice.knob->name, value});
      std::reverse(words.begin(), words.end());  // as CLI11 takes them
      try {
        renderer.parse(words);
      } catch (const CLI::ParseError& error) {
        throw Error(fmt::format("--knobs: {}={}: {}", choice.knob->name, value, error.what()));
      }
    }
  }
}

void understand(const Spoken& spoken, TradeOptions& options) {
  options.knobs = parse_knobs(spoken.knobs);
  check_values(options.knobs);
  options.baselines = parse_baselines(spoken.baselines);
  options.ladder = parse_ladder(spoken.ladder);
  for (const KnobChoice& choice : options.knobs)
    if (choice.knob->name == "spp" && !choice.values.empty())
      options.ladder = parse_ladder(fmt::format("{}", fmt::join(choice.values, ",")));
  if (spoken.budget_minutes) {
    if (!(*spoken.budget_minutes > 0))
      throw Error(fmt::format("--budget {}: expected minutes above 0", *spoken.budget_minutes));
    options.budget_s = 60 * *spoken.budget_minutes;
  }
  if (options.output.empty())
    options.output = fs::path(options.scene).filename().replace_extension(".trade").string();
  if (options.cache.empty()) options.cache = default_cache();
  complete_common(spoken, options);
}

}  // namespace

std::string default_cache() {
  const char* cache = std::getenv("XDG_CACHE_HOME");
  if (cache && *cache) return (fs::path(cache) / "tessera").string();
  const char* home = std::getenv("HOME");
  return (fs::path(home && *home ? home : ".") / ".cache/tessera").string();
}

std::optional<TradeOptions> parse_command_line(int argc, const char* const* argv, int& exit_code) {
  TradeOptions options;
  Spoken spoken;
  CLI::App app("Measures what a scene's options buy: time against error, one option at a time.",
               "tessera trade");
  add_what(app, options, spoken);
  add_how(app, options, spoken);
  add_reference(app, options);
  app.footer(footer());
  app.failure_message([](const CLI::App*, const CLI::Error& error) {
    return fmt::format("error: {}\nRun with --help for the options.\n", error.what());
  });
  // What follows "--" is the renderer's, whatever it looks like.
  const char* const* end = argv + argc;
  const char* const* separator =
      std::find_if(argv, end, [](const char* word) { return std::string_view(word) == "--"; });
  if (separator != end) options.common.assign(separator + 1, end);
  try {
    app.parse(int(separator - argv), const_cast<char**>(argv));
    understand(spoken, options);
  } catch (const CLI::ParseError& error) {
    exit_code = app.exit(error) == 0 ? exit_success : exit_usage;
    return std::nullopt;
  } catch (const Error& error) {
    fmt::print(stderr, "error: {}\n", error.what());
    exit_code = exit_usage;
    return std::nullopt;
  }
  return options;
}

}  // namespace tessera::trade
