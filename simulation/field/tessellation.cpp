#include "simulation/field/tessellation.hpp"

#include <algorithm>
#include <numbers>
#include <span>

#include "geometry/cut/cut.hpp"
#include "geometry/exact/measures.hpp"
#include "geometry/exact/predicates.hpp"
#include "geometry/shape/power_diagram.hpp"
#include "simulation/field/convex.hpp"

namespace polynya::simulation {
namespace {

using geometry::Box;
using geometry::Point;
using geometry::Polygon;
using geometry::PowerCell;
using geometry::Ring;
using geometry::Site;
using geometry::Vector;

// ---- the free area

/// Returns true if a ring has no concave corner.
bool is_convex(const Ring& ring) {
  const std::size_t n = ring.size();
  for (std::size_t i = 0; i < n; ++i) {
    if (cross(ring[(i + 1) % n] - ring[i], ring[(i + 2) % n] - ring[(i + 1) % n]) < 0) return false;
  }
  return true;
}

/// Returns true if a segment runs through a convex ring at a depth of more than `depth` [m] below its edges.
bool runs_through(Point from, Point to, const Ring& ring, double depth) {
  double enter = 0;
  double leave = 1;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const Vector edge = ring[(i + 1) % ring.size()] - ring[i];
    const double margin = depth * length(edge);
    const double at_from = cross(edge, from - ring[i]) - margin;
    const double at_to = cross(edge, to - ring[i]) - margin;
    if (at_from <= 0 && at_to <= 0) return false;
    if (at_from < 0) enter = std::max(enter, at_from / (at_from - at_to));
    if (at_to < 0) leave = std::min(leave, at_from / (at_from - at_to));
    if (enter >= leave) return false;
  }
  return true;
}

}  // namespace

FreeArea::FreeArea(const Ring& region, const std::vector<Polygon>& kept_clear, double gap, const Plane& plane) {
  hull_ = plane.from_world(region);
  if (!is_convex(region)) {
    region_ = hull_;
    const Box box = bounding_box(region_);
    hull_ = {box.low, {box.high.x, box.low.y}, box.high, {box.low.x, box.high.y}};
    add_edges(region, true, 0, plane);
  }
  // Cleared areas that lie farther from the hull than their edges are moved are left out. A distance in the world is at
  // most √stretch times as long in the plane, so the reach is ample.
  for (const Polygon& polygon : kept_clear) {
    const Ring ring = plane.from_world(polygon.outer);
    const Box reach = grown(bounding_box(ring), 2 * gap * plane.stretch);
    if (!overlaps(reach, bounding_box(hull_))) continue;
    clear_.push_back(ring);
    clear_boxes_.push_back(bounding_box(ring));
    add_edges(polygon.outer, false, 0.5 * gap, plane);
  }
  tree_ = geometry::BoxTree(edges_);
}

/// Adds the edges of a ring, moved to their free side by a margin and extended at both ends by it [m].
void FreeArea::add_edges(const Ring& in_world, bool is_free_inside, double margin, const Plane& plane) {
  for_ring_edges(in_world, [&](Point from, Point to) {
    if (!is_free_inside) std::swap(from, to);
    const Vector along = (to - from) / distance(from, to);
    from += margin * (perpendicular(along) - along);
    to += margin * (perpendicular(along) + along);
    edges_.push_back({plane.from_world(from), plane.from_world(to)});
  });
}

bool FreeArea::holds(Point p) const {
  if (!region_.empty() && side_of_ring(region_, p) < 0) return false;
  for (std::size_t i = 0; i < clear_.size(); ++i) {
    if (contains(clear_boxes_[i], {p, p}) && side_of_ring(clear_[i], p) > 0) return false;
  }
  return true;
}

