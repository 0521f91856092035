#include "engine/console.h"

#include <string_view>

#include <sys/ioctl.h>
#include <unistd.h>

namespace tessera {
namespace {

int terminal_columns(int descriptor) {
  winsize size{};
  if (ioctl(descriptor, TIOCGWINSZ, &size) == 0 && size.ws_col > 0) return size.ws_col;
  return 80;
}

/// What cannot be written is lost: no reason to give up a render. The stream remembers that it
/// failed, and main() looks.
void put(std::FILE* stream, std::string_view text) {
  std::fwrite(text.data(), 1, text.size(), stream);
}

}  // namespace

Console::Console(Verbosity verbosity) : verbosity_(verbosity), terminal_(isatty(STDERR_FILENO)) {}

void Console::write(std::FILE* stream, const std::string& text) {
  const std::lock_guard lock(mutex_);
  if (!bar_.empty()) put(stderr, clear_progress_bar);
  put(stream, text + "\n");
  std::fflush(stream);
  if (!bar_.empty()) put(stderr, bar_);
}

void Console::print(const std::string& line) {
  if (verbosity_ != Verbosity::quiet) write(stdout, line);
}

void Console::note(const std::string& line) {
  if (verbosity_ != Verbosity::quiet) write(stderr, line);
}

void Console::error(const std::string& line) { write(stderr, "error: " + line); }

void Console::begin_progress(const std::string& label) {
  if (verbosity_ == Verbosity::quiet) return;
  const std::lock_guard lock(mutex_);
  meter_.emplace(label, terminal_, terminal_ ? terminal_columns(STDERR_FILENO) : 0);
  progress_start_ = Clock::now();
}

void Console::progress(const FrameProgress& progress) {
  const std::lock_guard lock(mutex_);
  if (!meter_) return;
  const std::chrono::duration<double> elapsed = Clock::now() - progress_start_;
  const std::optional<std::string> text = meter_->update(progress, elapsed.count());
  if (!text) return;
  put(stderr, *text);
  std::fflush(stderr);
  if (terminal_) bar_ = *text;
}

void Console::end_progress() {
  const std::lock_guard lock(mutex_);
  if (!bar_.empty()) put(stderr, clear_progress_bar);
  bar_.clear();
  meter_.reset();
}

}  // namespace tessera
