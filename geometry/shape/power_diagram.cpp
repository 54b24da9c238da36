#include "geometry/shape/power_diagram.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
namespace polynya::geometry {
namespace {

/// Largest number of weight classes. Fewer: a heavy site widens the search of all sites in its class. More: each search
/// has more grids to go through. Results do not change.
constexpr int kMostClasses = 16;

/// A grid for fixed sites: square bins over a box, about one site per bin. (The grid for bodies, which are added and
/// removed over unbounded water, is the hashed one of dynamics. With hashed cells the making of fields takes a quarter
/// longer, docs/decisions/2026-11-23-spatial-searches.md.)
class SiteBins {
 public:
  SiteBins(const std::vector<Site>& sites, const std::vector<std::uint32_t>& chosen, const Box& box) : low_(box.low) {
    const Vector extent = box.high - box.low;
    const auto count = static_cast<double>(chosen.size());
    side_ = std::max({std::sqrt(extent.x * extent.y / count), extent.x / 1e6, extent.y / 1e6});
    columns_ = 1 + static_cast<int>(extent.x / side_);
    rows_ = 1 + static_cast<int>(extent.y / side_);
    first_.assign(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_) + 1, 0);
    for (const std::uint32_t i : chosen) ++first_[bin_at(sites[i].point) + 1];
    for (std::size_t bin = 1; bin < first_.size(); ++bin) first_[bin] += first_[bin - 1];
    std::vector<std::uint32_t> next(first_.begin(), first_.end() - 1);
    members_.resize(chosen.size());
    for (const std::uint32_t i : chosen) members_[next[bin_at(sites[i].point)]++] = i;
  }

  double side() const { return side_; }
  int most_rings() const { return std::max(columns_, rows_); }

  /// Calls visit(site) for the sites of the bins that are `ring` bins away from the point's.
  template <class Visit>
  void for_ring(Point p, int ring, Visit visit) const {
    const int column = column_of(p.x);
    const int row = row_of(p.y);
    for (int r = std::max(0, row - ring); r <= std::min(rows_ - 1, row + ring); ++r) {
      const bool is_end_row = r == row - ring || r == row + ring;
      const int stride = is_end_row || ring == 0 ? 1 : 2 * ring;
      for (int c = column - ring; c <= column + ring; c += stride) {
        if (c < 0 || c >= columns_) continue;
        const std::size_t bin = index(c, r);
        for (std::uint32_t k = first_[bin]; k < first_[bin + 1]; ++k) visit(members_[k]);
      }
    }
  }

 private:
  int column_of(double x) const { return std::clamp(static_cast<int>((x - low_.x) / side_), 0, columns_ - 1); }
  int row_of(double y) const { return std::clamp(static_cast<int>((y - low_.y) / side_), 0, rows_ - 1); }
  std::size_t index(int column, int row) const {
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(columns_) + static_cast<std::size_t>(column);
  }
  std::size_t bin_at(Point p) const { return index(column_of(p.x), row_of(p.y)); }

  Point low_;
  double side_ = 1;
  int columns_ = 1;
  int rows_ = 1;
  std::vector<std::uint32_t> first_;  // first member of each bin, and the end
  std::vector<std::uint32_t> members_;
};

/// Sites of similar weight.
struct WeightClass {
  double heaviest = 0;  ///< [m²]
  SiteBins bins;
};

/// Classes of weight. Each is four times as heavy as the one before, counted from the lightest site in units of the
/// mean area of a cell.
class WeightClasses {
 public:
  WeightClasses(const std::vector<Site>& sites, const Box& box, int most_classes) : class_of_(sites.size()) {
    const Vector extent = box.high - box.low;
    const double unit = extent.x * extent.y / static_cast<double>(sites.size());
    double lightest = sites.front().weight;
    for (const Site& site : sites) lightest = std::min(lightest, site.weight);
    std::array<std::vector<std::uint32_t>, kMostClasses> members;
    std::array<int, kMostClasses> number{};
    for (std::size_t i = 0; i < sites.size(); ++i) {
      int k = 0;
      for (double step = unit; k + 1 < most_classes && sites[i].weight - lightest > step; step *= 4) ++k;
      members[static_cast<std::size_t>(k)].push_back(static_cast<std::uint32_t>(i));
      class_of_[i] = static_cast<std::uint8_t>(k);
    }
    for (std::size_t k = 0; k < kMostClasses; ++k) {
      if (members[k].empty()) continue;
      number[k] = static_cast<int>(classes_.size());
      double heaviest = sites[members[k].front()].weight;
      for (const std::uint32_t i : members[k]) heaviest = std::max(heaviest, sites[i].weight);
      classes_.push_back({heaviest, SiteBins(sites, members[k], box)});
    }
    for (std::uint8_t& k : class_of_) k = static_cast<std::uint8_t>(number[k]);
  }

  /// Calls visit(class) for a site's own class, and then for the classes in order of their distance in weight.
  template <class Visit>
  void from(std::size_t site, Visit visit) const {
    const std::ptrdiff_t own = class_of_[site];
    const std::ptrdiff_t count = std::ssize(classes_);
    visit(classes_[static_cast<std::size_t>(own)]);
    for (std::ptrdiff_t away = 1; away < count; ++away) {
      if (own + away < count) visit(classes_[static_cast<std::size_t>(own + away)]);
      if (own - away >= 0) visit(classes_[static_cast<std::size_t>(own - away)]);
    }
  }

