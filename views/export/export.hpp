#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "io/import/plane.hpp"
#include "io/run/run_reader.hpp"
#include "io/text/json_writer.hpp"

namespace polynya::views {

/// One VTK PolyData as XML (.vtp), numbers in base64: vertices, lines and triangles in the plane z = 0.
struct VtkPolyData {
  explicit VtkPolyData(double at = 0) : time(at) {}

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
  double time;                     ///< [s], as field data TimeValue
};

std::string to_vtp(const VtkPolyData& data);

/// A file of a collection over time (.pvd).
struct VtkFile {
  double time = 0;  ///< [s]
  int part = 0;
  std::string name;
};
std::string to_pvd(const std::vector<VtkFile>& files);

struct VtkExport {
  std::size_t frames = 0;
  std::vector<simulation::FloeId> only_outlines;  ///< floes of a damaged run whose rings bound no area
};

/// Writes a run for ParaView (docs/export.md): run.pvd, and for each selected frame the ice, the ships, their
/// loads and the contacts. The error names the file.
io::Result<VtkExport> export_vtk(const io::Run& run, const io::FrameSelection& selection,
                                 const std::filesystem::path& folder);

/// In which coordinates the layers of a run are written.
struct LayerPlane {
  std::string system;  ///< a coordinate system, "OGC:CRS84" or "EPSG:3413"; empty: metres of the scene's plane
  double tolerance = io::kEdgeTolerance;  ///< as in an import (io/import/plane.hpp) [m]
};

/// The layers of a run at a time as GeoJSON FeatureCollections: floes, fractures up to then, and for each ship its
/// track and its hull. Returns the names of files with their text. In a system, which the scene needs an origin for,
/// edges get points where they are not straight there; in degrees longitudes run on past 180, so that no floe is torn,
/// and a floe over a pole has a seam to it (io/import/degrees.hpp).
io::Result<std::vector<std::pair<std::string, std::string>>> geojson_layers(const io::Run& run, double time,
                                                                            const LayerPlane& plane);

/// A scene that continues a run from one of its instants.
struct ContinuedScene {
  double time = 0;  ///< of the frame that it continues from [s]
  /// scene.json and floes.geojson, which it names.
  std::vector<std::pair<std::string, std::string>> files;
  std::vector<std::string> left_out;  ///< what of the run's state they do not have, in words
};

/// The scene of a run as it stands at the last frame up to a time: its ships and floes where they are, with
/// their velocities, lineage and thickness, everything else as in the run's scene.json. The clock starts at
/// 0.
io::Result<ContinuedScene> continued_scene(const io::Run& run, double time);

}  // namespace polynya::views
