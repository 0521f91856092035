#include "trade/folder.h"

#include <cerrno>
#include <cstring>
#include <filesystem>

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <unistd.h>

#include "base/error.h"

namespace tessera::trade {

namespace fs = std::filesystem;

FolderLock::FolderLock(const std::string& folder)
    : descriptor_(open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC)) {
  if (descriptor_ < 0 || flock(descriptor_, LOCK_EX | LOCK_NB) == 0 || errno != EWOULDBLOCK) return;
  close(descriptor_);
  throw Error(
      fmt::format("another sweep is writing to {}: wait for its end, or write elsewhere "
                  "with -o",
                  folder));
}

FolderLock::~FolderLock() {
  if (descriptor_ >= 0) close(descriptor_);
}

FolderLock prepare_folder(const std::string& output, bool resume, bool fresh) {
  const fs::path folder = output;
  std::error_code error;
  if (fs::exists(folder) && !fs::is_directory(folder))
    throw Error(fmt::format("cannot write to {}: it is no folder", folder.string()));
  const fs::path ledger = folder / "runs.jsonl";
  if (fs::exists(ledger) && !resume && !fresh)
    throw Error(
        fmt::format("{} holds runs already: --resume goes on with them, --fresh forgets "
                    "them, -o writes elsewhere",
                    folder.string()));
  fs::create_directories(folder, error);
  if (error) throw Error(fmt::format("cannot write to {}: {}", folder.string(), error.message()));
  FolderLock lock(folder.string());
  // Only what is a sweep's own: a folder without a ledger may hold anything.
  if (fresh && fs::exists(ledger)) {
    for (const char* name : {"runs.jsonl", "runs", "trade.json", "trade.csv"})
      fs::remove_all(folder / name, error);
  }
  fs::create_directories(folder / "runs", error);
  if (error || access(folder.c_str(), W_OK | X_OK) != 0 ||
      access((folder / "runs").c_str(), W_OK | X_OK) != 0)
    throw Error(fmt::format("cannot write to {}: {}", folder.string(),
                            error ? error.message() : std::strerror(errno)));
  return lock;
}

}  // namespace tessera::trade