 private:
  std::vector<WeightClass> classes_;
  std::vector<std::uint8_t> class_of_;
};

/// A cell that is being cut.
struct Clipped {
  Ring ring;
  std::vector<std::uint32_t> beyond;
  Ring ring_scratch;
  std::vector<std::uint32_t> beyond_scratch;

  void push(Point p, std::uint32_t across) {
    ring_scratch.push_back(p);
    beyond_scratch.push_back(across);
  }

  /// Keeps the part with dot(normal, x − origin) ≤ offset; `site` lies beyond the new edge.
  void clip(Point origin, Vector normal, double offset, std::uint32_t site) {
    ring_scratch.clear();
    beyond_scratch.clear();
    double before = dot(normal, ring.back() - origin) - offset;
    Point previous = ring.back();
    std::uint32_t previous_beyond = beyond.back();
    for (std::size_t k = 0; k < ring.size(); ++k) {
      const Point p = ring[k];
      const double side = dot(normal, p - origin) - offset;
      if ((side > 0) != (before > 0))
        push(previous + (before / (before - side)) * (p - previous), side > 0 ? site : previous_beyond);
      if (side <= 0) push(p, beyond[k]);
      previous = p;
      previous_beyond = beyond[k];
      before = side;
    }
    std::swap(ring, ring_scratch);
    std::swap(beyond, beyond_scratch);
    if (ring.size() < 3) {
      ring.clear();
      beyond.clear();
    }
  }

  double squared_reach(Point from) const {
    double most = 0;
    for (const Point p : ring) most = std::max(most, squared_length(p - from));
    return most;
  }
};

/// Makes the cells one after the other.
class Cutter {
 public:
  Cutter(const std::vector<Site>& sites, const Ring& region, int most_classes)
      : sites_(sites), region_(region), classes_(sites, bounding_box(region), most_classes) {}

  const Clipped& cut(std::size_t i, const NeighbourGuess& guess) {
    own_ = i;
    cell_.ring = region_;
    cell_.beyond.assign(region_.size(), kNoSite);
    reach2_ = cell_.squared_reach(sites_[i].point);
    has_guess_ = !guess.first.empty();
    if (has_guess_) {
      for (std::size_t k = guess.first[i]; k < guess.first[i + 1]; ++k) clip_by(guess.sites[k]);
    }
    classes_.from(i, [&](const WeightClass& other) { clip_by(other); });
    return cell_;
  }

 private:
  void clip_by(const WeightClass& other) {
    const Site& own = sites_[own_];
    const SiteBins& bins = other.bins;
    for (int ring = 0; ring <= bins.most_rings() && !cell_.ring.empty(); ++ring) {
      // A site at the distance d bounds the cell at (d² + w_i − w_j) / 2d. That is not within the cell's reach R unless
      // (d − R)² < R² + w_j − w_i.
      const double square = reach2_ + other.heaviest - own.weight;
      if (square < 0) return;
      if (ring > 1 && (ring - 1) * bins.side() >= std::sqrt(reach2_) + std::sqrt(square)) return;
      bins.for_ring(own.point, ring, [&](std::uint32_t j) { clip_by(j); });
    }
  }

  void clip_by(std::uint32_t j) {
    if (j == own_ || cell_.ring.empty()) return;
    const Site& own = sites_[own_];
    const Vector to = sites_[j].point - own.point;
    const double offset = 0.5 * (squared_length(to) + own.weight - sites_[j].weight);
    if (offset >= 0 && offset * offset >= squared_length(to) * reach2_) {
      if (!(to == Vector{} && offset == 0 && j < own_)) return;  // of two sites in one place, one has the cell
      cell_.clip(own.point, to, -1, j);
      return;
    }
    if (has_guess_ && std::find(cell_.beyond.begin(), cell_.beyond.end(), j) != cell_.beyond.end())
      return;  // the guess contained it
    cell_.clip(own.point, to, offset, j);
    reach2_ = cell_.squared_reach(own.point);
  }

  const std::vector<Site>& sites_;
  const Ring& region_;
  WeightClasses classes_;
  Clipped cell_;
  std::size_t own_ = 0;
  bool has_guess_ = false;
  double reach2_ = 0;
};

}  // namespace

void visit_power_cells(const std::vector<Site>& sites, const Ring& region,
                       const std::function<void(const PowerCell&)>& visit, const NeighbourGuess& guess) {
  if (sites.empty()) return;
  Cutter cutter(sites, region, kMostClasses);
  for (std::size_t i = 0; i < sites.size(); ++i) {
    const Clipped& cell = cutter.cut(i, guess);
    visit({i, cell.ring, cell.beyond});
  }
}

std::vector<Ring> power_diagram(const std::vector<Site>& sites, const Box& box) {
  std::vector<Ring> cells(sites.size());
  if (sites.empty()) return cells;
  const Ring region{box.low, {box.high.x, box.low.y}, box.high, {box.low.x, box.high.y}};
  Cutter cutter(sites, region, 1);
  for (std::size_t i = 0; i < sites.size(); ++i) cells[i] = cutter.cut(i, {}).ring;
  return cells;
}

}  // namespace polynya::geometry
