#pragma once
/// Methods that filter for distribution effects along one image axis. All share one form, so that
/// one code path runs them all: each pixel sums its samples weighted by a few functions of their
/// coordinate (moments), and a pixel's result is a weighted sum of its neighbours' moments,
///
///   h(x) = sum over k, dx of A_k(dx; wedge at x) * m_k(x + dx),  m_k = mean over samples of B_k(y)
///   f
///
/// divided by the same sum over f = 1. Two image axes are the product of two such filters. See
/// shade/effects.h for what y and slopes are.

#include <memory>
#include <span>
#include <string_view>

namespace tessera {

/// How far, in pixels and with sign, the pattern at coordinate y = 1 lies shifted along one image
/// axis: from `low` to `high` over the surfaces met near a pixel, low <= high. Slope times extent.
struct AxisWedge {
  float low = 0, high = 0;
};

/// A sample's coordinate along one axis and, where a second effect acts at the same time, that
/// one's.
struct BasisPoint {
  float y = 0;
  AxisWedge wedge;
  float second_y = 0;
  AxisWedge second_wedge{};  ///< {0, 0}: no second effect
};

class ReconstructionMethod {
 public:
  virtual ~ReconstructionMethod() = default;
  /// K, the number of functions B_k of one axis. At most max_basis.
  virtual int basis_count() const = 0;
  static constexpr int max_basis = 255;
  /// Writes B_0(y) .. B_{K-1}(y). B_0 of `aaf`, `fsf` and `wiener` is 1, and the functions of those
  /// do not depend on wedges or the second effect.
  virtual void basis(const BasisPoint& at, float* out) const = 0;
  /// Pairs (j, k) of an x and a y function are summed where degree(j) + degree(k) <= max_degree.
  virtual int degree(int k) const = 0;
  virtual int max_degree() const = 0;
  /// Pixels to either side that weights may reach.
  virtual int reach() const = 0;
  /// Writes A_k(dx) to out[k * (2 * reach() + 1) + reach() + dx] for `samples` samples a pixel.
  /// Finite for any finite wedge; wedges that hold 0 deep inside give (nearly) the pixel alone.
  virtual void weights(const AxisWedge& wedge, float samples, float* out) const = 0;
  /// Whether its result is blended with the unfiltered image where that has the smaller expected
  /// error (reconstruct/guard.h); B_0 must be 1 then.
  virtual bool guarded() const { return false; }
  /// The method for bounces, whose patterns are no edges; of the same reach or less. It lives as
  /// long as this one.
  virtual const ReconstructionMethod& for_bounces() const { return *this; }
};

/// A method, one file of reconstruct/methods/ each. `--reconstruct name:arguments` picks and tunes
/// it.
struct ReconstructionMethodDefinition {
  const char* name;
  const char* help;
  std::unique_ptr<ReconstructionMethod> (*make)(std::string_view arguments);  ///< throws Error
};
std::span<const ReconstructionMethodDefinition> reconstruction_method_registry();

}  // namespace tessera
