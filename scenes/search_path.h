#pragma once
/// Search paths as scene files write them.

#include <string>
#include <vector>

namespace tessera {

/// Splits "a:b:c". '&' stands for `previous`, the path in force so far; '@' for the renderer's
/// standard path, which is empty. Empty entries are dropped.
std::vector<std::string> parse_search_path(const std::string& text,
                                           const std::vector<std::string>& previous);

}  // namespace tessera
