#include <exception>
#include <new>
#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <stdexcept>
#include <string>

#include "call.h"
#include "documentation.h"
#include "exemplar.h"
#include "mesh.h"
#include "noise.h"
#include "solidnoise/core/output_file.h"
#include "solidnoise/core/progress.h"
#include "solidnoise/noise/registry/noise_recipe.h"
#include "volume.h"

namespace solidnoise::python {
namespace {

// Names of files in it may be of other bytes than UTF-8.
void set_error(PyObject* type, const std::string& message) {
  const auto text = py::reinterpret_steal<py::object>(
      PyUnicode_DecodeUTF8(message.data(), static_cast<py::ssize_t>(message.size()), "backslashreplace"));
  PyErr_SetObject(type, text.ptr());
}

// The library's messages, as what Python calls them: of options ValueError (pybind11 does that), of files
// OSError.
void translate(std::exception_ptr thrown) {
  try {
    if (thrown) std::rethrow_exception(thrown);
  } catch (const Cancelled& error) {
    set_error(PyExc_RuntimeError, error.what());
  } catch (const std::length_error&) {
    PyErr_SetString(PyExc_MemoryError, "this would take more than any machine has");
  } catch (const TooMuchMemory& error) {
    set_error(PyExc_MemoryError, error.what());
  } catch (const OutputExists& error) {
    set_error(PyExc_FileExistsError, error.what());
  } catch (const py::builtin_exception&) {
    throw;
  } catch (const std::runtime_error& error) {
    set_error(PyExc_OSError, error.what());
  }
}

}  // namespace
}  // namespace solidnoise::python

PYBIND11_MODULE(_solidnoise, module) {
  namespace py = pybind11;
  using namespace solidnoise::python;
  py::options options;
  options.disable_function_signatures();
  // pybind11 loads NumPy at its first use, and two threads that do so at once wait for each other for ever.
  py::dtype::of<double>();
  py::register_local_exception_translator(translate);
  // What is here belongs to the package, by name, too.
  const py::object name = module.attr("__name__");
  module.attr("__name__") = "solidnoise";
  add_noise(module);
  add_volume(module);
  add_mesh(module);
  add_exemplar(module);
  add_schema(module);
  module.attr("__name__") = name;
  module.attr("algorithm") = solidnoise::kAlgorithmVersion;
  py::list names;
  for (const auto& [key, value] : module.attr("__dict__").cast<py::dict>()) {
    if (!key.cast<std::string>().starts_with('_')) names.append(key);
  }
  names.attr("sort")();
  module.attr("__all__") = names;
  py::module_::import("atexit").attr("register")(py::cpp_function(stop_all_work));
}
