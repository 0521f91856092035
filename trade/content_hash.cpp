#include "trade/content_hash.h"

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <set>
#include <vector>

#include <fmt/format.h>

#include "base/error.h"
#include "scenes/rib/lexer.h"

namespace tessera::trade {

namespace fs = std::filesystem;

namespace {

/// Whether a file may be read as RIB. ReadArchive takes any name; whatever else names a file in
/// .rib (a delayed archive, a comment of an exporter's own) may mean one.
bool is_archive(const std::string& request, const fs::path& path) {
  return request == "ReadArchive" || path.extension() == ".rib" ||
         path.string().ends_with(".rib.gz");
}

std::string identity_of(const fs::path& path) {
  std::error_code ignored;
  return fs::weakly_canonical(path, ignored).string();
}

/// Follows the files of a scene, each once, in the order in which they are named. A file that was
/// named as something else first is followed when it turns out to be an archive.
class SceneFiles {
 public:
  SceneFiles(const fs::path& scene, ContentHash& hash)
      : folder_(scene.parent_path()), hash_(hash) {}

  void add(const fs::path& path) {
    if (seen_.insert(identity_of(path)).second) hash_.add_file(path.string());
  }
  void follow(const fs::path& path);

 private:
  void string_token(const std::string& request, const std::string& text, const fs::path& from);
  std::vector<fs::path> find(const std::string& name, const fs::path& from) const;

  fs::path folder_;
  ContentHash& hash_;
  std::vector<fs::path> search_;
  std::set<std::string> seen_, followed_;
};

/// The files that a name may stand for: which of several is taken is the business of who reads it.
std::vector<fs::path> SceneFiles::find(const std::string& name, const fs::path& from) const {
  constexpr size_t longest_name = 4096;
  if (name.empty() || name.size() > longest_name) return {};
  std::vector<fs::path> folders{from.parent_path(), folder_}, files;
  folders.insert(folders.end(), search_.begin(), search_.end());
  for (const fs::path& folder : search_) folders.push_back(folder_ / folder);
  folders.emplace_back();
  for (const fs::path& folder : folders) {
    std::error_code ignored;
    const fs::path path = folder / name;
    if (fs::is_regular_file(path, ignored)) files.push_back(path);
  }
  return files;
}

void SceneFiles::string_token(const std::string& request, const std::string& text,
                              const fs::path& from) {
  if (request == "Option") {
    // The folders of a searchpath; a file found through what is none is hashed in vain, no more.
    for (size_t start = 0; start <= text.size();) {
      const size_t end = std::min(text.find(':', start), text.size());
      if (end > start) search_.emplace_back(text.substr(start, end - start));
      start = end + 1;
    }
  }
  for (const fs::path& file : find(text, from)) {
    add(file);
    if (is_archive(request, file)) follow(file);
  }
}

void SceneFiles::follow(const fs::path& path) {
  if (!followed_.insert(identity_of(path)).second) return;
  try {
    Lexer lexer(ByteSource::from_file(path.string()));
    std::string request;
    for (Token token; lexer.next(token), token.kind != Token::Kind::end;) {
      if (token.kind == Token::Kind::request) request = token.text;
      if (token.kind == Token::Kind::string) string_token(request, token.text, path);
    }
  } catch (const Error&) {
    // Not RIB from here on: the renderer will say so.
  }
}

}  // namespace

void ContentHash::add_file(const std::string& path) {
  std::ifstream stream(path, std::ios::binary);
  std::vector<char> block(1 << 16);
  if (!stream || fs::is_directory(path))
    throw Error(fmt::format("cannot read {}: {}", path,
                            fs::is_directory(path) ? "it is a folder" : std::strerror(errno)));
  while (stream.read(block.data(), std::streamsize(block.size())), stream.gcount() > 0)
    add(std::string_view(block.data(), size_t(stream.gcount())));
  if (stream.bad()) throw Error(fmt::format("cannot read {}", path));
}

std::string ContentHash::text() const { return fmt::format("{:016x}", state_); }

std::string hash_scene(const std::string& scene) {
  ContentHash hash;
  SceneFiles files(scene, hash);
  files.add(scene);
  files.follow(scene);
  return hash.text();
}

std::string hash_file(const std::string& path) {
  ContentHash hash;
  hash.add_file(path);
  return hash.text();
}

std::string hash_pixels(const Image& image) {
  ContentHash hash;
  for (const PixelRect& window : {image.display_window, image.data_window})
    hash.add_item(fmt::format("{} {} {} {}", window.x0, window.y0, window.x1, window.y1));
  for (const Image::Channel& channel : image.channels) {
    hash.add_item(channel.name);
    hash.add(std::string_view(reinterpret_cast<const char*>(channel.values.data()),
                              channel.values.size() * sizeof(float)));
  }
  return hash.text();
}

}  // namespace tessera::trade
