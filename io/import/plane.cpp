#include "io/import/plane.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <numbers>
#include <span>

#include <dlfcn.h>
#include <fmt/format.h>
#include <proj.h>

#include "geometry/exact/measures.hpp"
#include "geometry/shape/angle.hpp"
#include "io/text/floe_text.hpp"

namespace polynya::io {
namespace {

using geometry::Box;
using geometry::Point;
using geometry::Ring;
using geometry::Vector;

constexpr const char* kDegreesByProj = "+proj=longlat +datum=WGS84 +no_defs +type=crs";

/// PROJ, loaded when it is first asked: it brings 37 libraries along, which each command would wait for and
/// carry otherwise. POLYNYA_PROJ is the name of the one that this was built with.
class Proj {
 public:
  void* const library = dlopen(POLYNYA_PROJ, RTLD_NOW | RTLD_LOCAL | RTLD_NODELETE);

#define POLYNYA_OF_PROJ(name) decltype(&::name) const name = find<decltype(&::name)>(#name)
  POLYNYA_OF_PROJ(proj_context_create);
  POLYNYA_OF_PROJ(proj_context_destroy);
  POLYNYA_OF_PROJ(proj_context_set_enable_network);
  POLYNYA_OF_PROJ(proj_log_level);
  POLYNYA_OF_PROJ(proj_create);
  POLYNYA_OF_PROJ(proj_create_crs_to_crs);
  POLYNYA_OF_PROJ(proj_normalize_for_visualization);
  POLYNYA_OF_PROJ(proj_destroy);
  POLYNYA_OF_PROJ(proj_is_crs);
  POLYNYA_OF_PROJ(proj_get_name);
  POLYNYA_OF_PROJ(proj_get_type);
  POLYNYA_OF_PROJ(proj_get_source_crs);
  POLYNYA_OF_PROJ(proj_crs_get_sub_crs);
  POLYNYA_OF_PROJ(proj_crs_get_coordinate_system);
  POLYNYA_OF_PROJ(proj_cs_get_axis_info);
  POLYNYA_OF_PROJ(proj_trans);
#undef POLYNYA_OF_PROJ

