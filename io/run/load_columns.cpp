#include "io/run/load_columns.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "io/text/csv_row.hpp"

namespace polynya::io {
namespace {

using simulation::ContactState;
using simulation::PanelSample;

constexpr std::array<std::string_view, 5> kPeakEnds{"", "bend", "split", "slip", "tilt"};

/// A column of the number at the end of a path of pointers to members.
template <class Row, class... Path>
LoadColumn<Row> number(std::string_view name, std::string_view meaning, Path... path) {
  const auto at = [path...](auto& row) -> auto& {
    return (row.*....*path);
  };
  return {name, meaning, [at](const Row& row) { return static_cast<double>(at(row)); },
          [at](Row& row, double value) {
            auto& place = at(row);
            place = static_cast<std::remove_reference_t<decltype(place)>>(value);
          }};
}

template <class Row>
void append_values(std::string& text, const Row& row, std::span<const LoadColumn<Row>> columns) {
  for (const LoadColumn<Row>& column : columns) {
    const double value = column.read(row);
    text += ',';
    if (!column.words.empty())
      text += column.words[static_cast<std::size_t>(value)];
    else if (!std::isnan(value))
      append_number(text, value);
  }
  text += '\n';
}

/// Of a field; nothing where it is neither a number nor a word of the column.
template <class Row>
std::optional<double> value_of(std::string_view field, const LoadColumn<Row>& column) {
  if (column.words.empty()) return field.empty() ? ContactState::kNowhere : csv_number(field);
  const auto word = std::ranges::find(column.words, field);
  if (word == column.words.end()) return {};
  return static_cast<double>(word - column.words.begin());
}

template <class Row>
bool read_values(std::string_view text, Row& row, std::span<const LoadColumn<Row>> columns) {
  bool has_more = true;
  for (const LoadColumn<Row>& column : columns) {
    if (!has_more) return true;
    const std::size_t comma = text.find(',');
    has_more = comma != std::string_view::npos;
    const auto value = value_of(text.substr(0, comma), column);
    if (!value) return false;
    column.store(row, *value);
    if (has_more) text.remove_prefix(comma + 1);
  }
  return !has_more;
}

}  // namespace

std::span<const ContactColumn> contact_columns() {
  using S = ContactState;
  static const std::array columns{
      number<S>("x_m", "where the force acts, over ground, when the step began: the contact line's centre of pressure",
                &S::point_in_world, &geometry::Point::x),
      number<S>("y_m", "likewise", &S::point_in_world, &geometry::Point::y),
      number<S>("fx_N", "the force on the first by the second, over ground: momentum given in the step, by its length",
                &S::force, &geometry::Vector::x),
      number<S>("fy_N", "likewise", &S::force, &geometry::Vector::y),
      number<S>("depth_m", "of the overlap, along the contact's normal", &S::depth),
      number<S>("is_crushing", "1 where the contact pressed with all that crushing ice carries, else 0",
                &S::is_crushing),
      number<S>("arc_m",
                "of that place on the waterline of `ship`, from its stem along the waterline, to port; to starboard "
                "negative; empty on a floe",
                &S::arc),
      number<S>("station_m", "of that place along the ship, from its stem aft; empty on a floe", &S::station),
      number<S>("width_m", "of the contact line", &S::width),
      number<S>("height_m", "of the ice that presses: its thickness, or what crushed of it at an inclined hull",
                &S::height),
      number<S>("pressure_Pa", "nominal: the force along the contact's normal, by width and height", &S::pressure),
      number<S>("thickness_m", "of the ice, of two floes the thinner; 0 of steel", &S::thickness),
      ContactColumn{"ended_by",
                    "of a peak what ended it: `bend`, `split`, `tilt` or `slip`; empty of a contact at a frame",
                    [](const S& s) { return static_cast<double>(s.ended_by); },
                    [](S& s, double word) { s.ended_by = static_cast<simulation::PeakEnd>(word); }, kPeakEnds}};
  return columns;
}

std::span<const PanelColumn> panel_columns() {
  using S = PanelSample;
  static const std::array columns{
      number<S>("panel", "its number from the stem, to port 0, 1, …, to starboard −1, −2, …", &S::column),
      number<S>("row", "from the bottom, 0, 1, …; −1: what acts above and below all rows", &S::row),
      number<S>("surge_N", "mean force of the ice forward", &S::load, &dynamics::Planar::surge),
      number<S>("sway_N", "mean force of the ice to port", &S::load, &dynamics::Planar::sway),
      number<S>("yaw_Nm", "mean moment of the ice counter-clockwise", &S::load, &dynamics::Planar::yaw),
      number<S>("force_N", "mean of what acts along the normals of its contacts", &S::force),
      number<S>("force_max_N", "of that, the largest step", &S::largest),
      number<S>("pressure_Pa", "`force_N` by the panel's area", &S::pressure),
      number<S>("loaded_s", "how long ice pressed on it in the interval", &S::loaded)};
  return columns;
}

void append_row(std::string& text, const ContactState& row) {
  append_values(text, row, contact_columns());
}
void append_row(std::string& text, const PanelSample& row) {
  append_values(text, row, panel_columns());
}
bool read_row(std::string_view text, ContactState& row) {
  return read_values(text, row, contact_columns());
}
bool read_row(std::string_view text, PanelSample& row) {
  return read_values(text, row, panel_columns());
}

}  // namespace polynya::io
