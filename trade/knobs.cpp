#include "trade/knobs.h"

#include <fmt/format.h>

#include "base/error.h"

namespace tessera::trade {
namespace {

std::string idle_without_blur(const ScenePlan& plan) {
  if (plan.has("motion") || plan.has("lens")) return "";
  return "nothing moves and the lens is closed";
}

std::string idle_without_textures(const ScenePlan& plan) {
  return plan.has("textures") ? "" : "no surface has a texture";
}

std::string idle_without_distribution(const ScenePlan& plan) {
  for (const char* feature : {"motion", "lens", "area_lights", "bounce"})
    if (plan.has(feature)) return "";
  return "no lens, motion, light with extent or bounce spreads the samples";
}

std::string idle_without_rays(const ScenePlan& plan) {
  return plan.has("ray_tracing") ? "" : "no light casts rays";
}

std::string idle_without_aas(const ScenePlan& plan) {
  const std::string shading = plan.text("shading");
  if (shading.starts_with("aas")) return "";
  return fmt::format("the shading mode is {}, and aas alone has shares", shading);
}

}  // namespace

std::span<const Knob> knob_table() {
  static const std::vector<Knob> table = {
      {.name = "spp",
       .option = "--spp",
       .what = "samples per pixel",
       .plan_entry = "samples_per_pixel",
       .numeric = true},
      {.name = "shading-rate",
       .option = "--shading-rate",
       .what = "area of a shading cell in pixels^2",
       .default_value = "the scene's own",
       .values = {"0.25", "4"},
       .numeric = true},
      {.name = "dicing-rate",
       .option = "--dicing-rate",
       .what = "area of a micropolygon in pixels^2",
       .default_value = "the scene's shading rate",
       .values = {"0.25", "4", "16"},
       .numeric = true},
      {.name = "ray-dicing-rate",
       .option = "--ray-dicing-rate",
       .what = "area of a micropolygon that rays meet in pixels^2",
       .default_value = "4 times the surface's own",
       .values = {"1", "16", "64"},
       .numeric = true,
       .idle = idle_without_rays},
      {.name = "hider",
       .option = "--hider",
       .what = "how visibility is found",
       .plan_entry = "hider",
       .values = {"auto", "shear", "bbox", "interleave", "accumulate"},
       .idle = idle_without_blur},
      {.name = "shading",
       .option = "--shading",
       .what = "how shading is placed",
       .plan_entry = "shading",
       .values = {"aas", "ds", "reyes", "pixel", "sample"}},
      {.name = "share",
       .option = "--shading",
       .what = "share of the energy of blur that shading cells can carry",
       .argument = "aas:share={}",
       .default_value = "0.96 of the lens, 0.98 of shutter and filter",
       .values = {"0.9", "0.99", "0.999"},
       .numeric = true,
       .idle = idle_without_aas},
      {.name = "reconstruct",
       .option = "--reconstruct",
       .what = "how samples become pixels",
       .plan_entry = "reconstruct",
       .values = {"filter", "wiener", "maaf"},
       .idle = idle_without_distribution},
      {.name = "texture-filter",
       .option = "--texture-filter",
       .what = "how textures are looked up",
       .default_value = "anisotropic",
       .values = {"point", "bilinear", "trilinear", "anisotropic"},
       .idle = idle_without_textures},
      {.name = "quality",
       .option = "--quality",
       .what = "the renderer's own presets; swept with --qualities",
       .default_value = "none"},
  };
  return table;
}

std::span<const Baseline> baseline_table() {
  static const std::vector<Baseline> table = {
      {"ds", {"shading", "ds"}, "decoupled sampling"},
      {"reyes", {"shading", "reyes"}, "shading of grid vertices"},
      {"pixel", {"shading", "pixel"}, "one shade for each micropolygon and pixel"},
      {"sample", {"shading", "sample"}, "one shade for each sample"},
      {"bbox", {"hider", "bbox"}, "boxes swept by micropolygons"},
      {"interleave", {"hider", "interleave"}, "interleaved rasterisation"},
      {"pixar", {"hider", "pixar"}, "boxes for strata of lens and shutter"},
      {"tct", {"hider", "tct"}, "time-continuous triangles"},
      {"accumulate", {"hider", "accumulate"}, "accumulation buffer"},
      {"aaf", {"reconstruct", "aaf"}, "axis-aligned filter"},
      {"fsf", {"reconstruct", "fsf"}, "sheared filter"},
      {"maaf", {"reconstruct", "maaf"}, "sum of axis-aligned filters"},
      {"filter", {"reconstruct", "filter"}, "the pixel filter alone"},
  };
  return table;
}

namespace {

template <class Row>
const Row& find_row(std::span<const Row> table, const std::string& name, const char* kind) {
  std::string names;
  for (const Row& row : table) {
    if (row.name == name) return row;
    names += " " + row.name;
  }
  throw Error(fmt::format("no {} '{}'; there is{}", kind, name, names));
}

}  // namespace

const Knob& find_knob(const std::string& name) { return find_row(knob_table(), name, "knob"); }

const Baseline& find_baseline(const std::string& name) {
  return find_row(baseline_table(), name, "baseline");
}

std::vector<std::string> options_of(const Turn& turn) {
  if (turn.is_default()) return {};
  const Knob& knob = find_knob(turn.knob);
  return {knob.option, fmt::format(fmt::runtime(knob.argument), turn.value)};
}

}  // namespace tessera::trade
