#include "fracture/bending/database.hpp"

#include <algorithm>
#include <atomic>
#include <cassert>
#include <charconv>
#include <mutex>
#include <optional>
#include <thread>
#include <utility>

#include "elementary/elementary.hpp"
#include "fracture/bending/wedge_solver.hpp"
#include "geometry/shape/angle.hpp"

namespace polynya::fracture {

namespace {

template <class Map>
std::vector<double> mapped(std::vector<double> values, Map map) {
  std::transform(values.begin(), values.end(), values.begin(), map);
  return values;
}

/// An interval of one axis, and the place of a coordinate in it, 0 to 1.
struct Cell {
  std::size_t lower = 0;
  double fraction = 0;

  double weight(unsigned end) const { return end == 0 ? 1 - fraction : fraction; }
};

Cell cell_at(const std::vector<double>& axis, double x) {
  const auto after = std::upper_bound(axis.begin() + 1, axis.end() - 1, x);
  const auto upper = static_cast<std::size_t>(after - axis.begin());
  return {upper - 1, std::clamp((x - axis[upper - 1]) / (axis[upper] - axis[upper - 1]), 0.0, 1.0)};
}

/// Exponent with which the interpolation between two softnesses follows pushes of equal duration, Fr ∝ Π^½ [-]: the
/// time to the break, τ_b = √(Π V̂)/Fr, is then the same at both except for V̂.
constexpr double kEqualDuration = 0.5;

/// Returns where to read the table at the lower and the upper value of the softness cell. The effect of inertia on the
/// break depends on the duration of the push, so the table is far smoother along Fr ∝ Π^½ than along Π alone. Near the
/// ends of the Froude axis the exponent shrinks to one that both softnesses allow.
std::array<Cell, 2> froude_cells(const std::vector<double>& softnesses, const Cell& softness,
                                 const std::vector<double>& froudes, double log_froude) {
  const double x = std::clamp(log_froude, froudes.front(), froudes.back());
  const double width = softnesses[softness.lower + 1] - softnesses[softness.lower];
  const double below = softness.fraction * width, above = width - below;
  const double exponent = std::min({kEqualDuration, (x - froudes.front()) / std::max(below, 1e-300),
                                    (froudes.back() - x) / std::max(above, 1e-300)});
  return {cell_at(froudes, x - exponent * below), cell_at(froudes, x + exponent * above)};
}

/// Returns the coordinates of a load on the axes.
std::array<double, 4> axis_coordinates(const WedgeGroups& groups) {
  return {groups.opening_angle, elementary::log(groups.mass_ratio), elementary::log(groups.softness),
          elementary::log(groups.froude)};
}

/// Tolerance at the edge of an axis, so that rounding does not count as outside [-].
constexpr double kEdgeTolerance = 1e-9;

/// Returns one bit per group that lies outside of its axis, NaN included. A Froude number below the smallest does not
/// count as outside: the wedge is only closer to rest.
std::uint8_t outside_bits(const std::array<std::vector<double>, 4>& axes, const std::array<double, 4>& x) {
  unsigned bits = 0;
  for (std::size_t axis = 0; axis < axes.size(); ++axis) {
    const bool may_be_below = axis == static_cast<std::size_t>(Group::kFroude);
    const bool is_inside = x[axis] <= axes[axis].back() + kEdgeTolerance &&
                           (x[axis] >= axes[axis].front() - kEdgeTolerance || may_be_below);
    if (!is_inside) bits |= 1U << axis;
  }
  return static_cast<std::uint8_t>(bits);
}

}  // namespace

bool is_grid_axis(const std::vector<double>& values) {
  if (values.size() < 2 || !(values.front() >= 1e-12) || !(values.back() <= 1e12)) return false;
  for (std::size_t i = 1; i < values.size(); ++i)
    if (!(values[i] > values[i - 1] * (1 + kEdgeTolerance))) return false;
  return true;
}

/// Chosen with `polynya_bench_wedges accuracy`: finer in Fr where inertia overshoots, and in Π where the loaded patch
/// is no longer small.
DatabaseGrid default_grid() {
  return {{20, 29, 40, 51, 63, 76, 90, 104, 118, 132, 145, 156, 165, 173, 180},
          {0.02, 0.05, 0.1},
          {3e-5, 9.5e-5, 2.7e-4, 7e-4, 1.6e-3, 3.5e-3, 7e-3, 1.3e-2, 2.3e-2, 4e-2, 6.5e-2, 1e-1},
          {5e-4,   7.5e-4, 1.1e-3, 1.6e-3, 2.3e-3, 3.3e-3, 4.7e-3, 6.7e-3, 9.4e-3, 1.3e-2, 1.8e-2, 2.5e-2, 3.5e-2,
           4.8e-2, 6.5e-2, 8.7e-2, 0.114,  0.15,   0.2,    0.27,   0.38,   0.54,   0.76,   1.07,   1.5}};
}

BendingDatabase::BendingDatabase(SolverSettings settings, DatabaseGrid grid, std::vector<DatabaseEntry> entries)
    : settings_(settings), grid_(std::move(grid)), entries_(std::move(entries)) {
  assert(entries_.size() == grid_.size());
  assert(is_grid_axis(grid_.opening_angles_deg) && is_grid_axis(grid_.mass_ratios) && is_grid_axis(grid_.softnesses) &&
         is_grid_axis(grid_.froude_numbers));
  const auto logarithm = [](double x) { return elementary::log(x); };
  coordinates_ = {
      mapped(grid_.opening_angles_deg, [](double degrees) { return degrees * geometry::kRadiansPerDegree; }),
      mapped(grid_.mass_ratios, logarithm), mapped(grid_.softnesses, logarithm),
      mapped(grid_.froude_numbers, logarithm)};
  strides_[3] = 1;
  for (std::size_t axis = 3; axis > 0; --axis) strides_[axis - 1] = strides_[axis] * coordinates_[axis].size();
  stored_.reserve(entries_.size());
  for (std::size_t i = 0; i < entries_.size(); ++i) {
    const DatabaseEntry& e = entries_[i];
    assert(e.force > 0 && e.cusp_radius > 0);
    const double opening_angle = coordinates_[0][i / strides_[0]];
    stored_.push_back({elementary::log(e.force / opening_angle), elementary::log(e.cusp_radius), e.crack_ratio});
  }
}

DatabaseAnswer BendingDatabase::look_up(const WedgeGroups& groups) const {
  const std::array<double, 4> x = axis_coordinates(groups);
  const Cell angle = cell_at(coordinates_[0], x[0]), mass = cell_at(coordinates_[1], x[1]),
             softness = cell_at(coordinates_[2], x[2]);
  const std::array<Cell, 2> froude = froude_cells(coordinates_[2], softness, coordinates_[3], x[3]);
  DatabaseAnswer answer;
  answer.outside = outside_bits(coordinates_, x);
  double log_force = 0, log_radius = 0;
  for (unsigned vertex = 0; vertex < 16; ++vertex) {  // the corners of the cell
    const unsigned a = vertex & 1U, m = (vertex >> 1U) & 1U, s = (vertex >> 2U) & 1U, f = vertex >> 3U;
    const double weight = angle.weight(a) * mass.weight(m) * softness.weight(s) * froude[s].weight(f);
    const DatabaseEntry& e = stored_[(angle.lower + a) * strides_[0] + (mass.lower + m) * strides_[1] +
                                     (softness.lower + s) * strides_[2] + (froude[s].lower + f) * strides_[3]];
    log_force += weight * e.force;
    log_radius += weight * e.cusp_radius;
    answer.crack_ratio += weight * e.crack_ratio;
  }
  const std::vector<double>& angles = coordinates_[0];
  answer.force = elementary::exp(log_force) * std::clamp(groups.opening_angle, angles.front(), angles.back());
  answer.cusp_radius = elementary::exp(log_radius);
  return answer;
}

std::vector<OutsideRange> BendingDatabase::outside(const WedgeGroups& groups) const {
  const std::uint8_t bits = outside_bits(coordinates_, axis_coordinates(groups));
  const std::array<double, 4> values = {groups.opening_angle * geometry::kDegreesPerRadian, groups.mass_ratio,
                                        groups.softness, groups.froude};
  const std::array<const std::vector<double>*, 4> axes = {&grid_.opening_angles_deg, &grid_.mass_ratios,
                                                          &grid_.softnesses, &grid_.froude_numbers};
  std::vector<OutsideRange> ranges;
  for (std::size_t axis = 0; axis < axes.size(); ++axis)
    if (((static_cast<unsigned>(bits) >> axis) & 1U) != 0)
      ranges.push_back({std::string(kGroupNames[axis]), values[axis], axes[axis]->front(), axes[axis]->back()});
  return ranges;
}

// ---- solution of the whole grid

namespace {

/// Rounds to six significant digits. This is far finer than the solution, and gives the same digits on machines whose
/// mathematical functions differ in the last bit.
double rounded(double x) {
  std::array<char, 32> text{};
  const auto end = std::to_chars(text.data(), text.data() + text.size(), x, std::chars_format::scientific, 5).ptr;
  double value = 0;
  std::from_chars(text.data(), end, value);
  return value;
}

struct Wedge {
  double opening_angle_deg;
  double mass_ratio;
};

/// Returns the entries of all pushes on one wedge; nullopt if one of the pushes does not break it.
std::optional<std::vector<DatabaseEntry>> solve_wedge(const Wedge& wedge, const SolverSettings& settings,
                                                      const DatabaseGrid& grid) {
  const WedgeSolver solver(wedge.opening_angle_deg * geometry::kRadiansPerDegree, wedge.mass_ratio, settings);
  std::vector<DatabaseEntry> entries;
  for (const double softness : grid.softnesses) {
    for (const double froude : grid.froude_numbers) {
      const std::optional<WedgeFailure> failure = solver.failure({froude, softness, 0, 0});
      if (!failure) return std::nullopt;
      entries.push_back({rounded(failure->force), rounded(failure->cusp_radius), rounded(failure->crack_ratio)});
    }
  }
  return entries;
}

}  // namespace

tl::expected<BendingDatabase, DatabaseError> build_database(const SolverSettings& settings, const DatabaseGrid& grid,
                                                            int threads, const BuildProgress& progress) {
  for (const auto* axis : {&grid.opening_angles_deg, &grid.mass_ratios, &grid.softnesses, &grid.froude_numbers})
    if (!is_grid_axis(*axis))
      return tl::unexpected(DatabaseError{0, "every group needs at least two positive, ascending values"});
  if (grid.opening_angles_deg.back() > 180)
    return tl::unexpected(DatabaseError{0, "opening angles above 180 degrees are not wedges"});

  std::vector<Wedge> wedges;
  for (const double angle : grid.opening_angles_deg)
    for (const double mass : grid.mass_ratios) wedges.push_back({angle, mass});
  std::vector<std::optional<std::vector<DatabaseEntry>>> solved(wedges.size());
  std::atomic<std::size_t> next = 0;
  std::size_t done = 0;
  std::mutex progress_mutex;
  const auto solve_all = [&] {
    for (std::size_t i = next++; i < wedges.size(); i = next++) {
      solved[i] = solve_wedge(wedges[i], settings, grid);
      const std::lock_guard lock(progress_mutex);
      ++done;
      if (progress) progress(done, wedges.size());
    }
  };
  {
    std::vector<std::jthread> helpers;
    for (int i = 1; i < threads; ++i) helpers.emplace_back(solve_all);
    solve_all();
  }

  std::vector<DatabaseEntry> entries;
  for (std::size_t i = 0; i < wedges.size(); ++i) {
    if (!solved[i])
      return tl::unexpected(DatabaseError{0, "a push of the grid does not break the wedge of " +
                                                 std::to_string(wedges[i].opening_angle_deg) +
                                                 " degrees within a penetration of 3 l: take smaller softnesses"});
    entries.insert(entries.end(), solved[i]->begin(), solved[i]->end());
  }
  return BendingDatabase(settings, grid, std::move(entries));
}

// ---- text

namespace {

constexpr std::string_view kTitle = "polynya-bending-database 1";
constexpr std::string_view kColumns = "columns force radius crack";
constexpr std::size_t kMostGridValues = 64;  ///< of an axis, so that a damaged count cannot reserve much memory

struct FluidName {
  FluidModel fluid;
  std::string_view name;
};
constexpr std::array<FluidName, 4> kFluidNames = {{{FluidModel::kWinkler, "winkler"},
                                                   {FluidModel::kLocalMass, "local-mass"},
                                                   {FluidModel::kPotential, "potential"},
                                                   {FluidModel::kFreeSurface, "free-surface"}}};

/// A numeric setting: its name in the file and the values that the reader accepts.
template <typename Number>
struct Setting {
  std::string_view name;
  Number SolverSettings::*member;
  Number least, most;
};
constexpr std::array<Setting<double>, 4> kLengths = {{{"poisson_ratio", &SolverSettings::poisson_ratio, 0, 0.5},
                                                      {"local_mass", &SolverSettings::local_mass, 0, 100},
                                                      {"inner_radius", &SolverSettings::inner_radius, 1e-6, 1},
                                                      {"outer_radius", &SolverSettings::outer_radius, 1, 1e3}}};
constexpr std::array<Setting<int>, 6> kCounts = {
    {{"radial_elements", &SolverSettings::radial_elements, 4, 10000},
     {"angular_terms", &SolverSettings::angular_terms, 1, 1000},
     {"panel_rings", &SolverSettings::panel_rings, 1, 10000},
     {"panel_columns", &SolverSettings::panel_columns, 1, 10000},
     {"free_surface_columns", &SolverSettings::free_surface_columns, 1, 10000},
     {"steps_to_failure", &SolverSettings::steps_to_failure, 1, 1000000}}};

struct GridName {
  std::string_view name;
  std::vector<double> DatabaseGrid::*member;
};
constexpr std::array<GridName, 4> kGrids = {{{"opening_angle_deg", &DatabaseGrid::opening_angles_deg},
                                             {"mass_ratio", &DatabaseGrid::mass_ratios},
                                             {"softness", &DatabaseGrid::softnesses},
                                             {"froude", &DatabaseGrid::froude_numbers}}};

// ---- writing

template <typename Number>
void append(std::string& text, Number value) {
  std::array<char, 32> digits{};
  text.append(digits.data(), std::to_chars(digits.data(), digits.data() + digits.size(), value).ptr);
}

/// Returns the FNV-1a hash, 64 bits [Fowler2019]. It protects against accidents, not against malice.
std::string hash_of(std::string_view text) {
  std::uint64_t hash = 0xcbf29ce484222325U;
  for (const char c : text) hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001b3U;
  constexpr std::string_view kDigits = "0123456789abcdef";
  std::string digits;
  for (int shift = 60; shift >= 0; shift -= 4) digits += kDigits[(hash >> static_cast<unsigned>(shift)) & 15U];
  return digits;
}

std::string body(const BendingDatabase& database) {
  std::string text(kTitle);
  text += "\nfluid ";
  text += fluid_name(database.settings().fluid);
  const auto item = [&text](std::string_view name, auto value) {
    text += '\n';
    text += name;
    text += ' ';
    append(text, value);
  };
  for (const auto& setting : kLengths) item(setting.name, database.settings().*setting.member);
  for (const auto& setting : kCounts) item(setting.name, database.settings().*setting.member);
  for (const auto& [name, member] : kGrids) {
    text += '\n';
    text += name;
    for (const double value : database.grid().*member) {
      text += ' ';
      append(text, value);
    }
  }
  text += '\n';
  text += kColumns;
  item("entries", database.entries().size());
  for (const DatabaseEntry& e : database.entries()) {
    text += '\n';
    append(text, e.force);
    text += ' ';
    append(text, e.cusp_radius);
    text += ' ';
    append(text, e.crack_ratio);
  }
  return text + '\n';
}

// ---- reading

/// Reads the lines of a text, one at a time, and keeps the first error.
class Reader {
 public:
  explicit Reader(std::string_view text) : text_(text) {}

