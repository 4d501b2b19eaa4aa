// The part of the Python package that is written in C++: rollres._rollres. What is for comfort stands in
// package/__init__.py. Numbers and names go over one by one, so that they are the same to the last bit.

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <chrono>
#include <condition_variable>
#include <sstream>
#include <thread>

#include "core/model/scene_rules.hpp"
#include "core/numerics/parallel.hpp"
#include "core/numerics/solution_limits.hpp"
#include "core/numerics/threads.hpp"
#include "core/scene/scene_input.hpp"
#include "db/queries/query.hpp"
#include "db/rows/layer_list.hpp"
#include "db/rows/result_store.hpp"
#include "db/rows/schema.hpp"
#include "studies/program/commands.hpp"
#include "studies/python/pickled_values.hpp"
#include "studies/run/stop_signal.hpp"
#include "studies/run/stored_evaluations.hpp"
#include "studies/run/sweep.hpp"
#include "studies/scene_io/doubtful_number.hpp"
#include "studies/scene_io/model_text.hpp"
#include "studies/scene_io/scene_entries.hpp"
#include "studies/scene_io/scene_file.hpp"
#include "studies/scene_io/scene_overrides.hpp"
#include "studies/scene_io/solution_json.hpp"
#include "studies/scene_io/summary.hpp"
#include "studies/sensitivity/gradient_report.hpp"
#include "studies/stored/derived_columns.hpp"
#include "studies/stored/study_rows.hpp"
#include "studies/study/study.hpp"
#include "studies/text/table_json.hpp"

namespace py = pybind11;

