#include "trade/trade.h"

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <optional>

#include <fmt/format.h>

#include "base/error.h"
#include "engine/command.h"
#include "images/exr.h"
#include "trade/bench_table.h"
#include "trade/conclusion.h"
#include "trade/content_hash.h"
#include "trade/find_reference.h"
#include "trade/folder.h"
#include "trade/heat_maps.h"
#include "trade/ledger.h"
#include "trade/measure.h"
#include "trade/schedule.h"
#include "trade/table.h"

namespace tessera::trade {

namespace fs = std::filesystem;

namespace {

/// Of a budget, what the report may take: its heat maps, and within that the page itself.
constexpr double report_share = 0.2, page_share = 0.05;

void say(const std::string& line) { fmt::print(stderr, "{}\n", line); }

/// One sweep from its first run to its files.
class Trade {
 public:
  Trade(const TradeOptions& options, const std::string& program, const std::atomic<bool>& cancel)
      : options_(options),
        cancel_(cancel),
        renderer_(program, options.scene, options.common, options.timeout_s, &cancel) {}

  ~Trade() {
    std::error_code ignored;
    fs::remove(path("probe.exr"), ignored);
  }
  Trade(const Trade&) = delete;
  Trade& operator=(const Trade&) = delete;

  int run();

 private:
  std::string path(const std::string& name) const {
    return (fs::path(options_.output) / name).string();
  }
  double elapsed_s() const {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
  }
  double left_s() const { return options_.budget_s ? *options_.budget_s - elapsed_s() : 1e30; }

  void note_load();
  void probe();
  void list();
  void choose_reference();
  Identity identity() const;
  void read_before();
  Ledger open_ledger();
  void name_configurations(const std::vector<Measurement>& before);
  SweepOutcome measure_all(Ledger& ledger, const std::vector<Measurement>& before);
  void map_costs();

