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

/// A VTK PolyData, which is written as XML (.vtp) with numbers in base64. It has vertices, lines and triangles in the
/// plane z = 0.
struct VtkPolyData {
  explicit VtkPolyData(double at = 0) : time(at) {}  ///< empty data at the time `at` [s]

  std::vector<geometry::Point> points;  ///< in the world [m]
  /// Cells, each a list of indices of points. VTK numbers all vertices first, then lines, then polygons.
  std::vector<std::vector<std::int64_t>> vertices, lines, polygons;

  /// A named column of numbers for cells or points.
  struct Column {
    std::string name;            ///< name with its unit, as ParaView shows it: "area_m2"
    std::vector<double> values;  ///< the rows one after the other, `components` numbers each; NaN: not known
    int components = 1;          ///< 1, or 3 for vectors
    bool is_integer = false;     ///< values are rounded and written as Int64, otherwise as Float64
  };
  std::vector<Column> cell_data;   ///< columns with one row per cell, in VTK's order
  std::vector<Column> point_data;  ///< columns with one row per point
  double time;                     ///< time [s], which is written as the field data TimeValue
};

/// Returns the text of a .vtp file. Columns must have as many rows as there are cells or points; this is not checked.
std::string to_vtp(const VtkPolyData& data);

/// A file of a time series, as a .pvd file lists it.
struct VtkFile {
  double time = 0;   ///< [s]
  int part = 0;      ///< number that distinguishes the files of one time
  std::string name;  ///< path relative to the .pvd file
};
/// Returns the text of a .pvd file, by which ParaView opens all files of a series together.
std::string to_pvd(const std::vector<VtkFile>& files);

/// Result of an export.
struct VtkExport {
  std::size_t frames = 0;  ///< number of frames that were written; each has a .vtp file for each kind of data
  /// Floes of a damaged run whose rings enclose no area; only their outlines were exported.
  std::vector<simulation::FloeId> only_outlines;
};

/// Writes a run for ParaView (docs/export.md): run.pvd, and for each selected frame the ice, the ships, their loads and
/// the contacts, and in scenes with a draught the ice under hulls. The loads of a frame are those of the recording
/// interval that ends there, and the fractures since the selected frame before. `folder` must exist. Files of these
/// names are replaced. Those that a longer earlier export left stay, but run.pvd does not list them. The error names
/// the file that could not be written; the files before it stay.
io::Result<VtkExport> export_vtk(const io::Run& run, const io::FrameSelection& selection,
                                 const std::filesystem::path& folder);

/// Coordinates in which the layers of a run are written.
struct LayerPlane {
  /// Coordinate system that PROJ knows (io::find_crs), for example "OGC:CRS84"; empty: metres of the scene's plane.
  std::string system;
  /// Largest error of an edge [m], as in an import (io/import/plane.hpp). Smaller values add more points to edges; 0
  /// adds none. It is not used if `system` is empty.
  double tolerance = io::kEdgeTolerance;
};

/// Returns the layers of a run at a time [s] as GeoJSON FeatureCollections, each with its file name: floes, fractures
/// until then, the tracks, waterlines and channels of the ships, and in scenes with a draught the ice under hulls. A
/// coordinate system needs a scene with an origin; without one the call fails, as it does if PROJ does not know the
/// system. Points are added to edges that are not straight in it. In degrees, longitudes continue beyond 180 so that no
/// floe is divided, and a floe over a pole has a seam to the pole (io/import/degrees.hpp). Positions between two frames
/// are interpolated.
io::Result<std::vector<std::pair<std::string, std::string>>> geojson_layers(const io::Run& run, double time,
                                                                            const LayerPlane& plane);

/// A scene that continues a run from one of its frames.
struct ContinuedScene {
  double time = 0;  ///< time of the frame in the run [s]
  /// Contents of scene.json and of floes.geojson, which scene.json names.
  std::vector<std::pair<std::string, std::string>> files;
  std::vector<std::string> left_out;  ///< parts of the run's state that the files do not contain, in words
};

/// Returns a scene with the state of a run at its last frame up to a time [s], or at the start of the run if there is
/// none: ships, walls and floes have their places, velocities, lineage and ice properties at that frame. Pieces under
/// hulls are among the floes. At the end of the run the floes are those of final.geojson, which is exact, if the folder
/// has it; otherwise they are right within the tolerance of frames. The rest is as in the run's scene.json, but the
/// clock starts at 0, so the end time, the tables of pilots, drift and wind, and the tide are shifted. Fails if the run
/// has no frames.
io::Result<ContinuedScene> continued_scene(const io::Run& run, double time);

}  // namespace polynya::views
