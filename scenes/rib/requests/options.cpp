/// Requests that set options.

#include "scenes/rib/request.h"
#include "scenes/search_path.h"

namespace tessera {

namespace {

void give(RibSession& session, const RibArguments& arguments, OptionCall call) {
  session.calls().option(call, arguments.where());
}

std::vector<Parameter> parameters(RibSession& session, RibArguments& arguments) {
  return arguments.parameters(session.declarations(), session.diagnostics());
}

void pixel_samples(RibSession& session, RibArguments& arguments) {
  const std::vector<double> n = arguments.numbers(2);
  give(session, arguments, option_call::PixelSamples{n[0], n[1]});
}

void pixel_filter(RibSession& session, RibArguments& arguments) {
  std::string name = arguments.string();
  const std::vector<double> width = arguments.numbers(2);
  give(session, arguments, option_call::PixelFilter{std::move(name), width[0], width[1]});
}

void exposure(RibSession& session, RibArguments& arguments) {
  const std::vector<double> n = arguments.numbers(2);
  give(session, arguments, option_call::Exposure{n[0], n[1]});
}

void display(RibSession& session, RibArguments& arguments) {
  option_call::AddDisplay call;
  call.display.file = arguments.string();
  call.display.type = arguments.string();
  call.display.mode = arguments.string();
  call.display.parameters = parameters(session, arguments);
  // "+name" adds a display to those given before.
  call.add = call.display.file.starts_with('+');
  if (call.add) call.display.file.erase(0, 1);
  give(session, arguments, std::move(call));
}

void hider(RibSession& session, RibArguments& arguments) {
  std::string name = arguments.string();
  give(session, arguments, option_call::Hider{std::move(name), parameters(session, arguments)});
}

void option(RibSession& session, RibArguments& arguments) {
  std::string category = arguments.string();
  option_call::User call{std::move(category), parameters(session, arguments)};
  // ReadArchive needs this one before any scene is built.
  if (call.category == "searchpath")
    if (const Parameter* path = find_parameter(call.parameters, "archive"))
      session.archive_search_path() =
          parse_search_path(path->strings.front(), session.archive_search_path());
  give(session, arguments, std::move(call));
}

void make_shadow(RibSession& session, RibArguments& arguments) {
  option_call::MakeShadow call;
  call.picture = arguments.string();
  call.shadow = arguments.string();
  parameters(session, arguments);  // filters of the map: look-ups filter themselves
  give(session, arguments, std::move(call));
}

const RibRequestRow rows[] = {
    {"PixelSamples", pixel_samples},
    {"PixelFilter", pixel_filter},
    {"Exposure", exposure},
    {"Display", display},
    {"Hider", hider},
    {"Option", option},
    {"MakeShadow", make_shadow},
};

}  // namespace

RibRequestTable rib_request_options() { return {rows}; }

}  // namespace tessera