bool FreeArea::clip(Ring& ring) const {
  if (edges_.empty() || ring.empty()) return false;
  const Box box = bounding_box(ring);
  std::vector<std::size_t> near;
  tree_.for_each_near(box, [&](std::size_t i) {
    near.push_back(i);
    return true;
  });
  // Depth that edges must reach, so that a ring that was clipped along an edge is not clipped along it again [m].
  const double depth = 1e-7 * distance(box.low, box.high);
  bool was_met = false;
  while (!ring.empty()) {
    Ring best;
    double most = -1;
    for (const std::size_t i : near) {
      const Point from = edges_[i].a;
      const Point to = edges_[i].b;
      if (!runs_through(from, to, ring, depth)) continue;
      Ring left = ring;
      clip_to_left(left, from, to);
      const double area = left.empty() ? 0 : measure_convex(left).area;
      if (area > most) {
        most = area;
        best = std::move(left);
      }
    }
    if (most < 0) break;
    was_met = true;
    ring = std::move(best);
  }
  if (!ring.empty() && !holds(measure_convex(ring).centroid)) ring.clear();
  return was_met;
}

double free_area(const Ring& region, const std::vector<Polygon>& kept_clear) {
  std::vector<geometry::Shape> pieces{{{region, {}}}};
  for (const Polygon& clear : kept_clear) {
    std::vector<geometry::Shape> left;
    for (geometry::Shape& piece : pieces) {
      auto cut = geometry::cut_by_polygon(piece, clear);
      if (!cut) {
        left.push_back(std::move(piece));  // the piece does not meet the clearing
        continue;
      }
      for (geometry::Piece& part : cut->pieces) {
        if (part.part == geometry::Part::kOutside) left.push_back(std::move(part.shape));
      }
    }
    pieces = std::move(left);
  }
  double area = 0;
  for (const geometry::Shape& piece : pieces) area += geometry::measure(piece.polygon).area;
  return area;
}

// ---- the cells of the free area

namespace {

// Each of these constants determines all fields with a size law, to the bit. If one is changed, goldens and pinned
// hashes must be renewed.
/// Number of random points per site [-]. Fewer: sites may start in places that belong to other floes.
constexpr double kPointsPerSite = 4;
/// Number of passes in which sites move to the centroids of their cells. Fewer leave slender cells.
constexpr int kMoves = 11;
/// Number of passes after them in which only weights change. Fewer leave errors of the areas above 1 %.
constexpr int kSettles = 5;
/// Largest number of further such passes while sites are without a cell. Fewer lose floes.
constexpr int kMostExtras = 6;
/// Number of conjugate-gradient iterations in each of these passes. Fewer leave errors of the areas above 1 %.
constexpr int kIterations = 12;

/// Returns at least `count` points in the free area: one at random in each cell of a grid. Returns fewer if a grid of
/// 1e9 cells over the bounding box would not be fine enough.
std::vector<Point> scatter_points(const FreeArea& free, double count, Random& random) {
  const Box box = bounding_box(free.hull());
  const Vector extent = box.high - box.low;
  std::vector<Point> points;
  // The grid is refined until there are enough points, because the free area may be a small part of the box.
  for (double wanted = count; static_cast<double>(points.size()) < count && wanted < 1e9; wanted *= 2) {
    points.clear();
    const double side = std::sqrt(extent.x * extent.y / wanted);
    const auto columns = static_cast<std::size_t>(std::ceil(extent.x / side));
    const auto rows = static_cast<std::size_t>(std::ceil(extent.y / side));
    for (std::size_t row = 0; row < rows; ++row) {
      for (std::size_t column = 0; column < columns; ++column) {
        const double x = (static_cast<double>(column) + random.uniform()) / static_cast<double>(columns);
        const double y = (static_cast<double>(row) + random.uniform()) / static_cast<double>(rows);
        const Point p = box.low + Vector{x * extent.x, y * extent.y};
        if (side_of_ring(free.hull(), p) >= 0 && free.holds(p)) points.push_back(p);
      }
    }
  }
  return points;
}

/// Distributes points among sites in proportion to their areas, and places each site in the middle of its points.
class PointDistributor {
 public:
  PointDistributor(const std::vector<double>& areas, std::vector<Point> points)
      : points_(std::move(points)), sum_before_(areas.size() + 1, 0), sites_(areas.size()) {
    for (std::size_t i = 0; i < areas.size(); ++i) sum_before_[i + 1] = sum_before_[i] + areas[i];
  }

