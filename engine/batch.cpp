#include "engine/batch.h"

#include <algorithm>
#include <exception>
#include <filesystem>
#include <memory>
#include <utility>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "engine/frame.h"
#include "engine/frame_numbers.h"
#include "engine/heatmap.h"
#include "engine/outputs.h"
#include "scenes/rib/rib_reader.h"
#include "scenes/scene_sink.h"

namespace tessera {

std::vector<SceneFile> expand_scenes(const std::vector<std::string>& names,
                                     const std::optional<std::vector<int>>& frames) {
  std::vector<SceneFile> files;
  for (const std::string& name : names) {
    if (!has_number_pattern(name)) {
      files.push_back({name, std::nullopt});
      continue;
    }
    if (!frames) {
      throw Error(fmt::format("{}: expected --frames A-B to go with a numbered name", name));
    }
    for (int number : *frames) files.push_back({with_number(name, number), number});
  }
  return files;
}

/// The frames of one file on their way to be rendered. Whether a name needs a number depends on
/// whether another frame follows, so where that matters a frame waits until the next one is read.
class Batch::FrameQueue : public SceneSink {
 public:
  FrameQueue(Batch& batch, const SceneFile& file, Diagnostics& diagnostics)
      : batch_(batch), file_(file), diagnostics_(diagnostics) {}

  bool frame(std::unique_ptr<const Scene> scene) override {
    ++frames_read_;
    if (!batch_.selects(file_, *scene)) return !batch_.cancel_;
    ++frames_selected_;
    several_ = frames_selected_ > 1;
    flush();
    waiting_ = std::move(scene);
    if (batch_.knows_names_of_lone_frame(file_)) flush();
    return !batch_.cancel_;
  }

  void make_shadow(const std::string& picture, const std::string& shadow,
                   const SourceLocation& where) override {
    shadows_.push_back({picture, shadow, where});
    if (!waiting_) flush();
  }

  /// Renders what is still waiting, then makes the shadow maps that were asked for after it.
  void flush() {
    if (waiting_ && !batch_.cancel_) batch_.run_frame(file_, *waiting_, several_, diagnostics_);
    waiting_.reset();
    for (const ShadowJob& job : std::exchange(shadows_, {})) make(job);
  }

  int frames_read() const { return frames_read_; }
  int frames_selected() const { return frames_selected_; }

 private:
  struct ShadowJob {
    std::string picture, shadow;
    SourceLocation where;
  };

  void make(const ShadowJob& job) {
    if (batch_.cancel_) return;
    try {
      tessera::make_shadow(job.picture, job.shadow);
    } catch (const std::exception& error) {
      diagnostics_.warn_once(
          "MakeShadow " + job.shadow, job.where,
          fmt::format("MakeShadow: {}; {} is not made", error.what(), job.shadow));
    }
  }

