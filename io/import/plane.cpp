#include "io/import/plane.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numbers>
#include <span>

#include <fmt/format.h>

#include "elementary/elementary.hpp"
#include "geometry/exact/measures.hpp"
#include "geometry/shape/angle.hpp"
#include "io/import/gdal.hpp"
#include "io/import/projected_lines.hpp"

namespace polynya::io {
namespace {

using geometry::Box;
using geometry::Point;
using geometry::Ring;
using geometry::Vector;

[[noreturn]] void refuse(std::string words, std::optional<std::size_t> floe = {}) {
  throw PlaneError{floe, std::move(words)};
}

template <class Value>
Value or_refuse(Result<Value> found) {
  if (!found) refuse(std::move(found.error()));
  return *std::move(found);
}

/// Calls use(ring) for each ring of each floe.
template <class Use>
void for_rings(SourceFloe& floe, Use use) {
  use(floe.polygon.outer);
  for (Ring& hole : floe.polygon.holes) use(hole);
}

/// Returns the first point of a polygon for which the condition is true.
template <class Condition>
std::optional<Point> find_point(const geometry::Polygon& polygon, Condition is_it) {
  const auto find_in = [&](const Ring& ring) -> std::optional<Point> {
    const auto found = std::ranges::find_if(ring, is_it);
    return found != ring.end() ? std::optional(*found) : std::nullopt;
  };
  auto found = find_in(polygon.outer);
  for (const Ring& hole : polygon.holes)
    if (!found) found = find_in(hole);
  return found;
}

/// Returns "75.1° S, 16° E" for a longitude and latitude in degrees.
std::string place_in_degrees(Point at) {
  const double longitude = std::remainder(at.x, 360);
  return fmt::format("{:.6g}° {}, {:.6g}° {}", std::abs(at.y), at.y < 0 ? "S" : "N", std::abs(longitude),
                     longitude < 0 ? "W" : "E");
}

/// Distance between two places in degrees on a sphere with the radius of the Earth [m].
double great_circle(Point a, Point b) {
  constexpr double kEarthRadius = 6371e3;  // [m]
  const auto radians = [](double degrees) { return degrees / geometry::kDegreesPerRadian; };
  const double cosine =
      elementary::sin(radians(a.y)) * elementary::sin(radians(b.y)) +
      elementary::cos(radians(a.y)) * elementary::cos(radians(b.y)) * elementary::cos(radians(a.x) - radians(b.x));
  return kEarthRadius * elementary::acos(std::clamp(cosine, -1.0, 1.0));
}

/// Returns longitude and latitude [°].
template <class Place>
Point degrees_of(const Place& place) {
  return {geometry::kDegreesPerRadian * place.longitude, geometry::kDegreesPerRadian * place.latitude};
}

double median(std::vector<double> values) {
  const auto middle = values.begin() + std::ssize(values) / 2;
  std::ranges::nth_element(values, middle);
  return *middle;
}

/// A floe without a place in the plane, and its first point that has none.
struct MisplacedFloe {
  std::size_t floe = 0;
  Point point;
};

/// The same, with the image of the point.
struct MisplacedLinePoint : MisplacedFloe {
  MisplacedLinePoint(std::size_t number, Point at, Point to) : MisplacedFloe{number, at}, image(to) {}
  Point image;
};

/// Returns true if a ring in degrees has an edge along the meridian of longitude 180, where files divide polygons.
bool has_edge_at_180(const Ring& ring) {
  constexpr double kNear = 1e-6;  // [°]; some files cut a little beside the meridian
  const auto is_on = [](Point p) { return 180 - std::abs(std::remainder(p.x, 360)) <= kNear; };
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const Point next = ring[(i + 1) % ring.size()];
    if (is_on(ring[i]) && is_on(next) && ring[i].y != next.y) return true;
  }
  return false;
}

bool is_one_system(const std::string& a, const std::string& b) {
  const auto first = find_crs(a), second = find_crs(b);
  return first && second && !first->code.empty() && first->code == second->code;
}

/// Projects the floes of one file to the plane, step by step.
class PlaneImport {
 public:
  PlaneImport(std::vector<SourceFloe>& floes, const PlaneSettings& settings) : floes_(floes), settings_(settings) {}

