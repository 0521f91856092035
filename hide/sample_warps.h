#pragma once
/// From uniform coordinates to the lens and the shutter.

#include <cstddef>

#include "cameras/lens_profile.h"
#include "cameras/shutter_profile.h"

namespace tessera {

/// The profiles of a frame; the common ones are mapped without a virtual call a sample.
class SampleWarps {
 public:
  /// Null: no lens, no time. The profiles must outlive this.
  SampleWarps(const LensProfile* lens, const ShutterProfile* shutter);

  bool has_lens() const { return lens_ != nullptr; }
  bool has_time() const { return shutter_ != nullptr; }
  /// Largest |u|, |v|.
  float lens_extent() const { return lens_->extent(); }

  /// In place, from [0, 1)^2 to lens coordinates. Writes whole vectors.
  void lens(float* u, float* v, size_t count) const;
  /// In place, from [0, 1) to shutter times; keeps their order.
  void time(float* t, size_t count) const;

 private:
  const LensProfile* lens_;
  const ShutterProfile* shutter_;
  bool disc_lens_, box_shutter_;
};

}  // namespace tessera