  std::vector<Site> distribute() {
    if (points_.size() >= sites_.size()) distribute(0, sites_.size(), points_);
    return std::move(sites_);
  }

 private:
  void distribute(std::size_t first, std::size_t end, std::span<Point> points) {
    Box box{points.front(), points.front()};
    for (const Point p : points) extend(box, p);
    if (end - first == 1) {
      sites_[first].point = midpoint(box.low, box.high);
      return;
    }
    const double half = 0.5 * (sum_before_[first] + sum_before_[end]);
    const auto found = std::lower_bound(sum_before_.begin() + static_cast<std::ptrdiff_t>(first) + 1,
                                        sum_before_.begin() + static_cast<std::ptrdiff_t>(end) - 1, half);
    auto middle = static_cast<std::size_t>(found - sum_before_.begin());
    if (middle > first + 1 && half - sum_before_[middle - 1] < sum_before_[middle] - half) --middle;
    const double share = (sum_before_[middle] - sum_before_[first]) / (sum_before_[end] - sum_before_[first]);
    const auto left = std::clamp(static_cast<std::size_t>(std::round(share * static_cast<double>(points.size()))),
                                 middle - first, points.size() - (end - middle));
    const bool is_wide = box.high.x - box.low.x > box.high.y - box.low.y;
    std::nth_element(points.begin(), points.begin() + static_cast<std::ptrdiff_t>(left), points.end(),
                     [is_wide](Point a, Point b) {
                       if (is_wide) return a.x < b.x || (a.x == b.x && a.y < b.y);
                       return a.y < b.y || (a.y == b.y && a.x < b.x);
                     });
    distribute(first, middle, points.first(left));
    distribute(middle, end, points.subspan(left));
  }

  std::vector<Point> points_;
  std::vector<double> sum_before_;
  std::vector<Site> sites_;
};

/// Derivatives of the areas of a power diagram's cells with respect to the weights of their sites. If the weight of a
/// cell is raised above that of a neighbour, the cell gains l / 2d of area per unit of weight from it, where l is the
/// length of their common edge and d the distance of their sites.
class CellCouplings {
 public:
  void begin(std::size_t cells);
  /// Starts the next cell. Cells are added in their order, each followed by its neighbours; end() is called last.
  void begin_cell();
  void add(std::uint32_t neighbour, double gain);
  void end() { neighbours_.first.push_back(gains_.size()); }
  const geometry::NeighbourGuess& neighbours() const { return neighbours_; }

  /// Returns Σ l / 2d of a cell.
  double growth(std::size_t cell) const { return growth_[cell]; }

  /// Returns changes of all weights that cause given changes of the areas [m²], to first order. They are found by a
  /// number of iterations of the conjugate gradient method, which keeps them small even if the changes of the areas do
  /// not add up to 0.
  std::vector<double> solve(const std::vector<double>& changes, int iterations) const;

 private:
  void multiply(const std::vector<double>& weights, std::vector<double>& areas) const;
  double diagonal(std::size_t cell) const;

