/// What shading costs and what it is worth, by mode: points and quads of 2 x 2 cells that memo
/// caches would have to shade (Figures 8 and 9 of K. Vaidyanathan et al., "Adaptive Image Space
/// Shading for Motion and Defocus Blur", 2012, on scenes of our own), seconds of shading, and the
/// distance from a converged image that shades every sample. Counts are of whole frames (those of a
/// sequence of the middle quarter of it), times of a strip across, images of a window of each
/// scene. Columns NAME_vs_ds divide the row's value by that of ds: quads by those of ds with a
/// cache 16 times as large (`quads_vs_ds`), without bounds, and of the same size.

#include <algorithm>
#include <charconv>
#include <map>

#include <tbb/parallel_for_each.h>

#include "bench/harness/benchmark.h"
#include "bench/shading_cases.h"
#include "bench/shading_replay.h"
#include "images/compare.h"
#include "images/perceptual.h"

namespace tessera {
namespace {

using Columns = BenchmarkContext::Columns;

/// Parts of the frame. Strips across it are like all of it in a quick run: blur and cells are as
/// many pixels wide as ever, which they would not be in a smaller frame.
struct Windows {
  Window counted, sequence, timed;
  double compared_share;  ///< of the sides of ShadingCase::compared, around its middle
};
constexpr Windows full_windows{{0, 1, 0, 1}, {0.25, 0.75, 0.25, 0.75}, {0, 1, 0.45, 0.52}, 1},
    quick_windows{{0, 1, 0.46, 0.54}, {0, 1, 0.48, 0.51}, {0, 1, 0.48, 0.505}, 0.3};

Window middle_of(const Window& w, double share) {
  const double x = (w.x_max - w.x_min) * (1 - share) / 2, y = (w.y_max - w.y_min) * (1 - share) / 2;
  return {w.x_min + x, w.x_max - x, w.y_min + y, w.y_max - y};
}

/// Those of the five that this program has.
std::vector<std::string> modes(std::initializer_list<const char*> wanted = {"aas", "ds", "reyes",
                                                                            "pixel", "sample"}) {
  std::vector<std::string> result;
  for (const char* name : wanted)
    for (const ShadingModeDefinition& mode : shading_mode_registry())
      if (std::string_view(mode.name) == name) result.push_back(name);
  return result;
}

double ratio(double a, double b) { return b > 0 ? a / b : 0; }

/// How large everything is.
struct Scale {
  int width = 1280, height = 720, side_samples = 4;
  Windows windows;
  CacheSizes cache_sizes;
  int reference_spp, warm_ups, repeats, sequence_frames;
  float expensive_cost;  ///< noise evaluations a point
};

/// Sizes of memo caches from "16,64,1024"; powers of two from 16 to 4096 without.
CacheSizes cache_sizes(const BenchmarkContext& context) {
  CacheSizes sizes;
  if (context.arguments.empty()) {
    for (size_t entries = 16; entries <= 4096; entries *= 2) sizes.push_back(entries);
    return sizes;
  }
  const std::string& list = context.arguments[0];
  for (size_t start = 0; start <= list.size();) {
    const size_t end = std::min(list.find(',', start), list.size());
    size_t entries = 0;
    const auto [last, error] = std::from_chars(&list[start], &list[start] + (end - start), entries);
    if (error != std::errc() || last != &list[start] + (end - start) || entries < 1)
      throw Error(
          fmt::format("cache sizes \"{}\": expected whole numbers above 0, separated by "
                      "commas, found \"{}\"",
                      list, list.substr(start, end - start)));
    sizes.push_back(entries);
    start = end + 1;
  }
  return sizes;
}

Scale scale_of(const BenchmarkContext& context) {
  return {.windows = context.quick ? quick_windows : full_windows,
          .cache_sizes = cache_sizes(context),
          .reference_spp = context.scaled(256, 32),
          .warm_ups = context.scaled(1, 0),
          .repeats = context.scaled(3, 1),
          .sequence_frames = context.scaled(24, 6),
          .expensive_cost = float(context.scaled(100, 25))};
}

/// One frame whose requests are replayed.
struct ReplayJob {
  std::string name, scene, lens;
  double motion = 1, place = 0;  ///< as in ShadingSceneRequest
  Window window;
  CacheSizes sizes{};
  std::vector<ModeReplay> replays{};

