/// What filtering for distribution effects is worth: four scenes with an open lens, soft shadows
/// and a bounce of light, by the default method with 16 and 32 samples a pixel, against frames of
/// many samples that are not filtered (AAF: one axis-aligned Gaussian; S. Mehta et al.,
/// "Axis-Aligned Filtering for Interactive Physically-Based Diffuse Indirect Lighting", 2013).
///
/// Speed-ups compare frames at equal relMSE: the error of AAF and of unfiltered frames is measured
/// at several sample counts, and counts and times interpolated between them. `speedup_vs_NAME` is
/// the ratio of sample counts, `time_ratio_vs_NAME` that of the times of whole frames, in which
/// what a frame costs whatever its samples, and the filter, count too. Columns NAME_capped are 1
/// where even the most samples are worse (the ratios are then at least this) and -1 where the
/// fewest are better already (at most this). `..._vs_aaf_bound` takes the samples that AAF's own
/// rule of sampling asks for instead, whatever the error, and their time by the last two steps
/// measured. `tables` in place of a scene: the tables of bench/maaf_tables.h alone.

#include "bench/harness/benchmark.h"
#include "bench/maaf_runs.h"
#include "bench/maaf_scenes.h"
#include "bench/maaf_tables.h"

namespace tessera {
namespace {

using Columns = BenchmarkContext::Columns;

/// How large everything is.
struct Scale {
  int width, height, reference_spp;
  std::vector<int> ladder;    ///< sample counts of AAF and of unfiltered frames
  std::vector<int> converge;  ///< sample counts, some of `ladder`
  int repeats, repeated_spp;  ///< further times each, of frames of up to so many samples
};

Scale scale_of(const BenchmarkContext& context) {
  if (context.quick) return {160, 90, 128, {4, 16, 32, 64}, {4, 16, 64}, 0, 0};
  return {320, 180, 256, {4, 16, 32, 64, 128, 256}, {4, 16, 64, 256}, 1, 32};
}

constexpr int row_spp[] = {16, 32};

/// The argument called for, or "" where it is not given or is `none`.
std::string argument(const BenchmarkContext& context, size_t index, std::string_view none) {
  if (index >= context.arguments.size() || context.arguments[index] == none) return "";
  return context.arguments[index];
}

class MaafBenchmark {
 public:
  explicit MaafBenchmark(BenchmarkContext& context)
      : context_(context),
        scale_(scale_of(context)),
        scene_(argument(context, 0, "all")),
        method_(argument(context, 1, "default")),
        folder_(argument(context, 2, "")) {}

  void run() {
    if (scene_ == "tables") return add_maaf_tables(context_);
    const std::vector<std::string> names =
        scene_.empty() ? maaf_scene_names() : std::vector<std::string>{scene_};
    for (const std::string& name : names) measure(name);
    for (const auto& [spp, rows] : measured_) add_average(spp, rows);
    if (scene_.empty()) add_maaf_tables(context_);
  }

 private:
  void measure(const std::string& name) {
    const auto scene = read_maaf_scene(name, {.width = scale_.width, .height = scale_.height});
    MaafRuns runs(*scene, scale_.reference_spp);
    render_all(runs);
    if (!folder_.empty()) write_frames(runs, name);
    for (const int spp : row_spp) {
      Columns columns = scene_columns(runs, spp);
      measured_[spp].push_back(columns);
      context_.add_row(fmt::format("scene/{}{}", name, row_suffix(spp)), std::move(columns));
    }
    add_methods_row(runs, name);
    add_converge_row(runs, name);
  }

  static std::string row_suffix(int spp) {
    return spp == row_spp[0] ? "" : fmt::format("@{}", spp);
  }

  /// The methods in turn at each sample count. A ladder ends where it is better than the best of
  /// the frames that it is compared with; the counts of the convergence rows are rendered in any
  /// case.
  void render_all(MaafRuns& runs) const {
    for (const int spp : row_spp) runs.run(method_, spp);
    const double target = runs.run(method_, row_spp[1]).rel_mse;
    std::map<std::string, bool> done;
    for (const int spp : scale_.ladder) {
      const bool converges = std::ranges::find(scale_.converge, spp) != scale_.converge.end();
      if (converges) runs.run(method_, spp);
      for (const std::string method : {MaafRuns::unfiltered, MaafRuns::aaf}) {
        const bool wanted =
            spp <= row_spp[1] || !done[method] || (converges && method == MaafRuns::unfiltered);
        if (wanted) done[method] |= runs.run(method, spp).rel_mse <= target;
      }
    }
    runs.repeat(scale_.repeats, scale_.repeated_spp);
  }