  geometry::NeighbourGuess neighbours_;
  std::vector<double> gains_;  ///< l / 2d for each of the neighbours
  std::vector<double> growth_;
};

double dot_product(const std::vector<double>& a, const std::vector<double>& b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += a[i] * b[i];
  return sum;
}

void CellCouplings::begin(std::size_t cells) {
  neighbours_.first.clear();
  neighbours_.sites.clear();
  gains_.clear();
  growth_.clear();
  neighbours_.first.reserve(cells + 1);
  growth_.reserve(cells);
}

void CellCouplings::begin_cell() {
  neighbours_.first.push_back(gains_.size());
  growth_.push_back(0);
}

void CellCouplings::add(std::uint32_t neighbour, double gain) {
  neighbours_.sites.push_back(neighbour);
  gains_.push_back(gain);
  growth_.back() += gain;
}

/// Returns the diagonal element of a cell. The smallest value 0.1 belongs to cells without neighbours, whose weights
/// hardly change. The factor 1.01 keeps the matrix from being singular.
double CellCouplings::diagonal(std::size_t cell) const {
  return 1.01 * std::max(growth_[cell], 0.1);
}

void CellCouplings::multiply(const std::vector<double>& weights, std::vector<double>& areas) const {
  const auto& [first, sites] = neighbours_;
  for (std::size_t i = 0; i < weights.size(); ++i) {
    double sum = diagonal(i) * weights[i];
    for (std::size_t k = first[i]; k < first[i + 1]; ++k) sum -= gains_[k] * weights[sites[k]];
    areas[i] = sum;
  }
}

std::vector<double> CellCouplings::solve(const std::vector<double>& changes, int iterations) const {
  const std::size_t count = changes.size();
  std::vector<double> solution(count, 0);
  std::vector<double> residual = changes;
  std::vector<double> scaled(count);
  std::vector<double> product(count);
  for (std::size_t i = 0; i < count; ++i) scaled[i] = residual[i] / diagonal(i);
  std::vector<double> direction = scaled;
  double descent = dot_product(residual, scaled);
  for (int iteration = 0; iteration < iterations && descent > 0; ++iteration) {
    multiply(direction, product);
    const double curvature = dot_product(direction, product);
    if (!(curvature > 0)) break;
    const double step = descent / curvature;
    for (std::size_t i = 0; i < count; ++i) {
      solution[i] += step * direction[i];
      residual[i] -= step * product[i];
      scaled[i] = residual[i] / diagonal(i);
    }
    const double next = dot_product(residual, scaled);
    const double turn = next / descent;
    descent = next;
    for (std::size_t i = 0; i < count; ++i) direction[i] = scaled[i] + turn * direction[i];
  }
  return solution;
}

/// Measures of a cell in a pass.
struct Found {
  double area = 0;
  Point centroid;
  Point farthest;  ///< corner of the cell that is farthest from its site
};

class Relaxation {
 public:
  Relaxation(const FreeArea& free, const std::vector<double>& areas, std::vector<Site> sites)
      : free_(free), areas_(areas), sites_(std::move(sites)), found_(sites_.size()) {
    for (const double area : areas) sum_ += area;
    share_ = measure_convex(free.hull()).area / sum_;
    for (std::size_t i = 0; i < sites_.size(); ++i) sites_[i].weight = share_ * areas[i] / std::numbers::pi;
  }

  std::vector<FieldCell> relax() {
    for (int pass = 0; pass < kMoves; ++pass) {
      measure();
      move();
      move_lost_sites();
    }
    bool is_whole = false;
    for (int pass = 0; pass < kSettles + (is_whole ? 0 : kMostExtras); ++pass) {
      measure();
      balance(std::min(1.0, 0.2 * (pass + 2)));  // 0.4 of Newton's step at first, all of it from the fourth pass
      is_whole = !move_lost_sites();
    }
    std::vector<FieldCell> cells(sites_.size());
    const auto keep = [&](const PowerCell& cell) {
      FieldCell& kept = cells[cell.site];
      kept.ring = cell.ring;
      kept.is_clipped = free_.clip(kept.ring);
    };
    geometry::visit_power_cells(sites_, free_.hull(), keep, couplings_.neighbours());
    return cells;
  }

 private:
  void measure() {
    std::swap(couplings_, before_);
    couplings_.begin(sites_.size());
    geometry::visit_power_cells(
        sites_, free_.hull(), [this](const PowerCell& cell) { measure(cell); }, before_.neighbours());
    couplings_.end();
    double sum = 0;
    for (const Found& found : found_) sum += found.area;
    share_ = sum / sum_;
  }

  void measure(const PowerCell& cell) {
    Found& found = found_[cell.site];
    found = {};
    couplings_.begin_cell();
    if (cell.ring.empty()) return;
    const Point own = sites_[cell.site].point;
    double most = -1;
    for (std::size_t k = 0; k < cell.ring.size(); ++k) {
      const Point corner = cell.ring[k];
      if (const double away = squared_length(corner - own); away > most) {
        most = away;
        found.farthest = corner;
      }
      if (cell.beyond[k] == geometry::kNoSite) continue;
      const double across = distance(sites_[cell.beyond[k]].point, own);
      const Point next = cell.ring[k + 1 < cell.ring.size() ? k + 1 : 0];
      if (across > 0) couplings_.add(cell.beyond[k], distance(corner, next) / (2 * across));
    }
    CellMeasures measures;
    if (free_.is_hull()) {
      measures = measure_convex(cell.ring);
    } else {
      Ring ring = cell.ring;
      free_.clip(ring);
      if (!ring.empty()) measures = measure_convex(ring);
    }
    found.area = measures.area;
    found.centroid = measures.centroid;
  }

