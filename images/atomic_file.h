#pragma once
/// Output files that appear whole or not at all.

#include <string>

namespace tessera {

/// A temporary file beside `path`, moved to `path` by commit(), deleted if that never happens.
class AtomicFile {
 public:
  /// Creates the temporary file, empty. Throws Error if the folder does not take it.
  explicit AtomicFile(const std::string& path);
  ~AtomicFile();
  AtomicFile(const AtomicFile&) = delete;
  AtomicFile& operator=(const AtomicFile&) = delete;

  /// Where to write. Ends in the extension of `path`.
  const std::string& temporary_path() const { return temporary_; }
  /// Replaces `path` by what was written. Throws Error, leaving `path` as it was, on failure.
  void commit();

 private:
  std::string path_, temporary_;
  bool committed_ = false;
};

}  // namespace tessera
