#include "trade/renderer.h"

#include <algorithm>
#include <filesystem>
#include <fstream>

#include <fmt/format.h>
#include <unistd.h>

#include "base/error.h"
#include "trade/content_hash.h"

namespace tessera::trade {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

Renderer::Renderer(std::string program, std::string scene, std::vector<std::string> common,
                   double timeout_s, const std::atomic<bool>* cancel)
    : program_(std::move(program)),
      scene_(std::move(scene)),
      common_(std::move(common)),
      timeout_s_(timeout_s),
      cancel_(cancel) {
  help_ = ask({"render", "--help"});
  software_ = ask({"--version"});
  software_.erase(std::min(software_.find('\n'), software_.size()));
  build_ = hash_file(program_);
}

std::string Renderer::ask(const std::vector<std::string>& arguments) const {
  std::vector<std::string> command{program_};
  command.insert(command.end(), arguments.begin(), arguments.end());
  std::string log = (fs::temp_directory_path() / "tessera-trade-XXXXXX").string();
  const int descriptor = mkstemp(log.data());
  if (descriptor < 0) throw Error(fmt::format("cannot write {}", log));
  close(descriptor);
  const ProcessResult result = run_process(command, log);
  std::error_code ignored;
  fs::remove(log, ignored);
  if (!result.ok())
    throw Error(fmt::format("{} {}: {}", program_, fmt::join(arguments, " "), result.failure()));
  return result.output;
}

bool Renderer::has_option(const std::string& option) const {
  for (size_t at = help_.find(option); at != help_.npos; at = help_.find(option, at + 1)) {
    const size_t end = at + option.size();
    const bool begins = at > 0 && (help_[at - 1] == ' ' || help_[at - 1] == ',');
    const bool ends = end == help_.size() || help_[end] == ' ' || help_[end] == '\n';
    // Options stand at the beginning of their line; elsewhere they are only spoken of.
    const size_t line = help_.rfind('\n', at) + 1;
    if (begins && ends && help_.find_first_not_of(' ', line) >= line &&
        help_[help_.find_first_not_of(' ', line)] == '-')
      return true;
  }
  return false;
}

Rendered Renderer::render(const std::vector<std::string>& options, const std::string& image,
                          double limit_s) const {
  const std::string statistics = image + ".json", log = image + ".log";
  std::vector<std::string> command{program_, "render", scene_, "-o", image, "--stats", statistics};
  command.insert(command.end(), common_.begin(), common_.end());
  command.insert(command.end(), options.begin(), options.end());
  std::error_code ignored;
  fs::remove(image, ignored);
  fs::remove(statistics, ignored);
  Rendered rendered;
  rendered.process = run_process(command, log, {limit_s, cancel_});
  rendered.failure = rendered.process.failure();
  if (rendered.failure.empty()) {
    std::ifstream stream(statistics);
    rendered.statistics = Json::parse(stream, nullptr, false);
    if (!fs::exists(image) || !rendered.statistics.is_object())
      rendered.failure = fmt::format(
          "wrote no single image; a scene of several frames needs one "
          "picked, as with -- --frames 1-1");
  }
  fs::remove(statistics, ignored);
  // What a failed run said stays beside its image.
  if (rendered.failure.empty() || rendered.process.cancelled) fs::remove(log, ignored);
  return rendered;
}

ScenePlan plan_of(const Json& statistics) {
  ScenePlan plan;
  const auto read = [&statistics](const char* section, std::map<std::string, std::string>& into) {
    if (!statistics.contains(section)) return;
    for (const auto& [name, value] : statistics.at(section).items())
      if (value.is_string()) into[name] = value.get<std::string>();
  };
  read("plan", plan.entries);
  read("options", plan.options);
  return plan;
}

}  // namespace tessera::trade