  /// Does all steps. Throws PlaneError.
  PlaneReport run(const FilePlace& place) {
    if (!place.stated.wrong.empty()) refuse(place.stated.wrong);
    check_numbers();
    if (place.stated.is_stated())
      keep_or_move(place.stated);
    else if (const std::string system = system_of(place.system); !system.empty())
      project(system, !place.system.empty());
    else if (settings_.origin)
      report_.origin = settings_.origin;
    if (settings_.is_shifted) shift();
    check_distance();
    return std::move(report_);
  }

 private:
  using Others = std::optional<std::size_t>;  ///< number of further floes with the same fault

  static bool is_kept(const SourceFloe& floe) { return floe.refused.empty(); }

  /// Returns the floes not yet refused that have a point for which the condition is true, each with its first such
  /// point.
  template <class Condition>
  std::vector<MisplacedFloe> find_floes(Condition is_it) const {
    std::vector<MisplacedFloe> found;
    for (std::size_t i = 0; i < floes_.size(); ++i) {
      if (!is_kept(floes_[i])) continue;
      if (const auto point = find_point(floes_[i].polygon, is_it)) found.push_back({i, *point});
    }
    return found;
  }

  /// Refuses floes one by one, or the whole file if they are more than the fraction `share` of its floes, or all of
  /// them. words_of(floe, others) returns the message. `others` is the number of further floes if the file is refused,
  /// and has no value if only the floe is.
  template <class Misplaced, class Words>
  void refuse_floes(const std::vector<Misplaced>& misplaced, Words words_of, double share = 1) {
    if (misplaced.empty()) return;
    const auto kept = static_cast<std::size_t>(std::ranges::count_if(floes_, is_kept));
    const auto count = static_cast<double>(misplaced.size());
    if (misplaced.size() == kept || count > share * static_cast<double>(kept))
      refuse(words_of(misplaced.front(), Others(misplaced.size() - 1)), misplaced.front().floe);
    for (const Misplaced& one : misplaced) floes_[one.floe].refused = words_of(one, Others());
  }

  /// Returns the system of the coordinates; empty if they are metres of the plane already.
  std::string system_of(const std::string& crs) const {
    if (!crs.empty() && !settings_.source.empty() && crs != settings_.source && !is_one_system(crs, settings_.source))
      refuse(fmt::format("the file names its own coordinate system, {}, where {} is given", name_of_system(crs),
                         name_of_system(settings_.source)));
    if (!crs.empty() || !settings_.source.empty()) return crs.empty() ? settings_.source : crs;
    CoordinateEvidence evidence;
    for (const SourceFloe& floe : floes_) evidence.add(floe.polygon);
    const bool is_projected = settings_.origin || !settings_.target.empty();
    if (!settings_.are_metres && (evidence.look_like_degrees() || (settings_.origin && lie_about_origin()))) {
      if (is_projected) return kDegreesOnEarth;
      const Point middle = middle_of_degrees();
      refuse(fmt::format(
          "these look like longitude and latitude, and the file names no coordinate system: {} "
          "within ±180, ±90, and as metres {:.4g} m² of ice in all. {} projects them; metres "
          "are kept where a crs member names a projected system",
          evidence.are_all_whole ? "all" : "most", evidence.area, settings_.origin_in_words(middle.y, middle.x)));
    }
    if (!settings_.target.empty())
      refuse(fmt::format("the file names no coordinate system to project to {} from: {}", settings_.target,
                         settings_.source_in_words));
    if (settings_.origin && !settings_.keeps_metres && evidence.floes > 0)
      refuse(
          fmt::format("the file names no coordinate system to project from, and its coordinates do "
                      "not look like longitude and latitude: {}; metres of the plane are kept "
                      "where no origin is given",
                      settings_.source_in_words));
    return "";
  }

  /// Returns true if the floes are degrees near the origin even if the file has some wrong numbers: at least a tenth of
  /// the floes are near it and small, or the floes taken as metres would be too small to simulate.
  bool lie_about_origin() const {
    constexpr double kLeastIce = 1;  // [m²] or square degrees
    double area = 0;
    std::size_t near = 0, floes = 0;
    for (const SourceFloe& floe : floes_) {
      const Ring& ring = floe.polygon.outer;
      if (ring.empty() || !std::ranges::all_of(ring, is_finite)) continue;
      const double of_floe = std::abs(geometry::signed_area(ring));
      area += of_floe;
      ++floes;
      if (of_floe < kLeastIce && std::ranges::all_of(ring, is_in_degrees) &&
          great_circle(ring.front(), degrees_of(*settings_.origin)) < kFarthestFloe)
        ++near;
    }
    return floes > 0 && (area < kLeastIce || 10 * near >= floes);
  }

