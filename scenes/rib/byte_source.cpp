#include "scenes/rib/byte_source.h"

#include <zlib.h>

#include <cerrno>
#include <cstring>

#include "base/error.h"

namespace tessera {

namespace {

constexpr size_t block_bytes = size_t(1) << 16;

}  // namespace

void ByteSource::CloseFile::operator()(gzFile_s* file) const { gzclose(file); }

ByteSource ByteSource::from_file(const std::string& path) {
  ByteSource source(path);
  errno = 0;
  source.file_.reset(gzopen(path.c_str(), "rb"));
  if (!source.file_)
    throw Error(SourceLocation{path, 0},
                fmt::format("cannot open the scene file: {}", std::strerror(errno)));
  gzbuffer(source.file_.get(), unsigned(block_bytes));
  source.block_.resize(block_bytes);
  return source;
}

ByteSource ByteSource::from_text(std::string_view text, const std::string& name) {
  ByteSource source(name);
  source.next_ = text.data();
  source.end_ = text.data() + text.size();
  return source;
}

bool ByteSource::refill() {
  if (!file_) return false;
  const int count = gzread(file_.get(), block_.data(), unsigned(block_.size()));
  int code = Z_OK;
  const char* message = gzerror(file_.get(), &code);
  // A gzip stream that breaks off reports Z_BUF_ERROR beside the bytes it still could give.
  if (count < 0 || (count == 0 && code != Z_OK && code != Z_STREAM_END))
    throw Error(SourceLocation{name_, 0},
                fmt::format("cannot read the scene file: {}",
                            code == Z_ERRNO ? std::strerror(errno) : message));
  next_ = block_.data();
  end_ = next_ + count;
  return count > 0;
}

}  // namespace tessera
