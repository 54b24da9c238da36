#include <cmath>
#include <map>
#include <regex>
#include <set>

#include "temporary_folder.hpp"
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <gtest/gtest.h>

#include "geometry/exact/measures.hpp"
#include "io/run/event_records.hpp"
#include "io/run/force_columns.hpp"
#include "io/run/motion_index.hpp"
#include "io/run/record_reader.hpp"
#include "io/run/records.hpp"
#include "io/run/run_folder.hpp"
#include "io/run/run_reader.hpp"
#include "io/run/run_writer.hpp"
#include "io/text/json_parser.hpp"

namespace polynya::io {
namespace {

using tests::read_file;
using tests::TemporaryFolder;

// A ship that breaks a plate and pushes a floe, in drifting water: every file has something to say.
const std::string kScene = R"({
  "name": "small", "time": {"step_s": 0.01, "until_s": 8}, "water": {"drift_m_per_s": [0.02, -0.01]},
  "record": {"forces_interval_s": 0.1, "frames_interval_s": 0.5, "contacts": "all"},
  "ships": [{"name": "a ship", "hull": {"length_m": 60, "beam_m": 14, "entrance_angle_deg": 30}, "mass_kg": 3e6,
             "moment_of_inertia_kg_m2": 5e8, "position_m": [-30.5, 2], "propulsion": {"constant_speed_m_per_s": 2}}],
  "floes": [{"rectangle": {"corner_m": [0, -20], "size_m": [60, 40]}}, {"rectangle": {"corner_m": [70, 0], "size_m": 5}, "angular_velocity_deg_per_s": 1},
            {"polygon": {"outer_m": [[70, 10], [80, 10], [80, 20], [70, 20]], "holes_m": [[[72, 12], [72, 14], [74, 14]]]}}]
})";

struct Recorded {
  std::vector<simulation::Birth> births;
  std::vector<simulation::Event> events;
  std::vector<simulation::ShipSample> samples;
  std::vector<std::pair<double, std::vector<simulation::FloeState>>> frames;
  std::vector<std::pair<double, std::vector<geometry::Point>>> centroids;
  std::vector<RunContact> contacts;
};

LoadedScene load() {
  auto loaded = read_scene(kScene, "small.json", ".");
  EXPECT_TRUE(loaded.has_value());
  return std::move(*loaded);
}

/// Runs the scene into a folder and keeps what it recorded.
Recorded write_run(const LoadedScene& scene, const std::filesystem::path& folder) {
  Recorded recorded;
  simulation::Simulation simulation(scene.scene);
  auto writer = RunWriter::create(folder, false, scene);
  EXPECT_TRUE(writer.has_value());
  const auto take = [&] {
    const simulation::Journal& journal = simulation.journal();
    recorded.births.insert(recorded.births.end(), journal.births.begin(), journal.births.end());
    recorded.events.insert(recorded.events.end(), journal.events.begin(), journal.events.end());
    recorded.samples.insert(recorded.samples.end(), journal.samples.begin(), journal.samples.end());
    writer->record(simulation.journal());
  };
  const auto frame = [&] {
    writer->frame(simulation);
    recorded.frames.emplace_back(simulation.time(), simulation.floe_states());
    for (const auto& state : simulation.contact_states())
      recorded.contacts.push_back({simulation.time(), state});
    auto& points = recorded.centroids.emplace_back(simulation.time(), std::vector<geometry::Point>{}).second;
    for (const auto& state : recorded.frames.back().second) {
      points.push_back(transform(state.world_from_body, geometry::measure(*state.polygon_in_body).centroid));
    }
  };
  take();
  frame();
  for (int step = 1; step <= 800; ++step) {
    simulation.step();
    take();
    if (step % 50 == 0) frame();
  }
  RunSummary summary;
  summary.finished = true;
  summary.steps = 800;
  summary.sim_time = simulation.time();
  summary.ledger = simulation.area_ledger();
  summary.counts = simulation.counts();
  summary.peaks = writer->peaks();
  summary.warnings = {"a \"warning\""};
  EXPECT_TRUE(writer->finish(summary, &simulation).has_value());
  return recorded;
}

