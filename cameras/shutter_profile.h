#pragma once
/// Shutter responses over t in [0, 1].

#include <memory>
#include <string>

namespace tessera {

class ShutterProfile {
 public:
  virtual ~ShutterProfile() = default;
  virtual const char* name() const = 0;
  /// Maps uniform a in [0, 1) to a shutter time in [0, 1] distributed as the response; monotonic.
  virtual float sample(float a) const = 0;
  /// Response at t, normalised to integrate to 1.
  virtual double response(double t) const = 0;
  /// Frequency in cycles per shutter within which `energy_share` in (0, 1) of the power spectrum
  /// lies.
  virtual double band_limit(double energy_share) const = 0;
};

/// `name` is box, trapezoid or gaussian; otherwise throws Error naming the choices.
std::unique_ptr<ShutterProfile> make_shutter_profile(const std::string& name);

}  // namespace tessera
