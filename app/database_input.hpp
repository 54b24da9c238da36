#pragma once

#include <memory>
#include <string>

#include <tl/expected.hpp>

#include "app/database.hpp"
#include "app/exit_code.hpp"
#include "fracture/bending/bending_model.hpp"
#include "fracture/bending/database.hpp"

namespace polynya::app {

/// The database of that file, or the shipped one for an empty name. Where the file cannot be read or is not a
/// database of this version, it has been told on stderr, and the code is kInputOutput.
tl::expected<std::shared_ptr<const fracture::BendingDatabase>, ExitCode> load_database(
    const std::string& file);

/// "the one that ships with Polynya", or the file's name.
std::string database_title(const std::string& file);

/// The load, with c_V from the hull's angle, the friction and the slip. Where the options contradict each
/// other it has been told on stderr.
tl::expected<fracture::BendingLoad, ExitCode> bending_load(const DatabaseLoadOptions& options);

/// One line: "0.5 m of ice, 90 deg wedge, hull 60 deg from the vertical, v_n 1 m/s".
std::string describe(const fracture::BendingLoad& load);

/// As many threads as asked, or for 0 as many as the machine runs at once.
int thread_count(int asked);

}  // namespace polynya::app
