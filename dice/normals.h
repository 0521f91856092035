#pragma once
/// Unit normals from whatever derivatives a patch has.

#include "dice/grid.h"

namespace tessera {

/// Makes the normals of a grid unit length and multiplies them by `sign`. Where the derivatives
/// vanish or overflow (poles, collapsed sides) the normal is the mean of the neighbouring
/// vertices'; where there is none at all, that of the micropolygons; in a grid of no area, towards
/// the camera. `N` holds x, y and z as separate runs, padded.
void make_unit_normals(const Grid& grid, float* const N[3], float sign);

/// Normals from the vertices' positions at `key`: cross products of central differences, one-sided
/// at the grid's boundary. Not unit length; `N` as above.
void normals_from_positions(const Grid& grid, int key, float* const N[3]);

}  // namespace tessera
