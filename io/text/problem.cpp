#include "io/text/problem.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <numeric>
#include <tuple>

#include "io/text/json_writer.hpp"

namespace polynya::io {

namespace {

/// Edit distance (Levenshtein) in bytes; exchanging two neighbouring bytes counts as one edit.
std::size_t edit_distance(std::string_view a, std::string_view b) {
  std::vector<std::size_t> before(b.size() + 1), above(b.size() + 1), row(b.size() + 1);
  std::iota(above.begin(), above.end(), std::size_t{0});
  for (std::size_t i = 1; i <= a.size(); ++i) {
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t exchange = a[i - 1] == b[j - 1] ? 0 : 1;
      row[j] = std::min({above[j] + 1, row[j - 1] + 1, above[j - 1] + exchange});
      if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1]) row[j] = std::min(row[j], before[j - 2] + 1);
    }
    std::swap(before, above);
    std::swap(above, row);
  }
  return above[b.size()];
}

std::string_view without_unit(std::string_view key) {
  return key.substr(0, key.rfind('_'));
}

}  // namespace

std::string to_json_text(const std::vector<Problem>& problems) {
  std::string text;
  JsonWriter json(text);
  json.object_lines(problems, [&](const Problem& problem) {
    json.key("file").value(problem.file);
    for (const auto& [key, value] : {std::pair{"line", problem.line}, {"column", problem.column}})
      json.key(key).value(problem.line > 0 ? std::optional(value) : std::nullopt);
    json.key("path").value(shortened(problem.path, kLongestPath)).key("severity").value(name_of(problem.severity));
    json.key("message").value(message_of(problem));
  });
  return text + "\n";
}

std::string places_in_words(std::span<const geometry::Point> places, std::size_t most) {
  std::string text;
  for (std::size_t i = 0; i < std::min(places.size(), most); ++i)
    text += fmt::format("{}({}, {})", i == 0 ? " at " : ", ", places[i].x, places[i].y);
  return text;
}

std::string show(const JsonValue& value) {
  std::string text;
  switch (value.kind()) {
    case JsonValue::Kind::kNumber:
      append_number(text, value.number());
      return text;
    case JsonValue::Kind::kText:
      append_text(text, shortened(value.text(), 60));
      return text;
    case JsonValue::Kind::kBoolean:
      return value.boolean() ? "true" : "false";
    case JsonValue::Kind::kArray:
      return fmt::format("a list of {}", value.items().size());
    default:
      return std::string(name_of(value.kind()));
  }
}

std::string nearest(std::string_view word, const std::vector<std::string_view>& candidates) {
  std::string_view best;
  std::size_t least = std::string_view::npos;
  if (word.size() > 200) return "";
  for (const std::string_view candidate : candidates) {
    // A forgotten or wrong unit counts as one edit: "thickness" means "thickness_m".
    const bool same_name = word == without_unit(candidate) || without_unit(word) == without_unit(candidate);
    const std::size_t distance = same_name ? 1 : edit_distance(word, candidate);
    if (distance < least) {
      least = distance;
      best = candidate;
    }
  }
  // Two edits turn a word of four letters into almost any other, for example "with" into "watch".
  const std::size_t near_enough = word.size() <= 4 ? 1 : std::max<std::size_t>(2, word.size() / 3);
  return least <= near_enough ? std::string(best) : "";
}

void ProblemCollector::add(std::size_t source, std::uint32_t offset, Problem problem) {
  if (entries_.size() >= kMost) {
    ++beyond_;
    return;
  }
  entries_.push_back({source, offset, std::move(problem)});
}

void ProblemCollector::report(std::size_t source, std::uint32_t offset, std::string path, std::string found,
                              std::string allowed, std::string suggestion) {
  add(source, offset,
      {.path = std::move(path),
       .found = std::move(found),
       .allowed = std::move(allowed),
       .suggestion = std::move(suggestion)});
}

void ProblemCollector::add_faults(std::size_t source, const std::vector<JsonFault>& faults) {
  for (const JsonFault& fault : faults) add(source, fault.offset, fault);
}

