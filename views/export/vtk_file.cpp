#include "views/export/vtk_file.hpp"

#include <cmath>

#include <fmt/format.h>

#include "io/text/encoding.hpp"
#include "io/text/json_writer.hpp"
#include "simulation/state/archive.hpp"

namespace polynya::views {
namespace {

using Cells = std::vector<std::vector<std::int64_t>>;

/// A DataArray: its length in bytes and its bytes as one stream of base64 (VTK seeks in it as in one).
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
      "<?xml version=\"1.0\"?>\n<VTKFile type=\"PolyData\" version=\"1.0\" "
      "byte_order=\"LittleEndian\" "
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

std::string to_pvd(const VtkTimeline& timeline) {
  std::string text =
      "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"0.1\" "
      "byte_order=\"LittleEndian\">\n<Collection>\n";
  for (const VtkTimeline::Entry& entry : timeline.entries)
    text += fmt::format("<DataSet timestep=\"{}\" part=\"{}\" file=\"{}\"/>\n", number(entry.time), entry.part,
                        io::escaped(entry.file));
  return text + "</Collection>\n</VTKFile>\n";
}

}  // namespace polynya::views
