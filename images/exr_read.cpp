#include <algorithm>

#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfInputFile.h>
#include <ImfMatrixAttribute.h>
#include <ImfStringAttribute.h>

#include "base/error.h"
#include "images/exr.h"

namespace tessera {
namespace {

PixelRect rect(const Imath::Box2i& box) {
  return {box.min.x, box.min.y, box.max.x + 1, box.max.y + 1};
}

void add_channels(const Imf::Header& header, Image& image) {
  for (auto i = header.channels().begin(); i != header.channels().end(); ++i) {
    if (i.channel().xSampling != 1 || i.channel().ySampling != 1)
      throw Error(fmt::format("channel {} is subsampled, which is not supported", i.name()));
    image.add_channel(i.name(),
                      i.channel().type == Imf::HALF ? PixelType::half : PixelType::float32);
  }
}

void add_attributes(const Imf::Header& header, Image& image) {
  for (auto i = header.begin(); i != header.end(); ++i) {
    const Imf::Attribute& attribute = i.attribute();
    if (const auto* text = dynamic_cast<const Imf::StringAttribute*>(&attribute))
      image.metadata[i.name()] = text->value();
    if (const auto* matrix = dynamic_cast<const Imf::M44fAttribute*>(&attribute))
      std::copy_n(&matrix->value()[0][0], 16, image.matrices[i.name()].begin());
  }
}

Image read(const std::string& path) {
  Imf::InputFile file(path.c_str());
  const Imf::Header& header = file.header();
  Image image(rect(header.displayWindow()), rect(header.dataWindow()));
  image.pixel_aspect = double(header.pixelAspectRatio());

  // Refused before memory is asked for: a header may claim any size.
  size_t channels = 0;
  for (auto i = header.channels().begin(); i != header.channels().end(); ++i) ++channels;
  const auto& window = header.dataWindow();
  const double values = (double(window.max.x) - double(window.min.x) + 1.0) *
                        (double(window.max.y) - double(window.min.y) + 1.0) * double(channels);
  if (values > 2147483648.0)
    throw Error(fmt::format("its header claims {:.0f} values; expected at most 2^31", values));

  add_channels(header, image);
  add_attributes(header, image);

  Imf::FrameBuffer buffer;
  for (auto& channel : image.channels)
    buffer.insert(channel.name,
                  Imf::Slice::Make(Imf::FLOAT, channel.values.data(), window, sizeof(float),
                                   sizeof(float) * size_t(image.width())));
  file.setFrameBuffer(buffer);
  file.readPixels(window.min.y, window.max.y);
  return image;
}

}  // namespace

Image read_exr(const std::string& path) {
  try {
    return read(path);
  } catch (const std::exception& error) {
    throw Error(fmt::format("cannot read {}: {}", path, error.what()));
  }
}

}  // namespace tessera
