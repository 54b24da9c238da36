#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "app/progress.hpp"
#include "fracture/bending/solver_settings.hpp"
#include "fracture/materials.hpp"

namespace polynya::app {

/// `polynya database …`: the icebreaking database made, shown, asked and studied.

struct DatabaseBuildOptions {
  std::string out = "icebreaking-database.txt";
  fracture::FluidModel fluid = fracture::FluidModel::kPotential;
  std::vector<double> wedge_angles_deg;  ///< 2α; empty: the shipped database's
  int threads = 0;                       ///< 0: as many as the machine runs at once
  ProgressKind progress = ProgressKind::kAuto;
  bool overwrite = false;
};
int database_build(const DatabaseBuildOptions& options);

inline constexpr double kUsualWedgeAngle = 90;  ///< where none is asked for [deg]

/// A wedge of floating ice and the hull that comes at it, as the command line says it.
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

struct DatabaseShowOptions {
  std::string file;        ///< empty: the shipped one
  std::string svg_folder;  ///< empty: no pictures
  DatabaseLoadOptions load;
};
int database_show(const DatabaseShowOptions& options);

struct DatabaseQueryOptions {
  std::string file;  ///< empty: the shipped one
  DatabaseLoadOptions load;
  bool json = false;
};
int database_query(const DatabaseQueryOptions& options);

enum class DatabaseStudy { kFluid, kCouple, kAccuracy };

struct DatabaseStudyOptions {
  DatabaseStudy study = DatabaseStudy::kFluid;
  std::string file;  ///< empty: the shipped one
  DatabaseLoadOptions load;
  int points = 200;               ///< kAccuracy
  std::uint64_t seed = 20170611;  ///< kAccuracy
  std::optional<double>
      inner_radius;             ///< kAccuracy, of the solution compared with [l]; a quarter of the table's
  std::optional<int> elements;  ///< kAccuracy, along its radius; as closely spaced as the table's
  int threads = 0;              ///< kAccuracy; 0: as many as the machine runs at once
};
int database_study(const DatabaseStudyOptions& options);

}  // namespace polynya::app
