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

std::vector<Problem> ProblemCollector::take() {
  std::ranges::stable_sort(entries_, {}, [](const Entry& e) { return std::tuple(e.source, e.offset); });
  std::vector<Problem> problems;
  for (Entry& entry : entries_) {
    const SourceText& source = sources_[entry.source];
    const auto place = line_and_column(source.text, entry.offset);
    entry.problem.file = source.name;
    entry.problem.line = place.line;
    entry.problem.column = place.column;
    problems.push_back(std::move(entry.problem));
  }
  if (beyond_ > 0)
    problems.push_back({.file = sources_[0].name, .found = fmt::format("{} more problems", beyond_)});
  entries_.clear();
  beyond_ = 0;
  return problems;
}

}  // namespace polynya::io
