#include <algorithm>
#include <array>
#include <iterator>
#include <limits>
#include <set>

#include "analysis/channel.hpp"
#include "io/run/event_records.hpp"
#include "io/run/records.hpp"
#include "io/run/summary.hpp"
#include "io/text/json_writer.hpp"
#include "simulation/ship/pattern.hpp"
#include "views/player/player_page.hpp"

namespace polynya::views {

using geometry::Box;
using geometry::Point;

namespace {

/// The floes of a run that a page contains.
class HeldFloes {
 public:
  /// Selects the floes whose distance is 0.
  explicit HeldFloes(const std::vector<double>& distances) : is_held_(distances.size()) {
    for (std::size_t i = 0; i < distances.size(); ++i) {
      is_held_[i] = distances[i] <= 0;
      if (is_held_[i]) ids_.push_back(static_cast<simulation::FloeId>(i));
    }
  }
  bool are_all() const { return ids_.size() == is_held_.size(); }
  /// Returns true for floes on the page, and for ids that are no floe.
  bool has(simulation::FloeId id) const { return id < 0 || is_held_[static_cast<std::size_t>(id)]; }
  const std::vector<simulation::FloeId>& ids() const { return ids_; }

 private:
  std::vector<bool> is_held_;  ///< by floe id
  std::vector<simulation::FloeId> ids_;
};

/// Collects the shapes of floes in columns. makeShapes() in views/player/run_data.js reads them and explains the
/// columns of parts.
class ShapeColumns {
 public:
  explicit ShapeColumns(const io::Run& run) : run_(run) {}

  void add(const simulation::BirthRecord& birth) {
    const io::ShapeParts* parts = run_.shapes.parts_of(birth.floe);
    const auto polygon = run_.shape(birth.floe);
    double reach = 0;  // a hole never extends farther than the outer ring
    for (const Point p : polygon->outer) reach = std::max(reach, distance(p, birth.centroid_in_body));
    reach_.push_back(reach);
    std::size_t end = 0;
    for (const std::size_t size : io::ring_sizes(*polygon)) {
      end += size;
      ring_ends_.push_back(static_cast<std::int32_t>(end));
    }
    rings_of_.push_back(static_cast<std::int32_t>(ring_ends_.size()));
    if (!parts) {
      add_points(polygon->outer);
      for (const geometry::Ring& hole : polygon->holes) add_points(hole);
      return;
    }
    add_points(parts->vertices);
    for (const io::ShapePart& part : parts->parts) {
      part_floe_.push_back(static_cast<std::int32_t>(birth.floe));
      part_ring_.push_back(part.ring);
      part_first_.push_back(static_cast<std::int32_t>(part.first));
      part_count_.push_back(static_cast<std::int32_t>(part.count));
    }
  }

  void add_to(ColumnWriter& columns) const {
    columns.add("rings_of", rings_of_);
    columns.add("ring_ends", ring_ends_);
    columns.add("part_floe", part_floe_);
    columns.add("part_ring", part_ring_);
    columns.add("part_first", part_first_);
    columns.add("part_count", part_count_);
    columns.add("reach_m", reach_);
    columns.add("points_m", points_);
  }

 private:
  void add_points(const geometry::Ring& ring) {
    for (const Point p : ring) points_.insert(points_.end(), {p.x, p.y});
  }