TEST(Run, AnEventOfASplitStatesAndReadsBackBothSides) {
  simulation::Split split;
  split.by_floe = 7;
  split.floe = 8;
  fracture::FailureCriteria& c = split.criterion;
  c.contact_force = 1e5 / 3;
  c.crack_length = 50.1;
  c.crack_width = 60.2;
  c.flank_forces[0] = 2e5 / 3;
  c.flank_forces[1] = 4e5 / 3;
  c.opening_force = 2e5 / 3;
  c.opening_capacity = 65e3;
  c.fracture_toughness = 115e3;
  const LoadedScene scene = load();
  const auto line_of = [&](const simulation::Event& event) {
    std::string text;
    append_event(text, event, scene.scene);
    return text;
  };
  const auto again = [&](std::string_view kind) {
    const std::string text = line_of({.time = 1, .ship = -1, .point_in_world = {1, 2}, .what = split});
    EXPECT_NE(text.find(kind), std::string::npos) << text;
    const simulation::Event read = event_of(json_of(text), scene.scene);
    EXPECT_EQ(line_of(read), text);
    return read;
  };
  const simulation::Event read = again("\"opening force >= opening capacity\"");
  EXPECT_EQ(read.ship, -1);
  EXPECT_EQ(read.ice()->by_floe, 7);
  const fracture::FailureCriteria& r = read.criteria();
  EXPECT_EQ(r.contact_force, c.contact_force);
  EXPECT_EQ(r.crack_length, c.crack_length);
  EXPECT_EQ(r.crack_width, c.crack_width);
  EXPECT_EQ(r.flank_forces[0], c.flank_forces[0]);
  EXPECT_EQ(r.flank_forces[1], c.flank_forces[1]);
  EXPECT_EQ(r.opening_force, c.opening_force);
  EXPECT_EQ(r.opening_capacity, c.opening_capacity);
  EXPECT_EQ(r.fracture_toughness, c.fracture_toughness);
  EXPECT_EQ(simulation::deciding_load(r, true).load, c.opening_force);
  c.splitting_force = 10e6;
  c.collision_force = 11e6;
  EXPECT_EQ(simulation::deciding_load(again("\"collision force > splitting force\"").criteria(), true).load,
            11e6);
}

TEST(Run, ReadsBackWhatWasWritten) {
  const TemporaryFolder folder;
  const LoadedScene scene = load();
  const Recorded recorded = write_run(scene, folder / "run");
  const auto run = read_run(folder / "run");
  ASSERT_TRUE(run.has_value()) << run.error();
  EXPECT_EQ(run->scene.hash, scene.hash);
  EXPECT_GT(recorded.events.size(), 3U);
  ASSERT_EQ(run->events.size(), recorded.events.size());
  for (std::size_t i = 0; i < run->events.size(); ++i) {
    const simulation::Event* const both[]{&run->events[i], &recorded.events[i]};
    std::string lines[2];
    for (int k = 0; k < 2; ++k) append_event(lines[k], *both[k], scene.scene);
    EXPECT_EQ(lines[0], lines[1]);
    EXPECT_GT(run->events[i].criteria().contact_force, 0);
  }
  ASSERT_EQ(run->floes.size(), recorded.births.size());
  for (std::size_t i = 0; i < run->floes.size(); ++i) {
    EXPECT_EQ(*run->shape(recorded.births[i].floe), recorded.births[i].polygon_in_body);
    EXPECT_EQ(run->floes[i].birth.parent, recorded.births[i].parent);
    EXPECT_EQ(run->floes[i].birth.area, recorded.births[i].area);
    EXPECT_EQ(run->floes[i].birth.centroid_in_body, recorded.births[i].centroid_in_body);
  }
  ASSERT_EQ(run->samples.size(), recorded.samples.size());
  for (std::size_t i = 0; i < run->samples.size(); ++i) {
    EXPECT_EQ(run->samples[i].from_ice.surge, recorded.samples[i].from_ice.surge);
    EXPECT_EQ(run->samples[i].collision.yaw, recorded.samples[i].collision.yaw);
    EXPECT_EQ(run->samples[i].position_in_world, recorded.samples[i].position_in_world);
    EXPECT_EQ(run->samples[i].thrust, recorded.samples[i].thrust);
    EXPECT_EQ(run->samples[i].contacts, recorded.samples[i].contacts);
  }
}