  void add_modes(const std::vector<std::string>& names) {
    for (const std::string& mode : names)
      replays.push_back({mode, CacheBank(sizes), CacheBank(sizes)});
  }
  const ModeReplay* find(const std::string& mode) const {
    for (const ModeReplay& replay : replays)
      if (replay.mode == mode) return &replay;
    return nullptr;
  }
};

class ShadingBenchmark {
 public:
  explicit ShadingBenchmark(BenchmarkContext& context)
      : context_(context), scale_(scale_of(context)) {}

  void run() {
    std::vector<ReplayJob> jobs = replay_jobs();
    tbb::parallel_for_each(jobs, [&](ReplayJob& job) { replay(job); });
    for (const ShadingCase& c : shading_cases()) {
      const auto job = std::ranges::find(jobs, c.name(), &ReplayJob::name);
      const auto scene = read(c.scene, c.lens);
      std::map<std::string, Columns> columns = quality(c, *scene);
      for (const auto& [mode, of_time] : time_columns(*scene))
        columns[mode].insert(columns[mode].end(), of_time.begin(), of_time.end());
      add_cache_rows(*job, columns);
      const ShaderCall shader = expensive_shader(scale_.expensive_cost);
      const auto expensive = time_columns(with_surface_shader(*scene, shader));
      for (const std::string& mode : modes())
        context_.add_row(fmt::format("{}/{}/expensive", c.name(), mode), expensive.at(mode));
    }
    for (const ReplayJob& job : jobs) {
      if (job.name.starts_with("sequence/")) add_sequence_rows(job);
      if (job.name.starts_with("static/")) add_static_rows(job);
    }
  }

 private:
  std::unique_ptr<const Scene> read(const std::string& scene, const std::string& lens,
                                    double motion = 1, double place = 0) const {
    ShadingSceneRequest request;
    request.width = scale_.width, request.height = scale_.height;
    request.side_samples = scale_.side_samples;
    request.lens = lens;
    request.motion = motion, request.place = place;
    request.textures = textures_.path();
    return read_shading_scene(scene, request);
  }

  // --- Counts ---

  std::vector<ReplayJob> replay_jobs() const {
    std::vector<ReplayJob> jobs;
    for (const ShadingCase& c : shading_cases()) {
      jobs.push_back({c.name(), c.scene, c.lens, 1, 0, scale_.windows.counted});
      jobs.back().sizes = scale_.cache_sizes;
      jobs.back().add_modes(modes());
    }
    jobs.push_back({"static/pinhole", "arena", "pinhole", 0, 0, scale_.windows.counted});
    jobs.back().add_modes(modes({"aas", "ds", "reyes"}));
    for (const char* lens : {"sharp", "smooth"})
      for (int frame = 0; frame < scale_.sequence_frames; ++frame) {
        // As Figure 9 has it: motion comes and goes, the lens stays open.
        const double place = (frame + 0.5) / scale_.sequence_frames - 0.5;
        const double swell = std::cos(std::numbers::pi * place);
        jobs.push_back({fmt::format("sequence/{:02}/{}", frame, lens), "arena", lens,
                        0.03 + 0.97 * swell * swell, place, scale_.windows.sequence,
                        sequence_sizes});
        jobs.back().add_modes(modes({"aas", "ds", "reyes"}));
      }
    return jobs;
  }

