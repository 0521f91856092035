#pragma once
/// From shape calls to checked Geometry: control points, primitive variables, motion keys.

#include "scenes/scene_calls.h"
#include "scenes/scene_time.h"

#include "base/diagnostics.h"

namespace tessera {

/// A checked shape whose keys are still in scene time: one key for each of `scene_times`.
/// geometry.key_times is not set yet.
struct KeyedShape {
  Geometry geometry;
  std::vector<double> scene_times{0.0};
};

/// Builds the shape of one call. Takes the control points out of "P", "Pw" or "Pz", fills in the
/// basis of a bicubic patch mesh and checks the number of values of every primitive variable.
/// Throws Error at `where`.
KeyedShape build_shape(ShapeCall call, const attribute_call::Basis& basis,
                       const SourceLocation& where, Diagnostics& diagnostics);

/// Adds `next`, the shape at scene time `time`, as a further key. Throws Error at its location when
/// the two do not share their topology.
void append_key(KeyedShape& shape, KeyedShape next, double time);

/// The geometry with its keys in shutter time.
Geometry in_shutter(KeyedShape shape, ShutterInterval shutter);

}  // namespace tessera
