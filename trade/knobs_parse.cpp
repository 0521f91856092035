// What the user writes about knobs.

#include <algorithm>
#include <cctype>
#include <charconv>

#include <fmt/format.h>

#include "base/error.h"
#include "trade/knobs.h"

namespace tessera::trade {
namespace {

std::vector<std::string> split(std::string_view text, char separator) {
  std::vector<std::string> pieces;
  for (size_t start = 0; start <= text.size();) {
    const size_t end = std::min(text.find(separator, start), text.size());
    pieces.emplace_back(text.substr(start, end - start));
    start = end + 1;
  }
  return pieces;
}

bool is_positive_number(const std::string& text) {
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  return error == std::errc() && end == text.data() + text.size() && value > 0 && value < 1e30;
}

/// Whether a piece between colons is an argument of the name before it.
bool is_argument(const std::string& piece) {
  return !piece.empty() &&
         (std::isdigit(static_cast<unsigned char>(piece[0])) || piece.find('=') != piece.npos);
}

std::vector<std::string> parse_values(const Knob& knob, std::string_view text) {
  std::vector<std::string> values;
  for (const std::string& piece : split(text, ':')) {
    if (piece.empty())
      throw Error(fmt::format("--knobs: {}={}: expected values separated by ':'", knob.name, text));
    if (knob.numeric && !is_positive_number(piece))
      throw Error(fmt::format("--knobs: {}={}: expected a number above 0", knob.name, piece));
    if (!knob.numeric && !values.empty() && is_argument(piece)) {
      values.back() += ":" + piece;
    } else {
      values.push_back(piece);
    }
  }
  return values;
}

KnobChoice parse_knob(const std::string& item) {
  const size_t equals = item.find('=');
  const Knob& knob = find_knob(item.substr(0, equals));
  if (knob.name == "quality") throw Error("the knob 'quality' is swept with --qualities");
  if (equals == item.npos) return {&knob, knob.values};
  return {&knob, parse_values(knob, std::string_view(item).substr(equals + 1))};
}

}  // namespace

std::vector<KnobChoice> parse_knobs(const std::string& text) {
  std::vector<KnobChoice> choices;
  if (text.empty()) {
    for (const Knob& knob : knob_table())
      if (knob.name == "spp" || !knob.values.empty()) choices.push_back({&knob, knob.values});
    return choices;
  }
  for (const std::string& item : split(text, ',')) {
    KnobChoice choice = parse_knob(item);
    for (const KnobChoice& other : choices)
      if (other.knob == choice.knob)
        throw Error(fmt::format("--knobs names '{}' twice", choice.knob->name));
    choices.push_back(std::move(choice));
  }
  return choices;
}

std::vector<Baseline> parse_baselines(const std::string& text) {
  std::vector<Baseline> baselines;
  if (text.empty()) return baselines;
  for (const std::string& name : split(text, ',')) baselines.push_back(find_baseline(name));
  return baselines;
}

std::vector<int> parse_ladder(const std::string& text) {
  constexpr int most = 1 << 16;
  std::vector<int> ladder;
  for (const std::string& item : split(text, ',')) {
    int spp = 0;
    const auto [end, error] = std::from_chars(item.data(), item.data() + item.size(), spp);
    if (error != std::errc() || end != item.data() + item.size() || spp < 1 || spp > most)
      throw Error(fmt::format(
          "--spp: '{}': expected whole numbers from 1 to {}, separated by commas", item, most));
    ladder.push_back(spp);
  }
  std::sort(ladder.begin(), ladder.end());
  ladder.erase(std::unique(ladder.begin(), ladder.end()), ladder.end());
  return ladder;
}

}  // namespace tessera::trade