  const io::Run& run_;
  std::vector<std::int32_t> rings_of_{0}, ring_ends_, part_floe_, part_ring_, part_first_, part_count_;
  std::vector<double> points_, reach_;
};

/// Adds columns with one value per floe: floe_id (only if the page does not contain all floes), parent, generation,
/// born_s, died_s, went_under_s, came_up (1 if the floe, or one from which it broke, surfaced from under a hull),
/// area_m2, mass_kg, thickness_m, flexural_strength_Pa, centroid, and reach_m, the distance of the farthest vertex from
/// the centroid. The shape follows: the ends of its rings, counted from its first vertex, and its vertices. For a shape
/// that refers to its parent, these are its parts and its new vertices.
void add_floes(ColumnWriter& columns, const io::Run& run, const HeldFloes& held) {
  const auto add_of_floe = [&](const char* name, auto read) {
    columns.add(name, held.ids(), [&run, read](simulation::FloeId id) { return std::invoke(read, *run.floe(id)); });
  };
  const auto add = [&](const char* name, auto read) {
    add_of_floe(name, [read](const io::RunFloe& floe) { return std::invoke(read, floe.birth); });
  };
  using simulation::BirthRecord;
  if (!held.are_all()) add("floe_id", &BirthRecord::floe);
  add("parent", &BirthRecord::parent);
  add("generation", &BirthRecord::generation);
  add("born_s", &BirthRecord::time);
  add_of_floe("died_s", &io::RunFloe::died);
  add_of_floe("went_under_s", &io::RunFloe::went_under);
  add_of_floe("came_up", &io::RunFloe::came_up);
  add("area_m2", &BirthRecord::area);
  add("mass_kg", &BirthRecord::mass);
  const simulation::Scene& scene = run.scene.scene;
  add("thickness_m", [&](const BirthRecord& birth) { return ice_of(scene, birth.own_ice).thickness; });
  add("flexural_strength_Pa", [&](const BirthRecord& birth) { return ice_of(scene, birth.own_ice).flexural_strength; });
  add("centroid_x_m", [](const BirthRecord& birth) { return birth.centroid_in_body.x; });
  add("centroid_y_m", [](const BirthRecord& birth) { return birth.centroid_in_body.y; });
  ShapeColumns shapes(run);
  for (const simulation::FloeId id : held.ids()) shapes.add(run.floe(id)->birth);
  shapes.add_to(columns);
}

/// Distance by which a box must grow on all sides to touch another [m]; 0 if they overlap.
double gap(const Box& box, const Box& other) {
  const double across = std::max(other.low.x - box.high.x, box.low.x - other.high.x);
  const double up = std::max(other.low.y - box.high.y, box.low.y - other.high.y);
  return std::max({0.0, across, up});
}

/// Returns, for each floe, the distance by which a box must grow on all sides so that the floe, or a floe of its
/// family, comes within it at one of these frames [m]; 0 if one of them comes within the box as it is. A family is one
/// floe of the scene with all floes that broke from it. The distance is estimated from the floes' circles and from the
/// boxes of their paths between records. HeldFloes only asks whether it is 0.
std::vector<double> family_distances(const io::Run& run, const Box& box, const std::vector<io::Frame>& frames) {
  std::vector<std::size_t> oldest(run.floes.size());
  std::vector<double> reach(run.floes.size());
  for (std::size_t i = 0; i < run.floes.size(); ++i) {
    const simulation::BirthRecord& birth = run.floes[i].birth;
    oldest[i] = birth.parent >= 0 ? oldest[static_cast<std::size_t>(birth.parent)] : i;
    for (const Point p : run.shape(birth.floe)->outer)
      reach[i] = std::max(reach[i], distance(p, birth.centroid_in_body));
  }
  // The index is the oldest floe of a family.
  std::vector<double> least(run.floes.size(), std::numeric_limits<double>::infinity());
  std::vector<std::optional<io::RecordedMotion>> last(run.floes.size());
  /// Extends the path of a floe from its last record to a time, at its velocity.
  const auto follow = [&](std::size_t floe, double time) {
    const Point from = last[floe]->motion.position;
    const Point to = carried_on(last[floe]->motion, time - last[floe]->time).position;
    double& distance = least[oldest[floe]];
    distance = std::min(distance, gap(box, geometry::grown(geometry::box_around(from, to), reach[floe])));
  };
  double before = 0;  // time of the previous frame [s]
  for (const io::Frame& frame : frames) {
    for (const auto& [id, motion] : frame.floes) {
      const auto floe = static_cast<std::size_t>(id);
      if (last[floe]) follow(floe, before);
      last[floe] = io::RecordedMotion{frame.time, motion};
      follow(floe, frame.time);
    }
    before = frame.time;
  }
  for (std::size_t i = 0; i < last.size(); ++i) {
    if (last[i]) follow(i, std::min(before, run.floes[i].died));
  }
  std::vector<double> distances(run.floes.size());
  for (std::size_t i = 0; i < distances.size(); ++i) distances[i] = least[oldest[i]];
  return distances;
}

/// Adds the contacts at these frames. Contacts with floes that the page does not contain are left out.
void add_contacts(ColumnWriter& columns, const io::Run& run, const std::vector<io::Frame>& frames,
                  const HeldFloes& held) {
  std::vector<io::RunContact> contacts;
  for (const io::Frame& frame : frames) {
    std::ranges::copy_if(run.contacts_at(frame.time), std::back_inserter(contacts), [&](const io::RunContact& contact) {
      return held.has(contact.state.on.floe) && held.has(contact.state.by.floe);
    });
  }
  const auto add = [&](const char* name, auto read) {
    columns.add(name, contacts, [read](const io::RunContact& contact) { return read(contact.state); });
  };
  using simulation::ContactState;
  columns.add("contact_t_s", contacts, &io::RunContact::time);
  add("contact_ship", [](const ContactState& c) { return c.on.ship; });
  add("contact_floe", [](const ContactState& c) { return c.on.floe; });
  add("contact_by_floe", [](const ContactState& c) { return c.by.floe; });
  add("contact_x_m", [](const ContactState& c) { return c.point_in_world.x; });
  add("contact_y_m", [](const ContactState& c) { return c.point_in_world.y; });
  add("contact_fx_N", [](const ContactState& c) { return c.force.x; });
  add("contact_fy_N", [](const ContactState& c) { return c.force.y; });
  add("contact_is_crushing", [](const ContactState& c) { return c.is_crushing; });
}

/// Adds the peaks of forces on hulls within the selected time, also those from floes that the page does not contain.
void add_peaks(ColumnWriter& columns, const io::Run& run, const std::vector<io::Frame>& frames) {
  std::vector<io::RunContact> peaks;
  const double from = frames.empty() ? 0 : frames.front().time, until = frames.empty() ? 0 : frames.back().time;
  std::ranges::copy_if(run.peaks, std::back_inserter(peaks),
                       [&](const io::RunContact& peak) { return peak.time >= from && peak.time <= until; });
  columns.add("peak_t_s", peaks, &io::RunContact::time);
  columns.add("peak_ship", peaks, [](const io::RunContact& peak) { return peak.state.on.ship; });
  columns.add("peak_arc_m", peaks, [](const io::RunContact& peak) { return peak.state.arc; });
  columns.add("peak_force_N", peaks,
              [](const io::RunContact& peak) { return peak.state.pressure * peak.state.width * peak.state.height; });
}

/// Adds, for each hull, the stations that are a channel, at frames spread evenly over the run and at the last one.
/// Stations that geometry fails to measure are left out.
void add_channels(ColumnWriter& columns, const io::Run& run, const std::vector<io::Frame>& frames) {
  // Largest number of instants at which the channels are measured. More make pages larger and take longer: 76 bytes per
  // station, and a millisecond per instant with 500 floes.
  constexpr std::size_t kMostInstants = 200;
  struct Row {
    int ship;
    double time;
    analysis::ChannelStation station;
  };
  std::vector<double> instants;
  const std::size_t count = std::min(kMostInstants, frames.size());
  for (std::size_t i = 0; i < count; ++i) instants.push_back(frames[(i + 1) * frames.size() / count - 1].time);
  std::vector<Row> rows;
  const io::MotionIndex motions(run);
  for (std::size_t ship = 0; ship < hull_count(run.scene.scene); ++ship) {
    for (const double time : instants) {
      const auto stations = analysis::measure_stations(run, motions, {.ship = ship, .time = time});
      if (!stations) continue;
      for (const analysis::ChannelStation& station : *stations) {
        if (station.is_channel) rows.push_back({static_cast<int>(ship), time, station});
      }
    }
  }
  const auto add = [&](const char* name, auto read) {
    columns.add(name, rows, [read](const Row& row) { return read(row.station); });
  };
  using Station = analysis::ChannelStation;
  columns.add("channel_measured_s", instants);
  columns.add("channel_ship", rows, &Row::ship);
  columns.add("channel_t_s", rows, &Row::time);
  add("channel_x_m", [](const Station& s) { return s.middle.x; });
  add("channel_y_m", [](const Station& s) { return s.middle.y; });
  add("channel_forward_x", [](const Station& s) { return s.forward.x; });
  add("channel_forward_y", [](const Station& s) { return s.forward.y; });
  add("channel_along_m", [](const Station& s) { return s.along; });
  add("channel_length_m", [](const Station& s) { return s.length; });
  add("channel_port_m", [](const Station& s) { return s.port; });
  add("channel_starboard_m", [](const Station& s) { return s.starboard; });
}

/// A cause as the page shows it: a column of forces.csv, or a column minus its shares, which are shown as causes of
/// their own.
struct ShownCause {
  io::ForceCause cause;
  std::vector<std::string_view> shares;  ///< columns of its shares

