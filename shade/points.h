#pragma once
/// A batch of surface points to be shaded together. Who makes the batch (the vertices of a grid,
/// the cells of a decoupled shading mode) is no concern of the shaders.

#include <string_view>
#include <vector>

#include "scenes/scene.h"
#include "shade/values.h"

namespace tessera {

/// A primitive variable at the points of a batch.
struct PrimvarView {
  const Parameter* source = nullptr;  ///< name and type
  int components = 1;
  const float* values = nullptr;  ///< [component][point]
  size_t stride = 0;              ///< floats between components
};

/// How st (texture coordinates) or P change over one shading cell along its two axes, x and y. A
/// null pointer stands for zero.
struct StFootprint {
  const float *dsdx = nullptr, *dtdx = nullptr, *dsdy = nullptr, *dtdy = nullptr;
};

/// Views of one entry a point, in camera space at shutter open. The maker of the batch owns the
/// memory; it stays valid while the batch is shaded.
struct ShadingPoints {
  int count = 0;
  Vec3Input P;                             ///< position
  Vec3Input N;                             ///< unit shading normal, outward
  Vec3Input I;                             ///< unit direction from the eye to P
  Vec3Input Cs, Os;                        ///< colour and opacity of the surface
  const float *u = nullptr, *v = nullptr;  ///< surface parameters
  const float *s = nullptr, *t = nullptr;  ///< texture coordinates
  /// Filter footprint: the change over one shading cell. dPdx.x is null where there is none (for
  /// displacement, which must not depend on how a surface was diced): nothing is filtered then.
  Vec3Input dPdx, dPdy;
  StFootprint st_footprint;
  /// The change of the unit normal likewise, for lobes to be widened by. Null x: not known.
  Vec3Input dNdx, dNdy;
  /// Mean squared deviation of the unit normal within the cell besides that linear change; null: 0.
  const float* normal_variance = nullptr;
  /// cross(dPdx, dPdy) times this sign points outward.
  float normal_sign = 1.0f;
  const int32_t* surface = nullptr;  ///< Surface::id of each point; null: not known
  const float* time = nullptr;       ///< shutter time of each point; null: shutter open
  std::vector<PrimvarView> primvars;
  glm::dmat4 camera_from_object{1.0};  ///< primitive variables that are points pass through it

  const PrimvarView* find_primvar(std::string_view name) const {
    for (const PrimvarView& view : primvars) {
      if (view.source->name == name) return &view;
    }
    return nullptr;
  }
};

}  // namespace tessera
