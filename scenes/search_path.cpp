#include "scenes/search_path.h"

namespace tessera {

std::vector<std::string> parse_search_path(const std::string& text,
                                           const std::vector<std::string>& previous) {
  std::vector<std::string> folders;
  size_t start = 0;
  while (start <= text.size()) {
    const size_t end = std::min(text.find(':', start), text.size());
    const std::string entry = text.substr(start, end - start);
    if (entry == "&")
      folders.insert(folders.end(), previous.begin(), previous.end());
    else if (!entry.empty() && entry != "@")
      folders.push_back(entry);
    start = end + 1;
  }
  return folders;
}

}  // namespace tessera
