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
    "3 or later: they are separate files so that you can replace them. polynya.dll, if it is there, has no GMP and no\n"
    "MPFR, but the runtime library of mingw-w64 and its winpthreads.\n";

}  // namespace

io::Result<std::string> pack_unit(const std::string& text, const io::LoadedScene& scene,
                                  const std::vector<UnitLibrary>& libraries) {
  io::ZipArchive archive;
  archive.add("modelDescription.xml", model_description(scene, interface_of(scene)));
  std::uint64_t size = text.size();
  for (const UnitLibrary& library : libraries) {
    const auto bytes = io::read_text_file(library.file, kLargestLibrary);
    if (!bytes) return io::fail(fmt::format("{}: {}", library.file.string(), bytes.error()));
    if (library.system == "win64" && !bytes->starts_with("MZ"))
      return io::fail(fmt::format("{}: not a library of Windows", library.file.string()));
    archive.add(fmt::format("binaries/{}/{}", library.system, library.name), *bytes);
    size += bytes->size();
  }
  if (size > io::ZipArchive::kLargest / 2)
    return io::fail(fmt::format("the unit would have {} bytes, allowed: {}", size, io::ZipArchive::kLargest / 2));
  archive.add(fmt::format("{}{}.json", kResources, scene.scene.name), text);
  archive.add("documentation/licenses.txt", kLicenses);
  return archive.bytes();
}

}  // namespace polynya::cosim
