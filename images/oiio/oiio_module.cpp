#include <OpenImageIO/imageio.h>

#include "base/error.h"
#include "images/atomic_file.h"
#include "images/exr.h"
#include "images/file_kinds.h"
#include "images/image_module.h"
#include "images/oiio/oiio_texture.h"
#include "images/preview.h"

namespace tessera {
namespace {

/// Writes `pixels`, interleaved, of type `type` as `spec` says, through a temporary file.
void write_pixels(const std::string& path, OIIO::ImageSpec spec, OIIO::TypeDesc type,
                  const void* pixels, const Image& image) {
  for (const auto& [name, value] : image.metadata) spec.attribute(name, value);
  spec.attribute("PixelAspectRatio", float(image.pixel_aspect));
  AtomicFile target(path);
  const auto output = OIIO::ImageOutput::create(target.temporary_path());
  if (!output) throw Error(fmt::format("cannot write {}: {}", path, OIIO::geterror()));
  if (!output->open(target.temporary_path(), spec) || !output->write_image(type, pixels) ||
      !output->close())
    throw Error(fmt::format("cannot write {}: {}", path, output->geterror()));
  target.commit();
}

void write_srgb8(const std::string& path, const Image& image, bool keep_alpha) {
  const Preview preview = make_preview(image, keep_alpha);
  OIIO::ImageSpec spec(preview.width, preview.height, preview.channels, OIIO::TypeDesc::UINT8);
  spec.attribute("oiio:ColorSpace", "sRGB");
  spec.attribute("oiio:UnassociatedAlpha", 1);
  write_pixels(path, spec, OIIO::TypeDesc::UINT8, preview.pixels.data(), image);
}

void write_floats(const std::string& path, const Image& image) {
  const size_t channels = image.channels.size();
  OIIO::ImageSpec spec(image.width(), image.height(), int(channels), OIIO::TypeDesc::FLOAT);
  spec.channelnames.clear();
  std::vector<float> pixels(channels * size_t(image.data_window.pixel_count()));
  for (size_t c = 0; c < channels; ++c) {
    spec.channelnames.push_back(image.channels[c].name);
    for (size_t i = 0; i < image.channels[c].values.size(); ++i)
      pixels[i * channels + c] = image.channels[c].values[i];
  }
  write_pixels(path, spec, OIIO::TypeDesc::FLOAT, pixels.data(), image);
}

class OiioModule final : public ImageModule {
 public:
  void write_image(const std::string& path, const Image& image) const override {
    if (image.data_window.empty() || image.channels.empty())
      throw Error(fmt::format("cannot write {}: the image is empty", path));
    check_format(path);
    if (named_exr(path)) return write_exr(path, image);
    if (named_8_bit(path)) return write_srgb8(path, image, lower_extension(path) == ".png");
    write_floats(path, image);
  }

  Image read_image(const std::string& path) const override {
    if (named_exr(path)) return read_exr(path);
    const auto input = OIIO::ImageInput::open(path);
    if (!input) throw Error(fmt::format("cannot read {}: {}", path, OIIO::geterror()));
    const OIIO::ImageSpec& spec = input->spec();
    Image image(
        {spec.full_x, spec.full_y, spec.full_x + spec.full_width, spec.full_y + spec.full_height},
        {spec.x, spec.y, spec.x + spec.width, spec.y + spec.height});
    image.pixel_aspect = double(spec.get_float_attribute("PixelAspectRatio", 1.0f));
    for (const auto& attribute : spec.extra_attribs)
      if (attribute.type() == OIIO::TypeString)
        image.metadata[attribute.name().string()] = attribute.get_string();
    const size_t channels = size_t(spec.nchannels);
    std::vector<float> pixels(channels * size_t(image.data_window.pixel_count()));
    if (!input->read_image(0, 0, 0, spec.nchannels, OIIO::TypeDesc::FLOAT, pixels.data()))
      throw Error(fmt::format("cannot read {}: {}", path, input->geterror()));
    for (size_t c = 0; c < channels; ++c) {
      auto& values = image.add_channel(spec.channel_name(int(c))).values;
      for (size_t i = 0; i < values.size(); ++i) values[i] = pixels[i * channels + c];
    }
    return image;
  }

  std::unique_ptr<TextureSampler> make_texture_sampler(
      const TextureSettings& settings) const override {
    return make_oiio_texture_sampler(settings);
  }
};

}  // namespace
}  // namespace tessera

/// See ImageModuleFactory.
extern "C" tessera::ImageModule* tessera_image_module_2() { return new tessera::OiioModule; }