 private:
  template <class Function>
  Function find(const char* name) const {
    return library != nullptr ? reinterpret_cast<Function>(dlsym(library, name)) : nullptr;
  }
};

const Proj& proj() {
  static const Proj loaded;
  return loaded;
}

bool has_proj() {
  return proj().library != nullptr;
}
constexpr const char* kNoProj = POLYNYA_PROJ " cannot be loaded: ./setup.sh, or apt-get install libproj25";

/// A context that reads PROJ's own files alone, and prints nothing.
pj_ctx* quiet_context() {
  pj_ctx* const context = proj().proj_context_create();
  proj().proj_log_level(context, PJ_LOG_NONE);
  proj().proj_context_set_enable_network(context, 0);
  return context;
}

/// Whether a system's first axis is in metres.
bool is_metric(pj_ctx* context, const PJ* crs) {
  PJ* const axes = proj().proj_crs_get_coordinate_system(context, crs);
  double metres = 0;
  const bool has_axis = axes != nullptr && proj().proj_cs_get_axis_info(context, axes, 0, nullptr, nullptr, nullptr,
                                                                        &metres, nullptr, nullptr, nullptr) == 1;
  proj().proj_destroy(axes);
  return has_axis && metres == 1;
}

void transform_all(PJ* steps, PJ_DIRECTION direction, std::vector<Point>& points) {
  for (Point& p : points) {
    PJ_COORD place{};
    place.xy = {p.x, p.y};
    const PJ_COORD at = proj().proj_trans(steps, direction, place);
    p = {at.xy.x, at.xy.y};
    if (!std::isfinite(p.x) || !std::isfinite(p.y))  // PROJ gives HUGE_VAL
      p.x = p.y = std::numeric_limits<double>::quiet_NaN();
  }
}

}  // namespace

void Projection::Free::operator()(PJconsts* object) const {
  proj().proj_destroy(object);
}
void Projection::Free::operator()(pj_ctx* context) const {
  proj().proj_context_destroy(context);
}

Result<Crs> find_crs(const std::string& definition) {
  if (!has_proj()) return fail(kNoProj);
  const std::unique_ptr<pj_ctx, Projection::Free> context(quiet_context());
  std::unique_ptr<PJ, Projection::Free> crs(proj().proj_create(context.get(), definition.c_str()));
  if (!crs || proj().proj_is_crs(crs.get()) == 0)
    return fail(fmt::format("PROJ knows no coordinate system \"{}\", allowed: EPSG:n, OGC:CRS84, a PROJ string, WKT",
                            definition));
  Crs found;
  if (const char* name = proj().proj_get_name(crs.get())) found.name = name;
  PJ_TYPE type = proj().proj_get_type(crs.get());
  if (type == PJ_TYPE_BOUND_CRS || type == PJ_TYPE_COMPOUND_CRS) {
    crs.reset(type == PJ_TYPE_BOUND_CRS ? proj().proj_get_source_crs(context.get(), crs.get())
                                        : proj().proj_crs_get_sub_crs(context.get(), crs.get(), 0));
    if (!crs) return fail(fmt::format("\"{}\" has no horizontal system", definition));
    type = proj().proj_get_type(crs.get());
  }
  found.is_geographic = type == PJ_TYPE_GEOGRAPHIC_2D_CRS || type == PJ_TYPE_GEOGRAPHIC_3D_CRS;
  found.is_projected = type == PJ_TYPE_PROJECTED_CRS || type == PJ_TYPE_ENGINEERING_CRS;
  found.is_metric = found.is_projected && is_metric(context.get(), crs.get());
  return found;
}

Result<Projection> Projection::between(const std::string& from, const std::string& to) {
  if (!has_proj()) return fail(kNoProj);
  Projection projection;
  projection.context_.reset(quiet_context());
  pj_ctx* const context = projection.context_.get();
  const std::unique_ptr<PJ, Free> steps(proj().proj_create_crs_to_crs(context, from.c_str(), to.c_str(), nullptr));
  if (!steps) return fail(fmt::format(R"(PROJ has no way from "{}" to "{}")", from, to));
  projection.steps_.reset(proj().proj_normalize_for_visualization(context, steps.get()));
  if (!projection.steps_) return fail(fmt::format(R"(PROJ has no way from "{}" to "{}")", from, to));
  return projection;
}

void Projection::apply(std::vector<Point>& points) const {
  transform_all(steps_.get(), PJ_FWD, points);
}
void Projection::apply_inverse(std::vector<Point>& points) const {
  transform_all(steps_.get(), PJ_INV, points);
}

std::string GeographicPlane::system(const simulation::GeographicOrigin& origin) {
  return fmt::format("+proj=aeqd +lat_0={} +lon_0={} +datum=WGS84 +units=m +no_defs +type=crs",
                     geometry::kDegreesPerRadian * origin.latitude, geometry::kDegreesPerRadian * origin.longitude);
}

Result<GeographicPlane> GeographicPlane::about(const simulation::GeographicOrigin& origin) {
  auto from_degrees = Projection::between(kDegreesByProj, system(origin));
  if (!from_degrees) return fail(from_degrees.error());
  return GeographicPlane(origin, std::move(*from_degrees));
}

Geographic GeographicPlane::geographic_of(Point point) const {
  // The x axis heads `heading` clockwise from north; y is 90° to port of it.
  const double sin_h = std::sin(origin_.heading), cos_h = std::cos(origin_.heading);
  std::vector<Point> at{{point.x * sin_h - point.y * cos_h, point.x * cos_h + point.y * sin_h}};
  from_degrees_.apply_inverse(at);
  const double origin_longitude = geometry::kDegreesPerRadian * origin_.longitude;
  const double longitude = origin_longitude + std::remainder(at[0].x - origin_longitude, 360);
  return {at[0].y / geometry::kDegreesPerRadian, longitude / geometry::kDegreesPerRadian};
}

void GeographicPlane::place(std::vector<Point>& degrees) const {
  from_degrees_.apply(degrees);
  turn(degrees);
}

void GeographicPlane::turn(std::vector<Point>& east_north) const {
  const double sin_h = std::sin(origin_.heading), cos_h = std::cos(origin_.heading);
  for (Point& p : east_north) p = {p.x * sin_h + p.y * cos_h, p.y * sin_h - p.x * cos_h};
}

namespace {

constexpr const char* kDegreesByOgc = "OGC:CRS84";

[[noreturn]] void refuse(std::string words, std::optional<std::size_t> floe = {}) {
  throw PlaneError{floe, std::move(words)};
}

template <class Value>
Value or_refuse(Result<Value> found) {
  if (!found) refuse(std::move(found.error()));
  return *std::move(found);
}

bool is_finite(Point p) {
  return std::isfinite(p.x) && std::isfinite(p.y);
}

/// Calls use(ring) for each ring of each floe.
template <class Use>
void for_rings(SourceFloe& floe, Use use) {
  use(floe.polygon.outer);
  for (Ring& hole : floe.polygon.holes) use(hole);
}

/// The first point of a floe of which it is true.
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

/// "75.1° S, 16° E", of longitude and latitude in degrees.
std::string place_in_words(Point at) {
  const double longitude = std::remainder(at.x, 360);
  return fmt::format("{:.6g}° {}, {:.6g}° {}", std::abs(at.y), at.y < 0 ? "S" : "N", std::abs(longitude),
                     longitude < 0 ? "W" : "E");
}

/// Between two places, longitude and latitude in degrees, on a sphere of the Earth's radius [m].
double great_circle(Point a, Point b) {
  constexpr double kEarthRadius = 6371e3;  // [m]
  const auto radians = [](double degrees) { return degrees / geometry::kDegreesPerRadian; };
  const double cosine = std::sin(radians(a.y)) * std::sin(radians(b.y)) +
                        std::cos(radians(a.y)) * std::cos(radians(b.y)) * std::cos(radians(a.x) - radians(b.x));
  return kEarthRadius * std::acos(std::clamp(cosine, -1.0, 1.0));
}

/// Longitude and latitude [°].
template <class Place>
Point degrees_of(const Place& place) {
  return {geometry::kDegreesPerRadian * place.longitude, geometry::kDegreesPerRadian * place.latitude};
}

double median(std::vector<double> values) {
  const auto middle = values.begin() + std::ssize(values) / 2;
  std::ranges::nth_element(values, middle);
  return *middle;
}

/// A floe that has no place in the plane, and its first point that has none.
struct MisplacedFloe {
  std::size_t floe = 0;
  Point point;
};

/// Brings one file's floes to the plane, step by step.
class PlaneImport {
 public:
  PlaneImport(std::vector<SourceFloe>& floes, const PlaneSettings& settings) : floes_(floes), settings_(settings) {}

