#pragma once

#include <functional>
#include <span>
#include <string>
#include <string_view>

#include "simulation/world/journal.hpp"

namespace polynya::io {

/// A column of contacts.csv or panels.csv behind those that name the bodies. Writer, reader and docs/run-folder.md
/// follow these tables (a test compares the page): to add a column, add it at the end of its table in
/// load_columns.cpp, and the row, which that test prints, to the page.
template <class Row>
struct LoadColumn {
  std::string_view name;                   ///< with its unit: "depth_m"
  std::string_view meaning;                ///< as docs/run-folder.md has it
  std::function<double(const Row&)> read;  ///< not a number where there is none; of words the place in them
  std::function<void(Row&, double)> store;
  std::span<const std::string_view> words = {};  ///< in the place of numbers
};

using ContactColumn = LoadColumn<simulation::ContactState>;
using PanelColumn = LoadColumn<simulation::PanelSample>;

std::span<const ContactColumn> contact_columns();
std::span<const PanelColumn> panel_columns();

/// Appends their names, each behind a comma, and a line's end.
template <class Row>
void append_header(std::string& text, std::span<const LoadColumn<Row>> columns) {
  for (const LoadColumn<Row>& column : columns) text.append(1, ',').append(column.name);
  text += '\n';
}

/// Appends a row's values, likewise; nothing where there is no number.
void append_row(std::string& text, const simulation::ContactState& row);
void append_row(std::string& text, const simulation::PanelSample& row);

/// Reads a row's values, as many as the row has: those of earlier versions had fewer. Returns whether all are good.
bool read_row(std::string_view text, simulation::ContactState& row);
bool read_row(std::string_view text, simulation::PanelSample& row);

}  // namespace polynya::io