TEST(Run, ForcesAreReadByTheirColumnsNames) {
  const TemporaryFolder folder;
  const Recorded recorded = write_run(load(), folder / "run");
  const std::filesystem::path path = folder / "run/forces.csv";
  const std::string whole = read_file(path);
  // A run of before, without the columns that are optional: the rest in another order.
  std::vector<const ForceColumn*> kept;
  for (const ForceColumn& column : force_columns()) {
    if (!column.is_optional) kept.insert(kept.begin(), &column);
  }
  std::string older = "t_s,ship";
  for (const ForceColumn* column : kept) older.append(1, ',').append(column->name);
  for (const simulation::ShipSample& sample : recorded.samples) {
    older += fmt::format("\n{},a ship", sample.time);
    for (const ForceColumn* column : kept) older += fmt::format(",{}", column->read(sample));
  }
  tests::write_file(path, older + '\n');
  const auto run = read_run(folder / "run");
  ASSERT_TRUE(run.has_value()) << run.error();
  ASSERT_EQ(run->samples.size(), recorded.samples.size());
  for (const ForceColumn* column : kept) {
    for (std::size_t i = 0; i < run->samples.size(); i += 7)
      ASSERT_NEAR(column->read(run->samples[i]), column->read(recorded.samples[i]),
                  1e-12 * std::abs(column->read(recorded.samples[i])))
          << column->name;
  }
  const auto refusal = [&](const std::string& from, const std::string& to) {
    std::string changed = whole;
    changed.replace(changed.find(from), from.size(), to);
    tests::write_file(path, changed);
    const auto read = read_run(folder / "run");
    return read ? "" : read.error();
  };
  EXPECT_NE(refusal(",sway_N,", ",").find("no column \"sway_N\""), std::string::npos);
  EXPECT_NE(refusal(",sway_N,", ",sway_kN,").find("\"sway_kN\""), std::string::npos);
  EXPECT_NE(refusal(",sway_N,", ",surge_N,").find("\"surge_N\""), std::string::npos);
}

TEST(Run, ColumnsOfForcesNameTheirUnitsOnce) {
  const std::map<std::string_view, std::string_view> suffixes{
      {"N", "_N"},         {"N·m", "_Nm"},        {"m", "_m"}, {"°", "_deg"}, {"m²", "_m2"},
      {"m/s", "_m_per_s"}, {"°/s", "_deg_per_s"}, {"W", "_W"}, {"", ""}};
  std::set<std::string_view> names;
  for (const ForceColumn& column : force_columns()) {
    ASSERT_TRUE(suffixes.contains(column.unit)) << column.name;
    EXPECT_TRUE(column.name.ends_with(suffixes.at(column.unit))) << column.name;
    EXPECT_TRUE(names.insert(column.name).second) << column.name;
  }
}

TEST(Run, DocumentationHasEveryColumnOfForces) {
  const std::string page = read_file(std::filesystem::path(POLYNYA_SOURCE_DIR) / "docs/run-folder.md");
  for (const ForceColumn& column : force_columns()) {
    const char* over = column.over == Over::kMean          ? "mean"
                       : column.over == Over::kLargestStep ? "largest step"
                                                           : "at its end";
    const std::string row = fmt::format("| `{}` | {} | {} |\n", column.name, over, column.meaning);
    EXPECT_NE(page.find(row), std::string::npos) << row;
  }
}

TEST(Run, DocumentationHasEveryFieldOfEvents) {
  const std::string page = read_file(std::filesystem::path(POLYNYA_SOURCE_DIR) / "docs/run-folder.md");
  const auto kinds = std::variant_size_v<decltype(simulation::Event::what)>;
  for (const EventField& field : event_fields()) {
    const std::string of = field.kinds.size() == kinds ? "all"
                           : field.kinds.size() == kinds - 2
                               ? "all of ice"
                               : fmt::format("`{}`", fmt::join(field.kinds, "`, `"));
    const std::string unit = field.meaning.unit.empty() ? "" : fmt::format(" [{}]", field.meaning.unit);
    const std::string row = fmt::format("| `{}{}` | {} | {}{} |\n", field.is_of_criterion ? "criterion." : "",
                                        field.key, of, field.meaning.meaning, unit);
    EXPECT_NE(page.find(row), std::string::npos) << row;
  }
}

