#include "images/oiio/oiio_texture.h"

#include <algorithm>
#include <cmath>

#include <OpenImageIO/texture.h>

#include "base/error.h"

namespace tessera {
namespace {

OIIO::TextureOpt::Wrap wrap(TextureWrap mode) {
  switch (mode) {
    case TextureWrap::black:
      return OIIO::TextureOpt::WrapBlack;
    case TextureWrap::clamp:
      return OIIO::TextureOpt::WrapClamp;
    case TextureWrap::periodic:
      break;
  }
  return OIIO::TextureOpt::WrapPeriodic;
}

bool finite(const TexturePoints& p, size_t i) {
  return std::isfinite(p.s[i]) && std::isfinite(p.t[i]) && std::isfinite(p.dsdx[i]) &&
         std::isfinite(p.dtdx[i]) && std::isfinite(p.dsdy[i]) && std::isfinite(p.dtdy[i]);
}

/// What the library calls a filter. Magnified textures are bicubic with `anisotropic` alone.
struct FilterModes {
  OIIO::TextureOpt::MipMode mip;
  OIIO::TextureOpt::InterpMode interpolation;
};

FilterModes filter_modes(TextureFilter filter) {
  using Options = OIIO::TextureOpt;
  switch (filter) {
    case TextureFilter::point:
      return {Options::MipModeNoMIP, Options::InterpClosest};
    case TextureFilter::bilinear:
      return {Options::MipModeNoMIP, Options::InterpBilinear};
    case TextureFilter::trilinear:
      return {Options::MipModeTrilinear, Options::InterpBilinear};
    case TextureFilter::anisotropic:
      break;
  }
  return {Options::MipModeAniso, Options::InterpSmartBicubic};
}

/// Beyond this many repetitions of the texture nothing but its mean is left; the squares of larger
/// footprints overflow in the library, which then does not filter at all.
float limited(float change) { return std::clamp(change, -1e6f, 1e6f); }

class OiioTextureSampler final : public TextureSampler {
 public:
  explicit OiioTextureSampler(const TextureSettings& settings)
      : system_(OIIO::TextureSystem::create(/*shared=*/false)),
        modes_(filter_modes(settings.filter)) {
    std::string path;
    for (const auto& folder : settings.search_path) path += (path.empty() ? "" : ":") + folder;
    system_->attribute("searchpath", path);
    const float mebibytes = float(double(settings.cache_bytes) / (1 << 20));
    system_->attribute("max_memory_MB", std::max(1.0f, mebibytes));
    system_->attribute("automip", 1);
    system_->attribute("autotile", 64);
    system_->attribute("gray_to_rgb", 1);
  }
  ~OiioTextureSampler() override { OIIO::TextureSystem::destroy(system_); }

  TextureResult sample(const TextureRequest& request, const TexturePoints& points,
                       std::span<float> out) override {
    const int channels = request.channel_count;
    const size_t count = points.s.size();
    if (channels < 1 || channels > max_channels || request.first_channel < 0)
      throw Error(fmt::format(
          "texture \"{}\": channels {} to {} wanted; expected 1 to {} from 0 on", request.file,
          request.first_channel, request.first_channel + channels - 1, max_channels));
    auto* thread = system_->get_perthread_info();
    auto* handle = system_->get_texture_handle(OIIO::ustring(request.file), thread);
    if (!handle || !system_->good(handle)) return failure(request.file);

    OIIO::TextureOpt base;
    base.firstchannel = request.first_channel;
    base.swrap = wrap(request.s_wrap), base.twrap = wrap(request.t_wrap);
    base.sblur = base.tblur = request.blur;
    base.swidth = base.twidth = request.filter_width;
    base.anisotropic = 16;
    base.mipmode = modes_.mip, base.interpmode = modes_.interpolation;
    float value[max_channels];
    for (size_t i = 0; i < count; ++i) {
      std::fill_n(value, channels, 0.0f);
      OIIO::TextureOpt options = base;  // the system writes to it
      if (finite(points, i) &&
          !system_->texture(handle, thread, options, points.s[i], points.t[i],
                            limited(points.dsdx[i]), limited(points.dtdx[i]),
                            limited(points.dsdy[i]), limited(points.dtdy[i]), channels, value))
        return failure(request.file);
      for (int c = 0; c < channels; ++c) out[size_t(c) * count + i] = value[c];
    }
    return {};
  }

 private:
  static constexpr int max_channels = 16;

  TextureResult failure(const std::string& file) const {
    std::string reason = system_->geterror();
    if (reason.empty()) reason = "it cannot be read";
    return {false, fmt::format("texture \"{}\": {}", file, reason)};
  }

  OIIO::TextureSystem* system_;
  FilterModes modes_;
};

}  // namespace

std::unique_ptr<TextureSampler> make_oiio_texture_sampler(const TextureSettings& settings) {
  return std::make_unique<OiioTextureSampler>(settings);
}

}  // namespace tessera
