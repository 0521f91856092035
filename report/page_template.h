#pragma once
/// The page as report/page/ builds it, compiled into the program.

#include <string_view>

namespace tessera {

/// HTML with its styles and scripts in it and, once, `report_data_marker` where the data go.
/// Generated from report/page/ by npm.
std::string_view report_page_template();

inline constexpr std::string_view report_data_marker = "<!--TRADE-DATA-->";

}  // namespace tessera
