#pragma once
/// Helpers for tests that read scenes.

#include <filesystem>
#include <fstream>
#include <memory>
#include <string>
#include <vector>

#include <catch2/catch.hpp>

#include "scenes/rib/rib_reader.h"

namespace tessera::test {

struct CollectFrames : SceneSink {
  std::vector<std::unique_ptr<const Scene>> frames;
  size_t wanted = size_t(-1);
  bool frame(std::unique_ptr<const Scene> scene) override {
    frames.push_back(std::move(scene));
    return frames.size() < wanted;
  }
};

struct ReadResult {
  std::vector<std::unique_ptr<const Scene>> frames;
  std::vector<std::string> warnings;
  const Scene& scene() const { return *frames.at(0); }
};

inline ReadResult read_text(std::string_view text) {
  CollectFrames sink;
  Diagnostics diagnostics;
  read_rib_text(text, "test.rib", sink, diagnostics);
  return {std::move(sink.frames), diagnostics.lines()};
}

/// One world with `text` in it.
inline ReadResult read_world(const std::string& text) {
  return read_text("WorldBegin\n" + text + "\nWorldEnd\n");
}

/// The message of the Error that reading `text` throws; empty if none is thrown.
inline std::string error_of(const std::string& text) {
  try {
    read_text(text);
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

inline std::string error_in_world(const std::string& text) {
  return error_of("WorldBegin " + text + " WorldEnd");
}

/// A folder of its own, removed in the end.
class TestFolder {
 public:
  explicit TestFolder(const std::string& name)
      : path_(std::filesystem::path(TESSERA_BINARY_DIR) / "test_files" / name) {
    std::filesystem::remove_all(path_);
    std::filesystem::create_directories(path_);
  }
  ~TestFolder() { std::filesystem::remove_all(path_); }
  std::string operator/(const std::string& file) const { return (path_ / file).string(); }
  std::string write(const std::string& file, const std::string& content) const {
    std::filesystem::create_directories((path_ / file).parent_path());
    std::ofstream(path_ / file, std::ios::binary) << content;
    return (path_ / file).string();
  }

 private:
  std::filesystem::path path_;
};

inline ReadResult read_file(const std::string& path, const RibReaderOptions& options = {}) {
  CollectFrames sink;
  Diagnostics diagnostics;
  read_rib(path, sink, diagnostics, options);
  return {std::move(sink.frames), diagnostics.lines()};
}

using Catch::Matchers::Contains;

}  // namespace tessera::test