TEST(Run, EventsOfWrongFieldsAreRefusedByTheirNames) {
  const LoadedScene scene = load();
  std::string line;
  append_event(line, {1, 0, {1, 2}, simulation::MooringBreak{{3, 4}, 6, 5}}, scene.scene);
  const auto refusal = [&](const std::string& from, const std::string& to) -> std::string {
    std::string changed = line;
    changed.replace(changed.find(from), from.size(), to);
    try {
      return std::string(name_of(event_of(json_of(changed), scene.scene)));
    } catch (const ReadError& error) {
      return error.what();
    }
  };
  EXPECT_EQ(refusal("kind", "kind"), "mooring_break");
  EXPECT_EQ(refusal("\"force_N\":6", "\"force_kN\":6"), "\"force_N\" is missing");
  EXPECT_EQ(refusal("\"force_N\":6", "\"force_N\":\"6\""), "\"force_N\" is not a number");
  EXPECT_EQ(refusal("\"force_N\":6", "\"force_N\":-6"), "\"force_N\" is not ≥ 0");
  EXPECT_EQ(refusal("[3,4]", "[3]"), "not a point");
  EXPECT_EQ(refusal("\"a ship\"", "\"b ship\""), "\"ship\" is \"b ship\", which is not in the scene");
  EXPECT_EQ(refusal("mooring_break", "mooring"), "an unknown kind of event, \"mooring\"");
}

TEST(Run, ReadsBackTheContactsOfItsFrames) {
  const TemporaryFolder folder;
  const Recorded recorded = write_run(load(), folder / "run");
  const auto run = read_run(folder / "run");
  ASSERT_TRUE(run.has_value()) << run.error();
  EXPECT_GT(recorded.contacts.size(), 10U);
  ASSERT_EQ(run->contacts.size(), recorded.contacts.size());
  for (std::size_t i = 0; i < run->contacts.size(); ++i) {
    const simulation::ContactState& a = run->contacts[i].state;
    const simulation::ContactState& b = recorded.contacts[i].state;
    EXPECT_EQ(run->contacts[i].time, recorded.contacts[i].time);
    EXPECT_EQ(a.on, b.on);
    EXPECT_EQ(a.by, b.by);
    EXPECT_EQ(a.point_in_world, b.point_in_world);
    EXPECT_EQ(a.force, b.force);
    EXPECT_EQ(a.depth, b.depth);
    EXPECT_EQ(a.is_crushing, b.is_crushing);
  }
  std::size_t told = 0;
  for (const Frame& frame : run->frames) told += run->contacts_at(frame.time).size();
  EXPECT_EQ(told, run->contacts.size()) << "each belongs to a frame";
  std::filesystem::remove(folder.path() / "run" / run_file::kContacts);
  const auto of_an_older_version = read_run(folder / "run");
  ASSERT_TRUE(of_an_older_version.has_value()) << of_an_older_version.error();
  EXPECT_TRUE(of_an_older_version->contacts.empty());
}

/// Who lives is told by births and events; where, by frames.
TEST(Run, TellsWhoLivesWhereAtEveryFrame) {
  const TemporaryFolder folder;
  const LoadedScene scene = load();
  const Recorded recorded = write_run(scene, folder / "run");
  const auto run = read_run(folder / "run");
  ASSERT_TRUE(run.has_value()) << run.error();
  const MotionIndex motions(*run);
  ASSERT_EQ(run->frames.size(), recorded.frames.size());
  for (std::size_t k = 0; k < recorded.frames.size(); ++k) {
    const auto& [time, states] = recorded.frames[k];
    std::size_t living = 0;
    for (const RunFloe& floe : run->floes) living += run->is_alive(floe.birth.floe, time);
    EXPECT_EQ(living, states.size()) << time;
    for (std::size_t i = 0; i < states.size(); ++i) {
      EXPECT_TRUE(run->is_alive(states[i].floe, time));
      const auto motion = motions.floe_at(states[i].floe, time);
      ASSERT_TRUE(motion.has_value());
      EXPECT_LE(distance(motion->position, recorded.centroids[k].second[i]), 1.5 * kFramePositionTolerance);
      EXPECT_NEAR(motion->angle, states[i].angle, kFrameAngleTolerance);
    }
  }
  for (const RunFloe& floe : run->floes) {
    const auto lineage = run->lineage(floe.birth.floe);
    EXPECT_EQ(static_cast<int>(lineage.size()) - 1, floe.birth.generation);
    EXPECT_EQ(lineage.back(), floe.birth.floe);
  }
}

