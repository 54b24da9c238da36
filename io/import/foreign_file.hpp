#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

#include "io/text/result.hpp"

namespace polynya::io {

/// A file of floes that GDAL reads for us. In the order of name_of().
enum class ForeignFormat { kShapefile, kGeoPackage, kFlatGeobuf };
std::string_view name_of(ForeignFormat format);

/// By how a file begins. None where it is of none of these formats, or cannot be read.
std::optional<ForeignFormat> foreign_format(const std::filesystem::path& file);

/// The file as GeoJSON with a crs member where it has a system, by GDAL's ogr2ogr, run as a child process.
/// `layer` is empty where the file has one. Coordinates in a system that ogr2ogr does not name are converted
/// to longitude and latitude (OGC:CRS84). Fails where ogr2ogr is not installed, with what ogr2ogr reports, or
/// where the text would be longer than `longest` [bytes].
Result<std::string> read_foreign_file(const std::filesystem::path& file, ForeignFormat format, const std::string& layer,
                                      std::size_t longest);

}  // namespace polynya::io
