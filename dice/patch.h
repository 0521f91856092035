#pragma once
/// What every kind of surface is turned into: patches over the unit square, in camera space, at
/// every motion key, and how the patches of one surface share their edges and corners.
///
///     corner 2 --- side 2 --- corner 3        sides 0 and 2 run along u, sides 1 and 3 along v,
///        |                       |            always towards larger parameters; corner iu + 2 iv
///      side 3                  side 1         is at (u, v) = (iu, iv).
///        |                       |
///     corner 0 --- side 0 --- corner 1

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include <glm/glm.hpp>

#include "dice/patch_primvar.h"

namespace tessera {

/// Where an evaluation writes: P (and, unless null, unnormalised normals along cross(dP/du, dP/dv))
/// as separate runs of x, y and z.
struct PatchOutput {
  float* P[3] = {nullptr, nullptr, nullptr};
  float* N[3] = {nullptr, nullptr, nullptr};
  bool wants_normals() const { return N[0] != nullptr; }
  PatchOutput from(size_t offset) const;
};

/// A rectangle of parameters.
struct ParameterRect {
  double u0 = 0, u1 = 1, v0 = 0, v1 = 1;
};

/// One patch of a surface. Parameter arrays must be readable, and outputs writable, up to the next
/// multiple of simd_padding. The same (key, u, v) always gives the same bits within one function.
class Patch {
 public:
  virtual ~Patch() = default;
  /// Evaluates all (u[i], v[j]) into element j * row_stride + i; row_stride >= padded(u.size()).
  virtual void tensor(int key, std::span<const float> u, std::span<const float> v,
                      size_t row_stride, const PatchOutput& out) const = 0;
  /// Evaluates the points (u[i], v[i]).
  virtual void points(int key, std::span<const float> u, std::span<const float> v,
                      const PatchOutput& out) const = 0;
  /// Evaluates side `side` at t along its direction, or against it when `flip`. Patches whose edge
  /// curves are given by control points of their own evaluate the curve alone, so that another
  /// patch with the same curve, in the same canonical direction, gets the same bits.
  virtual void side(int key, int side, bool flip, std::span<const float> t,
                    const PatchOutput& out) const;
  /// Whether the canonical direction of a side is against its parameter. See side().
  virtual bool side_is_flipped(int side) const;
  /// Adds points to `hull` whose convex hull at this key contains the part `rect` of the patch.
  virtual void append_hull(int key, const ParameterRect& rect,
                           std::vector<glm::vec3>& hull) const = 0;
  /// Segments to sample an edge or a row with when its size is estimated.
  virtual int sample_segments() const { return 8; }
};

/// (u, v) on side `side` at parameter t along it.
glm::dvec2 point_on_side(int side, double t);

/// A curve on a surface: a side of a patch, or a line of constant parameter inside one.
struct Curve {
  enum class Line : uint8_t { side0, side1, side2, side3, constant_u, constant_v };
  uint32_t patch = 0;
  Line line = Line::side0;
  bool flip = false;  ///< sides only: t runs against the side's parameter
  float constant = 0;
  bool is_side() const { return line < Line::constant_u; }
  /// (u, v) in `patch` at curve parameter t.
  glm::dvec2 parameters(double t) const;
  bool operator==(const Curve&) const = default;
};

/// A point of a surface that all patches touching it name alike.
struct Location {
  Curve curve;
  double t = 0;
  bool operator==(const Location&) const = default;
};
/// The location of a corner of a patch that nobody shares.
Location own_corner(uint32_t patch, int corner);

/// How a side of a patch lies on the curve it shares with its neighbours.
struct SharedSide {
  Curve curve;                ///< `flip` is filled in by the caller, from Patch::side_is_flipped
  double t0 = 0, t1 = 1;      ///< the part of the curve that is this side
  bool reversed = false;      ///< t falls while the side's own parameter rises
  bool forced_split = false;  ///< a neighbour begins in the middle: never dice in one piece
};

/// All patches of one surface instance. Thread safe.
class PatchSet {
 public:
  virtual ~PatchSet() = default;
  virtual uint32_t patch_count() const = 0;
  /// Null where there is no surface (holes, faces without a limit surface).
  virtual std::unique_ptr<Patch> patch(uint32_t index) const = 0;
  virtual SharedSide shared_side(uint32_t patch, int side) const;
  virtual Location shared_corner(uint32_t patch, int corner) const;
  /// The rectangle of surface parameters that a patch covers.
  virtual ParameterRect surface_parameters(uint32_t patch) const;
  /// Primitive variables that `wants` accepts by name.
  virtual std::vector<PatchPrimvar> primvars(uint32_t patch, const PrimvarFilter& wants) const = 0;
  /// Texture coordinates where the scene gives none (two components, no source); empty: bilinear
  /// in surface parameters between the corners of TextureCoordinates.
  virtual std::optional<PatchPrimvar> default_st(uint32_t) const { return std::nullopt; }
};

/// Topology of a rectangular array of patches, for PatchMesh and NuPatch.
struct PatchArray {
  int u_patches = 1, v_patches = 1;
  bool u_wraps = false, v_wraps = false;
  uint32_t index(int i, int j) const { return uint32_t(j * u_patches + i); }
  SharedSide shared_side(uint32_t patch, int side) const;
  Location shared_corner(uint32_t patch, int corner) const;
  ParameterRect surface_parameters(uint32_t patch) const;
};

}  // namespace tessera
