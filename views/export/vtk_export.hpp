#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include <tl/expected.hpp>

#include "geometry/shape/polygon.hpp"
#include "io/run/run_reader.hpp"

namespace polynya::views {

/// One VTK PolyData as XML (.vtp), numbers in base64: vertices, lines and triangles in the plane z = 0.
struct VtkPolyData {
  std::vector<geometry::Point> points;  ///< [m]
  /// Cells by the numbers of their points, in VTK's order: vertices, then lines, then polygons.
  std::vector<std::vector<std::int64_t>> vertices, lines, polygons;

  struct Column {
    std::string name;
    std::vector<double> values;
    int components = 1;  ///< 1, or 3 for vectors
    bool is_integer = false;
  };
  std::vector<Column> cell_data;   ///< a row a cell
  std::vector<Column> point_data;  ///< a row a point
  double time = 0;                 ///< [s], as field data TimeValue
};

std::string to_vtp(const VtkPolyData& data);

/// A collection of files over time (.pvd).
struct VtkTimeline {
  struct Entry {
    double time = 0;  ///< [s]
    int part = 0;
    std::string file;
  };
  std::vector<Entry> entries;
};
std::string to_pvd(const VtkTimeline& timeline);

struct VtkExport {
  std::size_t frames = 0;
  std::vector<simulation::FloeId> only_outlines;  ///< floes of a damaged run whose rings bound no area
};

/// Writes a run for ParaView (docs/export.md): run.pvd, and for each selected frame the ice, the ships, their
/// loads and the contacts. The error names the file.
tl::expected<VtkExport, std::string> export_vtk(const io::Run& run, const io::FrameSelection& selection,
                                                const std::filesystem::path& folder);

}  // namespace polynya::views
