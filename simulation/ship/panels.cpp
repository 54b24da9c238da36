#include "simulation/ship/panels.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "simulation/world/world.hpp"

namespace polynya::simulation {
namespace {

using dynamics::Contact;
using dynamics::Planar;
using geometry::Point;

/// The division of a hull's waterline and height into panels.
struct PanelGrid {
  const PanelSettings& settings;
  const Waterline& waterline;
  /// Returns the number of columns on each side.
  int half_columns() const { return static_cast<int>(std::ceil(waterline.length / 2 / settings.length - 1e-9)); }
  /// Returns the number of elements in each column: its rows, and one for the ice above and below them.
  std::size_t row_count() const { return static_cast<std::size_t>(settings.rows) + 1; }
  std::size_t size() const { return std::size_t{2} * static_cast<std::size_t>(half_columns()) * row_count(); }
  /// Returns the index in HullPanels of the first element of a column.
  std::size_t first_of(int column) const { return static_cast<std::size_t>(column + half_columns()) * row_count(); }
  /// Returns the length of a column along the waterline [m]. The column farthest from the stem on each side ends where
  /// the two sides meet.
  double length_of(int column) const {
    const double from = settings.length * (column < 0 ? -column - 1 : column);
    return std::min(settings.length, waterline.length / 2 - from);
  }
  double row_height() const { return (settings.top - settings.bottom) / settings.rows; }
};

/// Calls use(column, share) for each column that contains a part of a stretch of the waterline, with that part as a
/// fraction of the stretch. `from` and `to` are arc lengths from the stem [m]; `to` may lie beyond the place farthest
/// from the stem.
template <class Use>
void for_columns(const PanelGrid& grid, double from, double to, Use use) {
  const double half = grid.waterline.length / 2;
  const auto column_at = [&](double arc) {
    return std::clamp(static_cast<int>(std::floor(arc / grid.settings.length)), -grid.half_columns(),
                      grid.half_columns() - 1);
  };
  const double width = to - from;
  if (!(width > 1e-9)) return use(column_at(from > half ? from - 2 * half : from), 1.0);
  const auto within = [&](double low, double high) {  // arc lengths between −half and half
    for (int column = column_at(low); column <= column_at(high); ++column) {
      const double begin = column == column_at(low) ? low : column * grid.settings.length;
      const double end = column == column_at(high) ? high : (column + 1) * grid.settings.length;
      use(column, (end - begin) / width);
    }
  };
  if (from < half) within(from, std::min(to, half));
  if (to > half) within(std::max(from, half) - 2 * half, to - 2 * half);
}

/// Range of heights of the ice that presses on a hull, above the water level [m].
struct IceHeight {
  double bottom = 0;
  double top = 0;
};

/// Calls use(row, share) for each row that contains a part of the ice's height, with that part as a fraction of the
/// height. The row number `rows` stands for the ice above and below all rows.
template <class Use>
void for_rows_of(const PanelGrid& grid, const IceHeight& ice, Use use) {
  const auto [bottom, top] = ice;
  const double height = std::max(top - bottom, 1e-9);
  double inside = 0;
  for (int row = 0; row < grid.settings.rows; ++row) {
    const double low = grid.settings.bottom + row * grid.row_height();
    const double share = (std::min(bottom + height, low + grid.row_height()) - std::max(bottom, low)) / height;
    if (share <= 0) continue;
    inside += share;
    use(row, share);
  }
  if (inside < 1 - 1e-12) use(grid.settings.rows, 1 - inside);
}

/// Adds the impulses of a contact with ice to the panels of its hull.
void add_contact(const PanelGrid& grid, const dynamics::Bodies& bodies, const Contact& c, const IceHeight& ice,
                 HullPanels& panels) {
  const geometry::Pose pose = dynamics::water_from_body(bodies, c.a);
  const double full = grid.waterline.length;
  const std::array<double, 2> arc{arc_at(grid.waterline, inverse_transform(pose, c.ends[0])),
                                  arc_at(grid.waterline, inverse_transform(pose, c.ends[1]))};
  // The ends from starboard to port; the line may pass the stem or the place farthest from it.
  std::array<int, 2> end{0, 1};
  if ((arc[0] > arc[1]) != (std::abs(arc[0] - arc[1]) > full / 2)) std::swap(end[0], end[1]);
  const double from = arc[end[0]], to = from + std::remainder(arc[end[1]] - from, full);
  const double middle = 0.5 * (from + to);
  const Planar slip = planar_of(bodies, c.a, c.middle(), -c.slip_impulse * perpendicular(c.normal));
  for (int half = 0; half < 2; ++half) {
    const double normal = c.normal_impulse[end[half]];
    if (normal == 0) continue;
    const Planar load = planar_of(bodies, c.a, c.ends[end[half]], -normal * c.normal) +
                        normal / c.total_normal_impulse() * slip;  // friction acts where the ice presses
    for_columns(grid, half == 0 ? from : middle, half == 0 ? middle : to, [&](int column, double along) {
      for_rows_of(grid, ice, [&](int row, double up) {
        PanelLoads& panel = panels[grid.first_of(column) + static_cast<std::size_t>(row)];
        panel.impulse += along * up * c.step_share * load;
        panel.carried_load += along * up * (1 - c.step_share) * load;
        panel.step += along * up * c.step_share * normal;
        panel.step_missed += along * up * (1 - c.step_share) * normal;
      });
    });
  }
}

/// Adds the impulses of a step of length dt [s] to the sums of a panel.
void book_step(PanelLoads& panel, double dt) {
  const double carried = panel.carried.impulse + panel.step_missed;
  if (panel.step == 0 && carried == 0) return;
  if (panel.step > 0) panel.loaded += dt;
  const double booked = panel.carried.book(panel.step, panel.step_missed, dt);
  if (carried > 0) {
    const Planar given = (booked - panel.step) / carried * panel.carried_load;
    panel.impulse += given;
    panel.carried_load += -1.0 * given;
  }
  panel.normal += booked;
  panel.largest = std::max(panel.largest, booked / dt);
  panel.step = panel.step_missed = 0;
}

}  // namespace

std::vector<HullPanels> panels_of(const Setup& setup) {
  std::vector<HullPanels> panels(hull_count(setup.scene));
  for (std::size_t hull = 0; hull < panels.size(); ++hull) {
    if (const auto& settings = hull_of(setup.scene, hull).panels)
      panels[hull].resize(PanelGrid{*settings, setup.waterlines[hull]}.size());
  }
  return panels;
}

void load_panels(const Setup& setup, const Step& step, const Population& population, const StepData& data,
                 std::vector<HullPanels>& panels) {
  if (std::ranges::all_of(panels, &HullPanels::empty)) return;
  for (std::size_t i = 0; i < data.slopes.size(); ++i) {
    const Contact& c = data.contacts[i];
    const auto hull = static_cast<std::size_t>(c.a);
    if (panels[hull].empty() || population.is_hull(c.b) || c.total_normal_impulse() == 0) continue;
    const fracture::Ice& ice = ice_of_body(setup, population, c.b);
    const double top = ice.thickness * (1 - ice.density / setup.scene.water.water.density);
    add_contact({*hull_of(setup.scene, hull).panels, setup.waterlines[hull]}, population.bodies, c,
                {top - data.slopes[i].height, top}, panels[hull]);
  }
  for (HullPanels& of_hull : panels) {
    for (PanelLoads& panel : of_hull) book_step(panel, step.length);
  }
}

void sample_panels(const Setup& setup, const Clock& clock, double interval, std::vector<HullPanels>& panels,
                   Journal& journal) {
  for (std::size_t hull = 0; hull < panels.size(); ++hull) {
    if (panels[hull].empty()) continue;
    const PanelGrid grid{*hull_of(setup.scene, hull).panels, setup.waterlines[hull]};
    for (int column = -grid.half_columns(); column < grid.half_columns(); ++column) {
      for (int row = 0; row <= grid.settings.rows; ++row) {
        PanelLoads& panel = panels[hull][grid.first_of(column) + static_cast<std::size_t>(row)];
        if (panel.normal == 0) continue;
        const bool is_outside = row == grid.settings.rows;
        const double area = is_outside ? 0 : grid.length_of(column) * grid.row_height();
        journal.panels.push_back({.time = clock.time(),
                                  .hull = static_cast<int>(hull),
                                  .column = column,
                                  .row = is_outside ? -1 : row,
                                  .load = 1 / interval * panel.impulse,
                                  .force = panel.normal / interval,
                                  .largest = panel.largest,
                                  .pressure = area > 0 ? panel.normal / interval / area : 0,
                                  .loaded = panel.loaded});
        panel = {.carried = panel.carried, .carried_load = panel.carried_load};
      }
    }
  }
}

}  // namespace polynya::simulation