namespace {

/// Returns the unit in brackets at the end of what is allowed, such as m of "a number > 0 [m]"; empty if there is none.
std::string_view unit_of(std::string_view allowed) {
  const std::size_t begin = allowed.rfind('[');
  const bool has_unit = begin != std::string_view::npos && allowed.ends_with(']') && begin > 0;
  return has_unit ? allowed.substr(begin + 1, allowed.size() - begin - 2) : std::string_view{};
}

/// Converts a number that is not JSON (.05, 0,7, 5., +3, 007, 12 m) to JSON. Returns an empty text if it is no number,
/// or has another unit than the one that is allowed.
std::string as_json_number(std::string_view text, std::string_view unit_allowed) {
  std::string plain(trimmed(text));
  if (plain.starts_with('+')) plain.erase(0, 1);
  if (std::ranges::count(plain, ',') == 1 && plain.find('.') == std::string::npos)
    std::ranges::replace(plain, ',', '.');
  double value = 0;
  const auto read = std::from_chars(plain.data(), plain.data() + plain.size(), value);
  const std::string_view unit =
      trimmed(std::string_view(plain).substr(static_cast<std::size_t>(read.ptr - plain.data())));
  if (read.ec != std::errc{} || !std::isfinite(value) || (!unit.empty() && unit != unit_allowed)) return "";
  std::string json;
  append_number(json, value);
  return json;
}

/// Converts a list of numbers that is not JSON, such as 1,2 or (1 2), to JSON. Returns an empty text if it is no list.
std::string as_json_list(std::string_view text, std::string_view unit_allowed) {
  std::string plain(text), json;
  const auto is_between = [](char c) { return std::string_view("()[],; ").find(c) != std::string_view::npos; };
  std::ranges::replace_if(plain, is_between, ' ');
  std::string_view left = trimmed(plain);
  while (!left.empty()) {
    const std::string_view word = left.substr(0, left.find(' '));
    const std::string number = as_json_number(word, unit_allowed);
    if (number.empty()) return "";
    json += (json.empty() ? "[" : ", ") + number;
    left = trimmed(left.substr(word.size()));
  }
  return json.empty() ? "" : json + "]";
}

/// Guesses the JSON value that a user meant, from what is allowed there. Returns an empty text if that is not clear.
std::string meant_by(std::string_view text, std::string_view allowed) {
  std::string_view bare = trimmed(text);
  for (const char quote : {'\'', '"', '`'})
    if (bare.size() > 1 && bare.front() == quote && bare.back() == quote) bare = bare.substr(1, bare.size() - 2);
  if (allowed.starts_with("true or false")) {
    for (const std::string_view yes : {"True", "TRUE", "true", "yes", "Yes", "on", "1"})
      if (bare == yes) return "true";
    for (const std::string_view no : {"False", "FALSE", "false", "no", "No", "off", "0"})
      if (bare == no) return "false";
    return "";
  }
  const std::string_view unit = unit_of(allowed);
  return allowed.starts_with("[") || allowed.starts_with("a list") ? as_json_list(bare, unit)
                                                                   : as_json_number(bare, unit);
}

/// Adds to a problem that the value on the command line is not JSON, and what to write instead.
void explain_json(Problem& problem, const std::string& text) {
  if (!problem.sentence.empty() || problem.found != show({text})) return;
  const std::string meant = meant_by(text, problem.allowed);
  if (meant.empty()) {
    problem.found += ", which is not JSON and so is taken as a text";
  } else {
    const std::string_view kind = meant.starts_with('[')                ? "list"
                                  : meant == "true" || meant == "false" ? "boolean"
                                                                        : "number";
    problem.sentence =
        fmt::format("{} is not a JSON {}; write {}; allowed: {}", problem.found, kind, meant, problem.allowed);
  }
}

}  // namespace

std::uint32_t ProblemCollector::add_overlay(PlacedText text) {
  const std::size_t begin =
      overlays_.empty() ? sources_[0].text.size() + 1 : overlays_.back().begin + overlays_.back().text.length + 1;
  overlays_.push_back({static_cast<std::uint32_t>(begin), std::move(text)});
  return overlays_.back().begin;
}

void ProblemCollector::place(const Entry& entry, Problem& problem) const {
  const SourceText& source = sources_[entry.source];
  const auto behind = std::ranges::upper_bound(overlays_, entry.offset, {}, &Overlay::begin);
  if (entry.source == 0 && behind != overlays_.begin()) {
    const Overlay& overlay = *std::prev(behind);
    problem.file = overlay.text.name;
    problem.line = overlay.text.line;
    problem.column = problem.line > 0 ? static_cast<int>(entry.offset - overlay.begin) + 1 : 0;
    if (overlay.text.not_json) explain_json(problem, *overlay.text.not_json);
    return;
  }
  const auto place = line_and_column(source.text, entry.offset);
  problem.file = source.name;
  problem.line = place.line;
  problem.column = place.column;
}

std::vector<Problem> ProblemCollector::take() {
  std::ranges::stable_sort(entries_, {}, [](const Entry& e) { return std::tuple(e.source, e.offset); });
  std::vector<Problem> problems;
  for (Entry& entry : entries_) {
    place(entry, entry.problem);
    problems.push_back(std::move(entry.problem));
  }
  if (beyond_ > 0) problems.push_back({.file = sources_[0].name, .found = fmt::format("{} more problems", beyond_)});
  entries_.clear();
  beyond_ = 0;
  return problems;
}

}  // namespace polynya::io
