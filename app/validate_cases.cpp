#include "app/validate_cases.hpp"

#include <algorithm>
#include <filesystem>

#include "app/console.hpp"
#include "app/read_input.hpp"

namespace polynya::app {
namespace {

constexpr std::size_t kLongestCases = std::size_t{4} << 30;  ///< [bytes]
constexpr std::size_t kMostPrinted = 100;                    ///< cases whose problems are printed

/// What is wrong with the cases so far.
class Report {
 public:
  Report(std::string name, ProblemFormat format) : name_(std::move(name)), format_(format) {}

  void add(std::size_t line, const std::vector<io::Problem>& problems) {
    if (++refused_ > kMostPrinted && format_ == ProblemFormat::kText) return;
    if (format_ == ProblemFormat::kJson) {
      std::string list = io::to_json_text(problems);
      std::erase(list, '\n');
      write_out(fmt::format("{{\"line\": {}, \"problems\": {}}}\n", line, list));
      return;
    }
    for (const io::Problem& problem : problems) {
      const bool is_of_case = problem.file == name_;
      print_err("{}{}\n", is_of_case ? "" : fmt::format("{}:{}: ", name_, line), to_string(problem));
    }
  }

  /// The last words, and the code to exit with.
  ExitCode end(std::size_t count) const {
    if (format_ == ProblemFormat::kJson) return refused_ == 0 ? kDone : kSceneInvalid;
    if (refused_ == 0) {
      print_out("{}: {}, all valid\n", name_, counted(count, "case"));
      return kDone;
    }
    if (refused_ > kMostPrinted) print_err("{}: {} more are refused\n", name_, refused_ - kMostPrinted);
    return fail(kSceneInvalid,
                fmt::format("{} of {} are refused; nothing was written", refused_, counted(count, "case")));
  }

 private:
  std::string name_;
  ProblemFormat format_;
  std::size_t refused_ = 0;
};

/// Reads one case's scene; what is wrong with it.
std::vector<io::Problem> problems_of(const std::string& scene_text, const std::string& scene_name,
                                     std::string_view line, const std::string& cases, std::size_t number,
                                     io::SceneOverrides overrides) {
  auto assignments = io::parse_case(line, cases, static_cast<int>(number));
  if (!assignments) return {std::move(assignments.error())};
  std::ranges::move(*assignments, std::back_inserter(overrides.assignments));
  const auto loaded =
      io::read_scene(scene_text, scene_name, std::filesystem::path(scene_name).parent_path(), overrides);
  return loaded ? std::vector<io::Problem>{} : loaded.error();
}

}  // namespace

int validate_cases(const std::string& scene, const std::string& cases, const io::SceneOverrides& overrides,
                   ProblemFormat format) {
  const auto scene_text = read_input(scene, io::kLongestScene);
  if (!scene_text) return fail(kInputOutput, fmt::format("{}: {}", scene, scene_text.error()));
  const auto text = read_input(cases, kLongestCases);
  if (!text) return fail(kInputOutput, fmt::format("{}: {}", cases, text.error()));
  Report report(cases, format);
  std::size_t count = 0;
  for (std::size_t begin = 0; begin < text->size();) {
    const std::size_t end = std::min(text->find('\n', begin), text->size());
    const std::string_view line = std::string_view(*text).substr(begin, end - begin);
    const auto problems = problems_of(*scene_text, scene, line, cases, ++count, overrides);
    if (!problems.empty()) report.add(count, problems);
    begin = end + 1;
  }
  return report.end(count);
}

}  // namespace polynya::app
