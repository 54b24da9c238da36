#pragma once

#include <memory>
#include <optional>
#include <string>

#include <tl/expected.hpp>

#include "app/command_line/command_line.hpp"
#include "app/command_line/console.hpp"
#include "fracture/bending/bending_model.hpp"
#include "fracture/bending/database.hpp"
#include "fracture/materials.hpp"

namespace polynya::app {

/// What the commands of `polynya database` share: the wedge of ice, the database, threads.

inline constexpr double kUsualWedgeAngle = 90;  ///< where none is given [deg]

/// A wedge of floating ice and the hull that meets it, by the command line.
struct DatabaseLoadOptions {
  fracture::Ice ice;
  fracture::Water water;
  double speed = 1;                       ///< v_n, normal to the hull's waterline [m/s]
  double slip_speed = 0;                  ///< v_t, along it [m/s]
  std::optional<double> wedge_angle_deg;  ///< 2α, halved for the two edges
  std::optional<double> front_angle_deg;  ///< θ_wf
  std::optional<double> back_angle_deg;   ///< θ_wb
  double hull_angle_deg = 60;             ///< θ_s, from the vertical
};
/// The options of the ice, the water and the hull; defaults are the paper's.
void add_load(CommandLine& command, DatabaseLoadOptions& load);
/// Those of the load's size and speed, required or with the defaults of a slice.
void add_point(CommandLine& command, DatabaseLoadOptions& load, bool is_required);
/// --database and --threads.
void add_database_file(CommandLine& command, std::string& file);
void add_threads(CommandLine& command, int& threads);

/// The database of that file, or the shipped one for an empty name. Reports on stderr why a file cannot be
/// read or is not a database of this version; the code is then kInputOutput.
tl::expected<std::shared_ptr<const fracture::BendingDatabase>, ExitCode> load_database(const std::string& file);

/// "the one that ships with Polynya", or the file's name.
std::string database_title(const std::string& file);

/// The load, with c_V from the hull's angle, the friction and the slip. Reports on stderr where the options
/// contradict each other.
tl::expected<fracture::BendingLoad, ExitCode> bending_load(const DatabaseLoadOptions& options);

/// One line: "0.5 m of ice, 90 deg wedge, hull 60 deg from the vertical, v_n 1 m/s".
std::string describe(const fracture::BendingLoad& load);

Command add_database_query(CommandLine& app);
Command add_database_show(CommandLine& app);

/// As many threads as given, or for 0 as many as the machine runs at once.
int thread_count(int asked);

}  // namespace polynya::app