namespace rollres {

namespace {

const RollingScene no_scene;
const RollingSolution no_solution;

// Values of Python and of ours.

[[noreturn]] void refuse_value(const py::handle& value) {
  throw py::type_error("a value of type " + py::str(py::type::of(value).attr("__name__")).cast<std::string>() +
                       " is no input: give a number, a text, a list or a dict");
}

Json whole_number(const py::handle& value) {
  int beyond = 0;
  const long long number = PyLong_AsLongLongAndOverflow(value.ptr(), &beyond);
  if (beyond == 0) return static_cast<std::int64_t>(number);
  const double rounded = PyLong_AsDouble(value.ptr());
  if (!PyErr_Occurred()) return rounded;
  PyErr_Clear();
  throw std::invalid_argument("a whole number beyond 1e308 is no input");
}

/// As in scene files, where infinity is a text; what is no number is refused there with its key.
Json real_number(double number) {
  if (std::isnan(number)) return "nan";
  if (std::isinf(number)) return number > 0 ? "infinite" : "-infinite";
  return number;
}

/// @throws UnicodeEncodeError, a ValueError, for a text that is no Unicode
std::string unicode_of(const py::handle& value) {
  py::ssize_t size = 0;
  const char* const text = PyUnicode_AsUTF8AndSize(value.ptr(), &size);
  if (!text) throw py::error_already_set();
  return {text, static_cast<std::size_t>(size)};
}

/// @param depth  of value among lists and dicts, which may hold themselves
Json json_of(const py::handle& value, int depth = 0) {
  constexpr int deepest = 100;
  constexpr std::size_t longest = 10'000'000;
  if (depth > deepest)
    throw std::invalid_argument("inputs are nested more than " + std::to_string(deepest) + " levels deep");
  if (value.is_none()) return nullptr;
  if (py::isinstance<py::bool_>(value)) return value.cast<bool>();
  if (py::isinstance<py::str>(value)) return unicode_of(value);
  if (py::isinstance<py::int_>(value)) return whole_number(value);
  if (py::isinstance<py::dict>(value)) {
    Json object = Json::object();
    for (const auto& [key, item] : value.cast<py::dict>()) object[unicode_of(py::str(key))] = json_of(item, depth + 1);
    return object;
  }
  if (PyFloat_Check(value.ptr())) return real_number(value.cast<double>());
  if (py::hasattr(value, "item") && py::hasattr(value, "ndim") && py::object(value.attr("ndim")).equal(py::int_(0)))
    return json_of(value.attr("item")(), depth + 1);  // of numpy
  if (PyNumber_Check(value.ptr()) && !py::isinstance<py::sequence>(value) && !py::hasattr(value, "__len__"))
    return real_number(py::float_(py::reinterpret_borrow<py::object>(value)));
  if (py::hasattr(value, "__fspath__")) return py::str(value).cast<std::string>();
  const bool ordered = !PyAnySet_Check(value.ptr()) && !PyBytes_Check(value.ptr());
  if (!ordered || !py::hasattr(value, "__iter__")) refuse_value(value);
  Json list = Json::array();
  for (const py::handle item : py::iter(value)) {
    if (list.size() == longest)
      throw std::invalid_argument("a list of more than " + std::to_string(longest) + " values is no input");
    list.push_back(json_of(item, depth + 1));
  }
  return list;
}

/// Those of the inputs that are not None.
Json given_inputs(const py::dict& inputs) {
  Json object = json_of(inputs);
  for (auto item = object.begin(); item != object.end();) item = item->is_null() ? object.erase(item) : std::next(item);
  return object;
}

py::object from_json(const std::string& text) { return py::module_::import("json").attr("loads")(text); }

template <class Value>
py::object to_python(const Value& value) {
  if constexpr (std::is_enum_v<Value>)
    return py::cast(std::string(name_of(value)));
  else if constexpr (std::is_same_v<Value, BondedLayers>)
    return value.empty() ? py::object(py::list()) : from_json(text_of_layers(value));
  else
    return py::cast(value);
}

struct CellToPython {
  py::object operator()(std::monostate) const { return py::none(); }
  py::object operator()(const std::string& text) const {  // SQL can make what is no Unicode
    return py::reinterpret_steal<py::object>(
        PyUnicode_DecodeUTF8(text.data(), static_cast<py::ssize_t>(text.size()), "backslashreplace"));
  }
  template <class Value>
  py::object operator()(const Value& value) const {
    return py::cast(value);
  }
};

/// Columns by name, in their order.
py::dict to_python(const Table& table) {
  py::dict columns;
  for (std::size_t i = 0; i < table.columns.size(); ++i) {
    py::list values;
    for (const auto& row : table.rows) values.append(std::visit(CellToPython(), row[i]));
    columns[py::str(table.columns[i])] = values;
  }
  return columns;
}

// Work without the interpreter's lock, which Ctrl-C ends.

using Clock = std::chrono::steady_clock;
constexpr std::chrono::milliseconds glance{30};  // how often somebody looks whether Ctrl-C was pressed

/// Solves in the calling thread, which asks for Ctrl-C now and then.
RollingSolution solve_here(const RollingScene& scene) {
  std::atomic<bool> stopped = false;
  const std::thread::id caller = std::this_thread::get_id();
  auto next = Clock::now() + glance;
  const auto asked_to_stop = [&] {
    if (std::this_thread::get_id() == caller && !stopped && Clock::now() >= next) {
      const py::gil_scoped_acquire lock;
      stopped = PyErr_CheckSignals() != 0;
      next = Clock::now() + glance;
    }
    return stopped.load();
  };
  try {
    const py::gil_scoped_release unlocked;
    const Interruptible interruptible(asked_to_stop);
    return solve(scene);
  } catch (const Interrupted&) {
    throw py::error_already_set();
  }
}

/// `solve`, until `stop` is set.
Evaluate solve_until(const std::atomic<bool>& stop) {
  return [&stop](const RollingScene& scene) {
    const Interruptible interruptible([&stop] { return stop.load(); });
    return solve(scene);
  };
}

/// Calls work(stop) on a thread of its own and waits for it; meanwhile `tick` is called now and then under the lock. On
/// Ctrl-C, or where `tick` throws, sets `stop` and throws when the work has ended.
template <class Work, class Tick>
void watched(const Work& work, const Tick& tick) {
  std::atomic<bool> stop = false;
  std::mutex mutex;
  std::condition_variable changed;
  bool over = false;
  std::exception_ptr failure, refusal;
  std::optional<py::gil_scoped_release> unlocked(std::in_place);
  std::jthread thread([&] {
    try {
      work(stop);
    } catch (...) {
      failure = std::current_exception();
    }
    const std::lock_guard lock(mutex);
    over = true;
    changed.notify_all();
  });
  for (std::unique_lock lock(mutex); !changed.wait_for(lock, glance, [&] { return over; });) {
    lock.unlock();
    if (!stop) try {
        const py::gil_scoped_acquire locked;
        if (PyErr_CheckSignals() != 0) throw py::error_already_set();
        tick();
      } catch (...) {
        refusal = std::current_exception();
        stop = true;
      }
    lock.lock();
  }
  thread.join();
  unlocked.reset();
  if (refusal) std::rethrow_exception(refusal);
  if (failure) std::rethrow_exception(failure);
}

// Scenes.

/// An input's value, or an output's, by its key.
template <class Walk>
auto getter(std::string key, Walk walk) {
  return [key = std::move(key), walk](py::object self) {
    py::object found = py::none();
    walk(self, [&](const Quantity& quantity, const auto& value) {
      if (quantity.key == key) found = to_python(value);
    });
    return found;
  };
}

std::string described(const Quantity& quantity) {
  std::string text(quantity.meaning);
  if (!quantity.symbol.empty()) text = std::string(quantity.symbol) + ": " + text;
  const std::string_view line = quantity.unit_for(Indenter::cylinder), point = quantity.unit;
  if (!point.empty())
    text +=
        " [" + std::string(line) + (line == point ? "" : ", with width and of a sphere: " + std::string(point)) + "]";
  return text;
}

/// Entries with some inputs replaced, as by --set; those that are None are taken away.
RollingScene replaced(const std::vector<SceneEntry>& entries, const py::dict& inputs, const std::string& place) {
  std::vector<SceneEntry> taken;
  for (const auto& [key, value] : inputs)
    if (value.is_none())
      for (const SceneEntry& one : replacing_entries({{key.cast<std::string>(), nullptr}}, "--set"))
        taken.push_back(one);
  return scene_from(overridden(entries, replacing_entries(given_inputs(inputs), "--set"), taken), place);
}

RollingScene replaced(const RollingScene& scene, const py::dict& inputs) {
  const std::string place = "scene";
  return replaced(scene_entries(parse_object(scene_json(scene), place), {}, place), inputs, "--set");
}

/// @param base  a scene, a dict of inputs, the name of a file, or none
RollingScene read(const py::args& base, const py::kwargs& inputs) {
  if (base.size() > 1) throw py::type_error("a scene is made of one file, dict or scene, and of inputs by name");
  if (!base.empty() && py::isinstance<RollingScene>(base[0]))
    return inputs.empty() ? base[0].cast<RollingScene>() : replaced(base[0].cast<RollingScene>(), inputs);
  if (base.empty() || base[0].is_none() || py::isinstance<py::dict>(base[0])) {
    const std::string place = "scene";
    Json object = base.empty() || base[0].is_none() ? Json::object() : given_inputs(base[0].cast<py::dict>());
    object.update(given_inputs(inputs));
    return scene_from(scene_entries(object, {}, place), place);
  }
  const std::string file = py::module_::import("os").attr("fspath")(base[0]).cast<std::string>();
  if (inputs.empty()) return read_scene(file);
  return replaced(scene_entries(read_object(file), std::filesystem::path(file).parent_path(), file), inputs,
                  file + " with --set");
}

/// Objects whose __init__ was not called (Scene.__new__(Scene)) hold nothing: pybind11 would take memory for one of
/// them where it is used, and read what stands there.
template <class... Types>
void refuse_unmade() {
  const auto refuse = [](std::size_t) -> void* {
    throw py::type_error("the object was never made: its __init__ was not called");
  };
  ((py::detail::get_type_info(typeid(Types), true)->operator_new = refuse), ...);
}

void add_scene(py::module_& module) {
  py::class_<RollingScene> scene(module, "Scene");
  scene.def(py::init(&read))
      .def("replaced", py::overload_cast<const RollingScene&, const py::dict&>(&replaced),
           "The scene with other values of the inputs in a dict, as by --set; keys may be those of further "
           "layers:\n{\"coating_layers[0].layer_thickness\": \"8 mm\"}.")
      .def("json", &scene_json, "The scene as a scene file's text.");
  const auto walk = [](const py::object& self, const auto& visitor) {
    visit_inputs(self.cast<const RollingScene&>(), visitor);
  };
  scene.def_property_readonly(
      "diameter", [](const RollingScene& self) { return 2 * self.radius; }, "2R: diameter of the body [m]");
  visit_inputs(no_scene, [&](const Quantity& quantity, const auto&) {
    scene.def_property_readonly(quantity.key.data(), getter(std::string(quantity.key), walk),
                                described(quantity).c_str());
  });
}

// Answers.

struct Answer {
  RollingScene scene;
  RollingSolution solution;
};
using Answers = std::vector<std::shared_ptr<Answer>>;

/// An array that shows numbers of the answer where they are; None if there are none.
template <class Value, class Shown>
py::object shown(const std::shared_ptr<Answer>& answer, const std::vector<Value>& values) {
  if (values.empty()) return py::none();
  const SurfaceGrid& grid = answer->solution.fields.grid;
  const py::capsule owner(new std::shared_ptr<Answer>(answer),
                          [](void* pointer) { delete static_cast<std::shared_ptr<Answer>*>(pointer); });
  std::vector<py::ssize_t> shape{grid.columns};
  if (dimension_of(answer->scene.indenter) == 3) shape.insert(shape.begin(), grid.rows);
  py::array_t<Shown> array(shape, reinterpret_cast<const Shown*>(values.data()), owner);
  array.attr("flags").attr("writeable") = false;
  return array;
}

py::object positions(int count, const auto& position) {
  py::array_t<double> array(count);
  for (int i = 0; i < count; ++i) array.mutable_at(i) = position(i);
  return array;
}

struct FieldArrays {
  std::shared_ptr<Answer> answer;
  const SurfaceFields& fields() const { return answer->solution.fields; }
};

void add_fields(py::module_& module) {
  py::class_<FieldArrays> fields(module, "Fields");
  const auto show = [&](const char* name, std::vector<double> SurfaceFields::*values, const char* meaning) {
    fields.def_property_readonly(
        name, [values](const FieldArrays& self) { return shown<double, double>(self.answer, self.fields().*values); },
        meaning);
  };
  show("u", &SurfaceFields::u, "displacement of the surface along x [m]");
  show("v", &SurfaceFields::v, "displacement of the surface along y [m]; None for a cylinder");
  show("w", &SurfaceFields::w, "displacement of the surface along z [m]");
  show("pressure", &SurfaceFields::pressure, "pressure on the layer [Pa]");
  show("shear_x", &SurfaceFields::shear_x, "shear traction on the layer along x [Pa]");
  show("shear_y", &SurfaceFields::shear_y, "shear traction on the layer along y [Pa]; None for a cylinder");
  show("slip_x", &SurfaceFields::slip_x, "velocity of the body relative to the layer along x over speed [1]");
  show("slip_y", &SurfaceFields::slip_y, "the same along y [1]; None for a cylinder");
  fields.def_property_readonly(
      "zone", [](const FieldArrays& self) { return shown<Zone, std::int8_t>(self.answer, self.fields().zone); },
      "0: free, 1: stick, 2: slip");
  fields.def_property_readonly(
      "x",
      [](const FieldArrays& self) {
        const SurfaceGrid& grid = self.fields().grid;
        return positions(grid.columns, [&](int i) { return grid.x(i); });
      },
      "positions of the nodes along x [m]");
  fields.def_property_readonly(
      "y",
      [](const FieldArrays& self) {
        const SurfaceGrid& grid = self.fields().grid;
        return positions(grid.rows, [&](int i) { return grid.y(i); });
      },
      "positions of the nodes along y [m]");
  fields.def(py::pickle([](const FieldArrays& self) { return py::make_tuple(self.answer); },
                        [](const py::tuple& state) { return FieldArrays{state[0].cast<std::shared_ptr<Answer>>()}; }));
}

void add_result(py::module_& module) {
  py::class_<Answer, std::shared_ptr<Answer>> result(module, "Result");
  result
      .def_property_readonly(
          "scene", [](const Answer& self) { return self.scene; }, "the scene that was solved")
      .def_property_readonly(
          "fields",
          [](const std::shared_ptr<Answer>& self) {
            return self->solution.fields.grid.size() == 0 ? py::none() : py::cast(FieldArrays{self});
          },
          "fields on the layer's surface as arrays, rows along y and columns along x, that share the answer's memory;\n"
          "None where they were not kept")
      .def(
          "summary", [](const Answer& self) { return summary(self.scene, self.solution); },
          "The text of `rollres solve`.")
      .def(
          "json", [](const Answer& self) { return solution_json(self.scene, self.solution); },
          "The text of `rollres solve --json`.")
      .def(py::pickle([](const Answer& self) { return py::make_tuple(self.scene, state_of(self.solution)); },
                      [](const py::tuple& state) {
                        return std::make_shared<Answer>(
                            Answer{state[0].cast<RollingScene>(), solution_from(state[1].cast<py::dict>())});
                      }));
  const auto walk = [](const py::object& self, const auto& visitor) {
    visit_outputs(self.cast<const Answer&>().solution, visitor);
  };
  visit_outputs(no_solution, [&](const Quantity& quantity, const auto&) {
    result.def_property_readonly(quantity.key.data(), getter(std::string(quantity.key), walk),
                                 described(quantity).c_str());
  });
}

Answers solve_many(const std::vector<RollingScene>& scenes, int threads, const py::object& progress, bool fields,
                   const std::optional<std::string>& database) {
  Answers answers(scenes.size());
  std::atomic<std::size_t> answered = 0;
  std::size_t told = 0;
  const auto tell = [&] {
    if (progress.is_none() || (answered == told && told > 0)) return;
    told = answered;
    progress(told, answers.size());
  };
  watched(
      [&](const std::atomic<bool>& stop) {
        const Evaluate evaluate = solve_until(stop);
        std::optional<StoredEvaluations> stored;
        if (database) stored.emplace(evaluate, *database);
        for_each_piece(answers.size(), threads, [&](std::size_t i) {
          if (stop) throw Interrupted();
          answers[i] = std::make_shared<Answer>(Answer{
              scenes[i], stored ? (*stored)(scenes[i])
                                : evaluate_safely(evaluate, scenes[i], fields ? Fields::kept : Fields::dropped)});
          ++answered;
        });
        if (stored) stored->flush();
      },
      tell);
  tell();
  return answers;
}

/// One scene of many, by one thread: a pool has a process for each core.
std::shared_ptr<Answer> solve_one(const RollingScene& scene, bool fields) {
  const auto answer = std::make_shared<Answer>(Answer{scene, {}});
  watched(
      [&](const std::atomic<bool>& stop) {
        limit_threads(1);
        answer->solution = evaluate_safely(solve_until(stop), scene, fields ? Fields::kept : Fields::dropped);
      },
      [] {});
  return answer;
}

// Objectives.

/// An output as a function of some inputs, with its gradient.
class Function {
 public:
  using Choice = std::tuple<std::string, py::object, py::object>;

