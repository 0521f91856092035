/// Requests that are known and left out: some because nothing is lost, the rest with a warning.

#include "scenes/rib/request.h"

namespace tessera {

namespace {

/// Takes all arguments, whatever they are.
void ignore(RibSession&, RibArguments& arguments) { arguments.discard(); }

void skip(RibSession& session, RibArguments& arguments) {
  arguments.discard();
  session.warn_skipped(arguments.request(), "is not supported yet", arguments.where());
}

/// The shapes of a solid are rendered as they are; the block keeps attributes as it should.
void solid_begin(RibSession& session, RibArguments& arguments) {
  skip(session, arguments);
  session.calls().begin({BlockKind::attribute, 0, {}, {}}, arguments.where());
}

void solid_end(RibSession& session, RibArguments& arguments) {
  session.calls().end(BlockKind::attribute, arguments.where());
}

/// Conditions are not evaluated: the whole block is left out.
void if_begin(RibSession& session, RibArguments& arguments) {
  skip(session, arguments);
  session.skip_block("IfBegin", "IfEnd", arguments.where());
}

void color_samples(RibSession& session, RibArguments& arguments) {
  arguments.discard();
  session.warn_skipped(arguments.request(), "is not supported, colors have three components",
                       arguments.where());
}

const RibRequestRow rows[] = {
    {"version", ignore},
    {"ErrorHandler", ignore},
    {"Bound", ignore},
    {"Quantize", ignore},
    {"PixelVariance", ignore},
    {"RelativeDetail", ignore},
    {"Detail", skip},
    {"DetailRange", skip},
    {"GeometricRepresentation", ignore},
    {"ColorSamples", color_samples},
    {"Imager", skip},
    {"Atmosphere", skip},
    {"Interior", skip},
    {"Exterior", skip},
    {"Deformation", skip},
    {"Shader", skip},
    {"Curves", skip},
    {"Points", skip},
    {"Blobby", skip},
    {"Geometry", skip},
    {"HierarchicalSubdivisionMesh", skip},
    {"Procedural", skip},
    {"DelayedReadArchive", skip},
    {"RunProgram", skip},
    {"DynamicLoad", skip},
    {"TrimCurve", skip},
    {"Resource", skip},
    {"ResourceBegin", skip},
    {"ResourceEnd", ignore},
    {"System", skip},
    {"MakeTexture", skip},
    {"MakeLatLongEnvironment", skip},
    {"MakeCubeFaceEnvironment", skip},
    {"MakeBrickMap", skip},
    {"MakeBump", skip},
    {"SolidBegin", solid_begin},
    {"SolidEnd", solid_end},
    {"IfBegin", if_begin},
    {"ElseIf", skip},
    {"Else", skip},
    {"IfEnd", skip},
};

}  // namespace

RibRequestTable rib_request_skipped() { return {rows}; }

}  // namespace tessera
