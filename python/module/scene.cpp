#include "python/module/scene.hpp"

#include <string>

#include <pybind11/stl/filesystem.h>

#include "io/scene/scene_file.hpp"

namespace polynya::python {
namespace {

py::object optional_line(int line, bool has_lines) {
  return has_lines && line > 0 ? py::object(py::int_(line)) : py::none();
}

py::list to_python(const std::vector<io::Problem>& problems, bool has_lines) {
  const py::object type = py::module_::import("polynya.errors").attr("Problem");
  py::list list;
  for (const io::Problem& p : problems) {
    list.append(type(p.file, optional_line(p.line, has_lines), optional_line(p.column, has_lines), p.path, p.found,
                     p.allowed, p.suggestion, std::string(name_of(p.severity)), message_of(p)));
  }
  return list;
}

constexpr auto kSceneDoc =
    "Scene(scene)\n"
    "\n"
    "A scene from a dict, from JSON text (a str that contains a brace; comments are allowed), or from a file (a path, "
    "or\n"
    "a str without a brace). Floe files that a dict or a text names are searched for in the working folder. Keys and\n"
    "units: docs/scene.md.\n"
    "\n"
    "The scene may be wrong: validate() lists its problems, and Simulation(scene) raises SceneError.\n"
    "Raises TypeError for an argument of another type, FileNotFoundError, and ValueError for a dict with numbers that\n"
    "are not finite.";

}  // namespace

void raise(const char* type, const py::object& argument) {
  const py::object error = py::module_::import("polynya.errors").attr(type);
  const py::object raised = error(argument);
  PyErr_SetObject(error.ptr(), raised.ptr());
  throw py::error_already_set();
}

Scene::Scene(const py::object& given) {
  const py::tuple parts = py::module_::import("polynya.given").attr("scene_parts")(given);
  const auto path = parts[0].cast<std::string>();
  auto text = parts[1].cast<std::string>();
  has_lines_ = parts[2].cast<bool>();
  const py::gil_scoped_release release;
  outcome_ = path.empty() ? io::read_scene(std::move(text), "scene", ".") : io::read_scene_file(path);
}

py::list Scene::problems() const {
  return to_python(outcome_ ? outcome_->hints : outcome_.error(), has_lines_);
}

const io::LoadedScene& Scene::loaded() const {
  if (!outcome_) raise("SceneError", problems());
  return *outcome_;
}

void bind_scene(py::module_& module) {
  py::class_<Scene, std::shared_ptr<Scene>>(module, "Scene", kSceneDoc)
      .def(py::init<const py::object&>(), py::arg("scene"))
      .def("validate", &Scene::problems,
           "All problems as a list of Problem, each with its place. For a scene without errors these are\n"
           "its warnings and hints, by their severity.")
      .def_property_readonly(
          "name", [](const Scene& scene) { return scene.loaded().scene.name; }, "The scene's name.")
      .def_property_readonly(
          "hash", [](const Scene& scene) { return scene.loaded().hash; },
          "Hash of the scene with all defaults filled in: 16 hexadecimal digits, as in the run's summary.json.")
      .def_property_readonly(
          "resolved",
          [](const Scene& scene) { return py::module_::import("json").attr("loads")(scene.loaded().resolved_text); },
          "The scene as a dict with all defaults and with the floes of its files.")
      .def("__repr__", [](const Scene& scene) {
        const py::list problems = scene.problems();
        return py::str("polynya.Scene: {} problems, warnings and hints").format(problems.size());
      });
}

}  // namespace polynya::python