  Function(const RollingScene& scene, const std::vector<Choice>& inputs, const std::string& output) {
    for (const auto& [key, lowest, highest] : inputs) {
      require_held(key);
      choices_.push_back({key, bound(key, lowest, scene), bound(key, highest, scene)});
    }
    objective_ = objective(scene, choices_, output, solve);
  }

  /// Of a pickle, with the noise that was measured.
  explicit Function(const py::tuple& state) {
    for (const auto& [key, lowest, highest] : state[1].cast<std::vector<Held>>())
      choices_.push_back({key, lowest, highest});
    objective_ = objective(state[0].cast<RollingScene>(), choices_, state[2].cast<std::string>(), solve);
    if (!state[3].is_none()) calibration_ = calibration_from(state[3]);
  }
  py::tuple state() const {
    py::list choices;
    for (const InputChoice& choice : choices_) choices.append(Held(choice.key, choice.lowest, choice.highest));
    return py::make_tuple(objective_.base, choices, std::string(objective_.output.key),
                          calibration_ ? py::object(state_of(*calibration_)) : py::none());
  }

  const Objective& objective_itself() const { return objective_; }

  double value(const std::vector<double>& point) {
    require_inside(objective_, point);
    const RollingSolution solution = solve_here(scene_at(objective_, point));
    if (solution.status != Status::converged) return RollingSolution::absent;
    return output_number(solution, objective_.output.key);
  }

