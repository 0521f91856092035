/// Requests that describe the camera.

#include "scenes/rib/request.h"

namespace tessera {

namespace {

void give(RibSession& session, const RibArguments& arguments, OptionCall call) {
  session.calls().option(call, arguments.where());
}

void format(RibSession& session, RibArguments& arguments) {
  option_call::Format call{};
  call.x_resolution = arguments.integer();
  call.y_resolution = arguments.integer();
  call.pixel_aspect = arguments.left() > 0 ? arguments.number() : 1.0;
  give(session, arguments, call);
}

void frame_aspect_ratio(RibSession& session, RibArguments& arguments) {
  give(session, arguments, option_call::FrameAspectRatio{arguments.number()});
}

void screen_window(RibSession& session, RibArguments& arguments) {
  const std::vector<double> n = arguments.numbers(4);
  give(session, arguments, option_call::ScreenWindow{{n[0], n[1], n[2], n[3]}});
}

void crop_window(RibSession& session, RibArguments& arguments) {
  const std::vector<double> n = arguments.numbers(4);
  give(session, arguments, option_call::CropWindow{{n[0], n[1], n[2], n[3]}});
}

void projection(RibSession& session, RibArguments& arguments) {
  std::string name = arguments.string();
  give(session, arguments,
       option_call::Projection{
           std::move(name), arguments.parameters(session.declarations(), session.diagnostics())});
}

void clipping(RibSession& session, RibArguments& arguments) {
  const std::vector<double> n = arguments.numbers(2);
  give(session, arguments, option_call::Clipping{n[0], n[1]});
}

void depth_of_field(RibSession& session, RibArguments& arguments) {
  option_call::DepthOfField call;
  if (arguments.left() > 0) {  // "-" for a pinhole is spelt by leaving the arguments out
    const std::vector<double> n = arguments.numbers(3);
    call.lens = CameraSettings::ThinLens{n[0], n[1], n[2]};
  }
  give(session, arguments, call);
}

void shutter(RibSession& session, RibArguments& arguments) {
  const std::vector<double> n = arguments.numbers(2);
  give(session, arguments, option_call::Shutter{n[0], n[1]});
}

const RibRequestRow rows[] = {
    {"Format", format},
    {"FrameAspectRatio", frame_aspect_ratio},
    {"ScreenWindow", screen_window},
    {"CropWindow", crop_window},
    {"Projection", projection},
    {"Clipping", clipping},
    {"DepthOfField", depth_of_field},
    {"Shutter", shutter},
};

}  // namespace

RibRequestTable rib_request_camera() { return {rows}; }

}  // namespace tessera
