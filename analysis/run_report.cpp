#include "analysis/run_report.hpp"

#include <algorithm>
#include <array>

#include <fmt/format.h>

#include "io/run/records.hpp"
#include "io/text/json_writer.hpp"
#include "io/text/problem.hpp"

namespace polynya::analysis {
namespace {

using io::counted;
using io::id_or_none;
using io::JsonWriter;
using simulation::FloeId;

void add_hulls_and_crushed(std::string& text, const RunCheck& check, const simulation::Scene& scene) {
  const auto add = [&text](const std::string& line) { text += line + "\n"; };
  if (check.worst_with_hull.area > 0)
    add(fmt::format(
        "hulls      {} with floes whose boxes meet; largest: {} and floe {} at {:.6g} s, {:.6g} m2, a "
        "vertex {:.4g} m deep",
        counted(check.hull_pairs, "pair"), io::hull_name(scene, check.worst_hull), check.worst_with_hull.second,
        check.worst_with_hull.time, check.worst_with_hull.area, check.worst_with_hull.depth));
  if (!check.has_crushed) {
    add("crushed    not on record (no crushed.csv): overlaps are measured, not judged");
  } else {
    add(fmt::format("crushed    {} more than was crushed there and {:g} % of the smaller body",
                    check.uncrushed_pairs == 1 ? "1 pair shares" : fmt::format("{} pairs share", check.uncrushed_pairs),
                    100 * kUncrushedShare));
    const auto name = [&](const simulation::ContactState::Body& body) {
      return body.ship >= 0 ? std::string(io::hull_name(scene, body.ship)) : fmt::format("floe {}", body.floe);
    };
    for (const UncrushedOverlap& pair : check.uncrushed)
      add(
          fmt::format("           {} and {} at {:.6g} s about ({:.3f}, {:.3f}): {:.6g} m2 shared, {:.6g} m2 crushed, "
                      "{:.6g} m2 beyond it allowed",
                      name(pair.first), name(pair.second), pair.time, pair.place_in_world.x, pair.place_in_world.y,
                      pair.shared, pair.crushed, pair.allowed));
    add(fmt::format("work       {} of more than that; {} from the work on record by more than a factor of {:g}",
                    counted(check.paid_pairs, "crushed overlap"),
                    check.unpaid.size() == 1 ? "1 differs" : fmt::format("{} differ", check.unpaid.size()),
                    kMostWorkFactor));
    add(fmt::format(
        "           most at once, smaller overlaps included: {:.6g} kJ by what is crushed, {:.6g} kJ on record",
        1e-3 * check.most_expected, 1e-3 * check.work_then));
    for (std::size_t i = 0; i < std::min(check.unpaid.size(), kMostUncrushed); ++i) {
      const UnpaidOverlap& pair = check.unpaid[i];
      add(fmt::format("           {} and {} at {:.6g} s: {:.6g} m2 crushed, which takes {:.6g} kJ; {:.6g} kJ on record",
                      name(pair.first), name(pair.second), pair.time, pair.area, 1e-3 * pair.expected,
                      1e-3 * pair.work));
    }
  }
}

void write_worst(JsonWriter& json, std::string_view key, const Worst& worst) {
  json.key(key).open('{').key("largest_m2").value(worst.value);
  json.key("floe_id").value(id_or_none(worst.floe)).key("wrong").value(worst.wrong).close('}');
}

void write_shared(JsonWriter& json, std::string_view key, const SharedIce& shared) {
  json.key(key);
  if (shared.first == simulation::kNoFloe) {
    json.null();
    return;
  }
  json.open('{').key("floe_ids").list(std::array{shared.first, shared.second});
  json.key("t_s").value(shared.time).key("area_m2").value(shared.area).key("depth_m").value(shared.depth);
  json.close('}');
}

void write_invalid(JsonWriter& json, const std::vector<InvalidFloe>& invalid) {
  json.key("invalid").objects(invalid, [&](const InvalidFloe& floe) {
    json.key("floe_id").value(floe.floe).key("defect").value(floe.defect).key("places_m").value(floe.places_in_body);
  });
}

void write_hulls(JsonWriter& json, const RunCheck& check, const simulation::Scene& scene) {
  const auto write_body = [&](std::string_view key, const simulation::ContactState::Body& body) {
    json.key(key);
    if (body.ship >= 0)
      json.value(io::hull_name(scene, body.ship));
    else
      json.value(body.floe);
  };
  json.key("hull_pairs").value(check.hull_pairs).key("largest_overlap_with_hull");
  if (check.worst_hull >= 0) {
    json.open('{').key("ship").value(io::hull_name(scene, check.worst_hull));
    json.key("floe_id").value(check.worst_with_hull.second).key("t_s").value(check.worst_with_hull.time);
    json.key("area_m2").value(check.worst_with_hull.area).key("depth_m").value(check.worst_with_hull.depth);
    json.close('}');
  } else {
    json.null();
  }
  json.key("has_crushed").value(check.has_crushed).key("uncrushed_pairs").value(check.uncrushed_pairs);
  json.key("uncrushed").object_lines(check.uncrushed, [&](const UncrushedOverlap& pair) {
    write_body("first", pair.first);
    write_body("second", pair.second);
    json.key("t_s").value(pair.time).key("place_m").value(pair.place_in_world);
    json.key("shared_m2").value(pair.shared).key("crushed_m2").value(pair.crushed);
    json.key("allowed_beyond_m2").value(pair.allowed);
  });
  json.key("compared_with_work").value(check.paid_pairs).key("most_expected_J").value(check.most_expected);
  json.key("crushing_then_J").value(check.work_then);
  json.key("unpaid").object_lines(check.unpaid, [&](const UnpaidOverlap& pair) {
    write_body("first", pair.first);
    write_body("second", pair.second);
    json.key("t_s").value(pair.time).key("crushed_m2").value(pair.area);
    json.key("expected_J").value(pair.expected).key("crushing_J").value(pair.work);
  });
}

}  // namespace

std::string to_text(const SizeDistribution& sizes) {
  std::string text = fmt::format("{}, {:.6f} m2 at {:.6g} s; size is the root of the area\n",
                                 counted(sizes.count, "floe"), sizes.area, sizes.time);
  if (sizes.without_size > 0)
    text +=
        fmt::format("left out: {} whose recorded area is not a positive number\n", counted(sizes.without_size, "floe"));
  if (sizes.count == 0) return text;
  text +=
      fmt::format("size_m: least {:.6g}, median {:.6g}, largest {:.6g}\n", sizes.least, sizes.median, sizes.largest);
  text += fmt::format("{:>10} {:>10} {:>8} {:>16} {:>8} {:>10}\n", "from_m", "below_m", "floes", "area_m2", "area_%",
                      "from_on");
  for (const SizeClass& one : sizes.classes)
    text += fmt::format("{:>10g} {:>10g} {:>8} {:>16.6f} {:>8.3f} {:>10}\n", one.from, one.below, one.count, one.area,
                        100 * one.area / sizes.area, one.from_on);
  return text;
}

std::string to_text(const RunCheck& check, const simulation::Scene& scene) {
  std::string text;
  const auto add = [&text](const std::string& line) { text += line + "\n"; };
  const auto from = [](FloeId floe) {
    return floe == simulation::kNoFloe ? std::string() : fmt::format(" (floe {})", floe);
  };
  add(fmt::format("validity   {}, {} invalid", counted(check.shapes, "shape"), check.invalid.size()));
  for (const InvalidFloe& floe : check.invalid) {
    add(fmt::format("           floe {}: {}{}", floe.floe, floe.defect, io::places_in_words(floe.places_in_body, 4)));
  }
  add(fmt::format("areas      recorded - ring at most {:.2e} m2{}, {} beyond {:g} of the area",
                  check.recorded_area.value, from(check.recorded_area.floe), check.recorded_area.wrong,
                  kAreaTolerance));
  add(
      fmt::format("fractures  {}: pieces + submerged + brash - rounding - parent at most {:.2e} m2{}, {} "
                  "beyond {:g} of it",
                  check.fractures, check.balance.value, from(check.balance.floe), check.balance.wrong, kAreaTolerance));
  add(check.siblings.area > 0 ? fmt::format("           pieces of one fracture share at most {:.2e} m2 in "
                                            "their body frame (floes {} and {})",
                                            check.siblings.area, check.siblings.first, check.siblings.second)
                              : "           pieces of one fracture share 0 m2 in their body frame, exactly");
  add(fmt::format("overlap    {}, {} with boxes that meet, {} not decided; {} more than 1e-6 m2 at some instant",
                  counted(check.instants, "instant"), counted(check.pairs, "pair"), check.undecided,
                  check.overlapping_pairs == 1 ? "1 pair of floes shares"
                                               : fmt::format("{} pairs of floes share", check.overlapping_pairs)));
  add(fmt::format("           most at once {:.6g} m2 at {:.6g} s, {:.2e} of the {:.6g} m2 of ice", check.most_shared,
                  check.most_shared_time, check.ice_then > 0 ? check.most_shared / check.ice_then : 0, check.ice_then));
  const auto add_pair = [&](const char* words, const SharedIce& pair) {
    if (pair.first == simulation::kNoFloe) return;
    add(fmt::format("           {}: floes {} and {} at {:.6g} s, {:.6g} m2, a vertex {:.4g} m deep", words, pair.first,
                    pair.second, pair.time, pair.area, pair.depth));
  };
  add_pair("largest", check.worst);
  add_pair("deepest", check.deepest);
  add_hulls_and_crushed(text, check, scene);
  add("           Overlap is part of the contact model: ice in contact is let in by what it crushes, and "
      "frames are right to");
  add("           1 mm and 1e-5 rad. All areas are exact for the rings and poses on record.");
  add(check.is_sound() ? "sound" : "NOT SOUND");
  return text;
}

std::string to_json_text(const SizeDistribution& sizes) {
  return io::json_object([&](JsonWriter& json) {
    json.key("t_s").value(sizes.time).key("floes").value(sizes.count).key("left_out").value(sizes.without_size);
    json.key("area_m2").value(sizes.area).key("least_m").value(sizes.least).key("median_m").value(sizes.median);
    json.key("largest_m").value(sizes.largest);
    json.key("classes").object_lines(sizes.classes, [&](const SizeClass& one) {
      json.key("from_m").value(one.from).key("below_m").value(one.below).key("floes").value(one.count);
      json.key("area_m2").value(one.area).key("from_on").value(one.from_on);
    });
  });
}

std::string to_json_text(const RunCheck& check, const simulation::Scene& scene) {
  const auto write = [&](JsonWriter& json) {
    json.key("is_sound").value(check.is_sound()).key("shapes").value(check.shapes);
    write_invalid(json, check.invalid);
    write_worst(json, "recorded_area", check.recorded_area);
    json.key("fractures").value(check.fractures);
    write_worst(json, "balance", check.balance);
    json.key("overlapping_siblings").value(check.overlapping_siblings);
    json.key("most_shared_by_siblings_m2").value(check.siblings.area);
    json.key("moments").value(check.instants).key("pairs").value(check.pairs);
    json.key("undecided").value(check.undecided).key("overlapping_pairs").value(check.overlapping_pairs);
    json.key("most_shared_m2").value(check.most_shared).key("most_shared_s").value(check.most_shared_time);
    json.key("ice_then_m2").value(check.ice_then);
    write_shared(json, "largest_overlap", check.worst);
    write_shared(json, "deepest_overlap", check.deepest);
    write_hulls(json, check, scene);
  };
  return io::json_object(write, JsonWriter::Layout::kIndented);
}

}  // namespace polynya::analysis
