// The program with the renderer, as a user runs them.

#include <filesystem>

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "tests/trade/trade_fixtures.h"
#include "trade/process.h"

using namespace tessera::trade;
using Catch::Contains;
using Json = nlohmann::ordered_json;

namespace {

constexpr const char* scene_text = R"(Format 32 18 1
PixelSamples 2 2
Shutter 0 1
Projection "perspective" "fov" [40]
WorldBegin
  LightSource "ambientlight" 1 "intensity" [0.4]
  LightSource "distantlight" 2 "from" [1 2 -1] "to" [0 0 0]
  Translate 0 0 4
  MotionBegin [0 1]
    Translate -0.2 0 0
    Translate 0.2 0 0
  MotionEnd
  Surface "plastic"
  Sphere 1 -1 1 360
WorldEnd
)";

class Sweep {
 public:
  Sweep() { folder_.write("s.rib", scene_text); }

  ProcessResult run(std::vector<std::string> options) const {
    std::vector<std::string> command{TESSERA_BINARY_DIR "/tessera_trade", folder_ / "s.rib"};
    command.insert(command.end(), {"-o", folder_ / "out", "--cache", folder_ / "cache", "--threads",
                                   "1", "--repeats", "2", "--reference-spp", "32", "--spp", "1,4"});
    command.insert(command.end(), options.begin(), options.end());
    return run_process(command, folder_ / "log");
  }
  Json table() const { return Json::parse(text_in(folder_ / "out/trade.json")); }
  const TestFolder& folder() const { return folder_; }

 private:
  TestFolder folder_;
};

}  // namespace

TEST_CASE("a sweep of two knobs leaves its table, and goes on from half a ledger") {
  const Sweep sweep;
  const std::vector<std::string> knobs{"--knobs", "spp,hider=bbox,shading=sample", "--against",
                                       "bbox"};
  const ProcessResult result = sweep.run(knobs);
  INFO(result.output);
  REQUIRE(result.exit_code == 0);
  Json table = sweep.table();
  // 1, 2 and 4 samples of the default; 1 and 4 of two values.
  REQUIRE(table.at("runs").size() == 7);
  CHECK(table.at("tables").size() == 1);
  CHECK(table.at("reference").at("spp") == 32);
  CHECK(table.at("reference").at("rel_mse").get<double>() > 0);
  int front = 0;
  Json by_label;
  for (const Json& run : table.at("runs")) {
    INFO(run.dump());
    CHECK(run.at("ok") == true);
    CHECK(run.at("frame_s_all").size() == 2);
    CHECK(run.at("rel_mse").get<double>() > 0);
    CHECK(std::filesystem::exists(sweep.folder() / ("out/" + run.at("image").get<std::string>())));
    front += run.at("pareto") == true;
    by_label[run.at("label").get<std::string>()] = run;
  }
  CHECK(front > 0);
  // Boxes find what the default finds, bit for bit; more samples come nearer.
  CHECK(by_label["hider=bbox spp=4"]["rel_mse"] == by_label["spp=4"]["rel_mse"]);
  CHECK(by_label["spp=4"]["rel_mse"] < by_label["spp=1"]["rel_mse"]);
  CHECK_THAT(sweep.run(knobs).output, Contains("--resume"));

  const std::string ledger = sweep.folder() / "out/runs.jsonl", whole = text_in(ledger);
  sweep.folder().write("out/runs.jsonl", whole.substr(0, whole.size() / 2));
  std::vector<std::string> again = knobs;
  again.push_back("--resume");
  const ProcessResult resumed = sweep.run(again);
  INFO(resumed.output);
  CHECK(resumed.exit_code == 0);
  CHECK_THAT(resumed.output, Contains("reference (cached)") && Contains("resuming after"));
  CHECK(text_in(ledger).starts_with(
      whole.substr(0, whole.size() / 2).substr(0, whole.rfind('\n', whole.size() / 2))));
  table = sweep.table();
  for (const Json& run : table.at("runs")) {
    CHECK(run.at("rel_mse") == by_label[run.at("label").get<std::string>()]["rel_mse"]);
    CHECK(run.at("frame_s_all").size() == 2);
  }
  sweep.folder().write("s.rib", std::string(scene_text) + "# changed\n");
  CHECK_THAT(sweep.run(again).output, Contains("scene hash: was"));
}

TEST_CASE("a run that fails is a row, and the others go on") {
  const Sweep sweep;
  const ProcessResult result = sweep.run({"--knobs", "spp,shading=aas:nonsense=1"});
  INFO(result.output);
  CHECK(result.exit_code == 0);
  CHECK_THAT(result.output, Contains("failed: shading=aas:nonsense=1 spp=1: "));
}

TEST_CASE("what cannot be swept is said with the renderer's exit codes") {
  const TestFolder folder;
  const std::string program = TESSERA_BINARY_DIR "/tessera_trade";
  const auto run = [&](std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), program);
    return run_process(arguments, folder / "log");
  };
  CHECK(run({"--help"}).exit_code == 0);
  CHECK(run({}).exit_code == 2);
  CHECK(run({"s.rib", "--budget", "0"}).exit_code == 2);
  CHECK(run({"s.rib", "--knobs", "colour"}).exit_code == 2);
  const ProcessResult unknown = run({"s.rib", "--knobs", "shading=ds,hider=shear:foo"});
  CHECK(unknown.exit_code == 2);
  CHECK_THAT(unknown.output, Contains("hider=foo") && Contains("bbox"));
  CHECK(run({"s.rib", "--knobs", "dicing-rate=1e29"}).exit_code == 2);
  const ProcessResult missing = run({folder / "none.rib", "-o", folder / "out"});
  CHECK(missing.exit_code == 1);
  CHECK_THAT(missing.output, Contains("none.rib"));
  CHECK_FALSE(std::filesystem::exists(folder / "out"));
  const std::string broken = folder.write("broken.rib", "Sphere 1");
  CHECK_THAT(run({broken, "-o", folder / "out"}).output, Contains("cannot be rendered"));
  // Before the scene is rendered.
  const std::string file = folder.write("file", "");
  CHECK_THAT(run({broken, "-o", folder / "out", "--report", file + "/r"}).output,
             Contains("--report: cannot write"));
}
