#pragma once
/// The page that --report asks for.

#include <filesystem>

#include <nlohmann/json_fwd.hpp>

namespace tessera::trade {

/// Whether this build can write pages.
bool has_report_page();

/// Writes `page` from a trade table whose files lie in `folder`. Throws Error when it cannot.
void write_report_page(const nlohmann::ordered_json& table, const std::filesystem::path& folder,
                       const std::filesystem::path& page);

}  // namespace tessera::trade