  /// Returns the middle of the floes on the sphere, longitude first, to 0.001°. Points farther than kFarthestFloe from
  /// most others are left out, since they come from wrong numbers.
  Point middle_of_degrees() const {
    std::vector<Point> points;
    std::vector<double> latitudes, longitudes;
    for (const SourceFloe& floe : floes_)
      if (is_kept(floe)) std::ranges::copy_if(floe.polygon.outer, std::back_inserter(points), is_in_degrees);
    if (points.empty()) return {};
    for (const Point p : points) {
      latitudes.push_back(p.y);
      longitudes.push_back(std::remainder(p.x - points[0].x, 360));  // works across longitude 180 too
    }
    const Point middle{median(std::move(longitudes)) + points[0].x, median(std::move(latitudes))};
    const auto is_near = [&](Point p) { return great_circle(p, middle) < kFarthestFloe; };
    const bool are_all = std::ranges::none_of(points, is_near);
    double x = 0, y = 0, z = 0;
    for (const Point p : points) {
      if (!are_all && !is_near(p)) continue;
      x += elementary::cos(p.y / geometry::kDegreesPerRadian) * elementary::cos(p.x / geometry::kDegreesPerRadian);
      y += elementary::cos(p.y / geometry::kDegreesPerRadian) * elementary::sin(p.x / geometry::kDegreesPerRadian);
      z += elementary::sin(p.y / geometry::kDegreesPerRadian);
    }
    const auto to_thousandths = [](double value) { return std::round(1000 * value) / 1000; };
    return {to_thousandths(geometry::kDegreesPerRadian * elementary::atan2(y, x)),
            to_thousandths(geometry::kDegreesPerRadian * elementary::atan2(z, elementary::hypot(x, y)))};
  }

  void project(const std::string& system, bool is_of_file) {
    const auto crs = find_crs(system);
    if (!crs) refuse(crs.error() + (is_of_file ? "; a file of metres in a plane of its own has no crs" : ""));
    report_.system = crs->name;
    if (crs->is_geographic)
      check_degrees();
    else if (!crs->is_projected)
      refuse(fmt::format("{} is neither longitude and latitude nor a plane", crs->name));
    const CoordinateFrame from{.system = system, .is_in_degrees = crs->is_geographic, .is_metric = crs->is_metric};
    if (settings_.marks_180) mark_180(from);
    if (!settings_.target.empty()) return project_to_target(from);
    std::optional<simulation::GeographicOrigin> origin = settings_.origin;
    if (!origin && crs->is_geographic) {
      const Point middle = middle_of_degrees();
      if (!settings_.chooses_origin)
        refuse(fmt::format("longitude and latitude ({}), and no origin to project them about: {}", crs->name,
                           settings_.origin_in_words(middle.y, middle.x)));
      origin = {middle.y * geometry::kRadiansPerDegree, middle.x * geometry::kRadiansPerDegree, std::numbers::pi / 2};
      report_.is_origin_chosen = true;
    }
    if (origin) return project_about(*origin, from);
    if (!crs->is_metric)
      refuse(fmt::format("{} is not in metres: an origin, or a projected system in metres, is needed", crs->name));
    const bool is_wkt = system.find('[') != std::string::npos;
    report_.target = is_wkt && !crs->code.empty() ? crs->code : system;
  }

  /// Marks floes that may have been divided at longitude 180.
  void mark_180(const CoordinateFrame& from) {
    std::vector<Point> points;
    for (const SourceFloe& floe : floes_)
      points.insert(points.end(), floe.polygon.outer.begin(), floe.polygon.outer.end());
    if (!from.is_in_degrees) points = or_refuse(io::project(points, from, in_degrees()));
    auto next = points.begin();
    for (SourceFloe& floe : floes_) {
      const auto end = next + std::ssize(floe.polygon.outer);
      floe.is_at_180 = has_edge_at_180({next, end});
      next = end;
    }
  }

