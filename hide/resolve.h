#pragma once
/// The last pass over a bucket in which nothing was transparent: from one hit per sample to
/// fragments.

#include <cstdint>

#include "hide/hide.h"

namespace tessera {

class TriangleIds;

/// [sample]; infinite depth where nothing was hit. Readable to a whole vector past the last.
struct OpaqueHits {
  const float *z, *b1, *b2;
  const uint32_t* id;
};

void resolve_opaque(const OpaqueHits& hits, const TriangleIds& ids, const HideInput& input,
                    FragmentList& out);

}  // namespace tessera
