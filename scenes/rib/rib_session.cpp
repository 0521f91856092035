#include "scenes/rib/rib_session.h"

#include <algorithm>
#include <filesystem>

#include "scenes/rib/request.h"

namespace tessera {

namespace {

constexpr int deepest_archive = 64;
/// Archives that read archives multiply; this ends a small file that would take for ever.
constexpr size_t most_archives = size_t(1) << 20;
/// Names nobody knows before a file is taken for something else than RIB.
constexpr size_t most_unknown_names = 100;
constexpr size_t most_inline_bytes = size_t(1) << 30;

std::string resolved(const std::string& path) {
  std::error_code error;
  const auto canonical = std::filesystem::weakly_canonical(path, error);
  return error ? path : canonical.string();
}

size_t bytes_of(const RibRequest& request) {
  size_t bytes = sizeof(RibRequest) + request.name.size() + request.where.file.size();
  for (const RibValue& value : request.values) {
    bytes += sizeof(RibValue) + value.numbers.size() * sizeof(double);
    for (const std::string& text : value.strings) bytes += sizeof(text) + text.size();
  }
  return bytes;
}

}  // namespace

RibSession::RibSession(SceneCalls& calls, Diagnostics& diagnostics, ArchiveFolders folders)
    : calls_(calls), diagnostics_(diagnostics), folders_(std::move(folders)) {
  for (const RibRequestTable& table : rib_request_registry())
    for (const RibRequestRow& row : table.rows) handlers_.emplace(row.name, row.handler);
}

void RibSession::read(ByteSource source) {
  RequestParser parser(std::move(source));
  RibRequest request;
  while (calls_.wants_more() && parser.next(request)) handle(request);
  if (held_)
    throw Error(parser.where(), fmt::format("the file ends where {} was expected, for the block "
                                            "begun at {}",
                                            held_->end, held_->where.text()));
}

void RibSession::handle(RibRequest& request) {
  if (held_)
    hold(request);
  else
    dispatch(request);
}

void RibSession::hold(RibRequest& request) {
  if (request.name == held_->begin) ++held_->depth;
  if (request.name == held_->end && --held_->depth == 0) {
    const std::unique_ptr<HeldBlock> block = std::move(held_);
    if (!block->archive_name.empty())
      inline_archives_[block->archive_name] =
          std::make_shared<const InlineArchive>(std::move(block->requests));
    return;
  }
  if (held_->archive_name.empty()) return;
  held_->bytes += bytes_of(request);
  if (held_->bytes > most_inline_bytes)
    throw Error(held_->where,
                fmt::format("an inline archive of more than {} bytes", most_inline_bytes));
  held_->requests.push_back(std::move(request));
}

void RibSession::dispatch(RibRequest& request) {
  const auto found = handlers_.find(request.name);
  if (found == handlers_.end()) {
    if (unknown_names_.insert(request.name).second && unknown_names_.size() > most_unknown_names)
      throw Error(request.where, fmt::format("more than {} unknown requests, the last of them {}; "
                                             "expected a RIB file",
                                             most_unknown_names, request.name));
    return warn_skipped(request.name, "is not known", request.where);
  }
  RibArguments arguments(request);
  found->second(*this, arguments);
  arguments.finish();
}

void RibSession::warn_skipped(const std::string& request, const std::string& why,
                              const SourceLocation& where) {
  diagnostics_.warn_once("request:" + request, where,
                         fmt::format("the request {} {}: skipped", request, why));
}

void RibSession::read_archive(const std::string& name, const SourceLocation& where) {
  if (archive_depth_ == deepest_archive)
    throw Error(where, fmt::format("archives are nested more than {} deep", deepest_archive));
  if (++archives_read_ > most_archives)
    throw Error(where, fmt::format("more than {} archives are read", most_archives));
  const auto found = inline_archives_.find(name);
  if (found != inline_archives_.end()) {
    const std::shared_ptr<const InlineArchive> archive = found->second;
    ++archive_depth_;
    replay(*archive);
    --archive_depth_;
    return;
  }
  const std::string path = find_archive(name, folders_, where);
  const std::string file = resolved(path);
  if (std::find(open_files_.begin(), open_files_.end(), file) != open_files_.end() ||
      file == resolved(folders_.scene_file))
    throw Error(where, fmt::format("the archive \"{}\" reads itself", name));
  open_files_.push_back(file);
  ++archive_depth_;
  read(ByteSource::from_file(path));
  --archive_depth_;
  open_files_.pop_back();
}

void RibSession::replay(const InlineArchive& archive) {
  for (const RibRequest& request : archive) {
    if (!calls_.wants_more()) return;
    RibRequest copy = request;
    handle(copy);
  }
}

void RibSession::skip_block(const std::string& begin, const std::string& end,
                            const SourceLocation& where) {
  held_ = std::make_unique<HeldBlock>(HeldBlock{begin, end, where, 1, "", {}, 0});
}

void RibSession::record_archive(const std::string& name, const SourceLocation& where) {
  if (name.empty()) throw Error(where, "expected the name of an archive, found an empty string");
  held_ =
      std::make_unique<HeldBlock>(HeldBlock{"ArchiveBegin", "ArchiveEnd", where, 1, name, {}, 0});
}

}  // namespace tessera
