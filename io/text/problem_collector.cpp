#include "io/text/problem_collector.hpp"

#include <algorithm>
#include <tuple>

#include <fmt/format.h>

namespace polynya::io {

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
  for (const JsonFault& fault : faults)
    add(source, fault.offset,
        {.path = fault.path, .found = fault.found, .allowed = fault.allowed, .sentence = fault.sentence});
}

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
