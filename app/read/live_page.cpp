#include "app/read/live_page.hpp"

#include <cstdlib>
#include <filesystem>
#include <optional>

#include <fmt/format.h>

#include "io/text/json_writer.hpp"

namespace polynya::app {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kMark = "{{own}}";                   ///< mark in the page that is replaced by the scene
constexpr std::uint64_t kLongestPage = std::uint64_t{1} << 26;  ///< [bytes]

std::optional<fs::path> page_file() {
  if (const char* named = std::getenv("POLYNYA_LIVE_PAGE"); named && *named) return named;
  std::error_code error;
  const fs::path above = fs::read_symlink("/proc/self/exe", error).parent_path().parent_path();
  for (const fs::path& place : {above / "lib/polynya/live.html", above.parent_path() / "browser/polynya.template.html"})
    if (fs::is_regular_file(place, error)) return place;
  return {};
}

}  // namespace

io::Result<std::string> live_page(std::string_view scene) {
  const auto file = page_file();
  if (!file)
    return io::fail(
        "the page with the simulator is not built: ./setup.sh browser && cmake --build --preset browser makes it in "
        "build/browser, and POLYNYA_LIVE_PAGE names it elsewhere");
  auto page = io::read_text_file(*file, kLongestPage);
  if (!page) return io::fail(fmt::format("{}: {}", file->string(), page.error()));
  const std::size_t at = page->find(kMark);
  if (at == std::string::npos) return io::fail(file->string() + ": no page of polynya's with a place for a scene");
  std::string json, in_script;
  io::JsonWriter(json).value(scene);
  for (const char c : json) c == '<' ? in_script += "\\u003c" : in_script += c;
  page->replace(at, kMark.size(), in_script);
  return *std::move(page);
}

}  // namespace polynya::app