  /// Throws PlaneError.
  PlaneReport run(const std::string& crs) {
    const std::string system = system_of(crs);
    check_numbers();
    if (!system.empty())
      project(system, !crs.empty());
    else if (settings_.origin)
      report_.origin = settings_.origin;
    if (settings_.is_shifted) shift();
    check_distance();
    return std::move(report_);
  }

 private:
  using Others = std::optional<std::size_t>;  ///< how many floes more

  static bool is_kept(const SourceFloe& floe) { return floe.refused.empty(); }

  /// The floes, of those not refused before, with a point of which it is true.
  template <class Condition>
  std::vector<MisplacedFloe> find_floes(Condition is_it) const {
    std::vector<MisplacedFloe> found;
    for (std::size_t i = 0; i < floes_.size(); ++i) {
      if (!is_kept(floes_[i])) continue;
      if (const auto point = find_point(floes_[i].polygon, is_it)) found.push_back({i, *point});
    }
    return found;
  }

  /// Refuses floes one by one; the file where they are more of it than `share`, or all. words_of(floe,
  /// others) is why: `others` are how many more there are where the file is refused, none where the floe is.
  template <class Words>
  void refuse_floes(const std::vector<MisplacedFloe>& misplaced, Words words_of, double share = 1) {
    if (misplaced.empty()) return;
    const auto kept = static_cast<std::size_t>(std::ranges::count_if(floes_, is_kept));
    const auto count = static_cast<double>(misplaced.size());
    if (misplaced.size() == kept || count > share * static_cast<double>(kept))
      refuse(words_of(misplaced.front(), Others(misplaced.size() - 1)), misplaced.front().floe);
    for (const MisplacedFloe& one : misplaced) floes_[one.floe].refused = words_of(one, Others());
  }

