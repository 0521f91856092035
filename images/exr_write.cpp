#include <algorithm>
#include <cstdio>
#include <cstring>
#include <set>

#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfIO.h>
#include <ImfMatrixAttribute.h>
#include <ImfOutputFile.h>
#include <ImfStringAttribute.h>
#include <half.h>

#include "base/error.h"
#include "images/atomic_file.h"
#include "images/exr.h"

namespace tessera {
namespace {

/// A stream that remembers failures: OpenEXR writes its line table in a destructor, where it cannot
/// report any.
class FileStream final : public Imf::OStream {
 public:
  explicit FileStream(const std::string& path)
      : OStream(path.c_str()), file_(std::fopen(path.c_str(), "wb")) {
    if (!file_) failure_ = errno;
  }
  ~FileStream() override {
    if (file_) std::fclose(file_);
  }

  void write(const char bytes[], int count) override {
    if (failure_ == 0 && std::fwrite(bytes, 1, size_t(count), file_) != size_t(count))
      failure_ = errno;
    if (failure_ != 0) throw Error(std::strerror(failure_));
  }
  uint64_t tellp() override { return failure_ ? 0 : uint64_t(std::ftell(file_)); }
  void seekp(uint64_t position) override {
    if (failure_ == 0 && std::fseek(file_, long(position), SEEK_SET) != 0) failure_ = errno;
  }
  /// Flushes to the operating system. Throws Error if anything failed, at any time.
  void close() {
    if (file_ && std::fclose(file_) != 0 && failure_ == 0) failure_ = errno;
    file_ = nullptr;
    if (failure_ != 0) throw Error(std::strerror(failure_));
  }

 private:
  std::FILE* file_;
  int failure_ = 0;
};

void check_image(const Image& image) {
  if (image.data_window.empty() || image.channels.empty())
    throw Error(fmt::format("image of {} x {} pixels and {} channels; expected some of each",
                            image.width(), image.height(), image.channels.size()));
  std::set<std::string> names;
  for (const auto& channel : image.channels) {
    if (!names.insert(channel.name).second)
      throw Error(fmt::format("two channels are called \"{}\"", channel.name));
    if (channel.values.size() != size_t(image.data_window.pixel_count()))
      throw Error(fmt::format("channel \"{}\" has {} values for {} pixels", channel.name,
                              channel.values.size(), image.data_window.pixel_count()));
  }
}

Imath::Box2i box(const PixelRect& r) {
  return {Imath::V2i(r.x0, r.y0), Imath::V2i(r.x1 - 1, r.y1 - 1)};
}

Imf::Header make_header(const Image& image) {
  Imf::Header header(box(image.display_window), box(image.data_window));
  header.pixelAspectRatio() = float(image.pixel_aspect);
  header.compression() = Imf::ZIP_COMPRESSION;
  header.zipCompressionLevel() =
      1;  // half the time of the default level, files of much the same size
  for (const auto& [name, value] : image.metadata) header.insert(name, Imf::StringAttribute(value));
  for (const auto& [name, rows] : image.matrices) {
    Imath::M44f matrix;
    std::copy(rows.begin(), rows.end(), &matrix[0][0]);
    header.insert(name, Imf::M44fAttribute(matrix));
  }
  for (const auto& channel : image.channels)
    header.channels().insert(
        channel.name, Imf::Channel(channel.type == PixelType::half ? Imf::HALF : Imf::FLOAT));
  return header;
}

std::vector<half> halves(const std::vector<float>& values) {
  std::vector<half> result(values.size());
  std::transform(values.begin(), values.end(), result.begin(), [](float value) {
    return half(value != value ? value : std::clamp(value, -float(HALF_MAX), float(HALF_MAX)));
  });
  return result;
}

void write_pixels(Imf::OStream& stream, const Image& image) {
  Imf::OutputFile file(stream, make_header(image));
  std::vector<std::vector<half>> half_channels;
  Imf::FrameBuffer buffer;
  for (const auto& channel : image.channels) {
    const bool as_half = channel.type == PixelType::half;
    if (as_half) half_channels.push_back(halves(channel.values));
    const void* values =
        as_half ? static_cast<const void*>(half_channels.back().data()) : channel.values.data();
    const size_t size = as_half ? sizeof(half) : sizeof(float);
    // The library only reads through this pointer; Slice::Make moves it to pixel (0, 0).
    buffer.insert(channel.name,
                  Imf::Slice::Make(as_half ? Imf::HALF : Imf::FLOAT, values, box(image.data_window),
                                   size, size * size_t(image.width())));
  }
  file.setFrameBuffer(buffer);
  file.writePixels(image.height());
}

}  // namespace

void write_exr(const std::string& path, const Image& image) {
  try {
    check_image(image);
    AtomicFile target(path);
    FileStream stream(target.temporary_path());
    write_pixels(stream, image);
    stream.close();
    target.commit();
  } catch (const std::exception& error) {
    const std::string message = error.what();
    if (message.find(path) != std::string::npos) throw Error(message);
    throw Error(fmt::format("cannot write {}: {}", path, message));
  }
}

}  // namespace tessera