  bool has_failed() const { return error_.has_value(); }
  const DatabaseError& error() const { return *error_; }
  std::size_t position() const { return position_; }
  bool is_at_end() const { return position_ == text_.size(); }

  void fail(std::string message) {
    if (!error_) error_ = DatabaseError{line_, std::move(message)};
  }

  /// Returns the next line without its newline; empty after an error.
  std::string_view line() {
    if (error_) return {};
    ++line_;
    const std::size_t end = text_.find('\n', position_);
    if (end == std::string_view::npos) {
      fail("the file ends in the middle of a line");
      return {};
    }
    const std::string_view found = text_.substr(position_, end - position_);
    position_ = end + 1;
    return found;
  }

  void expect(std::string_view wanted) {
    const std::string_view found = line();
    if (found != wanted) fail("expected '" + std::string(wanted) + "', found '" + excerpt(found) + "'");
  }

  /// Returns the text that follows "name " on the next line.
  std::string_view item(std::string_view name) {
    const std::string_view found = line();
    if (found.size() > name.size() + 1 && found.substr(0, name.size()) == name && found[name.size()] == ' ')
      return found.substr(name.size() + 1);
    fail("expected '" + std::string(name) + " …', found '" + excerpt(found) + "'");
    return {};
  }

  template <typename Number>
  Number number(std::string_view digits) {
    Number value{};
    const auto [end, problem] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
    if (problem == std::errc() && end == digits.data() + digits.size()) return value;
    fail("not a number: '" + excerpt(digits) + "'");
    return {};
  }

