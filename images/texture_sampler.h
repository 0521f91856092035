#pragma once
/// Filtered lookups in texture files, in batches.

#include <span>
#include <string>

namespace tessera {

enum class TextureWrap { black, clamp, periodic };

struct TextureRequest {
  std::string file;  ///< relative names are looked for along the search path
  int first_channel = 0;
  /// Channels wanted. A file with one channel gives it to the first three; others it lacks are 0.
  int channel_count = 3;
  TextureWrap s_wrap = TextureWrap::periodic, t_wrap = TextureWrap::periodic;
  float blur = 0.0f;          ///< added to the filter's width, as a fraction of the texture
  float filter_width = 1.0f;  ///< multiplies the footprints
};

/// Where to look. All spans have one value a point; (0, 0) is the top left of the file's picture,
/// as in RenderMan, and (1, 1) its bottom right. The footprint of a point is the parallelogram of
/// (dsdx, dtdx) and (dsdy, dtdy).
struct TexturePoints {
  std::span<const float> s, t, dsdx, dtdx, dsdy, dtdy;
};

struct TextureResult {
  bool found = true;
  std::string message;  ///< why not, if it was not
};

/// Reads textures through a bounded cache. Thread safe.
class TextureSampler {
 public:
  virtual ~TextureSampler() = default;
  /// Writes the filtered values to `out`, [channel][point], MIP-mapped where the filter is
  /// (levels are made on the fly for plain pictures). Values are as stored, 8 and 16 bits scaled to
  /// [0, 1]; no transfer curve is undone. Points whose coordinates or footprint are not finite get
  /// 0. If the file cannot be read, `out` is left as it is and the result says so.
  virtual TextureResult sample(const TextureRequest& request, const TexturePoints& points,
                               std::span<float> out) = 0;
};

}  // namespace tessera
