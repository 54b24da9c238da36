#include <algorithm>
#include <cmath>
#include <cstring>
#include <map>
#include <random>

#include "expect_text.hpp"

#include "geometry/cut/cut.hpp"
#include "geometry/exact/measures.hpp"
#include "geometry/exact/validity.hpp"
#include "io/run/frames.hpp"
#include "io/run/records.hpp"
#include "io/run/run_reader.hpp"
#include "io/text/json_parser.hpp"
#include "tests/geometry/dice.hpp"

namespace polynya::io {
namespace {

using geometry::Point;
using geometry::Polygon;
using geometry::Ring;
using simulation::FloeId;

/// Floes as a run has them, and the lines that a run writes of them.
struct Family {
  std::vector<simulation::Birth> births;
  std::string lines;
  std::string whole_lines;  ///< lines as version 1 wrote them
  int holed = 0;
  int of_parts = 0;
};

void add(Family& family, FloeId parent, const geometry::Shape& shape) {
  simulation::Birth birth;
  birth.floe = static_cast<FloeId>(family.births.size());
  birth.parent = parent;
  birth.polygon_in_body = shape.polygon;
  const std::size_t before = family.lines.size();
  append_birth(family.lines, birth,
               parent < 0 ? nullptr : &family.births[static_cast<std::size_t>(parent)].polygon_in_body);
  append_birth(family.whole_lines, birth, nullptr);
  family.holed += shape.polygon.holes.empty() ? 0 : 1;
  family.of_parts += family.lines.find("ring_parts_m", before) != std::string::npos ? 1 : 0;
  family.births.push_back(std::move(birth));
}

/// Cuts a floe of a difficult kind again and again by difficult knives. Each cut is applied to one of the present
/// pieces.
Family roll_family(std::mt19937& random, int cuts) {
  std::vector<std::uint8_t> bytes(2000);
  for (std::uint8_t& byte : bytes) byte = static_cast<std::uint8_t>(random());
  geometry::trials::Dice dice(std::move(bytes));
  Family family;
  std::vector<std::pair<FloeId, geometry::Shape>> living;
  geometry::Shape first{geometry::trials::roll_floe(dice)};
  if (geometry::find_defect(first.polygon)) return family;
  add(family, simulation::kNoFloe, first);
  living.emplace_back(0, std::move(first));
  for (int i = 0; i < cuts && !living.empty(); ++i) {
    const auto chosen = static_cast<std::size_t>(dice.below(static_cast<int>(living.size())));
    const auto [parent, shape] = living[chosen];
    const auto knives = geometry::trials::roll_knives(dice, shape.polygon);
    const auto cut = knives.is_crack ? cut_along(shape, knives.crack) : cut_by_polygons(shape, knives.polygons);
    if (!cut) continue;
    living.erase(living.begin() + static_cast<std::ptrdiff_t>(chosen));
    for (const geometry::Piece& piece : cut->pieces) {
      living.emplace_back(static_cast<FloeId>(family.births.size()), piece.shape);
      add(family, parent, piece.shape);
    }
  }
  return family;
}

/// Reads lines as run_reader does.
tl::expected<FloeShapes, std::string> read_lines(const std::string& text) {
  FloeShapes shapes;
  try {
    for_pieces(text, '\n', [&](std::string_view words, std::size_t) {
      const JsonDocument line = parse_json(words);
      const JsonValue* parent = line.root.find("parent_id", JsonValue::Kind::kNumber);
      shapes.add(read_shape(line.root), parent ? static_cast<FloeId>(parent->number()) : simulation::kNoFloe);
    });
  } catch (const ReadError& error) {
    return tl::unexpected(std::string(error.what()));
  }
  return shapes;
}

/// Compares bit by bit, except that a text has only one zero.
bool are_same(const Ring& a, const Ring& b) {
  return std::ranges::equal(a, b, [](Point p, Point q) {
    const double one[]{p.x + 0.0, p.y + 0.0};
    const double other[]{q.x + 0.0, q.y + 0.0};
    return std::memcmp(one, other, sizeof one) == 0;
  });
}
bool are_same(const Polygon& a, const Polygon& b) {
  return are_same(a.outer, b.outer) &&
         std::ranges::equal(a.holes, b.holes, [](const Ring& p, const Ring& q) { return are_same(p, q); });
}

TEST(FloeShapes, ReadBackToTheBitWhateverTheCuts) {
  std::mt19937 random(15);
  int floes = 0, of_parts = 0, holed = 0;
  for (int trial = 0; trial < 100; ++trial) {
    const Family family = roll_family(random, 12);
    const auto shapes = tests::checked(read_lines(family.lines));
    const auto whole_shapes = tests::checked(read_lines(family.whole_lines));
    ASSERT_EQ(shapes->size(), family.births.size());
    std::vector<simulation::Birth> births = family.births;
    std::ranges::shuffle(births, random);  // asked for in any order
    for (const simulation::Birth& birth : births) {
      ASSERT_TRUE(are_same(*shapes->of(birth.floe), birth.polygon_in_body)) << trial << ' ' << birth.floe;
      ASSERT_TRUE(are_same(*whole_shapes->of(birth.floe), birth.polygon_in_body));
      EXPECT_EQ(whole_shapes->parts_of(birth.floe), nullptr);
    }
    floes += static_cast<int>(births.size());
    of_parts += family.of_parts;
    holed += family.holed;
  }
  EXPECT_GT(floes, 700);
  EXPECT_GT(of_parts, floes / 3);
  EXPECT_GT(holed, 30);
}

/// A line repeats no vertex that the parent has once, and states a vertex as new only if the parent has none left.
TEST(FloeShapes, ALineHoldsWhatIsNew) {
  std::mt19937 random(16);
  int lines = 0;
  for (int trial = 0; trial < 40; ++trial) {
    const Family family = roll_family(random, 12);
    for (const simulation::Birth& birth : family.births) {
      if (birth.parent < 0) continue;
      const Polygon& parent = family.births[static_cast<std::size_t>(birth.parent)].polygon_in_body;
      const ShapeParts shape = parts_of(birth.polygon_in_body, parent);
      if (!shape.has_parent()) continue;
      ++lines;
      std::vector<Ring> rings{parent.outer};
      rings.insert(rings.end(), parent.holes.begin(), parent.holes.end());
      std::map<std::pair<double, double>, int> left;
      for (const Ring& ring : rings)
        for (const Point p : ring) ++left[{p.x, p.y}];
      std::map<std::pair<std::int32_t, std::size_t>, int> taken;
      for (const ShapePart& part : shape.parts) {
        if (part.ring == ShapePart::kNew) continue;
        const Ring& of = rings[static_cast<std::size_t>(part.ring)];
        for (std::uint32_t k = 0; k < part.count; ++k) {
          const std::size_t at = (part.first + k) % of.size();
          EXPECT_EQ(++taken[std::pair(part.ring, at)], 1);
          --left[{of[at].x, of[at].y}];
        }
      }
      for (const Point p : shape.vertices) EXPECT_EQ(left[std::pair(p.x, p.y)], 0);
      EXPECT_LT(shape.vertices.size(), vertex_count(birth.polygon_in_body));
    }
  }
  EXPECT_GT(lines, 150);
}

/// A long boundary that loses a small part costs only the new vertices, wherever the rings start.
TEST(FloeShapes, ABiteOutOfALongBoundaryIsAFewEntries) {
  Ring ring;
  for (int i = 0; i < 1000; ++i)
    ring.push_back({1000 * std::cos(0.002 * 3.14159265358979 * i), 1000 * std::sin(0.002 * 3.14159265358979 * i)});
  for (const int turn : {0, 1, 500, 999}) {
    Ring bitten(ring.begin() + 10, ring.end());
    bitten.push_back({900, 10});
    std::rotate(bitten.begin(), bitten.begin() + turn % static_cast<int>(bitten.size()), bitten.end());
    const ShapeParts shape = parts_of({bitten, {}}, {ring, {}});
    EXPECT_EQ(shape.vertices.size(), 1U);
    EXPECT_LE(shape.parts.size(), 3U);
    EXPECT_EQ(assembled(shape, {ring, {}}).outer, bitten);
  }
}

/// The boundaries have twelve million vertices in all, of which four million are kept assembled. The test reads them
/// from the end.
TEST(FloeShapes, WhatWasAskedForLongAgoIsAssembledAgain) {
  Ring ring;
  for (int i = 0; i < 20000; ++i) ring.push_back({std::cos(3e-4 * i), std::sin(3e-4 * i)});
  FloeShapes shapes;
  shapes.add({ring, {}});
  for (FloeId i = 0; i < 600; ++i) {
    ShapeParts child;
    child.vertices = {{2.0 + static_cast<double>(i), 0}};
    child.parts = {{0, 0, 20000}, {ShapePart::kNew, 0, 1}};
    if (i > 0) child.parts.front().count = 19000;
    child.ring_ends = {2};
    ASSERT_NO_THROW(shapes.add(std::move(child), i > 0 ? i : 0));
  }
  const auto held = shapes.of(1);
  std::size_t vertices = 0;
  for (FloeId i = 600; i > 0; --i) vertices += shapes.of(i)->outer.size();
  EXPECT_EQ(vertices, 20001U + 599U * 19001U);
  EXPECT_EQ(held->outer.back(), (Point{2, 0}));
  EXPECT_EQ(*shapes.of(1), *held);
}

TEST(FloeShapes, DamagedPartsAreRefusedWithTheReason) {
  const std::string parent =
      R"({"floe_id":0,"parent_id":null,"ring_m":[[0,0],[9,0],[9,9],[0,9]],"holes_m":[[[1,1],[1,2],[2,1]]]})";
  for (const std::vector<std::string>& row : tests::table_of("io/damaged_shapes.txt")) {
    EXPECT_HAS(tests::refused(read_lines(parent + "\n{\"floe_id\":1," + row[0] + "}\n")), row[1]) << row[0];
  }
}

TEST(FloeShapes, DamageNeverCrashes) {
  std::mt19937 random(17);
  Family family;
  while (family.of_parts < 4) family = roll_family(random, 6);
  int readable = 0, refused = 0;
  for (int trial = 0; trial < 2000; ++trial) {
    std::string damaged = family.lines;
    static constexpr std::string_view kWritten = "0123456789[],.-e";
    for (int k = 0; k < 1 + trial % 3; ++k)
      damaged[random() % (damaged.size() - 1)] = kWritten[random() % kWritten.size()];
    const auto shapes = read_lines(damaged);
    ++(shapes ? readable : refused);
    EXPECT_TRUE(shapes || !shapes.error().empty());
    for (std::size_t i = 0; shapes && i < shapes->size(); ++i)
      EXPECT_GE(vertex_count(*shapes->of(static_cast<FloeId>(i))), 3U);
  }
  EXPECT_GT(readable, 50);
  EXPECT_GT(refused, 100);
}

// ---- frames

std::string encoded(FrameEncoder& encoder, double time, std::span<const Motion> ships,
                    std::span<const FloeMotion> floes) {
  encoder.begin(time, ships);
  for (const FloeMotion& floe : floes) encoder.add(floe);
  return encoder.end();
}

TEST(Frames, CarryOnFloesThatKeepTheirMotion) {
  FrameEncoder encoder;
  std::string bytes = FrameEncoder::header();
  const Motion drifting{{10, 20}, 0.5, {-0.05, -0.05}, 0};
  for (int k = 0; k <= 100; ++k) {
    const FloeMotion floe{3, carried_on(drifting, 2.0 * k)};
    bytes += encoded(encoder, 2.0 * k, {}, {&floe, 1});
  }
  const auto frames = tests::checked(decode_frames(bytes));
  ASSERT_EQ(frames->size(), 101U);
  EXPECT_EQ((*frames)[0].floes.size(), 1U);
  for (std::size_t k = 1; k < frames->size(); ++k) EXPECT_TRUE((*frames)[k].floes.empty());
}

TEST(Frames, TellEveryMotionWithinTheTolerances) {
  std::mt19937_64 random(7);
  std::normal_distribution<double> kick(0, 3e-4);
  constexpr std::size_t kFloes = 20;
  std::vector<FloeMotion> floes(kFloes);
  for (std::size_t i = 0; i < kFloes; ++i) floes[i].floe = static_cast<simulation::FloeId>(2 * i);
  FrameEncoder encoder;
  std::string bytes = FrameEncoder::header();
  std::vector<std::vector<FloeMotion>> truth;
  std::vector<Motion> ships{{{1, 2}, 3, {4, 5}, 6}};
  for (int k = 0; k < 200; ++k) {
    for (FloeMotion& floe : floes) {
      floe.motion = carried_on(floe.motion, 0.5);
      floe.motion.velocity += geometry::Vector{kick(random), kick(random)};
      floe.motion.angular_velocity += 0.01 * kick(random);
    }
    truth.push_back(floes);
    bytes += encoded(encoder, 0.5 * k, ships, floes);
  }
  const auto frames = tests::checked(decode_frames(bytes));
  std::vector<std::pair<double, Motion>> stated(2 * kFloes);
  std::size_t records = 0;
  for (std::size_t k = 0; k < frames->size(); ++k) {
    const Frame& frame = (*frames)[k];
    ASSERT_EQ(frame.ships.size(), 1U);
    EXPECT_EQ(frame.ships[0].velocity.y, 5);
    for (const FloeMotion& floe : frame.floes) stated[static_cast<std::size_t>(floe.floe)] = {frame.time, floe.motion};
    records += frame.floes.size();
    for (const FloeMotion& floe : truth[k]) {
      const auto& [time, motion] = stated[static_cast<std::size_t>(floe.floe)];
      const Motion carried = carried_on(motion, frame.time - time);
      EXPECT_LE(std::abs(carried.position.x - floe.motion.position.x), kFramePositionTolerance);
      EXPECT_LE(std::abs(carried.angle - floe.motion.angle), kFrameAngleTolerance);
      EXPECT_LE(std::abs(carried.velocity.y - floe.motion.velocity.y), kFrameSpeedTolerance);
    }
  }
  EXPECT_LT(records, 200 * kFloes);
}

TEST(Frames, LeaveOutALastFrameThatIsCutShort) {
  FrameEncoder encoder;
  const FloeMotion floe{0, {{1, 2}, 3, {4, 5}, 6}};
  const std::string head = FrameEncoder::header();
  const std::string first = encoded(encoder, 0, {}, {&floe, 1});
  const std::string second = encoded(encoder, 9, {}, {&floe, 1});
  for (std::size_t length = 0; length <= second.size(); ++length) {
    const auto frames = tests::checked(decode_frames(head + first + second.substr(0, length)));
    EXPECT_EQ(frames->size(), length == second.size() ? 2U : 1U);
  }
  EXPECT_FALSE(decode_frames("PLYNYFRMxxxx").has_value());
  EXPECT_FALSE(decode_frames(head + "GARBAGEGARBAGEGARBAGEGARBAGE").has_value());
}

}  // namespace
}  // namespace polynya::io
