#include "analysis/floe_sizes.hpp"

#include <algorithm>
#include <cmath>

namespace polynya::analysis {

std::vector<SizeClass> size_classes(const std::vector<SizedFloe>& floes) {
  std::vector<SizeClass> classes;
  if (floes.empty()) return classes;
  const auto edge = [](int number) {  // …, 1, 2, 5, 10, 20, 50, …
    static constexpr double kSteps[] = {1, 2, 5};
    const int decade = static_cast<int>(std::floor(number / 3.0));
    return kSteps[number - 3 * decade] * std::pow(10.0, decade);
  };
  int number = 3 * static_cast<int>(std::floor(std::log10(floes.front().size))) - 1;
  while (edge(number + 1) <= floes.front().size) ++number;
  for (std::size_t i = 0; i < floes.size(); ++number) {
    SizeClass one{.from = edge(number), .below = edge(number + 1), .from_on = floes.size() - i};
    for (; i < floes.size() && floes[i].size < one.below; ++i, ++one.count) one.area += floes[i].area;
    classes.push_back(one);
  }
  return classes;
}

SizeDistribution size_distribution(const io::Run& run, double time) {
  std::vector<SizedFloe> floes;
  SizeDistribution sizes{.time = time, .classes = {}};
  for (const io::RunFloe& floe : run.floes) {
    if (!run.is_alive(floe.birth.floe, time)) continue;
    const double area = floe.birth.area;
    if (std::isnormal(area) && area > 0)
      floes.push_back({std::sqrt(area), area});
    else
      ++sizes.without_size;
  }
  std::ranges::sort(floes, {}, &SizedFloe::area);
  sizes.count = floes.size();
  if (floes.empty()) return sizes;
  for (const SizedFloe& floe : floes) sizes.area += floe.area;
  sizes.least = floes.front().size;
  sizes.median = floes[floes.size() / 2].size;
  sizes.largest = floes.back().size;
  sizes.classes = size_classes(floes);
  return sizes;
}

}  // namespace polynya::analysis
