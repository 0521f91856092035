#include "images/atomic_file.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>

#include "base/error.h"

namespace tessera {
namespace {

/// A name nobody else uses: hidden, of this process, numbered. O_EXCL settles what is left.
std::string temporary_name(const std::filesystem::path& path, int attempt) {
  const std::string name = fmt::format(".{}.{}-{}.part{}", path.stem().string(), getpid(), attempt,
                                       path.extension().string());
  return (path.parent_path() / name).string();
}

}  // namespace

AtomicFile::AtomicFile(const std::string& path) : path_(path) {
  if (std::filesystem::is_directory(path))
    throw Error(fmt::format("cannot write {}: it is a folder", path));
  for (int attempt = 0; attempt < 100; ++attempt) {
    temporary_ = temporary_name(path, attempt);
    const int descriptor = open(temporary_.c_str(), O_CREAT | O_EXCL | O_WRONLY | O_CLOEXEC, 0666);
    if (descriptor >= 0) {
      close(descriptor);
      return;
    }
    if (errno != EEXIST) break;
  }
  throw Error(fmt::format("cannot write {}: {}", path, std::strerror(errno)));
}

AtomicFile::~AtomicFile() {
  if (!committed_) unlink(temporary_.c_str());
}

void AtomicFile::commit() {
  if (std::rename(temporary_.c_str(), path_.c_str()) != 0)
    throw Error(fmt::format("cannot write {}: {}", path_, std::strerror(errno)));
  committed_ = true;
}

}  // namespace tessera
