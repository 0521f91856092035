#pragma once
/// The folder that a sweep writes to.

#include <string>
#include <utility>

namespace tessera::trade {

/// One sweep writes to a folder at a time: others are refused while this exists. Ends with the
/// process, however that ends.
class FolderLock {
 public:
  /// Throws Error when another holds it. Where the file system has no locks there is none.
  explicit FolderLock(const std::string& folder);
  ~FolderLock();
  FolderLock(FolderLock&& other) noexcept : descriptor_(std::exchange(other.descriptor_, -1)) {}
  FolderLock& operator=(FolderLock&&) = delete;

 private:
  int descriptor_;
};

/// Makes the folder with all that is above it, and its folder of images. `fresh`: forgets the sweep
/// that it holds. Throws Error where it cannot be written, where another sweep is writing to it,
/// and where it holds runs and neither `resume` nor `fresh` says what is to become of them.
[[nodiscard]] FolderLock prepare_folder(const std::string& output, bool resume, bool fresh);

}  // namespace tessera::trade