  Columns scene_columns(MaafRuns& runs, int spp) const {
    const MaafRun& run = runs.run(method_, spp);
    const MaafRun &raw = runs.run(MaafRuns::unfiltered, spp), &aaf = runs.run(MaafRuns::aaf, spp);
    const std::vector<LadderStep> raw_ladder = runs.ladder(MaafRuns::unfiltered),
                                  aaf_ladder = runs.ladder(MaafRuns::aaf);
    const LadderPlace raw_place = equal_error(raw_ladder, run.rel_mse),
                      aaf_place = equal_error(aaf_ladder, run.rel_mse);
    const double bound_spp = statistic(aaf.frame.statistics.ratios, "aaf_bound_spp");
    const double frame_s = run.frame_s(), overhead = run.overhead_share();
    return {{"spp", double(spp)},
            {"rel_mse", run.rel_mse},
            {"frame_s", frame_s},
            {"sampling_s", frame_s * (1 - overhead)},
            {"filter_s", run.filter_s()},
            {"overhead_share", overhead},
            {"speedup_vs_aaf_bound", bound_spp / spp},
            {"speedup_vs_aaf", aaf_place.spp / spp},
            {"speedup_vs_unfiltered", raw_place.spp / spp},
            {"time_ratio_vs_aaf_bound", seconds_of(aaf_ladder, bound_spp) / frame_s},
            {"time_ratio_vs_aaf", aaf_place.seconds / frame_s},
            {"time_ratio_vs_unfiltered", raw_place.seconds / frame_s},
            {"unfiltered_capped", double(raw_place.capped)},
            {"aaf_capped", double(aaf_place.capped)},
            {"unfiltered_rel_mse", raw.rel_mse},
            {"aaf_rel_mse", aaf.rel_mse},
            {"energy_ratio", runs.energy_ratio(run)},
            {"reference_rel_mse", runs.reference_rel_mse()}};
  }

  /// Every method at one sample count.
  void add_methods_row(MaafRuns& runs, const std::string& name) {
    Columns columns;
    for (const std::string method :
         {MaafRuns::unfiltered, MaafRuns::aaf, "fsf", "maaf", "wiener"}) {
      const MaafRun& run = runs.run(method, row_spp[0]);
      columns.emplace_back(fmt::format("{}_rel_mse", method), run.rel_mse);
      columns.emplace_back(fmt::format("{}_energy_ratio", method), runs.energy_ratio(run));
    }
    context_.add_row(fmt::format("methods/{}", name), std::move(columns));
  }

  void add_converge_row(MaafRuns& runs, const std::string& name) {
    Columns columns;
    for (const int spp : scale_.converge)
      columns.emplace_back(fmt::format("rel_mse_{}", spp), runs.run(method_, spp).rel_mse);
    for (const int spp : scale_.converge)
      columns.emplace_back(fmt::format("unfiltered_rel_mse_{}", spp),
                           runs.run(MaafRuns::unfiltered, spp).rel_mse);
    context_.add_row(fmt::format("converge/{}", name), std::move(columns));
  }

  void add_average(int spp, const std::vector<Columns>& rows) {
    Columns columns;
    for (const std::string_view wanted :
         {"overhead_share", "speedup_vs_aaf_bound", "speedup_vs_aaf", "speedup_vs_unfiltered",
          "time_ratio_vs_aaf_bound", "time_ratio_vs_aaf", "time_ratio_vs_unfiltered"}) {
      double sum = 0;
      for (const Columns& row : rows) sum += statistic(row, wanted);
      columns.emplace_back(wanted, sum / double(rows.size()));
    }
    context_.add_row(fmt::format("average{}", row_suffix(spp)), std::move(columns));
  }

  void write_frames(MaafRuns& runs, const std::string& name) const {
    const int spp = row_spp[0];
    const std::string method = method_.empty() ? "default" : method_.substr(0, method_.find(':'));
    MaafRuns::write(runs.reference(), folder_, fmt::format("{}-reference", name));
    MaafRuns::write(runs.run(MaafRuns::unfiltered, spp).frame, folder_,
                    fmt::format("{}-unfiltered", name));
    MaafRuns::write(runs.run(MaafRuns::aaf, spp).frame, folder_, fmt::format("{}-aaf", name));
    MaafRuns::write(runs.run(method_, spp).frame, folder_, fmt::format("{}-{}", name, method));
  }

  BenchmarkContext& context_;
  Scale scale_;
  std::string scene_, method_, folder_;
  std::map<int, std::vector<Columns>> measured_;  ///< by samples a pixel, one entry a scene
};

}  // namespace

BenchmarkDefinition benchmark_maaf() {
  return {"maaf",
          "error and time of filtering for lens, soft shadows and bounces, against AAF and more "
          "samples",
          [](BenchmarkContext& context) { MaafBenchmark(context).run(); },
          {"SCENE|all|tables", "METHOD|default", "FOLDER"}};
}

}  // namespace tessera
