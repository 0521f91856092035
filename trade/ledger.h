#pragma once
/// The record of a sweep: a line of JSON for each finished process, so that it can go on later.

#include <cstdio>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "trade/measurement.h"

namespace tessera::trade {

/// What has to be the same for measurements to belong together: (what, value), in words that a
/// message can use.
using Identity = std::map<std::string, std::string>;

/// What a ledger holds.
struct LedgerContent {
  Identity identity;
  std::vector<Measurement> measurements;
  bool torn = false;       ///< the last line is half a line, and was left out
  size_t sound_bytes = 0;  ///< length of the file without it
};

/// Reads a ledger. Throws Error naming file and line for anything but a torn last line.
LedgerContent read_ledger(const std::string& path);

/// Throws Error naming everything of `now` in which the sweep of a ledger was another one.
void check_identity(const std::string& path, const Identity& recorded, const Identity& now);

/// Appends to a ledger. Every line is with the system before append() returns.
class Ledger {
 public:
  /// Starts anew. Throws Error when the file cannot be written.
  Ledger(const std::string& path, const Identity& identity);
  /// Goes on after what `content` holds of the file.
  Ledger(const std::string& path, const LedgerContent& content);
  /// Throws Error, as on a full disc.
  void append(const Measurement& measurement);

 private:
  struct Close {
    void operator()(std::FILE* file) const { std::fclose(file); }
  };
  void open(const char* mode);
  void write_line(const std::string& line);

  std::string path_;
  std::unique_ptr<std::FILE, Close> file_;
};

}  // namespace tessera::trade
