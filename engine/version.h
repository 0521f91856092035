#pragma once

namespace tessera {

inline constexpr const char* version = "0.1.0";

}  // namespace tessera
