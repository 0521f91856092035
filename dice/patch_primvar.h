#pragma once
/// Primitive variables over one patch.

#include <functional>
#include <span>
#include <string_view>
#include <vector>

#include "scenes/parameter.h"

namespace tessera {

using PrimvarFilter = std::function<bool(std::string_view name)>;

/// A primitive variable over one patch: constant, bilinear between the corners, or whatever
/// `custom` evaluates.
struct PatchPrimvar {
  const Parameter* source = nullptr;
  int components = 1;
  /// [control][component]: one control for a constant, four (the corners) for bilinear; unused
  /// when `custom` is set.
  std::vector<float> values;
  /// Writes value c of point i to out[c * stride + i].
  std::function<void(std::span<const float> u, std::span<const float> v, float* out, size_t stride)>
      custom;

  void evaluate(std::span<const float> u, std::span<const float> v, float* out,
                size_t stride) const;
};

/// A variable with one value for the whole patch: value `index` of `source`.
PatchPrimvar constant_primvar(const Parameter& source, size_t index);
/// A bilinear variable from the values at the four corners (corner order of dice/patch.h).
PatchPrimvar bilinear_primvar(const Parameter& source, const size_t (&corner_index)[4]);

/// Whether a parameter can be diced at all: numeric, and with the values a primvar needs.
bool is_numeric_primvar(const Parameter& parameter);

/// make(parameter) for each of `primvars` that can be diced and is wanted.
template <class Make>
std::vector<PatchPrimvar> wanted_primvars(const std::vector<Parameter>& primvars,
                                          const PrimvarFilter& wants, Make make) {
  std::vector<PatchPrimvar> found;
  for (const Parameter& p : primvars)
    if (is_numeric_primvar(p) && wants(p.name)) found.push_back(make(p));
  return found;
}

}  // namespace tessera
