#pragma once

#include <memory>

#include <pybind11/pybind11.h>

#include "io/scene/scene_reader.hpp"

namespace polynya::python {

namespace py = pybind11;

/// A scene that Python gave, after reading it. It may be wrong; problems() returns why.
class Scene {
 public:
  /// Reads a dict, JSON text or a path; polynya.given finds out which it is. Raises TypeError and FileNotFoundError.
  explicit Scene(const py::object& given);

  /// Returns errors as polynya.Problem, or warnings and hints if there are no errors.
  py::list problems() const;
  /// Returns the scene. Raises SceneError if it is wrong.
  const io::LoadedScene& loaded() const;

 private:
  io::SceneOutcome outcome_;
  bool has_lines_ = true;  ///< false for a dict, whose values have no lines
};

/// Raises an exception of polynya.errors.
[[noreturn]] void raise(const char* type, const py::object& argument);

void bind_scene(py::module_& module);

}  // namespace polynya::python
