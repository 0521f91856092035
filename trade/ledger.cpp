#include "trade/ledger.h"

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <sstream>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "base/error.h"

namespace tessera::trade {
namespace {

using Json = nlohmann::ordered_json;

constexpr int ledger_version = 1;

Identity identity_of(const Json& line, const SourceLocation& where) {
  try {
    if (line.at("ledger") != ledger_version)
      throw Error(where, fmt::format("expected a ledger of version {}", ledger_version));
    return line.at("identity").get<Identity>();
  } catch (const Json::exception&) {
    throw Error(where, "expected the first line of a ledger");
  }
}

void read_line(const std::string& text, const SourceLocation& where, LedgerContent& content) {
  Json line;
  try {
    line = Json::parse(text);
  } catch (const Json::exception& error) {
    throw Error(where, fmt::format("expected a line of JSON: {}", error.what()));
  }
  if (where.line == 1) {
    content.identity = identity_of(line, where);
    return;
  }
  try {
    content.measurements.push_back(Measurement::from_json(line));
  } catch (const Error& error) {
    throw Error(where, error.what());
  }
}

}  // namespace

LedgerContent read_ledger(const std::string& path) {
  std::ifstream stream(path, std::ios::binary);
  if (!stream) throw Error(fmt::format("cannot read {}: {}", path, std::strerror(errno)));
  std::ostringstream whole;
  whole << stream.rdbuf();
  const std::string text = whole.str();
  LedgerContent content;
  SourceLocation where{path, 0};
  for (size_t start = 0; start < text.size();) {
    ++where.line;
    const size_t end = text.find('\n', start);
    if (end == text.npos) {
      content.torn = true;
      break;
    }
    read_line(text.substr(start, end - start), where, content);
    start = content.sound_bytes = end + 1;
  }
  if (content.sound_bytes == 0)
    throw Error(fmt::format("{}: no whole line in it; start again with --fresh", path));
  return content;
}

void check_identity(const std::string& path, const Identity& recorded, const Identity& now) {
  std::string differences;
  for (const auto& [name, value] : now) {
    const auto entry = recorded.find(name);
    const std::string was = entry == recorded.end() ? "none" : entry->second;
    if (was != value) differences += fmt::format("\n  {}: was '{}', is '{}'", name, was, value);
  }
  if (!differences.empty())
    throw Error(
        fmt::format("{} cannot be resumed, its runs were of another kind:{}\nStart again "
                    "with --fresh, or write elsewhere with -o.",
                    path, differences));
}

Ledger::Ledger(const std::string& path, const Identity& identity) : path_(path) {
  open("wb");
  write_line(Json{{"ledger", ledger_version}, {"identity", identity}}.dump());
}

Ledger::Ledger(const std::string& path, const LedgerContent& content) : path_(path) {
  std::error_code error;
  if (content.torn) std::filesystem::resize_file(path, content.sound_bytes, error);
  if (error) throw Error(fmt::format("cannot write {}: {}", path, error.message()));
  open("ab");
}

void Ledger::open(const char* mode) {
  file_.reset(std::fopen(path_.c_str(), mode));
  if (!file_) throw Error(fmt::format("cannot write {}: {}", path_, std::strerror(errno)));
}

void Ledger::write_line(const std::string& line) {
  const std::string text = line + "\n";
  if (std::fwrite(text.data(), 1, text.size(), file_.get()) != text.size() ||
      std::fflush(file_.get()) != 0)
    throw Error(fmt::format("cannot write {}: {}", path_, std::strerror(errno)));
}

void Ledger::append(const Measurement& measurement) {
  write_line(measurement.json().dump(-1, ' ', false, Json::error_handler_t::replace));
}

}  // namespace tessera::trade