  /// Treats the floes of a file of Polynya that states its plane: keeps the plane, or moves the floes to the one asked
  /// for.
  void keep_or_move(const StatedPlace& stated) {
    if (!settings_.source.empty())
      refuse(fmt::format("the file states its own place, {}, where {} is given", in_words(stated), settings_.source));
    CoordinateFrame from;
    if (stated.origin)
      from = frame_about(*stated.origin);
    else
      from = {.system = stated.shifted_crs, .is_metric = true};
    from.shift = stated.shift;
    if (!settings_.target.empty()) return project_to_target(from);
    if (settings_.origin) {
      report_.system = in_words(stated);
      if (!stated.origin || !are_one(*settings_.origin, *stated.origin)) return project_about(*settings_.origin, from);
      report_.origin = settings_.origin;
      if (stated.shift != Vector{}) move_all(-stated.shift);
      return;
    }
    report_.origin = stated.origin;
    report_.target = stated.shifted_crs;
    report_.shift = stated.shift;
  }

  static std::string in_words(const StatedPlace& stated) {
    PlaneReport plane;
    plane.origin = stated.origin;
    plane.target = stated.shifted_crs;
    plane.shift = stated.shift;
    return place_in_words(plane);
  }

  void check_numbers() {
    const auto is_none = [](Point p) { return !is_finite(p); };
    refuse_floes(find_floes(is_none), [](const MisplacedFloe& one, Others) {
      return fmt::format("found [{}, {}], allowed: coordinates that are finite numbers", one.point.x, one.point.y);
    });
  }

  void check_degrees() {
    const auto is_beyond = [](Point p) { return !is_in_degrees(p); };
    refuse_floes(find_floes(is_beyond), [](const MisplacedFloe& one, Others others) {
      const Point p = one.point;
      if (std::abs(p.y) <= 90)
        return fmt::format(
            "found [{}, {}], allowed: [longitude, latitude], a longitude from -180 to 180, or "
            "one turn more or less",
            p.x, p.y);
      const bool is_swapped = others && std::abs(p.x) <= 90 && std::abs(p.y) <= 180;
      return fmt::format("found [{}, {}], allowed: [longitude, latitude], a latitude from -90 to 90{}", p.x, p.y,
                         is_swapped ? "; here latitude seems to come first" : "");
    });
  }

  void project_to_target(const CoordinateFrame& from) {
    const Crs target = or_refuse(find_crs(settings_.target));
    if (!target.is_metric) refuse(fmt::format("{} ({}) is not a plane in metres", settings_.target, target.name));
    report_.target = settings_.target;
    const CoordinateFrame to{.system = settings_.target, .is_metric = true};
    std::vector<ProjectedLine> lines = lines_of(from, to);
    finish(lines, from, to);
  }

  void project_about(const simulation::GeographicOrigin& origin, const CoordinateFrame& from) {
    report_.origin = origin;
    const CoordinateFrame to = frame_about(origin);
    std::vector<ProjectedLine> lines = lines_of(from, to);
    check_hemisphere(lines, from, to);
    finish(lines, from, to);
  }

  /// Returns the rings of all floes that are kept, in order, with the images of their vertices. Refuses floes without
  /// an image.
  std::vector<ProjectedLine> lines_of(const CoordinateFrame& from, const CoordinateFrame& to) {
    turn_velocities(from, to);
    std::vector<ProjectedLine> lines;
    for (SourceFloe& floe : floes_)
      if (is_kept(floe)) for_rings(floe, [&](Ring& ring) { lines.push_back(line_in(from, ring, true)); });
    if (auto projected = project_vertices(lines, from, to); !projected) refuse(projected.error());
    refuse_lines(
        lines, [](Point, Point image) { return !is_finite(image); },
        [](const MisplacedLinePoint& one, Others) {
          return fmt::format("[{}, {}] has no image in that plane", one.point.x, one.point.y);
        });
    return lines;
  }

  /// Adds points to edges whose images bend, and replaces the polygons of floes by their images.
  void finish(std::vector<ProjectedLine>& lines, const CoordinateFrame& from, const CoordinateFrame& to) {
    const auto count_points = [&] {
      std::size_t count = 0;
      for (const ProjectedLine& line : lines) count += line.to.size();
      return count;
    };
    const std::size_t before = count_points();
    if (auto added = add_points(lines, from, to, settings_.tolerance); !added) refuse(added.error());
    report_.added_points = count_points() - before;
    auto next = lines.begin();
    for (SourceFloe& floe : floes_)
      if (is_kept(floe)) for_rings(floe, [&](Ring& ring) { ring = image_of(*next++); });
  }

