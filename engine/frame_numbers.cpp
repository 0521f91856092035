#include "engine/frame_numbers.h"

#include <charconv>
#include <filesystem>
#include <optional>

#include <fmt/format.h>

#include "base/error.h"

namespace tessera {
namespace {

constexpr int max_frames = 1'000'000;

/// A whole number at the start of `text`, which is then cut off.
std::optional<int> take_number(std::string_view& text) {
  int value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || value < 0) return std::nullopt;
  text.remove_prefix(size_t(end - text.data()));
  return value;
}

bool take(std::string_view& text, char expected) {
  if (text.empty() || text.front() != expected) return false;
  text.remove_prefix(1);
  return true;
}

}  // namespace

std::vector<int> parse_frame_range(std::string_view text) {
  std::string_view rest = text;
  const std::optional<int> first = take_number(rest);
  std::optional<int> last = first, step = 1;
  if (first && take(rest, '-')) {
    last = take_number(rest);
    if (last && take(rest, 'x')) step = take_number(rest);
  }
  if (!first || !last || !step || !rest.empty() || *step < 1 || *last < *first) {
    throw Error(fmt::format(
        "frames '{}': expected A, A-B or A-BxS with whole numbers, A <= B and S >= 1", text));
  }
  if ((*last - *first) / *step >= max_frames) {
    throw Error(fmt::format("frames '{}': expected at most {} frames", text, max_frames));
  }
  std::vector<int> frames;
  for (long frame = *first; frame <= *last; frame += *step) frames.push_back(int(frame));
  return frames;
}

bool has_number_pattern(std::string_view name) { return name.find('#') != name.npos; }

std::string with_number(std::string_view pattern, int number) {
  std::string result;
  for (size_t i = 0; i < pattern.size();) {
    if (pattern[i] != '#') {
      result += pattern[i++];
      continue;
    }
    const size_t end = std::min(pattern.find_first_not_of('#', i), pattern.size());
    result += fmt::format("{:0{}}", number, end - i);
    i = end;
  }
  return result;
}

std::string insert_number(std::string_view name, int number) {
  const std::filesystem::path path(name);
  std::filesystem::path numbered = path;
  numbered.replace_filename(
      fmt::format("{}.{:04}{}", path.stem().string(), number, path.extension().string()));
  return numbered.string();
}

}  // namespace tessera
