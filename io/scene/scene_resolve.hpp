#pragma once

#include <functional>
#include <string>

#include "io/scene/scene_fields.hpp"
#include "io/text/json_value.hpp"
#include "io/text/problem_collector.hpp"

namespace polynya::io {

/// A scene's JSON checked against the field table, with every default filled in and its keys in the table's
/// order. What was wrong has been reported; it is then replaced by its default or, where it has none, its
/// list item becomes null.
JsonValue resolve_scene(const JsonValue& root, ProblemCollector& problems);

/// Calls the setters of a resolved scene's fields. Null list items are passed over.
/// Ships and floe groups are begun in order; `on_item` is called after each one's fields are set.
using OnItem = std::function<void(std::string_view list, std::size_t index, const JsonValue& item)>;
void bind_scene(const JsonValue& resolved, SceneDraft& draft, const OnItem& on_item);

/// A value as messages show it: "-0.5", "\"nevle\"", "a list of 3".
std::string show(const JsonValue& value);

}  // namespace polynya::io
