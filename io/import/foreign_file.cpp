#include "io/import/foreign_file.hpp"

#include <algorithm>
#include <array>
#include <cstdio>
#include <system_error>
#include <vector>

#include <fmt/format.h>

#include "io/text/child_process.hpp"

namespace polynya::io {
namespace {

constexpr const char* kConverter = "ogr2ogr";

/// GDAL's reason among its warnings: the first line that is one, without the list of drivers it tried.
std::string reason_in(const std::string& text) {
  for (std::size_t start = 0; start < text.size();) {
    const std::size_t end = std::min(text.find('\n', start), text.size());
    const std::string line = text.substr(start, end - start);
    if (line.starts_with("ERROR") || line.starts_with("Unable"))
      return line.substr(0, line.find(" with the following"));
    start = end + 1;
  }
  return text.substr(0, text.find('\n'));
}

Result<ChildOutput> convert(const std::filesystem::path& file, ForeignFormat format, const std::string& layer,
                            bool to_degrees, std::size_t longest) {
  std::vector<std::string> words{kConverter, "-f", "GeoJSON", "-lco", "RFC7946=NO", "-lco", "COORDINATE_PRECISION=15",
                                 "-dim",     "XY"};
  if (to_degrees) words.insert(words.end(), {"-t_srs", "OGC:CRS84"});
  words.insert(words.end(), {"/vsistdout/", std::filesystem::absolute(file).string()});
  if (!layer.empty()) words.push_back(layer);
  auto output = run_child(words, longest);
  if (output) return output;
  if (output.error().starts_with(std::string(kConverter) + " wrote")) return output;
  return fail(
      fmt::format("a {} is read by GDAL's ogr2ogr, which is not there ({}): apt-get install gdal-bin, "
                  "or convert the file to GeoJSON elsewhere",
                  name_of(format), output.error()));
}

}  // namespace

std::string_view name_of(ForeignFormat format) {
  constexpr std::string_view kNames[] = {"shapefile", "GeoPackage", "FlatGeobuf file"};
  return kNames[static_cast<std::size_t>(format)];
}

std::optional<ForeignFormat> foreign_format(const std::filesystem::path& file) {
  std::array<char, 16> bytes{};
  std::error_code error;
  if (!std::filesystem::is_regular_file(file, error)) return {};  // opening a pipe would wait for its writer
  std::FILE* const stream = std::fopen(file.c_str(), "rb");
  if (!stream) return {};
  const std::size_t count = std::fread(bytes.data(), 1, bytes.size(), stream);
  std::fclose(stream);
  const std::string_view begin(bytes.data(), count);
  using namespace std::string_view_literals;
  if (begin.starts_with("\x00\x00\x27\x0a"sv)) return ForeignFormat::kShapefile;
  if (begin.starts_with("SQLite format 3"sv)) return ForeignFormat::kGeoPackage;
  if (begin.starts_with("fgb\x03"sv)) return ForeignFormat::kFlatGeobuf;
  return {};
}

Result<std::string> read_foreign_file(const std::filesystem::path& file, ForeignFormat format, const std::string& layer,
                                      std::size_t longest) {
  auto output = convert(file, format, layer, false, longest);
  if (!output) return fail(output.error());
  if (output->code != 0 || output->out.empty()) {
    const std::string reason = reason_in(output->err);
    return fail(fmt::format("ogr2ogr could not read it: {}",
                            reason.empty() ? fmt::format("it ended with code {}", output->code) : reason));
  }
  // ogr2ogr writes no system that has no code, and of a GeoPackage not WGS 84 either: where the layer has
  // one, it can convert from it. Without one it fails.
  const std::string_view head = std::string_view(output->out).substr(0, output->out.find("\"features\":"));
  if (head.find("\"crs\":") != std::string_view::npos) return std::move(output->out);
  auto in_degrees = convert(file, format, layer, true, longest);
  if (!in_degrees || in_degrees->code != 0 || in_degrees->out.empty()) return std::move(output->out);
  std::string& text = in_degrees->out;
  if (text.substr(0, text.find("\"features\":")).find("\"crs\":") == std::string::npos)
    text.insert(text.find('{') + 1, R"("crs": {"type": "name", "properties": {"name": "OGC:CRS84"}},)");
  return std::move(text);
}

}  // namespace polynya::io
