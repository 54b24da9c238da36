#include "io/text/floe_ids.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <map>
#include <set>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "io/text/json_writer.hpp"
#include "io/text/problem.hpp"

namespace polynya::io {
namespace {

/// Reasons why an id cannot be used, in the order in which the message lists them.
enum class Fault { kText, kBeyond, kNotWhole, kOfFeature, kRepeated, kMissing };

Fault fault_of(const std::string& json) {
  if (json.starts_with('"')) return Fault::kText;
  const double number = std::strtod(json.c_str(), nullptr);
  if (std::abs(number) >= 9e15) return Fault::kBeyond;
  return number >= 0 && number == std::floor(number) && json.find_first_of("0123456789") == 0 ? Fault::kOfFeature
                                                                                              : Fault::kNotWhole;
}

std::string in_words(Fault fault, std::size_t count, const std::string& example) {
  const char* const is_or_are = count == 1 ? "is" : "are";
  switch (fault) {
    case Fault::kText:
      return fmt::format("{} {} text ({})", count, is_or_are, example);
    case Fault::kBeyond:
      return fmt::format("{} {} beyond 2^53 ({})", count, is_or_are, example);
    case Fault::kNotWhole:
      return fmt::format("{} {} no whole number from 0 on ({})", count, is_or_are, example);
    case Fault::kOfFeature:
      return fmt::format("{} {} not among the properties but the feature's ({})", count, is_or_are, example);
    case Fault::kRepeated:
      return fmt::format("{} {} the number of an earlier floe ({})", count, is_or_are, example);
    case Fault::kMissing:
      return fmt::format("{} {} none", counted(count, "floe"), count == 1 ? "has" : "have");
  }
  return "";
}

}  // namespace

GivenId given_id(const FloeEntry& entry) {
  return {entry.floe_id, entry.other_id};
}

std::string why_ids_are_replaced(const std::vector<GivenId>& ids) {
  struct Found {
    std::size_t count = 0;
    std::string example;
  };
  std::map<Fault, Found> faults;
  std::set<std::int64_t> seen;
  const auto add = [&](Fault fault, const std::string& example) {
    Found& found = faults[fault];
    if (found.count++ == 0) found.example = shortened(example, 40);
  };
  for (const GivenId& id : ids) {
    if (!id.is_given())
      add(Fault::kMissing, "");
    else if (id.other)
      add(fault_of(*id.other), *id.other);
    else if (!seen.insert(*id.number).second)
      add(Fault::kRepeated, id.as_json());
  }
  if (faults[Fault::kMissing].count == ids.size()) return "";
  std::vector<std::string> words;
  for (const auto& [fault, found] : faults)
    if (found.count > 0) words.push_back(in_words(fault, found.count, found.example));
  return fmt::format("{}", fmt::join(words, ", "));
}

bool are_usable(const std::vector<GivenId>& ids) {
  return std::ranges::all_of(ids, [](const GivenId& id) { return id.number.has_value(); }) &&
         why_ids_are_replaced(ids).empty();
}

std::string source_id_key(const std::vector<FloeEntry>& entries) {
  std::string key = "source_id";
  const auto has_key = [&](const FloeEntry& entry) {
    return entry.properties && entry.properties->find('"' + key + "\":") != std::string::npos;
  };
  while (std::ranges::any_of(entries, has_key)) key += '_';
  return key;
}

std::string replaced_in_words(std::string_view why, std::string_view key) {
  return fmt::format("floe_id: {}; floes are numbered, and the name of each in the file is kept as {}", why, key);
}

}  // namespace polynya::io