  /// Returns the area that a cell lacks; a cell that is too large loses at most 70 % of its area at once [m²].
  double missing_area(std::size_t i) const {
    return std::max(share_ * areas_[i] - found_[i].area, -0.7 * found_[i].area);
  }

  /// Moves the sites to the centroids of their cells, and changes each weight by the error of its own cell alone. This
  /// is stable far from the solution. The growth of a cell per unit of weight counts as at least 0.5, so that the
  /// weights of cells with short common edges do not jump.
  void move() {
    // Factor on the change of a weight [-]; above 1, the weights of neighbours overshoot in turn, and cells vanish.
    constexpr double kDamping = 0.6;
    for (std::size_t i = 0; i < sites_.size(); ++i) {
      if (!(found_[i].area > 0)) continue;
      sites_[i].weight += kDamping * missing_area(i) / std::max(couplings_.growth(i), 0.5);
      sites_[i].point = found_[i].centroid;
    }
  }

  /// Changes all weights together, by a fraction of Newton's step.
  void balance(double part) {
    std::vector<double> missing(sites_.size(), 0);
    for (std::size_t i = 0; i < sites_.size(); ++i) {
      if (found_[i].area > 0) missing[i] = missing_area(i);
    }
    const std::vector<double> changes = couplings_.solve(missing, kIterations);
    for (std::size_t i = 0; i < sites_.size(); ++i) {
      if (found_[i].area > 0) sites_[i].weight += part * changes[i];
    }
  }

  /// Moves sites without a cell to the farthest corners of cells that are too large. The weight makes a site's power at
  /// that corner smaller than its host's by half of the squared radius of a disc with its area, so that it gets a cell
  /// there. Returns false if all sites have cells.
  bool move_lost_sites() {
    std::vector<std::size_t> lost;
    for (std::size_t i = 0; i < sites_.size(); ++i) {
      if (!(found_[i].area > 0)) lost.push_back(i);
    }
    if (lost.empty()) return false;
    std::vector<std::size_t> hosts;
    for (std::size_t i = 0; i < sites_.size(); ++i) {
      if (found_[i].area > 0) hosts.push_back(i);
    }
    const std::size_t count = std::min(lost.size(), hosts.size());
    const auto surplus = [&](std::size_t i) { return found_[i].area - share_ * areas_[i]; };
    std::partial_sort(
        hosts.begin(), hosts.begin() + static_cast<std::ptrdiff_t>(count), hosts.end(),
        [&](std::size_t a, std::size_t b) { return surplus(a) > surplus(b) || (surplus(a) == surplus(b) && a < b); });
    for (std::size_t k = 0; k < count; ++k) {
      const Site& host = sites_[hosts[k]];
      const Point place = found_[hosts[k]].farthest;
      const double power = squared_length(place - host.point) - host.weight;
      sites_[lost[k]] = {place, 0.5 * share_ * areas_[lost[k]] / std::numbers::pi - power};
    }
    return true;
  }

  const FreeArea& free_;
  const std::vector<double>& areas_;
  double sum_ = 0;    ///< sum of the areas asked for [m²]
  double share_ = 1;  ///< area of all cells / sum of the areas asked for [-]
  std::vector<Site> sites_;
  std::vector<Found> found_;
  CellCouplings couplings_;
  CellCouplings before_;  ///< couplings of the previous pass
};

}  // namespace

std::vector<FieldCell> tessellate(const FreeArea& free, const std::vector<double>& areas, Random& random) {
  const auto count = static_cast<double>(areas.size());
  PointDistributor distributor(areas, scatter_points(free, kPointsPerSite * count, random));
  return Relaxation(free, areas, distributor.distribute()).relax();
}

}  // namespace polynya::simulation
