#include "trade/report_page.h"

#include <nlohmann/json.hpp>

#include "base/error.h"

namespace tessera::trade {

bool has_report_page() { return false; }

void write_report_page(const nlohmann::ordered_json&, const std::filesystem::path&,
                       const std::filesystem::path&) {
  throw Error("this build has no report page");
}

}  // namespace tessera::trade
