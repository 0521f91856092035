#pragma once
/// What needs OpenImageIO: textures, and image formats besides OpenEXR. Linking that library costs
/// 0.2 s at every start, so it lives in a module, tessera_oiio.so, that is loaded when a scene or
/// an option asks for it.

#include <memory>
#include <string>
#include <vector>

#include "images/image.h"
#include "images/texture_filters.h"
#include "images/texture_sampler.h"

namespace tessera {

struct TextureSettings {
  size_t cache_bytes = size_t(256) << 20;
  std::vector<std::string> search_path;  ///< folders, in order
  TextureFilter filter = TextureFilter::anisotropic;
};

class ImageModule {
 public:
  virtual ~ImageModule() = default;
  /// Writes `image` in the format its extension names, through a temporary file. Formats of 8 bits
  /// (PNG, JPEG) get sRGB code values of R, G, B and, for PNG, A (see make_preview); TIFF gets
  /// every channel as linear floats. Throws Error.
  virtual void write_image(const std::string& path, const Image& image) const = 0;
  /// Reads all channels of the first picture of a file; values as stored, integers scaled to
  /// [0, 1]. Throws Error.
  virtual Image read_image(const std::string& path) const = 0;
  /// A sampler with a cache of its own.
  virtual std::unique_ptr<TextureSampler> make_texture_sampler(
      const TextureSettings& settings) const = 0;
};

/// Loads the module from `path`; if that is empty, from the file the environment variable
/// TESSERA_IMAGE_MODULE names, or else from tessera_oiio.so beside the executable. Throws Error
/// naming the file and the reason. The shared object stays loaded until the process ends.
std::unique_ptr<ImageModule> load_image_module(const std::string& path = "");

/// Entry point of the module: `tessera_image_module_2`, to be renamed with any change of the
/// interfaces above, so that modules of another build are refused.
using ImageModuleFactory = ImageModule* (*)();
inline constexpr const char* image_module_entry = "tessera_image_module_2";

}  // namespace tessera