  std::string column() const { return std::string(cause.column) + (shares.empty() ? "" : " without shares"); }
  double read(const simulation::HullSample& sample) const {
    double left = io::force_column(cause.column).read(sample);
    for (const std::string_view share : shares) left -= io::force_column(share).read(sample);
    return left;
  }
};

std::vector<ShownCause> shown_causes(const simulation::Scene& scene) {
  std::vector<ShownCause> shown;
  for (const io::ForceCause& cause : io::force_causes(scene)) {
    ShownCause& one = shown.emplace_back(ShownCause{cause, {}});
    for (const io::ForceCause& other : io::force_causes(scene))
      if (other.share_of == cause.column) one.shares.push_back(other.column);
  }
  return shown;
}

/// Adds the rows of forces.csv in the selected time. The columns are all that plots show, including the columns of
/// causes, and for each cause with shares a column without its shares.
void add_forces(ColumnWriter& columns, const io::Run& run, const io::FrameSelection& selection) {
  std::vector<simulation::HullSample> rows;
  std::ranges::copy_if(run.samples, std::back_inserter(rows),
                       [&](const simulation::HullSample& s) { return selection.has(s.time); });
  columns.add("force_ship", rows, &simulation::HullSample::ship);
  columns.add("force_t_s", rows, &simulation::HullSample::time);
  for (const io::ForceColumn* column : io::plotted_columns(run.scene.scene))
    columns.add(column->name, rows, column->read);
  for (const ShownCause& cause : shown_causes(run.scene.scene)) {
    if (!cause.shares.empty())
      columns.add(cause.column(), rows, [&](const simulation::HullSample& s) { return cause.read(s); });
  }
}

void write_force_columns(io::JsonWriter& json, const simulation::Scene& scene) {
  json.key("force_columns").objects(io::plotted_columns(scene), [&](const io::ForceColumn* column) {
    json.key("name").value(column->name).key("unit").value(column->unit);
    json.key("plot").value(column->plot).key("curve").value(column->curve);
    json.key("is_optional").value(column->is_optional);
  });
}

void write_force_causes(io::JsonWriter& json, const simulation::Scene& scene) {
  json.key("force_causes").objects(shown_causes(scene), [&](const ShownCause& shown) {
    const io::ForceCause& cause = shown.cause;
    json.key("direction").value(cause.direction).key("cause").value(cause.cause).key("column").value(shown.column());
    json.key("words").value(shown.shares.empty() ? cause.words : cause.without_shares);
    json.key("unit").value(io::force_column(cause.column).unit);
  });
}

void write_events(io::JsonWriter& json, const io::Run& run, const HeldFloes& held) {
  json.key("event_labels").open('{');
  std::set<std::string_view> keys;
  for (const io::EventField& field : io::event_fields()) {
    if (field.meaning.label.empty() || !keys.insert(field.key).second) continue;
    json.key(field.key).open('{').key("label").value(field.meaning.label);
    json.key("unit").value(field.meaning.unit).close('}');
  }
  json.close('}').key("events").open('[');
  for (const simulation::Event& event : run.events) {
    if (!event.ice() || held.has(event.ice()->floe)) write_shown_event(json, event, run.scene.scene);
  }
  json.close(']');
}

void write_ships(io::JsonWriter& json, const simulation::Scene& scene) {
  json.key("ships").open('[');
  for (std::size_t hull = 0; hull < hull_count(scene); ++hull) {
    json.object([&] {
      json.key("name").value(hull_of(scene, hull).name).key("waterline_m").value(hull_of(scene, hull).hull.waterline);
      json.key("is_fixed").value(is_grounded(kind_of_hull(scene, hull)));
      const simulation::Ship* ship = hull < scene.ships.size() ? &scene.ships[hull] : nullptr;
      json.key("is_moored").value(ship && ship->mooring.has_value());
      json.key("has_engine").value(ship && std::holds_alternative<simulation::Engine>(ship->propulsion));
    });
  }
  json.close(']');
}

/// Writes the drift of the water over time: t [s], x and y of its path [m], and the velocity of free drift of ice in x
/// and y [m/s]. The duration of the scene is divided into kSamples intervals, between which the player interpolates
/// linearly: more follow a changing drift more closely and make the page larger. Steady drift needs only one. The page
/// moves channels with the path, and orients the patterns of write_patterns() upstream by the velocity.
void write_drift(io::JsonWriter& json, const simulation::Scene& scene) {
  constexpr int kSamples = 400;
  const int samples = scene.water.is_steady() && scene.wind.rows.empty() ? 1 : kSamples;
  json.key("drift").open('[');
  for (int i = 0; i <= samples; ++i) {
    const double time = scene.time.until * i / samples;
    const geometry::Vector path = scene.water.drift_path(time), ice = simulation::free_drift(scene, time);
    json.open('[').value(time).value(path.x).value(path.y).value(ice.x).value(ice.y).close(']');
  }
  json.close(']');
}

/// Writes the patterns of ships that manage ice, relative to the protected body, with x upstream.
void write_patterns(io::JsonWriter& json, const simulation::Scene& scene) {
  json.key("patterns").open('[');
  for (const simulation::Ship& ship : scene.ships) {
    const auto* pilot = std::get_if<simulation::ManagingPilot>(&ship.pilot);
    if (!pilot) continue;
    json.open('{').key("body").value(pilot->body_index).key("line_m").value(line_of(*pilot).corners).close('}');
  }
  json.close(']');
}

void write_summary(io::JsonWriter& json, const io::Run& run) {
  const io::JsonValue* finished = run.summary.find("finished", io::JsonValue::Kind::kBoolean);
  json.key("finished").value(finished && finished->boolean());
  if (const io::JsonValue* by = run.summary.find("stopped_by", io::JsonValue::Kind::kText))
    json.key("stopped_by").value(by->text());
}

/// Writes the tick, the number of time steps and the shortest one. Older runs did not record all of them.
void write_steps(io::JsonWriter& json, const io::Run& run) {
  for (const char* key : {"step_s", "time_steps", "shortest_step_s"})
    if (const io::JsonValue* found = run.summary.find(key, io::JsonValue::Kind::kNumber))
      json.key(key).value(found->number());
}

std::string info_of(const io::Run& run, const PlayerData& data, const PlayerSelection& selection,
                    const HeldFloes& held) {
  std::string text;
  io::JsonWriter json(text);
  const simulation::Scene& scene = run.scene.scene;
  json.open('{').key("polynya").value(io::version()).key("scene").value(scene.name);
  json.key("description").value(run.scene.description).key("scene_hash").value(run.scene.hash);
  json.key("seed").value(scene.seed).key("until_s").value(scene.time.until);
  json.key("frames").value(data.frames).key("frames_of_run").value(run.frames.size());
  json.key("floes").value(data.floes).key("floes_of_run").value(run.floes.size());
  if (const auto& area = selection.area)
    json.key("area_m").list(std::array{area->low.x, area->low.y, area->high.x, area->high.y});
  json.key("forces_interval_s").value(recording_interval(scene));
  json.key("splits_by_j_over_tau_c").value(splits_by_j_over_tau_c(scene));
  write_summary(json, run);
  write_steps(json, run);
  write_ships(json, scene);
  write_events(json, run, held);
  const simulation::ShearSettings& shear = scene.water.shear;
  json.key("water").open('{').key("shear_per_s").value(shear.rate).key("shear_origin_m").value(shear.origin);
  json.key("shear_direction_rad").value(shear.direction);
  write_drift(json, scene);
  json.close('}');
  write_patterns(json, scene);
  write_force_columns(json, scene);
  write_force_causes(json, scene);
  json.key("columns").objects(data.columns.table(), [&](const ColumnWriter::Column& column) {
    json.key("name").value(column.name).key("type").value(column.type);
    json.key("offset").value(column.offset).key("count").value(column.count);
  });
  json.close('}');
  return text;
}

}  // namespace

PlayerData player_data(const io::Run& run, const PlayerSelection& selection) {
  PlayerData data;
  std::vector<io::Frame> frames = thinned_frames(run, selection.frames);
  const HeldFloes held(selection.area ? family_distances(run, *selection.area, frames)
                                      : std::vector<double>(run.floes.size(), 0));
  data.floes = held.ids().size();
  add_floes(data.columns, run, held);
  data.floe_bytes = data.columns.bytes().size();
  data.frames = frames.size();
  if (!frames.empty()) data.start = frames.front().time, data.end = frames.back().time;
  std::string bytes = io::FrameEncoder::header();
  for (io::Frame& frame : frames) {
    std::erase_if(frame.floes, [&](const io::FloeMotion& record) { return !held.has(record.floe); });
    bytes += frame_bytes(frame.time, frame.ships, frame.floes);
  }
  data.columns.add("frames", bytes);
  data.frame_bytes = data.columns.bytes().size() - data.floe_bytes;
  add_forces(data.columns, run, selection.frames);
  add_contacts(data.columns, run, frames, held);
  add_peaks(data.columns, run, frames);
  add_channels(data.columns, run, frames);
  data.info = info_of(run, data, selection, held);
  return data;
}

}  // namespace polynya::views