  void replay(ReplayJob& job) const {
    const auto scene = read(job.scene, job.lens, job.motion, job.place);
    Settings settings;
    settings.threads = 1;
    settings.crop = job.window;
    FrameControl control;
    control.make_shading = [&](std::string_view, const ShadingFrame& frame) {
      return std::make_unique<ReplayShading>(frame, job.replays);
    };
    Diagnostics diagnostics;
    render_frame(*scene, settings, diagnostics, control);
  }

  /// `extra` columns of a mode go to its row without bounds.
  void add_cache_rows(const ReplayJob& job, const std::map<std::string, Columns>& extra) {
    const ModeReplay* ds = job.find("ds");
    for (const ModeReplay& replay : job.replays) {
      const bool compared = replay.mode == "aas" && ds;
      for (size_t c = 0; c < job.sizes.size(); ++c) {
        Columns columns{{"points", double(replay.points.shaded(c))},
                        {"quads", double(replay.quads.shaded(c))}};
        if (compared) add_ratios(job, c, replay, *ds, columns);
        context_.add_row(fmt::format("{}/{}/{}", job.name, replay.mode, job.sizes[c]), columns);
      }
      Columns columns = unbounded_columns(replay, compared ? ds : nullptr);
      columns.insert(columns.end(), extra.at(replay.mode).begin(), extra.at(replay.mode).end());
      context_.add_row(fmt::format("{}/{}/unbounded", job.name, replay.mode), columns);
    }
  }

  /// Quads of aas over those of ds with a cache 16 times as large, and with all it can use.
  static void add_ratios(const ReplayJob& job, size_t c, const ModeReplay& aas,
                         const ModeReplay& ds, Columns& columns) {
    const double quads = double(aas.quads.shaded(c));
    const auto larger = std::ranges::find(job.sizes, 16 * job.sizes[c]);
    if (larger != job.sizes.end()) {
      const size_t l = size_t(larger - job.sizes.begin());
      columns.emplace_back("quads_vs_ds", ratio(quads, double(ds.quads.shaded(l))));
    }
    columns.emplace_back("quads_vs_ds_unbounded",
                         ratio(quads, double(ds.quads.shaded_unbounded())));
    columns.emplace_back("quads_vs_ds_same_size", ratio(quads, double(ds.quads.shaded(c))));
  }

  static Columns unbounded_columns(const ModeReplay& replay, const ModeReplay* ds) {
    const double quads = double(replay.quads.shaded_unbounded());
    Columns columns{{"points", double(replay.points.shaded_unbounded())}, {"quads", quads}};
    if (ds)
      columns.emplace_back("quads_vs_ds_unbounded",
                           ratio(quads, double(ds->quads.shaded_unbounded())));
    return columns;
  }

  void add_sequence_rows(const ReplayJob& job) {
    const ModeReplay* ds = job.find("ds");
    for (const ModeReplay& replay : job.replays) {
      const double small = double(replay.quads.shaded(0)),
                   all = double(replay.quads.shaded_unbounded());
      Columns columns{{"quads", small}, {"quads_unbounded", all}};
      if (replay.mode == "aas" && ds) {
        columns.emplace_back("quads_vs_ds", ratio(small, double(ds->quads.shaded(1))));
        columns.emplace_back("quads_vs_ds_unbounded",
                             ratio(all, double(ds->quads.shaded_unbounded())));
      }
      context_.add_row(fmt::format("{}/{}", job.name, replay.mode), columns);
    }
  }

  void add_static_rows(const ReplayJob& job) {
    for (const ModeReplay& replay : job.replays)
      context_.add_row(fmt::format("{}/{}/unbounded", job.name, replay.mode),
                       unbounded_columns(replay, replay.mode == "aas" ? job.find("ds") : nullptr));
  }

  // --- Images ---