  /// The system that the coordinates are in; empty where they are metres of the plane already.
  std::string system_of(const std::string& crs) const {
    if (!crs.empty() && !settings_.source.empty() && crs != settings_.source)
      refuse(fmt::format("the file names its own coordinate system, {}, where {} is given", crs, settings_.source));
    if (!crs.empty() || !settings_.source.empty()) return crs.empty() ? settings_.source : crs;
    CoordinateEvidence evidence;
    for (const SourceFloe& floe : floes_) evidence.add(floe.polygon);
    const bool is_projected = settings_.origin || !settings_.target.empty();
    if (!settings_.are_metres && (evidence.look_like_degrees() || (settings_.origin && lie_about_origin()))) {
      if (is_projected) return kDegreesByOgc;
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

  /// Whether the floes are degrees about the origin, whatever a few wrong numbers show: those of a tenth or
  /// more of the floes are, and small; or as metres they are no ice to simulate.
  bool lie_about_origin() const {
    constexpr double kLeastIce = 1;  // [m²], or squares of a degree
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

  /// The middle of the points in degrees on the sphere, longitude first, to 0.001°; without points farther
  /// than kFarthestFloe from most, which wrong numbers bring there.
  Point middle_of_degrees() const {
    std::vector<Point> points;
    std::vector<double> latitudes, longitudes;
    for (const SourceFloe& floe : floes_)
      if (is_kept(floe)) std::ranges::copy_if(floe.polygon.outer, std::back_inserter(points), is_in_degrees);
    if (points.empty()) return {};
    for (const Point p : points) {
      latitudes.push_back(p.y);
      longitudes.push_back(std::remainder(p.x - points[0].x, 360));  // also across 180°
    }
    const Point middle{median(std::move(longitudes)) + points[0].x, median(std::move(latitudes))};
    const auto is_near = [&](Point p) { return great_circle(p, middle) < kFarthestFloe; };
    const bool are_all = std::ranges::none_of(points, is_near);
    double x = 0, y = 0, z = 0;
    for (const Point p : points) {
      if (!are_all && !is_near(p)) continue;
      x += std::cos(p.y / geometry::kDegreesPerRadian) * std::cos(p.x / geometry::kDegreesPerRadian);
      y += std::cos(p.y / geometry::kDegreesPerRadian) * std::sin(p.x / geometry::kDegreesPerRadian);
      z += std::sin(p.y / geometry::kDegreesPerRadian);
    }
    const auto to_thousandths = [](double value) { return std::round(1000 * value) / 1000; };
    return {to_thousandths(geometry::kDegreesPerRadian * std::atan2(y, x)),
            to_thousandths(geometry::kDegreesPerRadian * std::atan2(z, std::hypot(x, y)))};
  }

  void project(const std::string& system, bool is_of_file) {
    const auto crs = find_crs(system);
    if (!crs) refuse(crs.error() + (is_of_file ? "; a file of metres in a plane of its own has no crs" : ""));
    report_.system = crs->name;
    if (crs->is_geographic)
      check_degrees();
    else if (!crs->is_projected)
      refuse(fmt::format("{} is neither longitude and latitude nor a plane", crs->name));
    if (!settings_.target.empty()) return project_to_target(system);
    std::optional<simulation::GeographicOrigin> origin = settings_.origin;
    if (!origin && crs->is_geographic) {
      const Point middle = middle_of_degrees();
      if (!settings_.chooses_origin)
        refuse(fmt::format("longitude and latitude ({}), and no origin to project them about: {}", crs->name,
                           settings_.origin_in_words(middle.y, middle.x)));
      origin = {middle.y / geometry::kDegreesPerRadian, middle.x / geometry::kDegreesPerRadian, std::numbers::pi / 2};
      report_.is_origin_chosen = true;
    }
    if (origin) return project_about(*origin, system, crs->is_geographic);
    if (!crs->is_metric)
      refuse(fmt::format("{} is not in metres: an origin, or a projected system in metres, is needed", crs->name));
    report_.target = system;
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

  void project_to_target(const std::string& system) {
    const Crs target = or_refuse(find_crs(settings_.target));
    if (!target.is_metric) refuse(fmt::format("{} ({}) is not a plane in metres", settings_.target, target.name));
    const Projection steps = or_refuse(Projection::between(system, settings_.target));
    report_.target = settings_.target;
    apply([&](std::vector<Point>& points) { steps.apply(points); });
  }

  void project_about(const simulation::GeographicOrigin& origin, const std::string& system, bool is_geographic) {
    const Projection steps = or_refuse(Projection::between(system, GeographicPlane::system(origin)));
    report_.origin = origin;
    const GeographicPlane plane = or_refuse(GeographicPlane::about(origin));
    std::vector<SourceFloe> as_read;
    if (is_geographic) as_read = floes_;
    apply([&](std::vector<Point>& points) {
      steps.apply(points);
      plane.turn(points);
    });
    check_hemisphere(plane, as_read);
  }

  /// Projects all rings, and turns velocities as their axes turn there.
  template <class Steps>
  void apply(Steps steps) {
    std::vector<MisplacedFloe> lost;
    for (std::size_t i = 0; i < floes_.size(); ++i) {
      if (!is_kept(floes_[i])) continue;
      turn_velocity(floes_[i], steps);
      std::optional<Point> without_image;
      for_rings(floes_[i], [&](Ring& ring) {
        const Ring before = ring;
        steps(ring);
        for (std::size_t k = 0; k < ring.size(); ++k)
          if (!is_finite(ring[k])) without_image = before[k];
      });
      if (without_image) lost.push_back({i, *without_image});
    }
    refuse_floes(lost, [](const MisplacedFloe& one, Others) {
      return fmt::format("[{}, {}] has no image in that plane", one.point.x, one.point.y);
    });
  }

  template <class Steps>
  static void turn_velocity(SourceFloe& floe, Steps steps) {
    FloeProperties& p = floe.properties;
    if ((!p.velocity_x && !p.velocity_y) || floe.polygon.outer.empty()) return;
    const Point at = floe.polygon.outer.front();
    const double step = 1e-4 * std::max(1.0, 1e-3 * (std::abs(at.x) + std::abs(at.y)));
    std::vector<Point> frame{at, {at.x + step, at.y}, {at.x, at.y + step}};
    steps(frame);
    const Vector first = frame[1] - frame[0];
    const Vector second = frame[2] - frame[0];
    const Vector v =
        (p.velocity_x.value_or(0) / length(first)) * first + (p.velocity_y.value_or(0) / length(second)) * second;
    p.velocity_x = v.x;
    p.velocity_y = v.y;
  }

  /// Floes beyond the plane's reach from the origin, named by where they are on the Earth.
  void check_hemisphere(const GeographicPlane& plane, const std::vector<SourceFloe>& as_read) {
    const auto far = find_floes([](Point p) { return length(p - Point{}) > kFarthestFloe; });
    refuse_floes(far, [&](const MisplacedFloe& one, Others others) {
      const Point origin = degrees_of(*report_.origin), at = degrees_of(plane.geographic_of(one.point));
      std::string words = fmt::format("{} lies {:.0f} km from the origin at {}{}{}, allowed: up to {:g} km",
                                      place_in_words(at), length(one.point - Point{}) / 1000, place_in_words(origin),
                                      at.y * origin.y < 0 ? ", in the other hemisphere" : "", more_in_words(others),
                                      kFarthestFloe / 1000);
      const std::span<const SourceFloe> all(as_read);
      if (are_swapped(plane, others || all.empty() ? all : all.subspan(one.floe, 1)))
        return words + ". With latitude and longitude exchanged it lies near it: GeoJSON has [longitude, latitude]";
      if (others) words += ": " + settings_.origin_in_words(at.y, std::remainder(at.x, 360));
      return words;
    });
  }

  /// Whether degrees with latitude first lie near the origin.
  static bool are_swapped(const GeographicPlane& plane, std::span<const SourceFloe> as_read) {
    std::vector<Point> exchanged;
    for (const SourceFloe& floe : as_read) {
      for (const Point p : floe.polygon.outer)
        if (is_finite(p)) exchanged.push_back({p.y, p.x});
    }
    if (exchanged.empty()) return false;
    plane.place(exchanged);
    return std::ranges::all_of(exchanged, [](Point p) { return length(p - Point{}) <= kFarthestFloe; });
  }

  /// Floes far from most others, by a wrong number, do not count.
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
    report_.shift = {-std::round(middle.x), -std::round(middle.y)};
    for (SourceFloe& floe : floes_) {
      for_rings(floe, [&](Ring& ring) {
        for (Point& p : ring) p += report_.shift;
      });
    }
  }

  void check_distance() {
    const auto far = find_floes([](Point p) { return std::max(std::abs(p.x), std::abs(p.y)) > kFarthestFloe; });
    const auto words_of = [&](const MisplacedFloe& one, Others others) {
      return fmt::format("found [{:.12g}, {:.12g}]{}, allowed: coordinates from {:g} to {:g} [m]: {}", one.point.x,
                         one.point.y, more_in_words(others), -kFarthestFloe, kFarthestFloe, settings_.shift_in_words);
    };
    refuse_floes(far, words_of, 0.5);  // most of them: the file needs a shift
  }

  /// ", and as far in 3 more floes"
  static std::string more_in_words(Others count) {
    if (count.value_or(0) == 0) return "";
    return fmt::format(", and as far in {} more floe{}", *count, *count == 1 ? "" : "s");
  }

  std::vector<SourceFloe>& floes_;
  const PlaneSettings& settings_;
  PlaneReport report_;
};

}  // namespace

tl::expected<PlaneReport, PlaneError> bring_to_plane(std::vector<SourceFloe>& floes, const std::string& crs,
                                                     const PlaneSettings& settings) {
  try {
    return PlaneImport(floes, settings).run(crs);
  } catch (PlaneError& error) {
    return tl::unexpected(std::move(error));
  }
}

}  // namespace polynya::io
