#pragma once

#include <memory>

#include <pybind11/pybind11.h>

#include "io/scene/scene_reader.hpp"

namespace polynya::python {

namespace py = pybind11;

/// A scene as Python gave it, read once. It may be wrong: problems() lists what is.
class Scene {
 public:
  /// From a dict, JSON text or a path; polynya.given decides which it is. Raises TypeError and
  /// FileNotFoundError.
  explicit Scene(const py::object& given);

  /// Errors, or warnings and hints where there are none, as polynya.Problem.
  py::list problems() const;
  /// Raises SceneError where the scene is wrong.
  const io::LoadedScene& loaded() const;

 private:
  io::SceneOutcome outcome_;
  bool has_lines_ = true;  ///< a dict has none
};

/// Raises an exception of polynya.errors.
[[noreturn]] void raise(const char* type, const py::object& argument);

void bind_scene(py::module_& module);

}  // namespace polynya::python
