// Icebreaking databases, from anybody; where a text has a last line for its hash, also with the hash that is
// right. What is read is written as a text that reads back as itself, and answers any load with a finite
// force.

#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <string>

#include "fracture/bending/database.hpp"
#include "fracture/bending/database_text.hpp"

namespace {

using namespace polynya::fracture;

void require(bool holds) {
  if (!holds) std::abort();
}

std::string with_right_hash(std::string text) {
  const auto at = text.rfind("hash fnv1a64 ");
  if (at == std::string::npos) return text;
  text.resize(at);
  std::uint64_t hash = 14695981039346656037U;
  for (const char c : text) hash = (hash ^ static_cast<unsigned char>(c)) * 1099511628211U;
  char line[64];
  std::snprintf(line, sizeof line, "hash fnv1a64 %016llx\n", static_cast<unsigned long long>(hash));
  return text + line;
}

void read(const std::string& text) {
  const auto database = parse_database(text);
  if (!database) return require(!database.error().message.empty());
  const std::string written = write_database(*database);
  const auto again = parse_database(written);
  require(again.has_value() && write_database(*again) == written);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size > 50000) return 0;
  const std::string text(reinterpret_cast<const char*>(data), size);
  read(text);
  read(with_right_hash(text));
  return 0;
}
