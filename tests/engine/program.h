#pragma once
// Programs run as a user would, in a folder of their own.

#include <filesystem>
#include <string>
#include <vector>

#include <sys/types.h>

namespace tessera {

// A new empty folder that goes with its contents.
class TemporaryFolder {
 public:
  explicit TemporaryFolder(const std::string& name = "tessera-test");
  ~TemporaryFolder();
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;

  const std::filesystem::path& path() const { return path_; }
  std::string operator/(const std::string& name) const { return (path_ / name).string(); }
  // Writes a file, making its folder, and returns its path.
  std::string write(const std::string& name, const std::string& text) const;
  bool has(const std::string& name) const { return std::filesystem::exists(path_ / name); }
  // Names of all files, sorted, without those that Process leaves.
  std::vector<std::string> files() const;

 private:
  std::filesystem::path path_;
};

std::string read_text(const std::string& path);

struct ProgramResult {
  int exit_code = -1;  // -signal when one ended it
  std::string out, err;
};

// A program under way. Its output goes to files beside the folder it runs in.
class Process {
 public:
  // `environment`: "NAME=value" entries in place of those of this process.
  Process(std::vector<std::string> arguments, const TemporaryFolder& folder,
          const std::vector<std::string>& environment = {});
  ~Process();
  Process(const Process&) = delete;
  Process& operator=(const Process&) = delete;

  pid_t id() const { return id_; }
  std::string err_so_far() const { return read_text(err_); }
  ProgramResult wait();

 private:
  pid_t id_ = -1;
  std::string out_, err_;
};

// Runs the renderer with these arguments.
ProgramResult run_tessera(std::vector<std::string> arguments, const TemporaryFolder& folder);
std::string tessera_program();

}  // namespace tessera