  std::vector<double> numbers(std::string_view list, std::size_t most) {
    std::vector<double> values;
    while (!has_failed()) {
      const std::size_t space = list.find(' ');
      values.push_back(number<double>(list.substr(0, space)));
      if (values.size() > most) fail("more than " + std::to_string(most) + " numbers");
      if (space == std::string_view::npos) break;
      list.remove_prefix(space + 1);
    }
    return values;
  }

 private:
  static std::string excerpt(std::string_view text) {
    constexpr std::size_t kLongest = 40;
    std::string shown(text.substr(0, kLongest));
    for (char& c : shown)
      if (static_cast<unsigned char>(c) < 0x20 || static_cast<unsigned char>(c) == 0x7f) c = '?';
    return text.size() > kLongest ? shown + "..." : shown;
  }

  std::string_view text_;
  std::size_t position_ = 0;
  int line_ = 0;
  std::optional<DatabaseError> error_;
};

template <typename Number>
void read_setting(Reader& reader, const Setting<Number>& setting, SolverSettings& settings) {
  const auto value = reader.number<Number>(reader.item(setting.name));
  if (!(value >= setting.least && value <= setting.most)) reader.fail("out of range: " + std::string(setting.name));
  settings.*setting.member = value;
}

SolverSettings read_settings(Reader& reader) {
  SolverSettings settings;
  const auto fluid = fluid_from_name(reader.item("fluid"));
  if (fluid)
    settings.fluid = *fluid;
  else
    reader.fail(fluid.error().message);
  for (const auto& setting : kLengths) read_setting(reader, setting, settings);
  for (const auto& setting : kCounts) read_setting(reader, setting, settings);
  return settings;
}

DatabaseGrid read_grid(Reader& reader) {
  DatabaseGrid grid;
  for (const auto& [name, member] : kGrids) {
    const std::vector<double> values = reader.numbers(reader.item(name), kMostGridValues);
    if (!is_grid_axis(values))
      reader.fail("the values of " + std::string(name) + " must lie from 1e-12 to 1e12 and ascend");
    grid.*member = values;
  }
  if (!reader.has_failed() && grid.opening_angles_deg.back() > 180)
    reader.fail("an opening angle is above 180 degrees");
  return grid;
}

DatabaseEntry read_entry(Reader& reader) {
  const std::vector<double> values = reader.numbers(reader.line(), 3);
  if (values.size() != 3) {
    reader.fail("expected three numbers: force, radius, crack");
    return {};
  }
  const auto is_sound = [](double x) { return x >= 1e-12 && x <= 1e12; };
  if (!is_sound(values[0]) || !is_sound(values[1]) || !(values[2] >= 0 && values[2] <= 1e12))
    reader.fail("force and radius must be positive, the crack ratio not negative");
  return {values[0], values[1], values[2]};
}

}  // namespace

std::string_view fluid_name(FluidModel fluid) {
  return kFluidNames[static_cast<std::size_t>(fluid)].name;
}

tl::expected<FluidModel, DatabaseError> fluid_from_name(std::string_view name) {
  for (const auto& [fluid, known] : kFluidNames)
    if (known == name) return fluid;
  return tl::unexpected(
      DatabaseError{0, "no such fluid model; there are winkler, local-mass, potential, free-surface"});
}

std::string write_database(const BendingDatabase& database) {
  const std::string text = body(database);
  return text + "hash fnv1a64 " + hash_of(text) + '\n';
}

std::string database_hash(const BendingDatabase& database) {
  return hash_of(body(database));
}

tl::expected<BendingDatabase, DatabaseError> parse_database(std::string_view text) {
  if (text.size() > kLargestFile) return tl::unexpected(DatabaseError{0, "the file is too large for a database"});
  Reader reader(text);
  reader.expect(kTitle);
  const SolverSettings settings = read_settings(reader);
  DatabaseGrid grid = read_grid(reader);
  reader.expect(kColumns);
  const auto count = reader.number<std::size_t>(reader.item("entries"));
  if (count > kMostEntries) reader.fail("more than " + std::to_string(kMostEntries) + " entries");
  if (!reader.has_failed() && count != grid.size())
    reader.fail("the grids have " + std::to_string(grid.size()) + " points, not " + std::to_string(count));
  std::vector<DatabaseEntry> entries;
  while (!reader.has_failed() && entries.size() < count) entries.push_back(read_entry(reader));
  const std::string hash = hash_of(text.substr(0, reader.position()));
  reader.expect("hash fnv1a64 " + hash);
  if (!reader.has_failed() && !reader.is_at_end()) reader.fail("something follows the hash");
  if (reader.has_failed()) return tl::unexpected(reader.error());
  return BendingDatabase(settings, std::move(grid), std::move(entries));
}

const BendingDatabase& default_database() {
  static const BendingDatabase database = [] {
    auto parsed = parse_database(default_database_text());
    assert(parsed.has_value());
    return *std::move(parsed);
  }();
  return database;
}

}  // namespace polynya::fracture
