#include "io/import/plane.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <fmt/format.h>

#include "io/text/degrees.hpp"

namespace polynya::io {
namespace {

using geometry::Box;
using geometry::Point;
using geometry::Ring;
using geometry::Vector;

constexpr double kDegrees = 180 / std::numbers::pi;
constexpr const char* kLongitudeLatitude = "OGC:CRS84";

tl::unexpected<PlaneError> refuse(std::string words, std::optional<std::size_t> floe = {}) {
  return tl::unexpected(PlaneError{floe, std::move(words)});
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

/// The first floe with a point of which it is true, and the point.
template <class Condition>
std::optional<std::pair<std::size_t, Point>> find_point(const std::vector<SourceFloe>& floes,
                                                        Condition is_it) {
  for (std::size_t i = 0; i < floes.size(); ++i) {
    const auto found = std::ranges::find_if(floes[i].polygon.outer, is_it);
    if (found != floes[i].polygon.outer.end()) return {{i, *found}};
  }
  return {};
}

/// "75.1° S, 16° E"
std::string place_in_words(double latitude, double longitude) {
  const double lon = std::remainder(longitude, 360);
  return fmt::format("{:.6g}° {}, {:.6g}° {}", std::abs(latitude), latitude < 0 ? "S" : "N", std::abs(lon),
                     lon < 0 ? "W" : "E");
}

/// The middle of points in degrees on the sphere, longitude first, to 0.001°.
Point middle_of_degrees(const std::vector<SourceFloe>& floes) {
  double x = 0, y = 0, z = 0;
  for (const SourceFloe& floe : floes) {
    for (const Point p : floe.polygon.outer) {
      if (!is_finite(p)) continue;
      x += std::cos(p.y / kDegrees) * std::cos(p.x / kDegrees);
      y += std::cos(p.y / kDegrees) * std::sin(p.x / kDegrees);
      z += std::sin(p.y / kDegrees);
    }
  }
  const auto to_thousandths = [](double value) { return std::round(1000 * value) / 1000; };
  return {to_thousandths(kDegrees * std::atan2(y, x)),
          to_thousandths(kDegrees * std::atan2(z, std::hypot(x, y)))};
}

/// Brings one file's floes to the plane, step by step.
class PlaneImport {
 public:
  PlaneImport(std::vector<SourceFloe>& floes, const PlaneSettings& settings)
      : floes_(floes), settings_(settings) {}

  tl::expected<PlaneReport, PlaneError> run(const std::string& crs) {
    auto system = system_of(crs);
    if (!system) return tl::unexpected(system.error());
    if (!system->empty()) {
      if (auto projected = project(*system, crs.empty()); !projected)
        return tl::unexpected(projected.error());
    } else if (!settings_.target.empty()) {
      return refuse(fmt::format("the file names no coordinate system to project to {} from: {}",
                                settings_.target, settings_.source_in_words));
    } else if (settings_.origin) {
      report_.origin = settings_.origin;
    }
    if (settings_.is_shifted) shift();
    if (auto near = check_distance(); !near) return tl::unexpected(near.error());
    return std::move(report_);
  }

 private:
  /// The system that the coordinates are in; empty where they are metres of the plane already.
  tl::expected<std::string, PlaneError> system_of(const std::string& crs) {
    if (!crs.empty() && !settings_.source.empty() && crs != settings_.source)
      return refuse(fmt::format("the file names its own coordinate system, {}, where {} is given", crs,
                                settings_.source));
    if (!crs.empty() || !settings_.source.empty()) return crs.empty() ? settings_.source : crs;
    CoordinateEvidence evidence;
    for (const SourceFloe& floe : floes_) evidence.add(floe.polygon);
    if (settings_.are_metres || !evidence.look_like_degrees()) return std::string();
    if (settings_.origin || !settings_.target.empty()) return std::string(kLongitudeLatitude);
    const Point middle = middle_of_degrees(floes_);
    return refuse(fmt::format(
        "these look like longitude and latitude, and the file names no coordinate system: all within ±180, "
        "±90, and as metres {:.4g} m² of ice in all. {} projects them; metres are kept where {}",
        evidence.area, settings_.origin_in_words(middle.y, middle.x),
        "a crs member names a projected system"));
  }

  tl::expected<void, PlaneError> project(const std::string& system, bool is_given) {
    const auto crs = find_crs(system);
    const bool is_wanted = is_given || settings_.origin || !settings_.target.empty();
    if (!crs) {
      if (is_wanted) return refuse(crs.error());
      report_.system = system;  // a plane with a name of its own
      return {};
    }
    report_.system = crs->name;
    if (crs->is_geographic) {
      if (auto checked = check_degrees(); !checked) return checked;
    } else if (!crs->is_projected) {
      return refuse(fmt::format("{} is neither longitude and latitude nor a plane", crs->name));
    }
    if (!settings_.target.empty()) return project_to_target(system);
    std::optional<simulation::GeographicOrigin> origin = settings_.origin;
    if (!origin && crs->is_geographic) {
      const Point middle = middle_of_degrees(floes_);
      if (!settings_.chooses_origin)
        return refuse(fmt::format("longitude and latitude ({}), and no origin to project them about: {}",
                                  crs->name, settings_.origin_in_words(middle.y, middle.x)));
      origin = {middle.y / kDegrees, middle.x / kDegrees, std::numbers::pi / 2};
      report_.is_origin_chosen = true;
    }
    if (origin) return project_about(*origin, system, crs->is_geographic);
    if (!crs->is_metric)
      return refuse(fmt::format("{} is not in metres: an origin, or a projected system in metres, is needed",
                                crs->name));
    report_.target = system;
    return {};
  }

  tl::expected<void, PlaneError> check_degrees() const {
    const auto beyond = find_point(floes_, [](Point p) { return std::abs(p.y) > 90 || std::abs(p.x) > 540; });
    if (!beyond) return {};
    const auto [floe, p] = *beyond;
    return refuse(fmt::format("found [{}, {}], allowed: [longitude, latitude], a latitude from -90 to 90{}",
                              p.x, p.y, std::abs(p.x) <= 90 ? "; here latitude seems to come first" : ""),
                  floe);
  }

  tl::expected<void, PlaneError> project_to_target(const std::string& system) {
    const auto target = find_crs(settings_.target);
    if (!target) return refuse(target.error());
    if (!target->is_metric)
      return refuse(fmt::format("{} ({}) is not a plane in metres", settings_.target, target->name));
    const auto steps = Projection::between(system, settings_.target);
    if (!steps) return refuse(steps.error());
    report_.target = settings_.target;
    return apply([&](std::vector<Point>& points) { steps->apply(points); });
  }

  tl::expected<void, PlaneError> project_about(const simulation::GeographicOrigin& origin,
                                               const std::string& system, bool is_geographic) {
    const auto steps = Projection::between(system, GeographicPlane::system(origin));
    if (!steps) return refuse(steps.error());
    report_.origin = origin;
    const auto plane = GeographicPlane::about(origin);
    if (!plane) return refuse(plane.error());
    std::vector<SourceFloe> as_read;
    if (is_geographic) as_read = floes_;
    auto applied = apply([&](std::vector<Point>& points) {
      steps->apply(points);
      plane->turn(points);
    });
    if (!applied) return applied;
    return check_hemisphere(*plane, as_read);
  }

  /// Projects all rings, and turns velocities as their axes turn there.
  template <class Steps>
  tl::expected<void, PlaneError> apply(Steps steps) {
    for (std::size_t i = 0; i < floes_.size(); ++i) {
      turn_velocity(floes_[i], steps);
      std::optional<Point> lost;
      for_rings(floes_[i], [&](Ring& ring) {
        const Ring before = ring;
        steps(ring);
        for (std::size_t k = 0; k < ring.size(); ++k)
          if (is_finite(before[k]) && !is_finite(ring[k])) lost = before[k];
      });
      if (lost) return refuse(fmt::format("[{}, {}] has no image in that plane", lost->x, lost->y), i);
    }
    return {};
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
    const Vector v = (p.velocity_x.value_or(0) / length(first)) * first +
                     (p.velocity_y.value_or(0) / length(second)) * second;
    p.velocity_x = v.x;
    p.velocity_y = v.y;
  }

  /// Floes beyond the plane's reach from the origin, named by where they are on the Earth.
  tl::expected<void, PlaneError> check_hemisphere(const GeographicPlane& plane,
                                                  const std::vector<SourceFloe>& as_read) const {
    const auto is_far = [](Point p) { return length(p - Point{}) > kFarthestFloe; };
    const auto far = find_point(floes_, is_far);
    if (!far) return {};
    const simulation::GeographicOrigin& origin = *report_.origin;
    const Geographic at = plane.geographic_of(far->second);
    const bool is_other_hemisphere = at.latitude * origin.latitude < 0;
    std::string words = fmt::format(
        "{} lies {:.0f} km from the origin at {}{}{}, allowed: up to {:g} km",
        place_in_words(kDegrees * at.latitude, kDegrees * at.longitude), length(far->second - Point{}) / 1000,
        place_in_words(kDegrees * origin.latitude, kDegrees * origin.longitude),
        is_other_hemisphere ? ", in the other hemisphere" : "", more_in_words(is_far), kFarthestFloe / 1000);
    if (are_swapped(plane, as_read))
      return refuse(words +
                        ". With latitude and longitude exchanged they lie near it: GeoJSON has [longitude, "
                        "latitude]",
                    far->first);
    return refuse(
        words + ": " +
            settings_.origin_in_words(kDegrees * at.latitude, std::remainder(kDegrees * at.longitude, 360)),
        far->first);
  }

  /// Whether degrees with latitude first lie near the origin.
  static bool are_swapped(const GeographicPlane& plane, const std::vector<SourceFloe>& as_read) {
    std::vector<Point> exchanged;
    for (const SourceFloe& floe : as_read) {
      for (const Point p : floe.polygon.outer)
        if (is_finite(p)) exchanged.push_back({p.y, p.x});
    }
    if (exchanged.empty()) return false;
    plane.place(exchanged);
    return std::ranges::all_of(exchanged, [](Point p) { return length(p - Point{}) <= kFarthestFloe; });
  }

  void shift() {
    std::optional<Box> box;
    for (const SourceFloe& floe : floes_) {
      for (const Point p : floe.polygon.outer)
        if (is_finite(p)) box = box ? united(*box, {p, p}) : Box{p, p};
    }
    if (!box) return;
    const Point middle = midpoint(box->low, box->high);
    report_.shift = {-std::round(middle.x), -std::round(middle.y)};
    for (SourceFloe& floe : floes_) {
      for_rings(floe, [&](Ring& ring) {
        for (Point& p : ring) p += report_.shift;
      });
    }
  }

  tl::expected<void, PlaneError> check_distance() const {
    const auto is_far = [](Point p) { return std::max(std::abs(p.x), std::abs(p.y)) > kFarthestFloe; };
    const auto far = find_point(floes_, is_far);
    if (!far) return {};
    return refuse(fmt::format("found [{:.12g}, {:.12g}]{}, allowed: coordinates from {:g} to {:g} [m]: {}",
                              far->second.x, far->second.y, more_in_words(is_far), -kFarthestFloe,
                              kFarthestFloe, settings_.shift_in_words),
                  far->first);
  }

  /// ", and as far in 3 more floes"
  template <class Condition>
  std::string more_in_words(Condition is_far) const {
    const auto count = std::ranges::count_if(
        floes_, [&](const SourceFloe& floe) { return std::ranges::any_of(floe.polygon.outer, is_far); });
    return count > 1 ? fmt::format(", and as far in {} more floe{}", count - 1, count == 2 ? "" : "s") : "";
  }

  std::vector<SourceFloe>& floes_;
  const PlaneSettings& settings_;
  PlaneReport report_;
};

}  // namespace

tl::expected<PlaneReport, PlaneError> bring_to_plane(std::vector<SourceFloe>& floes, const std::string& crs,
                                                     const PlaneSettings& settings) {
  return PlaneImport(floes, settings).run(crs);
}

}  // namespace polynya::io
