#pragma once
/// Bytes of a scene file, read in blocks; gzip is undone on the way.

#include <memory>
#include <string>
#include <string_view>
#include <vector>

struct gzFile_s;

namespace tessera {

/// A forward-only stream of bytes with one byte of look-ahead. Holds one block, whatever the size
/// of the file.
class ByteSource {
 public:
  /// Opens a file, plain or gzip (told apart by its first bytes). Throws Error naming the file.
  static ByteSource from_file(const std::string& path);
  /// Reads `text`, which must outlive the source. `name` stands for it in messages.
  static ByteSource from_text(std::string_view text, const std::string& name);

  const std::string& name() const { return name_; }
  /// The next byte, 0 to 255, or -1 at the end. Throws Error when the file cannot be read.
  int peek() { return next_ < end_ || refill() ? int((unsigned char)*next_) : -1; }
  int get() { return next_ < end_ || refill() ? int((unsigned char)*next_++) : -1; }

 private:
  struct CloseFile {
    void operator()(gzFile_s* file) const;
  };

  explicit ByteSource(std::string name) : name_(std::move(name)) {}
  bool refill();

  std::string name_;
  std::unique_ptr<gzFile_s, CloseFile> file_;
  std::vector<char> block_;
  const char* next_ = nullptr;
  const char* end_ = nullptr;
};

}  // namespace tessera
