#pragma once
/// Frames in turn: several files, numbered files, files of several frames. What fails is noted and
/// does not stop the rest.

#include <atomic>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "base/diagnostics.h"
#include "engine/console.h"
#include "engine/frame_files.h"
#include "engine/settings.h"
#include "scenes/scene.h"

namespace tessera {

/// What to render and where to put it. Names may hold a run of '#' for the frame's number; one that
/// does not gets ".NNNN" before its extension when there are several frames.
struct BatchRequest {
  std::vector<std::string> scenes;
  /// A file, or a folder (ends in '/' or exists as one) for a file named after each scene. Empty:
  /// the scene's own Displays.
  std::string output;
  std::string preview, statistics;  ///< further files of each frame; empty: none
  /// Numbers for scenes named with '#'; of the frames of other files, only these are rendered.
  std::optional<std::vector<int>> frames;
  bool skip_existing = false;  ///< leave out frames whose images exist and are finished
  Settings settings;
};

struct BatchFailure {
  std::string name;  ///< of the scene file or frame
  std::string message;
};

struct BatchResult {
  int rendered = 0, skipped = 0;
  std::vector<BatchFailure> failures;
  bool cancelled = false;
};

/// A scene file to read. `number` is the one its name was made with.
struct SceneFile {
  std::string name;
  std::optional<int> number;
};

/// Names with '#' become one file for each of the frames. Throws Error if none are given then.
std::vector<SceneFile> expand_scenes(const std::vector<std::string>& names,
                                     const std::optional<std::vector<int>>& frames);

/// Runs a request, once. The number of a frame is that of its file or of its FrameBegin; where that
/// was taken by an earlier frame of the batch, the next free one.
class Batch {
 public:
  /// Throws Error when the request makes no sense. Everything given outlives the batch. When
  /// `cancel` turns true, the frame under way is written as far as it is, and no other is begun.
  Batch(const BatchRequest& request, Console& console, const std::atomic<bool>& cancel);

  BatchResult run();

 private:
  class FrameQueue;

  void run_file(const SceneFile& file);
  void run_frame(const SceneFile& file, const Scene& scene, bool several, Diagnostics& diagnostics);
  void render(const Scene& scene, const FrameFiles& files, const std::string& label,
              Diagnostics& diagnostics);
  bool skip(const FrameFiles& files, const std::string& label);
  void fail(const std::string& name, const std::string& message);

  bool selects(const SceneFile& file, const Scene& scene) const;
  bool knows_names_of_lone_frame(const SceneFile& file) const;
  int number_of(const SceneFile& file, const Scene& scene);
  FrameFiles name_files(const SceneFile& file, int number, bool several) const;
  void claim(const FrameFiles& files);

  const BatchRequest& request_;
  Console& console_;
  const std::atomic<bool>& cancel_;
  std::vector<SceneFile> files_;
  bool output_is_folder_ = false;
  std::set<int> numbers_taken_;
  std::set<std::string> names_claimed_;  ///< so that no frame overwrites another
  BatchResult result_;
};

}  // namespace tessera
