#include "fracture/bending/database_text.hpp"

#include <array>
#include <cassert>
#include <charconv>
#include <optional>
#include <utility>

namespace polynya::fracture {
namespace {

constexpr std::string_view kTitle = "polynya-bending-database 1";
constexpr std::string_view kColumns = "columns force radius crack";
constexpr std::size_t kMostGridValues = 64;  ///< of an axis: a damaged count must not reserve memory

struct FluidName {
  FluidModel fluid;
  std::string_view name;
};
constexpr std::array<FluidName, 4> kFluidNames = {{{FluidModel::kWinkler, "winkler"},
                                                   {FluidModel::kLocalMass, "local-mass"},
                                                   {FluidModel::kPotential, "potential"},
                                                   {FluidModel::kFreeSurface, "free-surface"}}};

/// A numeric setting, by its name in the file, with the values that the reader accepts.
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

/// FNV-1a, 64 bits [Fowler2019]: against accidents, not against malice.
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

/// The lines of a text, one at a time, and what is wrong with them.
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

  /// The next line without its newline; empty after a failure.
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

  /// What follows "name " on the next line.
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
