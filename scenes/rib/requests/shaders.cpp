/// Requests that name shaders.

#include "scenes/rib/request.h"

namespace tessera {

namespace {

std::vector<Parameter> parameters(RibSession& session, RibArguments& arguments) {
  return arguments.parameters(session.declarations(), session.diagnostics());
}

void shader(RibSession& session, RibArguments& arguments, attribute_call::Shader::Slot slot) {
  std::string name = arguments.string();
  session.calls().attribute(
      attribute_call::Shader{slot, std::move(name), parameters(session, arguments)},
      arguments.where());
}

void surface(RibSession& session, RibArguments& arguments) {
  shader(session, arguments, attribute_call::Shader::Slot::surface);
}

void displacement(RibSession& session, RibArguments& arguments) {
  shader(session, arguments, attribute_call::Shader::Slot::displacement);
}

void light(RibSession& session, RibArguments& arguments, bool area) {
  LightCall call;
  call.area = area;
  call.name = arguments.string();
  call.handle = arguments.handle();
  call.parameters = parameters(session, arguments);
  session.calls().light(call, arguments.where());
}

void light_source(RibSession& session, RibArguments& arguments) {
  light(session, arguments, false);
}

void area_light_source(RibSession& session, RibArguments& arguments) {
  light(session, arguments, true);
}

void illuminate(RibSession& session, RibArguments& arguments) {
  std::string handle = arguments.handle();
  const bool on = arguments.boolean();
  session.calls().attribute(attribute_call::Illuminate{std::move(handle), on}, arguments.where());
}

const RibRequestRow rows[] = {
    {"Surface", surface},          {"Displacement", displacement},
    {"LightSource", light_source}, {"AreaLightSource", area_light_source},
    {"Illuminate", illuminate},
};

}  // namespace

RibRequestTable rib_request_shaders() { return {rows}; }

}  // namespace tessera