  /// Value, derivatives and their estimated errors. What noise there is, is measured once, at the first point.
  py::tuple gradient(const std::vector<double>& point, int order, int threads) {
    Gradient found;
    watched(
        [&](const std::atomic<bool>& stop) {
          Objective here = objective_;
          here.evaluate = solve_until(stop);
          if (!calibration_) calibration_ = calibrate(here, point, threads);
          found = rollres::gradient(here, point, *calibration_, {order, threads});
        },
        [] {});
    std::vector<double> derivatives, errors;
    for (const InputGradient& input : found.inputs) {
      derivatives.push_back(input.derivative);
      errors.push_back(input.error());
    }
    return py::make_tuple(found.centre.value, derivatives, errors);
  }

 private:
  using Held = std::tuple<std::string, std::optional<double>, std::optional<double>>;  // key and bounds

  /// A bound: a number in SI, a text with a unit, or none.
  static std::optional<double> bound(const std::string& key, const py::object& given, const RollingScene& scene) {
    const InputKind* const kind = find_number(key);
    if (given.is_none() || !kind) return std::nullopt;
    if (py::isinstance<py::str>(given))
      return std::get<double>(input_value({key, given.cast<std::string>(), "bounds"}, *kind, body_of(scene)));
    const double number = PyFloat_AsDouble(given.ptr());
    if (PyErr_Occurred()) throw py::error_already_set();
    if (const std::string doubt = doubt_of(kind->quantity, number); !doubt.empty())
      refuse("bounds", key, json_of(given), doubt);
    return number;
  }

