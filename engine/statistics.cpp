#include "engine/statistics.h"

#include <sys/resource.h>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace tessera {
namespace {

template <class Section>
nlohmann::ordered_json object_of(const Section& section) {
  nlohmann::ordered_json object = nlohmann::ordered_json::object();
  for (const auto& [name, value] : section) object[name] = value;
  return object;
}

template <class Section>
auto value_of(const Section& section, std::string_view name) {
  for (const auto& [entry, value] : section)
    if (entry == name) return value;
  return typename Section::value_type::second_type{};
}

template <class Section>
void append_section(std::string& text, std::string_view title, const Section& section) {
  if (!title.empty()) text += fmt::format("{}\n", title);
  for (const auto& [name, value] : section) text += fmt::format("  {:<28} {}\n", name, value);
}

constexpr double bytes_per_mib = 1024.0 * 1024.0;

}  // namespace

nlohmann::ordered_json Statistics::json() const {
  nlohmann::ordered_json json = {
      {"times_s", object_of(times_s)}, {"counts", object_of(counts)},
      {"ratios", object_of(ratios)},   {"memory_bytes", object_of(memory_bytes)},
      {"plan", object_of(plan)},       {"options", object_of(options)},
      {"warnings", warnings}};
  if (!accuracy.numbers.empty()) {
    json["accuracy"] = object_of(accuracy.numbers);
    json["accuracy"].update(object_of(accuracy.words));
  }
  if (!heatmap.empty()) json["heatmap"] = object_of(heatmap);
  return json;
}

std::string Statistics::summary() const {
  return fmt::format(
      "{:.2f} s: {} grids, {} micropolygons, {} shaded points, STE {:.1f}%, peak {:.0f} MiB",
      value_of(times_s, "frame_s"), value_of(counts, "grids"), value_of(counts, "micropolygons"),
      value_of(counts, "points_shaded"), 100.0 * value_of(ratios, "ste"),
      double(value_of(memory_bytes, "peak_resident_bytes")) / bytes_per_mib);
}

std::string Statistics::report() const {
  std::string text;
  append_section(text, "plan", plan);
  append_section(text, "options", options);
  append_section(text, "times (stage times are summed over threads)", times_s);
  append_section(text, "counts", counts);
  append_section(text, "ratios", ratios);
  append_section(text, "memory", memory_bytes);
  if (!accuracy.numbers.empty()) {
    append_section(text, "accuracy", accuracy.numbers);
    append_section(text, "", accuracy.words);
  }
  if (!heatmap.empty()) append_section(text, "heat map (per pixel)", heatmap);
  return text;
}

uint64_t peak_resident_bytes() {
  rusage usage{};
  if (getrusage(RUSAGE_SELF, &usage) != 0) return 0;
  return uint64_t(usage.ru_maxrss) * 1024;  // Linux reports KiB
}

}  // namespace tessera
