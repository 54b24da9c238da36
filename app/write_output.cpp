#include "app/write_output.hpp"

#include <sys/stat.h>
#include <unistd.h>

#include "app/console.hpp"
#include "io/text/output_file.hpp"

namespace polynya::app {
namespace {

bool is_open_as(const std::string& file, int descriptor) {
  struct stat named {
  }, opened{};
  return ::stat(file.c_str(), &named) == 0 && ::fstat(descriptor, &opened) == 0 &&
         named.st_dev == opened.st_dev && named.st_ino == opened.st_ino;
}

}  // namespace

bool is_stdout(const std::string& file) {
  return file == "-" || is_open_as(file, STDOUT_FILENO);
}

io::Result<> write_output(const std::string& file, const std::string& text) {
  // Replacing the file that a stream goes to would lose what else is written there.
  if (is_stdout(file))
    write_out(text);
  else if (is_open_as(file, STDERR_FILENO))
    write_err(text);
  else
    return io::write_named_file(file, text);
  return {};
}

io::Result<> make_folder(const std::filesystem::path& folder) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error) return io::fail(folder.string() + ": " + error.message());
  return {};
}

io::Result<> write_product(const std::string& out, const std::string& run, std::string_view name,
                           const std::string& text) {
  if (out.empty()) return io::write_whole_file(std::filesystem::path(run) / name, text);
  static_cast<void>(make_folder(out));  // writing reports what is wrong with it
  return write_output((std::filesystem::path(out) / name).string(), text);
}

}  // namespace polynya::app
