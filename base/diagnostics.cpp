#include "base/diagnostics.h"

namespace tessera {

void Diagnostics::warn_once(const std::string& key, const SourceLocation& where,
                            const std::string& message) {
  std::lock_guard lock(mutex_);
  ++count_;
  if (!seen_.insert(key).second) return;
  const std::string place = where.text();
  lines_.push_back(place.empty() ? "warning: " + message : place + ": warning: " + message);
  if (sink_) sink_(lines_.back());
}

std::vector<std::string> Diagnostics::lines() const {
  std::lock_guard lock(mutex_);
  return lines_;
}

size_t Diagnostics::warning_count() const {
  std::lock_guard lock(mutex_);
  return count_;
}

}  // namespace tessera