TEST(Run, TheSameSceneGivesTheSameBytes) {
  const TemporaryFolder folder;
  const LoadedScene scene = load();
  write_run(scene, folder / "a");
  write_run(scene, folder / "b");
  for (const auto name : {run_file::kForces, run_file::kEvents, run_file::kFloes, run_file::kFrames,
                          run_file::kContacts, run_file::kFinalGeojson, run_file::kScene}) {
    EXPECT_EQ(read_file(folder.path() / "a" / name), read_file(folder.path() / "b" / name)) << name;
  }
}

TEST(Run, ALineCutShortIsLeftOut) {
  const TemporaryFolder folder;
  const LoadedScene scene = load();
  const Recorded recorded = write_run(scene, folder / "run");
  for (const auto name : {run_file::kForces, run_file::kEvents, run_file::kFrames, run_file::kContacts}) {
    const auto path = folder.path() / "run" / name;
    std::filesystem::resize_file(path, std::filesystem::file_size(path) - 5);
  }
  const auto run = read_run(folder / "run");
  ASSERT_TRUE(run.has_value()) << run.error();
  EXPECT_EQ(run->samples.size(), 79U);
  EXPECT_EQ(run->frames.size(), 16U);
  EXPECT_EQ(run->contacts.size(), recorded.contacts.size() - 1);
}

TEST(Run, DamageIsToldWithItsLine) {
  const TemporaryFolder folder;
  const LoadedScene scene = load();
  write_run(scene, folder / "run");
  const auto path = folder.path() / "run" / run_file::kFloes;
  std::string text = read_file(path);
  text.insert(text.find('\n') + 1, "{\"floe_id\": 1}\n");
  tests::write_file(path, text);
  const auto run = read_run(folder / "run");
  ASSERT_FALSE(run.has_value());
  EXPECT_NE(run.error().find("floes.ndjson:2: "), std::string::npos) << run.error();
  EXPECT_FALSE(read_run(folder / "none").has_value());
}

/// Parts of a parent's shape that cannot be.
TEST(Run, DamagedPartsOfAShapeAreToldWithTheirLine) {
  const TemporaryFolder folder;
  write_run(load(), folder / "run");
  const auto path = folder.path() / "run" / run_file::kFloes;
  const std::string text = read_file(path);
  std::smatch stretch;
  ASSERT_TRUE(std::regex_search(text, stretch, std::regex(R"(\[0,\d+,\d+\])")));
  const auto parts = static_cast<std::size_t>(stretch.position());
  const auto line = 1 + std::ranges::count(text.substr(0, parts), '\n');
  for (const auto& [other, reason] :
       {std::pair{"[9,", "ring 9 of a parent"}, {"[0,999", "of the parent's ring 0, which has"}}) {
    tests::write_file(path, std::string(text).replace(parts, 3, other));
    const auto run = read_run(folder / "run");
    ASSERT_FALSE(run.has_value());
    EXPECT_NE(run.error().find("floes.ndjson:" + std::to_string(line) + ": "), std::string::npos)
        << run.error();
    EXPECT_NE(run.error().find(reason), std::string::npos) << run.error();
  }
}

