#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <limits>
#include <map>
#include <numbers>
#include <set>

#include <fmt/format.h>

#include "geometry/shape/outline.hpp"
#include "io/import/floe_properties.hpp"
#include "io/run/run_reader.hpp"
#include "io/text/json_writer.hpp"
#include "io/text/output_file.hpp"
#include "simulation/state/archive.hpp"
#include "views/export/export.hpp"

namespace polynya::views {
namespace {

using Cells = std::vector<std::vector<std::int64_t>>;

/// Returns a DataArray: its length in bytes and its bytes as one stream of base64, as VTK requires.
template <class Value>
std::string data_array(const std::string& name, const std::vector<Value>& values, int components) {
  simulation::ByteWriter bytes;
  bytes(std::uint64_t{values.size() * sizeof(Value)});
  for (const Value value : values) bytes(value);
  return fmt::format("<DataArray type=\"{}\" Name=\"{}\" NumberOfComponents=\"{}\" format=\"binary\">{}</DataArray>\n",
                     std::is_same_v<Value, double> ? "Float64" : "Int64", io::escaped(name), components,
                     io::to_base64(bytes.take()));
}

std::string cells_element(const char* element, const Cells& cells) {
  std::vector<std::int64_t> connectivity, offsets;
  for (const auto& cell : cells) {
    connectivity.insert(connectivity.end(), cell.begin(), cell.end());
    offsets.push_back(static_cast<std::int64_t>(connectivity.size()));
  }
  return fmt::format("<{0}>\n{1}{2}</{0}>\n", element, data_array("connectivity", connectivity, 1),
                     data_array("offsets", offsets, 1));
}

std::string column_element(const VtkPolyData::Column& column) {
  if (!column.is_integer) return data_array(column.name, column.values, column.components);
  std::vector<std::int64_t> values;
  for (const double value : column.values) values.push_back(std::llround(value));
  return data_array(column.name, values, column.components);
}

std::string columns_element(const char* element, const std::vector<VtkPolyData::Column>& columns) {
  std::string text = fmt::format("<{}>\n", element);
  for (const VtkPolyData::Column& column : columns) text += column_element(column);
  return text + fmt::format("</{}>\n", element);
}

std::string number(double value) {
  std::string text;
  io::append_number(text, value);
  return text;
}

}  // namespace

std::string to_vtp(const VtkPolyData& data) {
  std::vector<double> coordinates;
  for (const geometry::Point p : data.points) coordinates.insert(coordinates.end(), {p.x, p.y, 0.0});
  std::string text =
      "<?xml version=\"1.0\"?>\n<VTKFile type=\"PolyData\" version=\"1.0\" byte_order=\"LittleEndian\" "
      "header_type=\"UInt64\">\n<PolyData>\n";
  text += fmt::format(
      "<FieldData>\n<DataArray type=\"Float64\" Name=\"TimeValue\" NumberOfTuples=\"1\" format=\"ascii\">{}"
      "</DataArray>\n</FieldData>\n",
      number(data.time));
  text += fmt::format(
      "<Piece NumberOfPoints=\"{}\" NumberOfVerts=\"{}\" NumberOfLines=\"{}\" NumberOfStrips=\"0\" "
      "NumberOfPolys=\"{}\">\n",
      data.points.size(), data.vertices.size(), data.lines.size(), data.polygons.size());
  text += "<Points>\n" + data_array("Points", coordinates, 3) + "</Points>\n";
  text += cells_element("Verts", data.vertices) + cells_element("Lines", data.lines) +
          cells_element("Polys", data.polygons);
  text += columns_element("PointData", data.point_data) + columns_element("CellData", data.cell_data);
  return text + "</Piece>\n</PolyData>\n</VTKFile>\n";
}

std::string to_pvd(const std::vector<VtkFile>& files) {
  std::string text =
      "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"0.1\" "
      "byte_order=\"LittleEndian\">\n<Collection>\n";
  for (const VtkFile& file : files)
    text += fmt::format("<DataSet timestep=\"{}\" part=\"{}\" file=\"{}\"/>\n", number(file.time), file.part,
                        io::escaped(file.name));
  return text + "</Collection>\n</VTKFile>\n";
}

namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

using Column = VtkPolyData::Column;

/// Appends a row to a table: one value for each column, three for a vector.
void add_row(std::vector<Column>& columns, std::initializer_list<double> values) {
  const double* value = values.begin();
  for (Column& column : columns) {
    column.values.insert(column.values.end(), value, value + column.components);
    value += column.components;
  }
}

/// Collects the cells of floes: their rings as lines, and their triangles.
class IceExport {
 public:
  explicit IceExport(const io::Run& run) : run_(run), motions_(run) {}

