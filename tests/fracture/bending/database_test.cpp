// The icebreaking database: its text, its accuracy, its trends, the input that it refuses, and the queries that it
// reports as outside its range.
#include "fracture/bending/database.hpp"

#include <cmath>
#include <numbers>
#include <random>
#include <string>

#include <gtest/gtest.h>

#include "bench/wedge_studies.hpp"
#include "fracture/bending/fsi_database_model.hpp"

namespace polynya::fracture {
namespace {

SolverSettings coarse_settings() {
  SolverSettings settings;
  settings.radial_elements = 14;
  settings.angular_terms = 3;
  settings.panel_rings = 10;
  settings.panel_columns = 3;
  settings.steps_to_failure = 30;
  return settings;
}

DatabaseGrid small_grid() {
  return {{40, 90, 150}, {0.03, 0.08}, {1e-4, 1e-2}, {1e-3, 0.1}};
}

const BendingDatabase& small_database() {
  static const BendingDatabase database = *build_database(coarse_settings(), small_grid(), 1);
  return database;
}

// ---- building

TEST(DatabaseBuild, SameBytesForAnyNumberOfThreads) {
  const std::string one = write_database(small_database());
  for (const int threads : {2, 3, 8})
    EXPECT_EQ(write_database(*build_database(coarse_settings(), small_grid(), threads)), one) << threads;
}

TEST(DatabaseBuild, UnusableGridsAreErrors) {
  const auto error_of = [](auto change) {
    DatabaseGrid grid = small_grid();
    change(grid);
    const auto built = build_database(coarse_settings(), grid);
    EXPECT_FALSE(built.has_value());
    return built ? "" : built.error().message;
  };
  error_of([](DatabaseGrid& grid) { grid.froude_numbers = {0.1}; });
  error_of([](DatabaseGrid& grid) { grid.softnesses = {1e-2, 1e-4}; });
  error_of([](DatabaseGrid& grid) { grid.opening_angles_deg.back() = 200; });
  const std::string too_soft = error_of([](DatabaseGrid& grid) { grid.softnesses.back() = 1e3; });
  EXPECT_NE(too_soft.find("does not break"), std::string::npos);
}

// The shipped bytes are those that the present solver makes. The test solves two wedges; `polynya database build`
// solves all of them.
TEST(DefaultDatabase, IsWhatTheSolverMakes) {
  const BendingDatabase& shipped = default_database();
  EXPECT_EQ(shipped.settings(), SolverSettings{});
  EXPECT_EQ(shipped.grid(), default_grid());
  DatabaseGrid part = default_grid();
  constexpr std::size_t kMiddle = 6;
  part.opening_angles_deg = {part.opening_angles_deg.front(), part.opening_angles_deg[kMiddle]};
  part.mass_ratios = {part.mass_ratios.front(), part.mass_ratios.back()};
  const auto built = build_database(shipped.settings(), part, 2);
  ASSERT_TRUE(built.has_value());
  const std::size_t block = part.softnesses.size() * part.froude_numbers.size();
  const std::size_t masses = default_grid().mass_ratios.size();
  for (std::size_t wedge = 0; wedge < 4; ++wedge) {
    const std::size_t angle = wedge / 2 == 0 ? 0 : kMiddle, mass = wedge % 2 == 0 ? 0 : masses - 1;
    for (std::size_t k = 0; k < block; ++k)
      ASSERT_EQ(built->entries()[wedge * block + k], shipped.entries()[(angle * masses + mass) * block + k]);
  }
}

// Checks the accuracy that docs/theory/bending.md states, over the whole range of the table. The reference solutions
// use a mesh whose inner radius is four times smaller. A comparison on the table's own mesh would not show an inner
// radius that is too coarse. `polynya_bench_wedges accuracy` does the same for 200 points.
TEST(DefaultDatabase, AgreesWithFinerSolutionsAtRandomPoints) {
  constexpr std::uint64_t kSeed = 20170611;
  const SolverSettings& own = default_database().settings();
  const AccuracyStudy study =
      accuracy_study(default_database(), with_inner_radius(own, own.inner_radius / 4), 50, kSeed, 2);
  EXPECT_EQ(study.rows.size(), 50U);
  EXPECT_LT(study.worst_force_error, 0.01);
  EXPECT_LT(study.worst_radius_error, 0.03);
}

// A mesh that starts too far out shows against a finer one, not against itself.
TEST(AccuracyStudy, SeesACoarseInnerRadius) {
  SolverSettings settings = coarse_settings();
  settings.inner_radius = 0.02;
  const DatabaseGrid grid{{20, 22}, {0.05, 0.055}, {3e-5, 4e-5}, {0.1, 0.12}};
  const BendingDatabase database = *build_database(settings, grid, 1);
  constexpr int kPoints = 3;
  const AccuracyStudy by_one = accuracy_study(database, settings, kPoints, 1),
                      by_three = accuracy_study(database, settings, kPoints, 1, 3);
  EXPECT_LT(by_one.worst_radius_error, 0.02);
  EXPECT_EQ(by_one.worst_radius_error, by_three.worst_radius_error) << "whatever the threads";
  const SolverSettings finer = with_inner_radius(settings, settings.inner_radius / 16);
  EXPECT_GT(accuracy_study(database, finer, kPoints, 1).worst_radius_error, 0.1);
}

// ---- looking up

TEST(DatabaseLookUp, ReproducesItsOwnPoints) {
  const BendingDatabase& database = default_database();
  const DatabaseGrid& grid = database.grid();
  std::size_t k = 0;
  for (const double angle : grid.opening_angles_deg)
    for (const double mass : grid.mass_ratios)
      for (const double softness : grid.softnesses)
        for (const double froude : grid.froude_numbers) {
          const DatabaseAnswer answer = database.look_up({angle * std::numbers::pi / 180, mass, softness, froude});
          const DatabaseEntry& entry = database.entries()[k++];
          ASSERT_TRUE(answer.is_in_range());
          ASSERT_NEAR(answer.force / entry.force, 1, 1e-12);
          ASSERT_NEAR(answer.cusp_radius / entry.cusp_radius, 1, 1e-12);
          ASSERT_NEAR(answer.crack_ratio, entry.crack_ratio, 1e-12 * (1 + entry.crack_ratio));
        }
}

/// "mass ratio, Froude number"
std::string names(const std::vector<OutsideRange>& ranges) {
  std::string text;
  for (const OutsideRange& range : ranges) text += (text.empty() ? "" : ", ") + range.name;
  return text;
}

// Neither at the grid's planes nor where the ends of the Froude axis limit the interpolation does the answer
// jump.
TEST(DatabaseLookUp, IsContinuous) {
  const BendingDatabase& database = default_database();
  const DatabaseGrid& grid = database.grid();
  std::mt19937_64 random(5);
  const auto one_of = [&](const std::vector<double>& values) { return values[random() % values.size()]; };
  const auto between = [&](const std::vector<double>& values) {
    const double share = static_cast<double>(random() >> 11U) * 0x1p-53;
    return values.front() * std::pow(values.back() / values.front(), share);
  };
  for (int trial = 0; trial < 2000; ++trial) {
    const auto pick = [&](const std::vector<double>& values) {
      return random() % 2 == 0 ? one_of(values) : between(values);
    };
    WedgeGroups below{pick(grid.opening_angles_deg) * std::numbers::pi / 180, pick(grid.mass_ratios),
                      pick(grid.softnesses), pick(grid.froude_numbers)};
    WedgeGroups above = below;
    constexpr double kNear = 1e-8;
    for (double WedgeGroups::*group :
         {&WedgeGroups::opening_angle, &WedgeGroups::mass_ratio, &WedgeGroups::softness, &WedgeGroups::froude}) {
      below.*group *= 1 - kNear;
      above.*group *= 1 + kNear;
    }
    const DatabaseAnswer a = database.look_up(below), b = database.look_up(above);
    ASSERT_NEAR(a.force / b.force, 1, 1e-6) << trial;
    ASSERT_NEAR(a.cusp_radius / b.cusp_radius, 1, 1e-6) << trial;
  }
}

TEST(DatabaseLookUp, NamesWhatIsOutside) {
  const BendingDatabase& database = default_database();
  const WedgeGroups inside{std::numbers::pi / 2, 0.05, 1e-3, 0.1};
  EXPECT_TRUE(database.outside(inside).empty());
  WedgeGroups groups = inside;
  groups.opening_angle = 0.1;
  EXPECT_EQ(database.outside(groups),
            (std::vector<OutsideRange>{{"opening angle", 0.1 * (180 / std::numbers::pi), 20, 180}}));
  groups = inside;
  groups.mass_ratio = 0.5;
  groups.froude = 7;
  EXPECT_EQ(names(database.outside(groups)), "mass ratio, Froude number");
  // the edge's answer, not a guess
  EXPECT_EQ(database.look_up(groups).force, database.look_up({std::numbers::pi / 2, 0.1, 1e-3, 1.5}).force);
  groups = inside;
  groups.softness = std::numeric_limits<double>::infinity();
  EXPECT_EQ(names(database.outside(groups)), "softness");
  groups.softness = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(database.look_up(groups).is_in_range());
}

// The water under a wedge acts as at rest below the least Froude number of the table. The answer is that of the
// table's edge and counts as inside.
TEST(DatabaseLookUp, RestIsInside) {
  const DatabaseAnswer slow = default_database().look_up({std::numbers::pi / 2, 0.05, 1e-3, 0});
  EXPECT_TRUE(slow.is_in_range());
  const WedgeSolver solver(std::numbers::pi / 2, 0.05, {});
  const auto still = solver.failure({1e-5, 1e-3, 0, 0});
  EXPECT_NEAR(slow.force / still->force, 1, 1e-3);
  EXPECT_NEAR(slow.cusp_radius / still->cusp_radius, 1, 5e-3);
}

// ---- trends

TEST(DefaultDatabase, ForceGrowsWithTheOpeningAngle) {
  const BendingDatabase& database = default_database();
  const std::size_t stride = database.entries().size() / database.grid().opening_angles_deg.size();
  for (std::size_t k = 0; k + stride < database.entries().size(); ++k)
    ASSERT_LT(database.entries()[k].force, database.entries()[k + stride].force) << k;
}

// Once a push is fast against the plate's own time, a faster one breaks off a smaller cusp. (Slower ones
// break off a cusp up to a sixth larger than at rest, where inertia overshoots.)
TEST(DefaultDatabase, RadiusFallsWithSpeed) {
  const BendingDatabase& database = default_database();
  const DatabaseGrid& grid = database.grid();
  const std::size_t froudes = grid.froude_numbers.size();
  std::size_t compared = 0;
  for (std::size_t k = 0; k < database.entries().size(); ++k) {
    const std::size_t f = k % froudes, s = k / froudes % grid.softnesses.size();
    if (f + 1 == froudes) continue;
    const DatabaseEntry &slow = database.entries()[k], &fast = database.entries()[k + 1];
    if (std::sqrt(grid.softnesses[s] * slow.force) / grid.froude_numbers[f] > 0.3) continue;
    ++compared;
    ASSERT_LT(fast.cusp_radius, slow.cusp_radius) << k;
  }
  EXPECT_GT(compared, database.entries().size() / 4);
}

const FsiDatabaseModel kModel;

BendingLoad load_of(double hull_angle, double vertical_to_crushing, double speed) {
  BendingLoad load;
  load.hull_angle = hull_angle;
  load.vertical_to_crushing = vertical_to_crushing;
  load.mean_approach_speed = speed;
  return load;
}

TEST(FsiDatabaseModel, ForceGrowsWithThicknessStrengthAndAngle) {
  const BendingLoad load = load_of(1, 0.75, 0.8);
  const auto force = [&](auto change, double value) {
    BendingLoad changed = load;
    change(changed, value);
    const BendingCapacity capacity = kModel.capacity(changed);
    EXPECT_TRUE(capacity.is_in_range) << value;
    return capacity.vertical_force;
  };
  const auto grows = [&](auto change, double from, double to) {
    double previous = 0;
    for (double value = from; value < to; value += (to - from) / 50) {
      const double now = force(change, value);
      EXPECT_GT(now, previous) << value;
      previous = now;
    }
  };
  grows([](BendingLoad& l, double h) { l.ice.thickness = h; }, 0.15, 2.5);
  grows([](BendingLoad& l, double s) { l.ice.flexural_strength = s; }, 0.2e6, 2e6);
  grows([](BendingLoad& l, double a) { l.front_half_angle = l.back_half_angle = a; }, 0.18, 1.43);
}

// ---- physical answers

TEST(FsiDatabaseModel, IsTheDirectSolution) {
  BendingLoad load = load_of(0.9, 0.66, 1.3);
  load.front_half_angle = 0.6;
  load.back_half_angle = 1.1;
  const BendingForecast table = kModel.forecast(load), direct = *direct_forecast(wedge_of(load, {}), load);
  EXPECT_TRUE(table.outside.empty());
  EXPECT_EQ(table.equivalent_softness, scaled(load).groups.softness);
  EXPECT_NEAR(table.capacity.vertical_force / direct.capacity.vertical_force, 1, 0.01);
  EXPECT_NEAR(table.capacity.cusp_radius / direct.capacity.cusp_radius, 1, 0.04);
  EXPECT_NEAR(table.time / direct.time, 1, 0.01);
  EXPECT_NEAR(table.penetration / direct.penetration, 1, 0.01);
  EXPECT_NEAR(table.normal_force / direct.normal_force, 1, 0.01);
  load.penetration = table.penetration;  // what the simulation asks on the way
  EXPECT_EQ(kModel.capacity(load).vertical_force, table.capacity.vertical_force);
}

// Edges of unequal angles are exchangeable, and crush more than they bend: T grows at the same 2α.
TEST(FsiDatabaseModel, UnequalEdges) {
  BendingLoad load = load_of(0.9, 0.66, 1);
  const BendingForecast even = kModel.forecast(load);
  load.front_half_angle = 0.4;
  load.back_half_angle = std::numbers::pi / 2 - 0.4;
  const BendingForecast uneven = kModel.forecast(load);
  std::swap(load.front_half_angle, load.back_half_angle);
  EXPECT_NEAR(kModel.forecast(load).capacity.vertical_force, uneven.capacity.vertical_force, 1e-6);
  EXPECT_LT(uneven.penetration, even.penetration);
  EXPECT_NEAR(uneven.capacity.vertical_force / even.capacity.vertical_force, 1, 0.05);
}

// Steep walls crush through the thickness first; the equivalent push stays near the direct solution.
TEST(FsiDatabaseModel, ThroughThicknessContact) {
  const double steep = 20 * std::numbers::pi / 180;
  BendingLoad load = load_of(steep, std::sin(steep) - 0.2 * std::cos(steep), 1);
  for (const double half_angle : {0.4, 0.8, 1.3}) {
    load.front_half_angle = load.back_half_angle = half_angle;
    const BendingForecast table = kModel.forecast(load);
    const BendingForecast direct = *direct_forecast(wedge_of(load, {}), load);
    EXPECT_GT(table.penetration, load.ice.thickness * std::tan(load.hull_angle));
    EXPECT_NEAR(table.capacity.vertical_force / direct.capacity.vertical_force, 1, 0.02) << half_angle;
    EXPECT_NEAR(table.capacity.cusp_radius / direct.capacity.cusp_radius, 1, 0.1) << half_angle;
  }
}

TEST(FsiDatabaseModel, NamesWhatIsOutside) {
  BendingLoad load = load_of(1, 0.7, 1);
  EXPECT_TRUE(kModel.capacity(load).is_in_range);
  load.ice.poisson_ratio = 0.25;
  EXPECT_FALSE(kModel.capacity(load).is_in_range);
  EXPECT_EQ(kModel.forecast(load).outside, (std::vector<OutsideRange>{{"Poisson ratio", 0.25, 0.3, 0.3}}));
  load.ice.poisson_ratio = 0.3;
  load.vertical_to_crushing = -0.1;  // a wall too steep to press down: finite, and outside
  EXPECT_FALSE(kModel.capacity(load).is_in_range);
  EXPECT_TRUE(std::isfinite(kModel.capacity(load).vertical_force));
  EXPECT_EQ(names(kModel.forecast(load).outside), "softness");
}

// A hull that barely presses the ice down crushes far through the thickness. What is looked up, and outside,
// is then not the load's own softness.
TEST(FsiDatabaseModel, NamesTheSoftnessItLooksUp) {
  const double steep = 12 * std::numbers::pi / 180;
  BendingLoad load = load_of(steep, std::sin(steep) - 0.2 * std::cos(steep), 1);
  const double own = scaled(load).groups.softness;
  ASSERT_LT(own, kModel.database().grid().softnesses.back());
  const BendingForecast forecast = kModel.forecast(load);
  ASSERT_EQ(names(forecast.outside), "equivalent softness");
  EXPECT_EQ(forecast.outside[0].value, forecast.equivalent_softness);
  EXPECT_GT(forecast.outside[0].value, forecast.outside[0].most);
  load.penetration = forecast.penetration;
  EXPECT_FALSE(kModel.capacity(load).is_in_range);
}

// ---- the text

TEST(DatabaseText, RoundTripsByteForByte) {
  const std::string text = write_database(small_database());
  const auto read = parse_database(text);
  ASSERT_TRUE(read.has_value()) << read.error().message;
  EXPECT_EQ(write_database(*read), text);
  EXPECT_EQ(read->entries(), small_database().entries());
  EXPECT_EQ(read->grid(), small_database().grid());
  EXPECT_EQ(read->settings(), small_database().settings());
  EXPECT_EQ(write_database(default_database()), default_database_text());
  EXPECT_NE(text.find("hash fnv1a64 " + database_hash(small_database())), std::string::npos);
}

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  const auto place = text.find(from);
  EXPECT_NE(place, std::string::npos) << from;
  return text.replace(place, from.size(), to);
}

TEST(DatabaseText, RefusesWithTheLineAndTheReason) {
  const std::string text = write_database(small_database());
  struct Row {
    std::string from, to;
    int line;
    std::string reason;
  };
  const std::string entries = text.substr(text.find("entries 24") + 11);
  for (const auto& [from, to, line, reason] :
       {Row{text, "", 1, "ends in the middle"},
        Row{"database 1", "database 2", 1, "expected 'polynya"},
        Row{"fluid potential", "fluid honey", 2, "no such fluid"},
        Row{"poisson_ratio 0.3", "poisson_ratio 0.7", 3, "out of range"},
        Row{"poisson_ratio 0.3", "poisson_ratio nan", 3, "out of range"},
        Row{"poisson_ratio 0.3", "poisson 0.3", 3, "expected 'poisson_ratio"},
        Row{"angular_terms 3", "angular_terms 3.5", 8, "not a number"},
        Row{"angular_terms 3", "angular_terms 99999999999", 8, "not a number"},
        Row{"mass_ratio 0.03 0.08", "mass_ratio 0.08 0.03", 14, "ascend"},
        Row{"mass_ratio 0.03 0.08", "mass_ratio 0.03", 14, "ascend"},
        Row{"mass_ratio 0.03 0.08", "mass_ratio 0.03  0.08", 14, "not a number"},
        Row{"mass_ratio 0.03 0.08", "mass_ratio 0.03 inf", 14, "ascend"},
        Row{"mass_ratio 0.03 0.08", "mass_ratio 0.03 0.03000000000000001", 14, "ascend"},
        Row{"mass_ratio 0.03 0.08", "mass_ratio 1e-13 0.08", 14, "from 1e-12 to 1e12"},
        Row{"entries 24", "entries 25", 18, "not 25"},
        Row{"entries 24", "entries 999999999", 18, "more than"},
        Row{"columns force", "columns radius", 17, "expected 'columns"},
        Row{entries, "", 19, "ends in the middle"},
        Row{entries, entries.substr(0, entries.size() - 1), 43, "ends in the middle"},
        Row{entries, entries + "\n", 43, "follows the hash"}}) {
    const auto read = parse_database(replaced(text, from, to));
    ASSERT_FALSE(read.has_value()) << reason;
    EXPECT_EQ(read.error().line, line) << read.error().message;
    EXPECT_NE(read.error().message.find(reason), std::string::npos) << read.error().message;
  }
}

}  // namespace
}  // namespace polynya::fracture