  Batch& batch_;
  const SceneFile& file_;
  Diagnostics& diagnostics_;
  std::unique_ptr<const Scene> waiting_;
  std::vector<ShadowJob> shadows_;
  int frames_read_ = 0, frames_selected_ = 0;
  bool several_ = false;
};

namespace {

/// What there is to add to the names of a frame's files.
std::string_view outcome(const FrameResult& frame) {
  if (frame.complete) return "";
  return frame.whole ? " (interrupted: fewer samples than it would have)"
                     : " (interrupted: finished buckets only)";
}

}  // namespace

Batch::Batch(const BatchRequest& request, Console& console, const std::atomic<bool>& cancel)
    : request_(request),
      console_(console),
      cancel_(cancel),
      files_(expand_scenes(request.scenes, request.frames)) {
  std::error_code ignored;
  output_is_folder_ =
      request.output.ends_with('/') ||
      (!request.output.empty() && std::filesystem::is_directory(request.output, ignored));
}

BatchResult Batch::run() {
  for (const SceneFile& file : files_) {
    if (cancel_) break;
    run_file(file);
  }
  result_.cancelled = cancel_;
  return result_;
}

void Batch::run_file(const SceneFile& file) {
  // A numbered file tells its frame's names without being read.
  if (file.number && !request_.output.empty() &&
      skip(name_files(file, *file.number, false), file.name)) {
    return;
  }
  Diagnostics diagnostics([this](const std::string& line) { console_.note(line); });
  FrameQueue queue(*this, file, diagnostics);
  std::string message;
  try {
    read_rib(file.name, queue, diagnostics);
    if (queue.frames_read() == 0) {
      message = fmt::format("{}: no frame found, expected WorldBegin ... WorldEnd", file.name);
    } else if (queue.frames_selected() == 0 && !cancel_) {
      message = fmt::format("{}: none of its {} frames is among --frames", file.name,
                            queue.frames_read());
    }
  } catch (const std::exception& error) {
    message = error.what();
  }
  queue.flush();
  if (!message.empty()) fail(file.name, message);
}

void Batch::run_frame(const SceneFile& file, const Scene& scene, bool several,
                      Diagnostics& diagnostics) {
  std::string label = file.name;
  if (scene.frame_number > 0 && !file.number) label += fmt::format(" frame {}", scene.frame_number);
  try {
    FrameFiles files = name_files(file, number_of(file, scene), several);
    if (files.images.empty()) {
      files.images = display_outputs(scene);
      files.from_displays = true;
    }
    if (request_.settings.heatmap)
      files.heatmap = heatmap_path(files.images.front(), *request_.settings.heatmap);
    claim(files);
    if (skip(files, label)) return;
    for (const std::string& name : files.all()) check_writable(name);
    check_formats(files, scene);
    render(scene, files, label, diagnostics);
  } catch (const std::exception& error) {
    fail(label, error.what());
  }
}

void Batch::render(const Scene& scene, const FrameFiles& files, const std::string& label,
                   Diagnostics& diagnostics) {
  struct ProgressGuard {
    Console& console;
    ~ProgressGuard() { console.end_progress(); }
  };
  FrameControl control;
  control.progress = [this](const FrameProgress& progress) { console_.progress(progress); };
  control.cancel = &cancel_;
  const FrameResult frame = [&] {
    const ProgressGuard guard{console_};
    console_.begin_progress(label);
    return render_frame(scene, request_.settings, diagnostics, control);
  }();

  std::vector<std::string> written = files.images;
  if (files.from_displays) {
    written = write_displays(frame, scene);
  } else {
    write_frame(frame, files.images.front());
  }
  if (!files.preview.empty()) {
    write_preview(frame, files.preview);
    written.push_back(files.preview);
  }
  if (!files.heatmap.empty()) {
    write_heatmap(frame, files.heatmap);
    written.push_back(files.heatmap);
    console_.note(describe_scale(heatmap_scale(frame.image, frame.heatmap), frame.heatmap));
  }
  if (!files.statistics.empty()) {
    write_text_file(files.statistics, frame.statistics.json().dump(2) + "\n");
    written.push_back(files.statistics);
  }
  if (frame.complete) ++result_.rendered;
  console_.print(fmt::format("{} -> {}{}", label, fmt::join(written, ", "), outcome(frame)));
  console_.print(console_.verbose() ? frame.statistics.report() : frame.statistics.summary());
}

bool Batch::skip(const FrameFiles& files, const std::string& label) {
  if (!request_.skip_existing || files.images.empty()) return false;
  if (!std::all_of(files.images.begin(), files.images.end(), is_finished_image)) return false;
  ++result_.skipped;
  console_.print(fmt::format("{}: {} exists, skipped", label, fmt::join(files.images, ", ")));
  return true;
}

void Batch::fail(const std::string& name, const std::string& message) {
  console_.error(message);
  result_.failures.push_back({name, message});
}

bool Batch::selects(const SceneFile& file, const Scene& scene) const {
  if (file.number || !request_.frames) return true;
  return std::binary_search(request_.frames->begin(), request_.frames->end(), scene.frame_number);
}

/// Whether the first frame of a file has the same names when it is alone as when others follow.
bool Batch::knows_names_of_lone_frame(const SceneFile& file) const {
  const bool named = !(request_.output + request_.preview + request_.statistics).empty();
  if (!named) return true;
  if (output_is_folder_) return false;
  return file.number || files_.size() > 1;
}

int Batch::number_of(const SceneFile& file, const Scene& scene) {
  if (file.number) return *file.number;
  int number = scene.frame_number;
  while (!numbers_taken_.insert(number).second) ++number;
  return number;
}

FrameFiles Batch::name_files(const SceneFile& file, int number, bool several) const {
  const bool numbered = several || file.number || files_.size() > 1;
  const auto name = [number](const std::string& pattern, bool insert) {
    if (pattern.empty()) return pattern;
    if (has_number_pattern(pattern)) return with_number(pattern, number);
    return insert ? insert_number(pattern, number) : pattern;
  };
  FrameFiles files;
  files.preview = name(request_.preview, numbered);
  files.statistics = name(request_.statistics, numbered);
  if (output_is_folder_) {
    const std::filesystem::path stem = std::filesystem::path(file.name).stem();
    const std::string path = (request_.output / stem).string() + ".exr";
    files.images = {name(path, several)};
  } else if (!request_.output.empty()) {
    files.images = {name(request_.output, numbered)};
  }
  return files;
}

void Batch::claim(const FrameFiles& files) {
  std::set<std::string> of_frame;
  for (const std::string& name : files.all()) {
    const std::string path = std::filesystem::path(name).lexically_normal().string();
    if (!of_frame.insert(path).second)
      throw Error(fmt::format(
          "{} is named twice by this frame; expected a name of its own for each of its files",
          name));
    if (names_claimed_.contains(path))
      throw Error(
          fmt::format("{} was already written by an earlier frame; expected a name of its "
                      "own, as with -o NAME.####.exr",
                      name));
  }
  names_claimed_.merge(of_frame);
}

}  // namespace tessera
