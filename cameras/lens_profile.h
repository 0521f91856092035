#pragma once
/// Aperture shapes: where on the lens light passes, and what frequencies that lets through.

#include <memory>
#include <string>

#include <glm/glm.hpp>

namespace tessera {

/// A density over lens coordinates, |u| and |v| at most extent().
class LensProfile {
 public:
  virtual ~LensProfile() = default;
  virtual const char* name() const = 0;
  /// Maps uniform (a, b) in [0, 1)^2 to lens coordinates distributed as the profile; continuous and
  /// of bounded stretch, so that stratification survives.
  virtual glm::vec2 sample(float a, float b) const = 0;
  /// Largest |u| or |v| that sample() returns: 1, or 1.1 for the smooth profile.
  virtual float extent() const = 0;
  /// Radius in cycles per unit lens coordinate within which `energy_share` in (0, 1) of the power
  /// spectrum lies.
  virtual double band_limit(double energy_share) const = 0;
};

/// `name` is disc, smooth or polygon; otherwise throws Error naming the choices.
std::unique_ptr<LensProfile> make_lens_profile(const std::string& name, int blades,
                                               double rotation_degrees);

}  // namespace tessera