  Image picture(const Scene& scene, const std::string& mode, int spp, uint32_t seed,
                const Window& window) const {
    Settings settings;
    settings.shading = mode;
    settings.samples_per_pixel = spp;
    settings.seed = seed;
    settings.crop = window;
    Diagnostics diagnostics;
    Image image = render_frame(scene, settings, diagnostics).image;
    std::erase_if(image.channels, [](const Image::Channel& c) {
      return c.name != "R" && c.name != "G" && c.name != "B";
    });
    return image;
  }

  /// Columns of each mode. The reference has samples of its own, and those of the modes once.
  std::map<std::string, Columns> quality(const ShadingCase& c, const Scene& scene) const {
    std::map<std::string, Columns> result;
    constexpr uint32_t reference_seed = 1;
    const int spp = scale_.side_samples * scale_.side_samples;
    const std::string best = modes({"sample"}).empty() ? "reyes" : "sample";
    const Window compared = middle_of(c.compared, scale_.windows.compared_share);
    const Image reference = picture(scene, best, scale_.reference_spp, reference_seed, compared);
    ViewingConditions viewing;
    viewing.width_degrees *= float(compared.x_max - compared.x_min);
    for (const std::string& mode : modes()) {
      const Image usual = picture(scene, mode, spp, 0, compared);
      const Image same_samples =
          mode == best ? reference
                       : picture(scene, mode, scale_.reference_spp, reference_seed, compared);
      result[mode] = {{"rel_mse", compare_images(usual, reference).rel_mse},
                      {"rel_mse_same_samples", compare_images(same_samples, reference).rel_mse},
                      {"perceptual", visible_share(usual, reference, viewing)},
                      {"perceptual_same_samples", visible_share(same_samples, reference, viewing)}};
    }
    return result;
  }

  // --- Times ---

  struct ShadeCost {
    std::vector<double> shade_s;
    double points = 0;
  };

  /// Renders a part of the frame with all modes in turn.
  std::map<std::string, ShadeCost> shade_costs(const Scene& scene) const {
    std::map<std::string, ShadeCost> costs;
    const std::vector<std::string> names = modes();
    for (int round = -scale_.warm_ups; round < scale_.repeats; ++round)
      for (size_t k = 0; k < names.size(); ++k) {
        const std::string& mode = names[(k + size_t(round + scale_.warm_ups)) % names.size()];
        Settings settings;
        settings.shading = mode;
        settings.crop = scale_.windows.timed;
        Diagnostics diagnostics;
        const Statistics statistics = render_frame(scene, settings, diagnostics).statistics;
        if (round < 0) continue;
        for (const auto& [name, seconds] : statistics.times_s)
          if (name == "shade_s") costs[mode].shade_s.push_back(seconds);
        for (const auto& [name, count] : statistics.counts)
          if (name == "points_shaded") costs[mode].points = double(count);
      }
    return costs;
  }

  std::map<std::string, Columns> time_columns(const Scene& scene) const {
    const auto costs = shade_costs(scene);
    const auto ds = costs.find("ds");
    std::map<std::string, Columns> result;
    for (const auto& [mode, cost] : costs) {
      const double seconds = median(cost.shade_s);
      Columns& columns = result[mode];
      columns = {{"points_shaded", cost.points}, {"shade_s", seconds}};
      if (ds == costs.end() || mode == "ds") continue;
      columns.emplace_back("shade_ratio_vs_ds", ratio(seconds, median(ds->second.shade_s)));
      columns.emplace_back("points_ratio_vs_ds", ratio(cost.points, ds->second.points));
    }
    return result;
  }

  /// 64, and 16 times as many for ds.
  static inline const CacheSizes sequence_sizes{64, 1024};

  BenchmarkContext& context_;
  Scale scale_;
  ShadingTextureFolder textures_;
};

}  // namespace

BenchmarkDefinition benchmark_shading() {
  return {"shading",
          "points, quads, seconds and errors of the shading modes under blur",
          [](BenchmarkContext& context) { ShadingBenchmark(context).run(); },
          {"CACHE,CACHE,..."}};
}

}  // namespace tessera
