#pragma once
/// Stage header: the RIB reader. RenderMan Interface Bytestream 3.2, ASCII and binary, plain or
/// gzip, read as a stream.

#include <string>
#include <string_view>
#include <vector>

#include "base/diagnostics.h"
#include "scenes/scene_calls.h"
#include "scenes/scene_sink.h"

namespace tessera {

struct RibReaderOptions {
  std::vector<std::string> archive_path;  ///< tried after the scene's own search path
};

/// Reads the file at `path` and delivers every world in it to `sink`. Requests that are not
/// supported are skipped with a warning each; anything malformed throws Error with file and line.
void read_rib(const std::string& path, SceneSink& sink, Diagnostics& diagnostics,
              const RibReaderOptions& options = {});
/// The same for RIB held in memory; `name` stands for the file in messages and Scene::file.
void read_rib_text(std::string_view text, const std::string& name, SceneSink& sink,
                   Diagnostics& diagnostics, const RibReaderOptions& options = {});

/// The parser alone: turns RIB into calls.
void parse_rib(const std::string& path, SceneCalls& calls, Diagnostics& diagnostics,
               const RibReaderOptions& options = {});
void parse_rib_text(std::string_view text, const std::string& name, SceneCalls& calls,
                    Diagnostics& diagnostics, const RibReaderOptions& options = {});

}  // namespace tessera
