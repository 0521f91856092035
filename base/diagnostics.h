#pragma once
/// Warnings: said once each, counted, sent to whoever renders. No global logger.

#include <functional>
#include <mutex>
#include <set>
#include <string>
#include <vector>

#include "base/error.h"

namespace tessera {

/// Collects warnings from any thread. Each distinct `key` is reported once; repeats are counted.
class Diagnostics {
 public:
  using Sink = std::function<void(const std::string& line)>;

  /// `sink` receives each finished line ("file:line: warning: message"), under a lock. A null sink
  /// only collects.
  explicit Diagnostics(Sink sink = nullptr) : sink_(std::move(sink)) {}

  /// Reports `message` the first time `key` is seen.
  void warn_once(const std::string& key, const SourceLocation& where, const std::string& message);
  void warn_once(const std::string& key, const std::string& message) {
    warn_once(key, SourceLocation{}, message);
  }

  /// Every line reported so far, in order.
  std::vector<std::string> lines() const;
  /// Calls of warn_once, repeats included.
  size_t warning_count() const;

 private:
  mutable std::mutex mutex_;
  Sink sink_;
  std::set<std::string> seen_;
  std::vector<std::string> lines_;
  size_t count_ = 0;
};

}  // namespace tessera
