#include "io/import/foreign_file.hpp"

#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <system_error>
#include <vector>

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

namespace polynya::io {
namespace {

constexpr const char* kConverter = "ogr2ogr";

/// What a program wrote, and how it ended.
struct ChildOutput {
  std::string out;
  std::string err;
  int code = 0;  ///< as a shell has it: 128 + signal where one ended it
};

/// Both ends of a pipe, closed with it.
class Pipe {
 public:
  Pipe() { is_open_ = pipe2(ends_.data(), O_CLOEXEC) == 0; }
  ~Pipe() {
    close_end(0);
    close_end(1);
  }
  Pipe(const Pipe&) = delete;
  Pipe& operator=(const Pipe&) = delete;
  bool is_open() const { return is_open_; }
  int end(int which) const { return ends_[which]; }
  void close_end(int which) {
    if (ends_[which] >= 0) close(ends_[which]);
    ends_[which] = -1;
  }

 private:
  std::array<int, 2> ends_{-1, -1};
  bool is_open_ = false;
};

int spawn(const std::vector<std::string>& words, const Pipe& out, const Pipe& err, pid_t& child) {
  std::vector<std::string> copies = words;
  std::vector<char*> arguments;
  arguments.reserve(copies.size() + 1);
  for (std::string& word : copies) arguments.push_back(word.data());
  arguments.push_back(nullptr);
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_addopen(&actions, 0, "/dev/null", O_RDONLY, 0);
  posix_spawn_file_actions_adddup2(&actions, out.end(1), 1);
  posix_spawn_file_actions_adddup2(&actions, err.end(1), 2);
  const int error = posix_spawnp(&child, arguments[0], &actions, nullptr, arguments.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  return error;
}

/// Reads both pipes to their ends; false where there is too much to read.
bool drain(Pipe& out, Pipe& err, std::size_t longest, ChildOutput& output) {
  std::array<pollfd, 2> open{{{out.end(0), POLLIN, 0}, {err.end(0), POLLIN, 0}}};
  std::array<std::string*, 2> texts{&output.out, &output.err};
  while (open[0].fd >= 0 || open[1].fd >= 0) {
    if (poll(open.data(), open.size(), -1) < 0 && errno != EINTR) return true;
    for (std::size_t i = 0; i < open.size(); ++i) {
      if (open[i].fd < 0 || open[i].revents == 0) continue;
      char block[1 << 16];
      const ssize_t count = read(open[i].fd, block, sizeof block);
      if (count < 0 && errno == EINTR) continue;
      if (count <= 0) {
        open[i].fd = -1;
        continue;
      }
      texts[i]->append(block, static_cast<std::size_t>(count));
      if (texts[i]->size() > longest) return false;
    }
  }
  return true;
}

/// Runs a program of the search path with these words, the first of which is its name, without a shell and
/// with nothing on stdin. Fails where it is not there, or where it writes more than `longest` bytes.
Result<ChildOutput> run_child(const std::vector<std::string>& words, std::size_t longest) {
  Pipe out, err;
  if (!out.is_open() || !err.is_open()) return fail(std::strerror(errno));
  pid_t child = 0;
  if (const int error = spawn(words, out, err, child); error != 0)
    return fail(fmt::format("{}: {}", words[0], std::strerror(error)));
  out.close_end(1);
  err.close_end(1);
  ChildOutput output;
  const bool is_whole = drain(out, err, longest, output);
  if (!is_whole) kill(child, SIGKILL);
  int status = 0;
  while (waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  if (!is_whole) return fail(fmt::format("{} wrote more than the {} bytes allowed", words[0], longest));
  output.code = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  if (output.code == 127) return fail(fmt::format("{}: not found", words[0]));
  return output;
}

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