  /// Returns the floating ice at a time [s], or the ice under hulls.
  VtkPolyData at(double time, bool is_under_hulls) {
    VtkPolyData data(time);
    const std::vector<io::PlacedFloe> floes =
        is_under_hulls ? floes_under_hulls_at(run_, motions_, time) : floes_at(run_, motions_, time);
    std::erase_if(triangles_,
                  [&](const auto& of) { return !run_.is_alive(of.first, time) && !run_.is_under(of.first, time); });
    std::vector<std::int64_t> first_point;
    for (const io::PlacedFloe& floe : floes) {
      first_point.push_back(static_cast<std::int64_t>(data.points.size()));
      add_rings(data, transform(floe.world_from_body, *floe.polygon_in_body));
    }
    data.cell_data = {{"floe_id", {}, 1, true},        {"parent_id", {}, 1, true},         {"generation", {}, 1, true},
                      {"born_s", {}, 1, false},        {"area_m2", {}, 1, false},          {"mass_kg", {}, 1, false},
                      {"speed_m_per_s", {}, 1, false}, {"velocity_m_per_s", {}, 3, false}, {"is_outline", {}, 1, true},
                      {"came_up", {}, 1, true}};
    for (const io::FloeProperty& property : io::floe_ice_properties())
      data.cell_data.push_back({std::string(property.key), {}, 1, false});
    for (const io::PlacedFloe& floe : floes) {
      for (std::size_t ring = 0; ring <= floe.polygon_in_body->holes.size(); ++ring) add_cell(data, floe, true);
    }
    for (std::size_t i = 0; i < floes.size(); ++i) {
      for (const geometry::Triangle& triangle : triangles_of(floes[i])) {
        data.polygons.push_back(
            {first_point[i] + triangle[0], first_point[i] + triangle[1], first_point[i] + triangle[2]});
        add_cell(data, floes[i], false);
      }
    }
    return data;
  }

  /// Floes whose rings enclose no area; only their outlines are exported.
  const std::set<simulation::FloeId>& without_triangles() const { return without_triangles_; }

 private:
  /// Returns the triangles of a floe. Each shape is triangulated once, in its body frame, in which it is exact.
  const std::vector<geometry::Triangle>& triangles_of(const io::PlacedFloe& floe) {
    auto& triangles = triangles_[floe.birth->floe];
    if (triangles.empty()) triangles = geometry::triangulate(*floe.polygon_in_body);
    if (triangles.empty()) without_triangles_.insert(floe.birth->floe);
    return triangles;
  }

  static void add_rings(VtkPolyData& data, const geometry::Polygon& polygon) {
    const auto add = [&](const geometry::Ring& ring) {
      std::vector<std::int64_t> line;
      for (const geometry::Point p : ring) {
        line.push_back(static_cast<std::int64_t>(data.points.size()));
        data.points.push_back(p);
      }
      line.push_back(line.front());
      data.lines.push_back(std::move(line));
    };
    add(polygon.outer);
    std::ranges::for_each(polygon.holes, add);
  }