  /// Turns velocities by the angle through which the axes turn at the first vertex of the floe.
  void turn_velocities(const CoordinateFrame& from, const CoordinateFrame& to) {
    std::vector<Point> points;
    const auto moves = [](const SourceFloe& floe) {
      const FloeProperties& p = floe.properties;
      return is_kept(floe) && (p.velocity_x || p.velocity_y) && !floe.polygon.outer.empty();
    };
    for (const SourceFloe& floe : floes_) {
      if (!moves(floe)) continue;
      const Point at = floe.polygon.outer.front();
      const double step =
          from.is_in_degrees ? 1e-4 : 10;  // Some metres: PROJ treats points less than a millimetre apart as one.
      // The second step points towards the equator, because there is nothing beyond a pole.
      const double step_y = from.is_in_degrees && at.y > 0 ? -step : step;
      for (const Point p : {at, Point{at.x + step, at.y}, Point{at.x, at.y + step_y}}) points.push_back(p);
    }
    const std::vector<Point> images = or_refuse(io::project(points, from, to));
    auto next = images.begin();
    for (SourceFloe& floe : floes_) {
      if (!moves(floe)) continue;
      FloeProperties& p = floe.properties;
      Vector first = next[1] - next[0], second = next[2] - next[0];
      if (from.is_in_degrees && floe.polygon.outer.front().y > 0) second = -second;
      next += 3;
      const Vector v =
          (p.velocity_x.value_or(0) / length(first)) * first + (p.velocity_y.value_or(0) / length(second)) * second;
      p.velocity_x = v.x;
      p.velocity_y = v.y;
    }
  }

  /// Refuses floes that have a vertex for which is_it(point in the file, image) is true, and leaves out their lines.
  template <class Condition, class Words>
  void refuse_lines(std::vector<ProjectedLine>& lines, Condition is_it, Words words_of) {
    std::vector<MisplacedLinePoint> found;
    std::vector<std::size_t> floe_of;
    for (std::size_t i = 0; i < floes_.size(); ++i)
      if (is_kept(floes_[i])) floe_of.insert(floe_of.end(), 1 + floes_[i].polygon.holes.size(), i);
    for (std::size_t k = 0; k < lines.size(); ++k) {
      if (!found.empty() && found.back().floe == floe_of[k]) continue;
      for (std::size_t v = 0; v < lines[k].to.size(); ++v) {
        if (!is_it(lines[k].from[v], lines[k].to[v])) continue;
        found.push_back({floe_of[k], lines[k].from[v], lines[k].to[v]});
        break;
      }
    }
    refuse_floes(found, words_of);
    std::size_t k = 0;
    std::erase_if(lines, [&](const ProjectedLine&) { return !is_kept(floes_[floe_of[k++]]); });
  }

  /// Refuses floes beyond kFarthestFloe from the origin. The message says where they are on the Earth.
  void check_hemisphere(std::vector<ProjectedLine>& lines, const CoordinateFrame& from, const CoordinateFrame& to) {
    const auto is_far = [](Point, Point image) { return length(image - Point{}) > kFarthestFloe; };
    refuse_lines(lines, is_far, [&](const MisplacedLinePoint& one, Others others) {
      const Point origin = degrees_of(*report_.origin);
      const Point at = from.is_in_degrees ? one.point : or_refuse(io::project({one.point}, from, in_degrees())).front();
      std::string words = fmt::format("{} lies {:.0f} km from the origin at {}{}{}, allowed: up to {:g} km",
                                      place_in_degrees(at), length(one.image - Point{}) / 1000,
                                      place_in_degrees(origin), at.y * origin.y < 0 ? ", in the other hemisphere" : "",
                                      more_in_words(others), kFarthestFloe / 1000);
      const std::span<const SourceFloe> all(floes_);
      if (from.is_in_degrees && are_swapped(to, others ? all : all.subspan(one.floe, 1)))
        return words + ". With latitude and longitude exchanged it lies near it: GeoJSON has [longitude, latitude]";
      if (others) words += ": " + settings_.origin_in_words(at.y, std::remainder(at.x, 360));
      return words;
    });
  }

