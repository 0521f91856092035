#pragma once

#include <memory>

#include "images/image_module.h"

namespace tessera {

/// A TextureSampler over a private OpenImageIO texture system.
std::unique_ptr<TextureSampler> make_oiio_texture_sampler(const TextureSettings& settings);

}  // namespace tessera