  void add_cell(VtkPolyData& data, const io::PlacedFloe& floe, bool is_outline) const {
    const simulation::BirthRecord& birth = *floe.birth;
    const geometry::Vector velocity = floe.motion ? floe.motion->velocity : geometry::Vector{kNan, kNan};
    const fracture::Ice& ice = ice_of(run_.scene.scene, birth.own_ice);
    add_row(data.cell_data,
            {static_cast<double>(birth.floe), static_cast<double>(birth.parent), static_cast<double>(birth.generation),
             birth.time, birth.area, birth.mass, length(velocity), velocity.x, velocity.y, 0.0, is_outline ? 1.0 : 0.0,
             run_.floe(birth.floe)->came_up ? 1.0 : 0.0, ice.thickness, ice.density, ice.flexural_strength,
             ice.compressive_strength, ice.tensile_strength, ice.fracture_toughness});
  }

  const io::Run& run_;
  io::MotionIndex motions_;
  std::map<simulation::FloeId, std::vector<geometry::Triangle>> triangles_;
  std::set<simulation::FloeId> without_triangles_;
};

/// Returns the waterline of each ship as a polygon, with its motion at the time [s].
VtkPolyData ships_at(const io::Run& run, const io::MotionIndex& motions, double time) {
  VtkPolyData data(time);
  data.cell_data = {{"ship", {}, 1, true}, {"velocity_m_per_s", {}, 3, false}, {"heading_deg", {}, 1, false}};
  for (std::size_t ship = 0; ship < hull_count(run.scene.scene); ++ship) {
    const auto& waterline = hull_of(run.scene.scene, ship).hull.waterline;
    const geometry::Pose pose = ship_pose_at(run, motions, ship, time);
    const auto first = static_cast<std::int64_t>(data.points.size());
    const geometry::Ring ring = transform(pose, waterline);
    data.points.insert(data.points.end(), ring.begin(), ring.end());
    for (const geometry::Triangle& t : geometry::triangulate({waterline, {}})) {
      data.polygons.push_back({first + t[0], first + t[1], first + t[2]});
      const auto motion = motions.ship_at(ship, time);
      const geometry::Vector velocity = motion ? motion->velocity : geometry::Vector{kNan, kNan};
      add_row(data.cell_data, {static_cast<double>(ship), velocity.x, velocity.y, 0.0,
                               motion ? motion->angle * 180 / std::numbers::pi : kNan});
    }
  }
  return data;
}

/// Number of a fracture in the column `kind` of the loads; ships have 0.
int number_of(const simulation::Event& fracture) {
  if (fracture.is<simulation::Bend>()) return 1;
  return fracture.is<simulation::Split>() ? 2 : 3;
}

/// A ship with its ice load, or a fracture with the force that caused it.
struct LoadVertex {
  geometry::Point at;
  int kind = 0;
  int ship = 0;
  simulation::FloeId floe = simulation::kNoFloe;
  double time = 0;
  geometry::Vector force;
  double moment = 0;
  geometry::Vector collision;
};

/// Returns the ice loads of the recording interval that ends at `time` [s], as a vertex at the centre of each ship, and
/// the fractures since the frame at `after` [s], as a vertex where each happened.
VtkPolyData loads_at(const io::Run& run, double after, double time) {
  VtkPolyData data(time);
  data.cell_data = {{"kind", {}, 1, true},           {"ship", {}, 1, true},     {"floe_id", {}, 1, true},
                    {"t_s", {}, 1, false},           {"force_N", {}, 3, false}, {"yaw_moment_Nm", {}, 1, false},
                    {"j_over_tau_c_N", {}, 3, false}};
  const auto add = [&](const LoadVertex& vertex) {
    data.vertices.push_back({static_cast<std::int64_t>(data.points.size())});
    data.points.push_back(vertex.at);
    const geometry::Vector force = vertex.force, collision = vertex.collision;
    add_row(data.cell_data,
            {static_cast<double>(vertex.kind), static_cast<double>(vertex.ship), static_cast<double>(vertex.floe),
             vertex.time, force.x, force.y, 0.0, vertex.moment, collision.x, collision.y, 0.0});
  };
  std::vector<const simulation::HullSample*> last(hull_count(run.scene.scene), nullptr);
  const auto until = std::ranges::upper_bound(run.samples, time + 1e-9, {}, &simulation::HullSample::time);
  for (auto sample = until; sample != run.samples.begin();) {
    --sample;
    if (sample->time < time - run.scene.scene.record.forces_interval - 1e-9) break;
    const auto ship = static_cast<std::size_t>(sample->ship);
    if (ship < last.size() && !last[ship]) last[ship] = &*sample;
  }
  for (const simulation::HullSample* s : last) {
    if (!s) continue;
    const auto world_from_ship = geometry::Rotation::by(s->heading);
    add({.at = s->position_in_world,
         .ship = s->ship,
         .time = s->time,
         .force = rotate(world_from_ship, {s->from_ice.surge, s->from_ice.sway}),
         .moment = s->from_ice.yaw,
         .collision = rotate(world_from_ship, {s->collision.surge, s->collision.sway})});
  }
  for (const simulation::Event& event : run.events) {
    if (!(event.time > after && event.time <= time) || !event.is_fracture()) continue;
    add({.at = event.point_in_world,
         .kind = number_of(event),
         .ship = event.ship,
         .floe = event.ice()->floe,
         .time = event.time,
         .force = {kNan, kNan},
         .moment = kNan,
         .collision = event.criteria().collision_force * event.ice()->normal_in_world});
  }
  return data;
}

/// Returns the contacts recorded at a frame as vertices. Their columns belong to points, because ParaView draws glyphs
/// at points.
VtkPolyData contacts_at(const io::Run& run, double time) {
  VtkPolyData data(time);
  data.point_data = {{"ship", {}, 1, true},       {"floe_id", {}, 1, true},  {"by_ship", {}, 1, true},
                     {"by_floe_id", {}, 1, true}, {"force_N", {}, 3, false}, {"depth_m", {}, 1, false},
                     {"is_crushing", {}, 1, true}};
  for (const io::RunContact& contact : run.contacts_at(time)) {
    const simulation::ContactState& state = contact.state;
    data.vertices.push_back({static_cast<std::int64_t>(data.points.size())});
    data.points.push_back(state.point_in_world);
    add_row(data.point_data, {static_cast<double>(state.on.ship), static_cast<double>(state.on.floe),
                              static_cast<double>(state.by.ship), static_cast<double>(state.by.floe), state.force.x,
                              state.force.y, 0.0, state.depth, state.is_crushing ? 1.0 : 0.0});
  }
  return data;
}

}  // namespace

