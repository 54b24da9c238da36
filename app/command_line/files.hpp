#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include <tl/expected.hpp>

#include "app/command_line/progress.hpp"
#include "io/run/run_reader.hpp"
#include "io/text/source_text.hpp"

namespace polynya::app {

/// The whole of a file, or of stdin where its name is "-", or what is wrong with it in words. What is longer
/// than `longest` bytes is refused, and a named pipe, but for those that the shell makes (`<(command)`).
tl::expected<std::string, std::string> read_input(const std::string& file, std::size_t longest);

/// What an input is called in messages: the file's name, or "stdin".
std::string input_name(const std::string& file);

/// A run's folder, with its progress on stderr (io/run/run_reader.hpp).
io::Result<io::Run> read_run(const std::string& folder, ProgressKind progress);

/// Whether the name means the program's own stdout: "-", "/dev/stdout", or the file that stdout goes to.
bool is_stdout(const std::string& file);

/// Writes to a name that a user gave: to a file, or into a pipe, a device or the program's own stdout or
/// stderr, whose failures close_streams() reports.
io::Result<> write_output(const std::string& file, const std::string& text);

/// Makes a folder that a user named, with those above it.
io::Result<> make_folder(const std::filesystem::path& folder);

/// Writes what a command makes of a run: into the folder `out` that a user named, which is made where it is
/// missing, or where that is empty into the run's, where links are not followed.
io::Result<> write_product(const std::string& out, const std::string& run, std::string_view name,
                           const std::string& text);

}  // namespace polynya::app