  /// Returns true if the coordinates lie near the origin when they are read as latitude first.
  static bool are_swapped(const CoordinateFrame& to, std::span<const SourceFloe> floes) {
    std::vector<Point> exchanged;
    for (const SourceFloe& floe : floes) {
      if (!is_kept(floe)) continue;
      for (const Point p : floe.polygon.outer)
        if (is_finite(p)) exchanged.push_back({p.y, p.x});
    }
    if (exchanged.empty()) return false;
    const auto images = or_refuse(io::project(exchanged, in_degrees(), to));
    return std::ranges::all_of(images, [](Point p) { return length(p - Point{}) <= kFarthestFloe; });
  }

  /// Shifts the floes. Floes far from most others, which come from wrong numbers, do not count for the middle.
  void shift() {
    std::vector<double> xs, ys;
    std::vector<Point> points;
    for (const SourceFloe& floe : floes_)
      if (is_kept(floe)) std::ranges::copy(floe.polygon.outer, std::back_inserter(points));
    if (points.empty()) return;
    for (const Point p : points) {
      xs.push_back(p.x);
      ys.push_back(p.y);
    }
    const Point centre{median(std::move(xs)), median(std::move(ys))};
    Box box{centre, centre};
    for (const Point p : points)
      if (length(p - centre) <= 2 * kFarthestFloe) extend(box, {p, p});
    const Point middle = midpoint(box.low, box.high);
    const Vector by{-std::round(middle.x), -std::round(middle.y)};
    report_.shift += by;
    move_all(by);
  }

  void move_all(Vector by) {
    for (SourceFloe& floe : floes_) {
      for_rings(floe, [&](Ring& ring) {
        for (Point& p : ring) p += by;
      });
    }
  }

  void check_distance() {
    const auto far = find_floes([](Point p) { return std::max(std::abs(p.x), std::abs(p.y)) > kFarthestFloe; });
    const auto words_of = [&](const MisplacedFloe& one, Others others) {
      return fmt::format("found [{:.12g}, {:.12g}]{}, allowed: coordinates from {:g} to {:g} [m]: {}", one.point.x,
                         one.point.y, more_in_words(others), -kFarthestFloe, kFarthestFloe, settings_.shift_in_words);
    };
    refuse_floes(far, words_of, 0.5);  // If most floes are too far, the whole file needs a shift.
  }

  /// Returns ", and as far in 3 more floes".
  static std::string more_in_words(Others count) {
    if (count.value_or(0) == 0) return "";
    return fmt::format(", and as far in {} more floe{}", *count, *count == 1 ? "" : "s");
  }

  std::vector<SourceFloe>& floes_;
  const PlaneSettings& settings_;
  PlaneReport report_;
};

}  // namespace

tl::expected<PlaneReport, PlaneError> bring_to_plane(std::vector<SourceFloe>& floes, const FilePlace& place,
                                                     const PlaneSettings& settings) {
  try {
    return PlaneImport(floes, settings).run(place);
  } catch (PlaneError& error) {
    return tl::unexpected(std::move(error));
  }
}

bool are_one(const simulation::GeographicOrigin& a, const simulation::GeographicOrigin& b) {
  constexpr double kSame = 1e-12;  // [rad]; 6 micrometres on the Earth
  const auto are_near = [](double first, double second) {
    return std::abs(std::remainder(first - second, 2 * std::numbers::pi)) <= kSame;
  };
  return are_near(a.latitude, b.latitude) && are_near(a.longitude, b.longitude) && are_near(a.heading, b.heading);
}

std::string place_in_words(const PlaneReport& plane) {
  std::string words;
  if (plane.origin)
    words = fmt::format("the plane about {}, x along {:.9g}°", place_in_degrees(degrees_of(*plane.origin)),
                        degrees_in_file(plane.origin->heading));
  else if (!plane.target.empty())
    words = "the plane of " + plane.target;
  if (!words.empty() && plane.shift != Vector{})
    words += fmt::format(", shifted by ({:.12g}, {:.12g}) m", plane.shift.x, plane.shift.y);
  return words;
}

}  // namespace polynya::io