io::Result<VtkExport> export_vtk(const io::Run& run, const io::FrameSelection& selection,
                                 const std::filesystem::path& folder) {
  IceExport ice(run);
  const io::MotionIndex motions(run);
  std::vector<VtkFile> files;
  double before = -std::numeric_limits<double>::infinity();
  std::size_t number = 0;
  for (const io::Frame& frame : thinned_frames(run, selection)) {
    std::vector<std::pair<const char*, VtkPolyData>> parts;
    parts.emplace_back("ice", ice.at(frame.time, false));
    parts.emplace_back("ships", ships_at(run, motions, frame.time));
    parts.emplace_back("loads", loads_at(run, before, frame.time));
    parts.emplace_back("contacts", contacts_at(run, frame.time));
    if (has_draught(run.scene.scene)) parts.emplace_back("under-hull", ice.at(frame.time, true));
    int part = 0;
    for (const auto& [name, data] : parts) {
      const std::string file = fmt::format("{}-{:05}.vtp", name, number);
      if (const auto written = io::write_named_file(folder / file, to_vtp(data)); !written)
        return io::fail(written.error());
      files.push_back({frame.time, part++, file});
    }
    before = frame.time;
    ++number;
  }
  if (const auto written = io::write_named_file(folder / "run.pvd", to_pvd(files)); !written)
    return io::fail(written.error());
  return VtkExport{number, {ice.without_triangles().begin(), ice.without_triangles().end()}};
}

}  // namespace polynya::views
