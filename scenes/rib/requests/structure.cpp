/// Requests that open and close blocks, read archives and declare parameters.

#include "scenes/rib/request.h"

namespace tessera {

namespace {

template <BlockKind kind>
void begin(RibSession& session, RibArguments& arguments) {
  session.calls().begin({kind, 0, {}, {}}, arguments.where());
}

template <BlockKind kind>
void end(RibSession& session, RibArguments& arguments) {
  session.calls().end(kind, arguments.where());
}

void frame_begin(RibSession& session, RibArguments& arguments) {
  session.calls().begin({BlockKind::frame, arguments.integer(), {}, {}}, arguments.where());
}

void object_begin(RibSession& session, RibArguments& arguments) {
  session.calls().begin({BlockKind::object, 0, arguments.handle(), {}}, arguments.where());
}

void object_instance(RibSession& session, RibArguments& arguments) {
  session.calls().instance(arguments.handle(), arguments.where());
}

void motion_begin(RibSession& session, RibArguments& arguments) {
  std::vector<double> times;
  while (arguments.left() > 0)
    for (double time : arguments.number_array()) times.push_back(time);
  session.calls().begin({BlockKind::motion, 0, {}, std::move(times)}, arguments.where());
}

void declare(RibSession& session, RibArguments& arguments) {
  const std::string name = arguments.string();
  session.declarations().declare(name, arguments.string(), arguments.where());
}

void read_archive(RibSession& session, RibArguments& arguments) {
  const std::string name = arguments.string();
  // A callback and its parameters may follow; they are of no use here.
  arguments.parameters(session.declarations(), session.diagnostics());
  session.read_archive(name, arguments.where());
}

void archive_begin(RibSession& session, RibArguments& arguments) {
  const std::string name = arguments.handle();
  arguments.parameters(session.declarations(), session.diagnostics());
  session.record_archive(name, arguments.where());
}

void archive_end(RibSession&, RibArguments& arguments) {
  arguments.fail("no ArchiveBegin is open");
}

const RibRequestRow rows[] = {
    {"FrameBegin", frame_begin},
    {"FrameEnd", end<BlockKind::frame>},
    {"WorldBegin", begin<BlockKind::world>},
    {"WorldEnd", end<BlockKind::world>},
    {"AttributeBegin", begin<BlockKind::attribute>},
    {"AttributeEnd", end<BlockKind::attribute>},
    {"TransformBegin", begin<BlockKind::transform>},
    {"TransformEnd", end<BlockKind::transform>},
    {"ObjectBegin", object_begin},
    {"ObjectEnd", end<BlockKind::object>},
    {"ObjectInstance", object_instance},
    {"MotionBegin", motion_begin},
    {"MotionEnd", end<BlockKind::motion>},
    {"Declare", declare},
    {"ReadArchive", read_archive},
    {"ArchiveBegin", archive_begin},
    {"ArchiveEnd", archive_end},
};

}  // namespace

RibRequestTable rib_request_structure() { return {rows}; }

}  // namespace tessera
