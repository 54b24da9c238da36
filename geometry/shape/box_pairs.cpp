#include "geometry/shape/box_pairs.hpp"

#include <algorithm>

#include <CGAL/box_intersection_d.h>

namespace polynya::geometry {

std::vector<std::pair<std::size_t, std::size_t>> pairs_of_boxes(const std::vector<Box>& boxes) {
  using CgalBox = CGAL::Box_intersection_d::Box_with_info_d<double, 2, std::size_t>;
  std::vector<CgalBox> all;
  all.reserve(boxes.size());
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    double low[] = {boxes[i].low.x, boxes[i].low.y};
    double high[] = {boxes[i].high.x, boxes[i].high.y};
    all.emplace_back(low, high, i);
  }
  std::vector<std::pair<std::size_t, std::size_t>> pairs;
  CGAL::box_self_intersection_d(all.begin(), all.end(), [&](const CgalBox& a, const CgalBox& b) {
    pairs.emplace_back(std::min(a.info(), b.info()), std::max(a.info(), b.info()));
  });
  std::sort(pairs.begin(), pairs.end());
  return pairs;
}

}  // namespace polynya::geometry