/// Version 1 wrote every shape whole, and no version.
TEST(Run, AFolderOfVersionOneReadsTheSame) {
  const TemporaryFolder folder;
  const Recorded recorded = write_run(load(), folder / "run");
  std::string lines;
  for (const simulation::Birth& birth : recorded.births) append_birth(lines, birth, nullptr);
  tests::write_file(folder.path() / "run" / run_file::kFloes, lines);
  const auto path = folder.path() / "run" / run_file::kSummary;
  std::string summary = read_file(path);
  const std::string version = "\"folder_version\": 4,";
  ASSERT_NE(summary.find(version), std::string::npos);
  tests::write_file(path, std::string(summary).replace(summary.find(version), version.size(), ""));
  const auto run = read_run(folder / "run");
  ASSERT_TRUE(run.has_value()) << run.error();
  for (const simulation::Birth& birth : recorded.births)
    EXPECT_EQ(*run->shape(birth.floe), birth.polygon_in_body);
  for (const char* other : {"\"folder_version\": 5,", R"("folder_version": "3",)"}) {
    tests::write_file(path, std::string(summary).replace(summary.find(version), version.size(), other));
    const auto newer = read_run(folder / "run");
    ASSERT_FALSE(newer.has_value());
    EXPECT_NE(newer.error().find("summary.json: a run folder of version"), std::string::npos);
  }
}

/// Level ice: every cusp leaves the same plate with a longer boundary. Later lines are as short as early
/// ones.
TEST(Run, FloesGrowWithTheIceThatIsNewNotWithThePlate) {
  const TemporaryFolder folder;
  const auto scene = read_scene(R"({
    "name": "level", "time": {"step_s": 0.02, "until_s": 60}, "fracture": {"characteristic_length": "fourth_root"},
    "ships": [{"name": "a ship", "hull": {"length_m": 60, "beam_m": 24, "entrance_angle_deg": 27}, "mass_kg": 3e6,
               "moment_of_inertia_kg_m2": 5e8, "position_m": [-30.5, 2], "propulsion": {"constant_speed_m_per_s": 3}}],
    "floes": [{"rectangle": {"corner_m": [0, -75], "size_m": [300, 150]}}]
  })",
                                "level.json", ".");
  ASSERT_TRUE(scene.has_value());
  simulation::Simulation simulation(scene->scene);
  auto writer = RunWriter::create(folder / "run", false, *scene);
  ASSERT_TRUE(writer.has_value());
  for (int step = 0; step < 3000; ++step) {
    writer->record(simulation.journal());
    simulation.step();
  }
  ASSERT_TRUE(writer->finish({}, &simulation).has_value());
  const auto run = read_run(folder / "run");
  ASSERT_TRUE(run.has_value()) << run.error();
  std::istringstream lines(read_file(folder.path() / "run" / run_file::kFloes));
  const std::size_t half = run->floes.size() / 2;
  ASSERT_GT(half, 100U);
  std::size_t vertices[2] = {}, bytes[2] = {};
  std::string line;
  for (std::size_t i = 0; std::getline(lines, line); ++i) {
    const std::size_t part = i < half ? 0 : 1;
    vertices[part] += vertex_count(*run->shape(static_cast<simulation::FloeId>(i)));
    bytes[part] += line.size();
  }
  EXPECT_GT(2 * vertices[1], 3 * vertices[0]) << "whole shapes would take half as much again";
  EXPECT_LT(static_cast<double>(bytes[1]), 1.1 * static_cast<double>(bytes[0]));
}

TEST(Run, SummaryHasTheKeysOfTheDesign) {
  const TemporaryFolder folder;
  const LoadedScene scene = load();
  write_run(scene, folder / "run");
  const JsonValue summary = parse_json(read_file(folder.path() / "run" / run_file::kSummary)).root;
  for (const char* key : {"version", "folder_version", "seed", "scene_hash", "steps", "sim_time_s",
                          "wall_time_s", "real_time_factor", "peaks", "warnings", "finished"}) {
    EXPECT_NE(summary.find(key), nullptr) << key;
  }
  for (const char* key : {"initial_ice_area_m2", "floe_area_m2", "submerged_area_m2", "brash_area_m2",
                          "rounding_defect_m2", "imbalance_m2"}) {
    EXPECT_NE(summary.find("ledger")->find(key), nullptr) << key;
  }
  for (const char* key : {"floes_initial", "floes_final", "bends", "splits", "crush_contacts",
                          "rejected_cuts", "database_out_of_range"}) {
    EXPECT_NE(summary.find("counts")->find(key), nullptr) << key;
  }
  EXPECT_EQ(read_file(folder.path() / "run" / run_file::kForces).substr(0, 9), "t_s,ship,");
}

}  // namespace
}  // namespace polynya::io
