#pragma once
/// Prints the calls of a scene as ASCII RIB. The second receiver of SceneCalls beside SceneBuilder:
/// with it a scene of any format can be turned into RIB, one archive-free file.

#include <iosfwd>
#include <string>

#include "scenes/scene_calls.h"

namespace tessera {

/// Writes each call as one line. Numbers keep their full precision, every parameter is declared in
/// line, and transforms are written as matrices, so reading the text gives the same calls again.
class RibWriter : public SceneCalls {
 public:
  /// `out` must outlive the writer.
  explicit RibWriter(std::ostream& out) : out_(out) {}

  void begin(const BlockCall& block, const SourceLocation& where) override;
  void end(BlockKind kind, const SourceLocation& where) override;
  void option(const OptionCall& call, const SourceLocation& where) override;
  void attribute(const AttributeCall& call, const SourceLocation& where) override;
  void transform(const TransformCall& call, const SourceLocation& where) override;
  void light(const LightCall& call, const SourceLocation& where) override;
  void shape(ShapeCall call, const SourceLocation& where) override;
  void instance(const std::string& object_handle, const SourceLocation& where) override;
  void finish(const SourceLocation&) override {}

 private:
  void line(const std::string& text);

  std::ostream& out_;
};

}  // namespace tessera
