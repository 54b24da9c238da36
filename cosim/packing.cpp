#include "cosim/packing.hpp"

#include "cosim/model_description.hpp"
#include "cosim/variables.hpp"
#include <fmt/format.h>

#include "io/text/zip_archive.hpp"

namespace polynya::cosim {
namespace {

namespace fs = std::filesystem;

/// Largest shared library that is packed [bytes]. A release build has some 3 MB, one for a sanitizer far more.
constexpr std::size_t kLargestLibrary = std::size_t{512} << 20;

constexpr auto kLicenses =
    "The library polynya.so has Polynya's code, and within it code of CGAL, Boost, Eigen, fmt, nlohmann::json and the\n"
    "GNU C++ library, each under its own licence. libgmp.so.10 and libmpfr.so.6 beside it are the GNU Multiple\n"
    "Precision Arithmetic Library and the GNU MPFR Library, both under the GNU Lesser General Public License, version\n"
    "3 or later: they are separate files so that you can replace them.\n";

}  // namespace

io::Result<std::string> pack_unit(const std::string& text, const io::LoadedScene& scene,
                                  const std::vector<fs::path>& libraries) {
  io::ZipArchive archive;
  archive.add("modelDescription.xml", model_description(scene, interface_of(scene)));
  std::uint64_t size = text.size();
  for (const fs::path& file : libraries) {
    const auto bytes = io::read_text_file(file, kLargestLibrary);
    if (!bytes) return io::fail(fmt::format("{}: {}", file.string(), bytes.error()));
    archive.add("binaries/linux64/" + file.filename().string(), *bytes);
    size += bytes->size();
  }
  if (size > io::ZipArchive::kLargest / 2)
    return io::fail(fmt::format("the unit would have {} bytes, allowed: {}", size, io::ZipArchive::kLargest / 2));
  archive.add(fmt::format("{}{}.json", kResources, scene.scene.name), text);
  archive.add("documentation/licenses.txt", kLicenses);
  return archive.bytes();
}

}  // namespace polynya::cosim
