#pragma once
/// The reading of one RIB scene: open files, declarations, archives.

#include <map>
#include <memory>
#include <set>
#include <string>
#include <vector>

#include "base/diagnostics.h"
#include "scenes/rib/archive_files.h"
#include "scenes/rib/declarations.h"
#include "scenes/rib/request_parser.h"
#include "scenes/scene_calls.h"

namespace tessera {

/// What request handlers work with: where their calls go, and the state of the file format itself.
class RibArguments;

class RibSession {
 public:
  RibSession(SceneCalls& calls, Diagnostics& diagnostics, ArchiveFolders folders);

  SceneCalls& calls() { return calls_; }
  Diagnostics& diagnostics() { return diagnostics_; }
  Declarations& declarations() { return declarations_; }
  std::vector<std::string>& archive_search_path() { return folders_.search_path; }

  /// Reads all requests of `source`, until its end or until nobody wants more.
  void read(ByteSource source);
  /// ReadArchive: an inline archive of that name, or a file. Throws Error when it cannot be found,
  /// is being read already, or archives nest too deep.
  void read_archive(const std::string& name, const SourceLocation& where);

  /// Reads over the following requests to the `end` that belongs to the block just begun by a
  /// request called `begin`.
  void skip_block(const std::string& begin, const std::string& end, const SourceLocation& where);
  /// ArchiveBegin: keeps the following requests, to the ArchiveEnd that belongs to it, as an
  /// archive.
  void record_archive(const std::string& name, const SourceLocation& where);

  /// Says that a request is left out, once for each name.
  void warn_skipped(const std::string& request, const std::string& why,
                    const SourceLocation& where);

 private:
  using InlineArchive = std::vector<RibRequest>;
  /// A block whose requests are not carried out.
  struct HeldBlock {
    std::string begin, end;
    SourceLocation where;
    int depth = 1;
    std::string archive_name;  ///< empty: skipped
    InlineArchive requests;
    size_t bytes = 0;
  };

  void handle(RibRequest& request);
  void hold(RibRequest& request);
  void dispatch(RibRequest& request);
  void replay(const InlineArchive& archive);

  SceneCalls& calls_;
  Diagnostics& diagnostics_;
  ArchiveFolders folders_;
  Declarations declarations_;
  std::map<std::string, void (*)(RibSession&, RibArguments&), std::less<>> handlers_;
  std::map<std::string, std::shared_ptr<const InlineArchive>> inline_archives_;
  std::unique_ptr<HeldBlock> held_;
  std::vector<std::string> open_files_;  ///< resolved paths, outermost first
  int archive_depth_ = 0;
  size_t archives_read_ = 0;
  std::set<std::string> unknown_names_;
};

}  // namespace tessera
