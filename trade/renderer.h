#pragma once
/// `tessera render`, driven from outside as a user does.

#include <atomic>
#include <optional>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "trade/process.h"
#include "trade/scene_plan.h"

namespace tessera::trade {

struct Rendered {
  ProcessResult process;
  nlohmann::ordered_json statistics;  ///< as --stats writes them; null when it failed
  std::string failure;                ///< in one line; empty: all went well
};

class Renderer {
 public:
  /// `program`: the renderer. `common`: options of every run. `timeout_s`: what a measured run may
  /// take. Outlived by what `cancel` points to.
  Renderer(std::string program, std::string scene, std::vector<std::string> common,
           double timeout_s, const std::atomic<bool>* cancel);

  /// Renders the scene to `image` (an EXR) with these options besides the common ones, for at most
  /// `limit_s`. Never throws for what the renderer does.
  Rendered render(const std::vector<std::string>& options, const std::string& image,
                  double limit_s) const;

  /// Whether `tessera render --help` lists an option ("--hider").
  bool has_option(const std::string& option) const;
  /// Version, and a hash of the program's bytes: "Tessera 0.1.0", "0123456789abcdef".
  const std::string& software() const { return software_; }
  const std::string& build() const { return build_; }
  const std::string& scene() const { return scene_; }
  const std::vector<std::string>& common() const { return common_; }
  double timeout_s() const { return timeout_s_; }

 private:
  std::string ask(const std::vector<std::string>& arguments) const;

  std::string program_, scene_;
  std::vector<std::string> common_;
  double timeout_s_;
  const std::atomic<bool>* cancel_;
  std::string help_, software_, build_;
};

/// The plan and the options in force, from statistics.
ScenePlan plan_of(const nlohmann::ordered_json& statistics);

}  // namespace tessera::trade