  const TradeOptions& options_;
  const std::atomic<bool>& cancel_;
  Renderer renderer_;
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
  double probe_wall_s_ = 0;
  std::string reference_hash_, busy_note_;
  std::optional<LedgerContent> before_;
  TradeTable table_;
};

/// Times of a busy machine are less sure, and whoever reads them should know.
void Trade::note_load() {
  double load = 0;
  if (getloadavg(&load, 1) != 1 || load < 0.5) return;
  busy_note_ = fmt::format(
      "the machine was busy before the first run (load {:.1f}): frame times "
      "are less sure than on one that is idle",
      load);
  say(busy_note_);
}

/// The default, with the samples that the scene asks for: what is in the scene, and what a frame
/// costs.
void Trade::probe() {
  const Rendered rendered =
      renderer_.render({}, path("probe.exr"), std::min(options_.timeout_s, left_s()));
  if (!rendered.failure.empty())
    throw Error(fmt::format("{} cannot be rendered: {}", options_.scene, rendered.failure));
  probe_wall_s_ = rendered.process.wall_s;
  table_.plan = plan_of(rendered.statistics);
}

void Trade::list() {
  SweepRequest request;
  request.knobs = options_.knobs;
  request.baselines = options_.baselines;
  request.qualities = options_.qualities;
  request.ladder = options_.ladder;
  request.plan = table_.plan;
  request.common = options_.common;
  request.has_option = [this](const std::string& option) { return renderer_.has_option(option); };
  table_.list = list_configurations(request);
  table_.ladder = options_.ladder;
  for (const std::string& note : table_.list.notes) say(note);
  for (const std::string& note : table_.list.missing_baselines) say(note);
}

void Trade::choose_reference() {
  Reference& reference = table_.reference;
  const ReferenceSearch search{options_,
                               table_.scene_hash,
                               16 * std::max(options_.ladder.back(), table_.list.pivot_spp),
                               before_ ? before_->identity["reference"] : std::string(),
                               [this] { return left_s(); },
                               say};
  const size_t known_notes = table_.list.notes.size();
  reference = find_reference(renderer_, search, table_.list.notes);
  for (size_t i = known_notes; i < table_.list.notes.size(); ++i) say(table_.list.notes[i]);
  reference_hash_ = hash_pixels(read_exr(reference.file));
  say(fmt::format("reference{}: {}, its own relMSE {}", reference.cached ? " (cached)" : "",
                  reference.file,
                  reference.rel_mse == reference.rel_mse ? fmt::format("{:.2g}", reference.rel_mse)
                                                         : std::string("unknown")));
}

/// What can be known before anything is rendered.
Identity Trade::identity() const {
  return {{"scene hash", table_.scene_hash},
          {"renderer", renderer_.software()},
          {"renderer's bytes", renderer_.build()},
          {"options of every run", fmt::format("{}", fmt::join(options_.common, " "))}};
}

/// The runs of before, if they are to be gone on with.
void Trade::read_before() {
  const std::string file = path("runs.jsonl");
  if (!options_.resume) return;
  if (!fs::exists(file)) return say(fmt::format("nothing to resume in {}: starting anew", file));
  before_ = read_ledger(file);
  check_identity(file, before_->identity, identity());
  if (before_->torn) say(fmt::format("{}: the last line is torn and left out", file));
  const auto& runs = before_->measurements;
  const auto failed = std::count_if(runs.begin(), runs.end(), [](auto& run) { return !run.ok; });
  say(fmt::format("resuming after {} runs{}", runs.size(),
                  failed > 0 ? fmt::format("; {} that failed are tried again", failed) : ""));
}

Ledger Trade::open_ledger() {
  const std::string file = path("runs.jsonl");
  Identity now = identity();
  now["reference"] = reference_hash_;
  if (before_) check_identity(file, before_->identity, now);
  // Only now: the reference of other runs is not replaced by one that does not belong to them.
  const std::string& reference = table_.reference.file;
  std::error_code same;
  if (!fs::equivalent(reference, path("reference.exr"), same))
    fs::copy_file(reference, path("reference.exr"), fs::copy_options::overwrite_existing);
  return before_ ? Ledger(file, *before_) : Ledger(file, now);
}

/// Configurations that the ledger knows keep their names, others take new ones.
void Trade::name_configurations(const std::vector<Measurement>& before) {
  int next = 1;
  for (const Measurement& measurement : before)
    next = std::max(next, std::atoi(measurement.id.c_str()) + 1);
  for (Configuration& configuration : table_.list.configurations) {
    for (const Measurement& measurement : before)
      if (measurement.label == configuration.label()) configuration.id = measurement.id;
    if (configuration.id.empty()) configuration.id = fmt::format("{:04}", next++);
  }
}

SweepOutcome Trade::measure_all(Ledger& ledger, const std::vector<Measurement>& before) {
  const std::vector<Configuration>& all = table_.list.configurations;
  size_t done = 0;
  const Runner runner = [&](const Configuration& configuration, int round, double limit_s) {
    Measurement m =
        measure(renderer_, configuration, round, limit_s,
                {path(fmt::format("runs/{}.exr", configuration.id)), path("reference.exr")});
    if (m.stopped) return m;
    ledger.append(m);
    const std::string result =
        m.ok ? fmt::format("{:.3f} s", m.frame_s) +
                   (round == 0 ? fmt::format(", relMSE {:.3g}", m.rel_mse) : std::string())
             : "failed: " + m.error;
    say(fmt::format("[{}/{}] {}: {}", ++done, all.size() * size_t(options_.repeats), m.label,
                    result));
    return m;
  };
  SweepSettings settings;
  settings.repeats = options_.repeats;
  if (options_.budget_s)
    settings.end_s = *options_.budget_s * (options_.report.empty() ? 1 : 1 - report_share);
  settings.probe_wall_s = probe_wall_s_;
  settings.probe_spp = table_.list.scene_spp;
  return sweep(
      all, settings, before, runner, [this] { return elapsed_s(); },
      [this] { return cancel_.load(); });
}

void Trade::map_costs() {
  const double page_s = options_.budget_s ? page_share * *options_.budget_s : 0;
  HeatMaps maps = render_heat_maps(
      renderer_, runs_to_map(table_.runs),
      {path("runs"), [&] { return left_s() - page_s; }, [this] { return cancel_.load(); }});
  table_.heat_maps = std::move(maps.made);
  for (std::string& note : maps.notes) table_.list.notes.push_back(std::move(note));
}

int Trade::run() {
  table_.scene = options_.scene;
  table_.software = renderer_.software();
  table_.scene_hash = hash_scene(options_.scene);
  read_before();
  note_load();
  probe();
  list();
  choose_reference();
  Ledger ledger = open_ledger();
  const std::vector<Measurement> before =
      before_ ? before_->measurements : std::vector<Measurement>();
  name_configurations(before);
  const SweepOutcome outcome = measure_all(ledger, before);
  if (!busy_note_.empty()) table_.list.notes.push_back(busy_note_);
  conclude(options_, outcome, table_);
  if (!options_.report.empty() && !outcome.cancelled) map_costs();
  write_results(options_, table_);
  if (outcome.cancelled || cancel_) {
    say("interrupted; --resume goes on");
    return exit_cancelled;
  }
  const bool any =
      std::any_of(table_.runs.begin(), table_.runs.end(), [](const Run& run) { return run.ok(); });
  return any ? exit_success : exit_failure;
}

}  // namespace

int run_trade(const TradeOptions& options, const std::string& program,
              const std::atomic<bool>& cancel) {
  // Before anything is made: a scene that is not there leaves no folder behind.
  ContentHash().add_file(options.scene);
  for (const std::string& file : options.tables) read_bench_table(file);
  const FolderLock lock = prepare_folder(options.output, options.resume, options.fresh);
  prepare_report(options);
  try {
    return Trade(options, program, cancel).run();
  } catch (const Error&) {
    if (!cancel) throw;
    say("interrupted");
    return exit_cancelled;
  }
}

}  // namespace tessera::trade
