#pragma once
/// Texture look-ups of one frame. The image library is loaded at the first of them.

#include <functional>
#include <memory>
#include <mutex>

#include "base/diagnostics.h"
#include "images/texture_sampler.h"
#include "shade/values.h"

namespace tessera {

class FrameTextures {
 public:
  using MakeSampler = std::function<std::shared_ptr<TextureSampler>()>;
  /// `make_sampler` may be null or give null: every texture is then missing.
  FrameTextures(MakeSampler make_sampler, Diagnostics& diagnostics)
      : make_sampler_(std::move(make_sampler)), diagnostics_(diagnostics) {}

  /// Three filtered channels at the points. A file that cannot be read is reported once, at
  /// `where`, and gives magenta. Thread safe. Throws Error when the image library cannot be loaded.
  Vec3Array color(const TextureRequest& request, const TexturePoints& points,
                  const SourceLocation& where);

 private:
  TextureSampler* sampler();

  MakeSampler make_sampler_;
  Diagnostics& diagnostics_;
  std::once_flag made_;
  std::shared_ptr<TextureSampler> sampler_;
};

}  // namespace tessera
