#include "scenes/rib/rib_reader.h"

#include "scenes/rib/rib_session.h"
#include "scenes/scene_builder.h"

namespace tessera {

namespace {

void parse(ByteSource source, SceneCalls& calls, Diagnostics& diagnostics,
           const RibReaderOptions& options) {
  const std::string name = source.name();
  RibSession session(calls, diagnostics, {name, {}, options.archive_path});
  session.read(std::move(source));
  if (calls.wants_more()) calls.finish({name, 0});
}

}  // namespace

void parse_rib(const std::string& path, SceneCalls& calls, Diagnostics& diagnostics,
               const RibReaderOptions& options) {
  parse(ByteSource::from_file(path), calls, diagnostics, options);
}

void parse_rib_text(std::string_view text, const std::string& name, SceneCalls& calls,
                    Diagnostics& diagnostics, const RibReaderOptions& options) {
  parse(ByteSource::from_text(text, name), calls, diagnostics, options);
}

void read_rib(const std::string& path, SceneSink& sink, Diagnostics& diagnostics,
              const RibReaderOptions& options) {
  SceneBuilder builder(sink, diagnostics, path);
  parse_rib(path, builder, diagnostics, options);
}

void read_rib_text(std::string_view text, const std::string& name, SceneSink& sink,
                   Diagnostics& diagnostics, const RibReaderOptions& options) {
  SceneBuilder builder(sink, diagnostics, name);
  parse_rib_text(text, name, builder, diagnostics, options);
}

}  // namespace tessera