  std::vector<InputChoice> choices_;
  Objective objective_;
  std::optional<Calibration> calibration_;
};

void add_objective(py::module_& module) {
  py::class_<Variable>(module, "Variable")
      .def_property_readonly("key", [](const Variable& self) { return std::string(self.quantity.key); })
      .def_readonly("lowest", &Variable::lowest)
      .def_readonly("highest", &Variable::highest)
      .def_property_readonly("logarithmic", [](const Variable& self) { return self.scaling == Scaling::logarithmic; })
      .def_readonly("size", &Variable::size)
      .def("scaled", &Variable::scaled)
      .def("value", &Variable::value)
      .def("slope", &Variable::slope);
  py::class_<Function>(module, "Function")
      .def(py::init<const RollingScene&, const std::vector<Function::Choice>&, const std::string&>())
      .def_property_readonly("variables", [](const Function& self) { return self.objective_itself().variables; })
      .def_property_readonly("base", [](const Function& self) { return base_point(self.objective_itself()); })
      .def("scene",
           [](const Function& self, const std::vector<double>& x) { return scene_at(self.objective_itself(), x); })
      .def("value", &Function::value)
      .def("gradient", &Function::gradient)
      .def(py::pickle([](const Function& self) { return self.state(); },
                      [](const py::tuple& state) { return Function(state); }));
}

py::object gradient_of(const RollingScene& scene, const std::vector<std::string>& inputs, const std::string& output,
                       int order, int threads) {
  std::vector<InputChoice> choices;
  for (const std::string& key : inputs) {
    require_held(key);
    choices.push_back({key});
  }
  std::string report;
  watched(
      [&](const std::atomic<bool>& stop) {
        report = text_of(
            rollres::json_of(gradient_report(objective(scene, choices, output, solve_until(stop)), {order, threads})),
            -1);
      },
      [] {});
  return from_json(report);
}

// Studies and databases.

py::dict sweep(const std::string& file, const std::string& database, int threads, const py::object& progress,
               bool fields, const std::string& retry) {
  const int chosen = find_name(ChoiceNames<Retry>::names, retry);
  if (chosen < 0)
    throw std::invalid_argument("retry = \"" + retry + "\": must be nothing, failed, not_converged or all");
  SweepReport report;
  std::atomic<std::size_t> solved = 0, to_solve = 0;
  watched(
      [&](const std::atomic<bool>& stop) {
        const Study study = read_study(file);
        SweepOptions options{.jobs = threads, .stop = &stop};
        options.retry = static_cast<Retry>(chosen);
        options.fields = fields || study.fields ? Fields::kept : Fields::dropped;
        options.report = [&](const SweepProgress& now) {
          solved = now.solved;
          to_solve = now.to_solve;
        };
        report = run_sweep(study, solve, database, options);
      },
      [&] {
        if (!progress.is_none() && to_solve > 0) progress(solved.load(), to_solve.load());
      });
  if (!progress.is_none()) progress(report.solved, report.solved);
  py::dict told;
  told["study"] = report.study.name;
  told["points"] = report.points;
  told["dropped"] = report.dropped;
  told["answered"] = report.answered;
  told["recalled"] = report.recalled;
  told["solved"] = report.solved;
  told["failed"] = report.failed;
  told["seconds"] = report.seconds;
  return told;
}

py::dict query(const std::string& database, const std::vector<std::string>& filters,
               const std::vector<std::string>& columns, const std::vector<std::string>& sort,
               std::optional<std::int64_t> limit) {
  Query question{.columns = columns, .sort = sort, .limit = limit};
  for (const std::string& filter : filters) question.filters.push_back(read_filter(filter));
  const Database file = open_database(database, Access::read);
  add_derived(file, question);
  return to_python(run_query(file, question));
}

/// A command of the program: its exit status, answer and messages. A signal that the command takes for itself
/// (StopSignal) ends it early.
py::tuple command(const std::vector<std::string>& words) {
  std::ostringstream out, err;
  int status = 0;
  { const StopSignal forgotten; }  // of an earlier command
  watched([&](const std::atomic<bool>& stop) { status = run_program(words, {out, err, solve_until(stop)}); }, [] {});
  if (StopSignal::requested()) {
    PyErr_SetNone(PyExc_KeyboardInterrupt);
    throw py::error_already_set();
  }
  return py::make_tuple(status, out.str(), err.str());
}

py::list quantities(bool outputs) {
  py::list list;
  const auto add = [&](const Quantity& quantity, const auto& value) {
    using Value = std::decay_t<decltype(value)>;
    py::list choices;
    if constexpr (std::is_enum_v<Value>)
      for (const std::string_view name : ChoiceNames<Value>::names) choices.append(std::string(name));
    const char* kind = std::is_enum_v<Value> || std::is_same_v<Value, std::string> ? "str"
                       : std::is_same_v<Value, int>                                ? "int"
                       : std::is_same_v<Value, double>                             ? "float"
                       : std::is_same_v<Value, std::optional<double>>              ? "float | None"
                       : std::is_same_v<Value, std::vector<std::string>>           ? "list[str]"
                       : std::is_same_v<Value, BondedLayers>                       ? "list[dict]"
                                                                                   : "list[float]";
    list.append(py::make_tuple(std::string(quantity.key), kind, described(quantity), choices));
  };
  if (outputs)
    visit_outputs(no_solution, add);
  else
    visit_inputs(no_scene, add);
  return list;
}

}  // namespace

}  // namespace rollres

PYBIND11_MODULE(_rollres, module) {
  using namespace rollres;
  module.attr("__version__") = ROLLRES_VERSION;
  py::register_exception_translator([](std::exception_ptr error) {  // what the outside world does: files, databases
    try {
      std::rethrow_exception(error);
    } catch (const py::builtin_exception&) {
      throw;
    } catch (const std::runtime_error& failure) {
      PyErr_SetString(PyExc_OSError, failure.what());
    }
  });
  add_scene(module);
  add_fields(module);
  add_result(module);
  add_objective(module);
  refuse_unmade<RollingScene, Answer, FieldArrays, Variable, Function>();
  module.def("solve", [](const RollingScene& scene) {
    return std::make_shared<Answer>(Answer{scene, solve_here(scene)});
  });
  module.def("model", [](const RollingScene& scene) { return from_json(model_json(scene)); });
  module.def("solve_many", &solve_many);
  module.def("solve_one", &solve_one);
  module.def("gradient", &gradient_of);
  module.def("sweep", &sweep);
  module.def("query", &query);
  module.def("sql", [](const std::string& database, const std::string& statement) {
    return to_python(run_sql(open_database(database, Access::read), statement));
  });
  module.def("command", &command);
  module.def("quantities", &quantities);
}
