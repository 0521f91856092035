#pragma once
/// The table of RIB requests. Every file of scenes/rib/requests/ contributes rows; adding a request
/// is adding a row.

#include <span>

#include "scenes/rib/arguments.h"
#include "scenes/rib/rib_session.h"

namespace tessera {

/// Interprets one request. What it leaves of the arguments is an error.
using RibRequestHandler = void (*)(RibSession& session, RibArguments& arguments);

struct RibRequestRow {
  const char* name;
  RibRequestHandler handler;
};

/// The rows of one file; they live in static storage.
struct RibRequestTable {
  std::span<const RibRequestRow> rows;
};

/// The tables of all files of scenes/rib/requests/. (The definition is generated.)
std::span<const RibRequestTable> rib_request_registry();

}  // namespace tessera
