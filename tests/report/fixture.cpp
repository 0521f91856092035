#include "tests/report/fixture.h"

#include <stdlib.h>

#include <fstream>
#include <limits>
#include <stdexcept>

#include <fmt/format.h>

#include "images/exr.h"

namespace tessera::fixture {
namespace {

using Json = nlohmann::ordered_json;

constexpr int run_count = 13, strange_run = 5, markup_run = 8, large_run = 11, failed_run = 12,
              left_out_run = 13;

bool is_ok(int run) { return run != failed_run && run != left_out_run; }
bool has_heatmap(int run) { return run == 1 || run == 4; }
std::string image_name(int run) { return fmt::format("runs/{:04}.exr", run); }
std::string heatmap_name(int run) { return fmt::format("runs/{:04}.tests.exr", run); }

Image strange_image(double gain) {
  Image image = gradient(gain);
  constexpr float infinity = std::numeric_limits<float>::infinity();
  for (Image::Channel& channel : image.channels) {
    channel.values[image.index(10, 5)] = std::numeric_limits<float>::quiet_NaN();
    channel.values[image.index(20, 5)] = 1e30f;
    if (channel.name == "R") channel.values[image.index(30, 5)] = infinity;
    channel.values[image.index(40, 5)] = -1.0f;
  }
  return image;
}

Image heatmap(int factor) {
  Image image(width, height);
  Image::Channel& channel = image.add_channel("heatmap.tests");
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) channel.values[image.index(x, y)] = float(factor * x);
  return image;
}

/// The number of samples and another knob, three runs a value.
Json settings_of(int run) {
  static const std::pair<const char*, const char*> turns[] = {
      {"", ""}, {"hider", "bbox"}, {"hider", "tct"}, {"shading", "ds"}, {"hider", "interleave"}};
  Json settings = {{"spp", std::to_string(1 << 2 * ((run - 1) % 3 + 1))}};
  const auto [knob, value] = turns[(run - 1) / 3];
  if (*knob) settings[knob] = value;
  return settings;
}

std::string label_of(int run) {
  if (run == markup_run) return "hider=<b>tct</b></script><script>alert(1)</script><!-- spp=16";
  std::string label;
  const Json settings = settings_of(run);  // items() does not keep a temporary alive
  for (const auto& [name, value] : settings.items())
    label =
        fmt::format("{}{}{}={}", label, label.empty() ? "" : " ", name, value.get<std::string>());
  return label;
}

Json ok_run(int run) {
  const double seconds = 0.05 * double(1 << (run - 1) % 3) * (1.0 + 0.3 * ((run * 5) % 7));
  const double error = 0.02 / double(1 << 2 * ((run - 1) % 3)) * (1.0 + 0.1 * ((run * 3) % 5));
  return {{"frame_s", seconds},
          {"frame_s_all", run == 6 ? Json{seconds * 0.97, seconds * 1.01} : Json{seconds}},
          {"wall_s", seconds + 0.1},
          {"cpu_s", seconds * 1.9},
          {"peak_bytes", 40'000'000 + run * 1'000'000},
          {"rays", run == 3 ? Json(nullptr) : Json(run == 7 ? 0 : 1000 * ((run * 7) % 11 + 1))},
          {"shaded_points", 90'000 + 1000 * run},
          {"samples", 9216 * run},
          {"ste", 0.2 + 0.01 * run},
          {"rmse", error * 3.0},
          {"rel_mse", error},
          {"visible", run == 3 ? 0.0 : error},
          {"pareto", run <= 3},
          {"limited_by_reference", run == 3},
          {"image", image_name(run)},
          {"heatmaps", has_heatmap(run) ? Json{{"tests", heatmap_name(run)}} : Json::object()}};
}

Json run_json(int run) {
  const Json settings = settings_of(run);
  Json json = {{"id", fmt::format("{:04}", run)},
               {"label", label_of(run)},
               {"options", Json::array()},
               {"settings", settings},
               {"ok", is_ok(run)},
               {"error", run == failed_run     ? "no memory: <b>4 GiB</b> needed</script>"
                         : run == left_out_run ? "not run"
                                               : ""}};
  if (run == left_out_run) json["not_run"] = true;
  for (const auto& [name, value] : settings.items()) {
    json["options"].push_back("--" + name);
    json["options"].push_back(value);
  }
  if (is_ok(run)) {
    json.update(ok_run(run));
    return json;
  }
  for (const char* name : {"frame_s", "wall_s", "cpu_s", "peak_bytes", "rays", "shaded_points",
                           "samples", "ste", "rmse", "rel_mse", "visible", "image"})
    json[name] = nullptr;
  json["pareto"] = false;
  return json;
}

Json words_of_six() {
  Json words = {"More samples & <less> error."};
  for (int i = 2; i <= 6; ++i) words.push_back(fmt::format("Finding {} of the sweep.", i));
  return words;
}

/// One of a kind that is said last, and one as long as a list of what was not run.
Json notes() {
  std::string left_out = "not run, as the budget was spent: ";
  for (int spp = 1; spp <= 40; ++spp)
    left_out += fmt::format("hider=interleave spp={}{}", spp, spp < 40 ? ", " : "");
  return {"texture-filter is left out: no surface has a texture",
          "the machine was busy before the first run (load 8.8)", left_out,
          "2 configurations have fewer than 3 repeats"};
}

/// Wider than a telephone, its verdict after what it is about and many numbers; nothing in "seen".
Json extremes() {
  Json table = {{"title", "extremes"},
                {"columns",
                 {{{"name", "case"}},
                  {{"name", "compared"}},
                  {{"name", "frame_s"}, {"unit", "s"}},
                  {{"name", "worst_error"}},
                  {{"name", "time_saved_percent"}},
                  {{"name", "verdict"}},
                  {{"name", "oracle"}},
                  {{"name", "seen"}}}},
                {"rows",
                 {{"blur of <i>1000</i> pixels", 200000, 1.25, 1e-6, 12.5, "ok",
                   "a closed form in long double, and brute force besides", ""},
                  {"no light", 17, nullptr, "at least 3.17", 0.0, "failed", "black", ""}}},
                {"notes", {"Times are medians."}}};
  for (int i = 1; i <= 4; ++i) {
    table["rows"].push_back(table["rows"][0]);
    table["rows"].back()[0] = fmt::format("a case of a rather long name, number {}", i);
  }
  return table;
}

}  // namespace

Image gradient(double gain, int columns, int rows) {
  Image image(columns, rows);
  for (const char* name : {"R", "G", "B"}) image.add_channel(name);
  for (int y = 0; y < rows; ++y)
    for (int x = 0; x < columns; ++x) {
      const size_t i = image.index(x, y);
      image.channels[0].values[i] = float(gain * (x + 0.5) / columns);
      image.channels[1].values[i] = float(gain * (y + 0.5) / rows);
      image.channels[2].values[i] = float(gain / 4);
    }
  return image;
}

Json table() {
  Json runs = Json::array();
  for (int run = 1; run <= run_count; ++run) runs.push_back(run_json(run));
  return {{"version", 1},
          {"scene", "scenes/<fixture>.rib"},
          {"scene_hash", "0123456789abcdef"},
          {"software", "Tessera 0.1.0"},
          {"machine", {{"cpu", "a processor"}, {"cores", 2}}},
          {"created", "2026-01-02T03:04:05Z"},
          {"reference",
           {{"file", "reference.exr"},
            {"spp", 1024},
            {"frame_s", 12.3},
            {"options", {"--spp", "1024"}},
            {"rel_mse", 1e-5}}},
          {"knobs",
           {{{"name", "spp"},
             {"what", "samples per pixel"},
             {"default", "16"},
             {"values", {"4", "16", "64"}}},
            {{"name", "hider"},
             {"what", "how visibility is found"},
             {"default", "auto"},
             {"values", {"bbox", "tct", "interleave"}}},
            {{"name", "shading"},
             {"what", "how shading is placed"},
             {"default", "aas"},
             {"values", {"ds"}}}}},
          {"runs", runs},
          {"words", words_of_six()},
          {"notes", notes()},
          {"tables", Json::array({extremes()})}};
}

void write(const std::filesystem::path& folder) {
  std::filesystem::create_directories(folder / "runs");
  write_exr((folder / "reference.exr").string(), gradient(1.0));
  for (int run = 1; run <= run_count; ++run) {
    const double gain = 1.0 + run / 16.0;
    if (is_ok(run))
      write_exr((folder / image_name(run)).string(), run == strange_run ? strange_image(gain)
                                                     : run == large_run
                                                         ? gradient(gain, large_width, large_height)
                                                         : gradient(gain));
    if (has_heatmap(run)) write_exr((folder / heatmap_name(run)).string(), heatmap(run));
  }
  std::ofstream(folder / "trade.json") << table().dump(1);
}

TemporaryFolder::TemporaryFolder() {
  std::string name = (std::filesystem::temp_directory_path() / "tessera-report-XXXXXX").string();
  if (!mkdtemp(name.data())) throw std::runtime_error("no temporary folder");
  path_ = name;
}

TemporaryFolder::~TemporaryFolder() {
  std::error_code ignored;
  std::filesystem::remove_all(path_, ignored);
}

}  // namespace tessera::fixture
