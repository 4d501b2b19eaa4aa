#pragma once

/// Values as Python's pickle takes them, for pools of processes: every bit of every number returns.

#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <stdexcept>
#include <string>
#include <tuple>
#include <type_traits>
#include <vector>

#include "core/derivatives/calibration.hpp"
#include "core/scene/solution.hpp"
#include "db/rows/fields_table.hpp"

namespace rollres {

template <class Choice>
Choice choice_named(const std::string& name) {
  const int found = find_name(ChoiceNames<Choice>::names, name);
  if (found < 0) throw std::invalid_argument("a pickle of another version of rollres: " + name + " is not known");
  return static_cast<Choice>(found);
}

/// Outputs by their keys, and what is no output by names of its own. Fields only where they were kept.
inline pybind11::dict state_of(const RollingSolution& solution) {
  namespace py = pybind11;
  py::dict state;
  visit_outputs(solution, [&](const Quantity& quantity, const auto& value) {
    if constexpr (std::is_enum_v<std::decay_t<decltype(value)>>)
      state[py::str(std::string(quantity.key))] = std::string(name_of(value));
    else
      state[py::str(std::string(quantity.key))] = value;
  });
  state["moduli_factors"] = solution.moduli_factors;
  const SurfaceFields& fields = solution.fields;
  if (fields.grid.size() == 0) return state;
  py::list panels;
  for (const TractionPanel& panel : fields.panels)
    panels.append(py::make_tuple(panel.from, panel.to, panel.pressure, panel.shear));
  state["fields"] = py::make_tuple(fields_format, py::bytes(packed(fields)), fields.grid.folded, panels);
  return state;
}

inline SurfaceFields fields_from(const pybind11::tuple& state) {
  SurfaceFields fields = unpacked_fields(state[0].cast<int>(), state[1].cast<std::string>());
  fields.grid.folded = state[2].cast<bool>();
  using Panel = std::tuple<double, double, std::vector<double>, std::vector<double>>;
  for (const auto& [from, to, pressure, shear] : state[3].cast<std::vector<Panel>>())
    fields.panels.push_back({from, to, pressure, shear});
  return fields;
}

/// What the state lacks is absent.
inline RollingSolution solution_from(const pybind11::dict& state) {
  RollingSolution solution;
  visit_outputs(solution, [&](const Quantity& quantity, auto& value) {
    using Value = std::decay_t<decltype(value)>;
    const std::string key(quantity.key);
    if (!state.contains(key.c_str())) return;
    const pybind11::object given = state[key.c_str()];
    if constexpr (std::is_enum_v<Value>)
      value = choice_named<Value>(given.cast<std::string>());
    else
      value = given.cast<Value>();
  });
  solution.moduli_factors = state["moduli_factors"].cast<decltype(solution.moduli_factors)>();
  if (state.contains("fields")) solution.fields = fields_from(state["fields"]);
  return solution;
}

/// A calibration, so that the noise is not measured again.
inline pybind11::tuple state_of(const Calibration& calibration) {
  namespace py = pybind11;
  py::list inputs;
  for (const InputCalibration& input : calibration.inputs) {
    py::list failures;
    for (const FailedPoint& failure : input.failures)
      failures.append(py::make_tuple(failure.value, std::string(name_of(failure.status)), failure.reason));
    inputs.append(
        py::make_tuple(input.size.noise, input.size.derivatives, input.size.reach, input.evaluations, failures));
  }
  const ObjectiveValue& centre = calibration.centre;
  return py::make_tuple(calibration.point, centre.value, centre.relative_error, std::string(name_of(centre.status)),
                        centre.reason, inputs);
}

inline Calibration calibration_from(const pybind11::tuple& state) {
  Calibration calibration{state[0].cast<std::vector<double>>(),
                          {state[1].cast<double>(), state[2].cast<double>(),
                           choice_named<Status>(state[3].cast<std::string>()), state[4].cast<std::string>()},
                          {}};
  using Failure = std::tuple<double, std::string, std::string>;
  using Input = std::tuple<double, std::array<double, 4>, double, int, std::vector<Failure>>;
  for (const auto& [noise, derivatives, reach, evaluations, failures] : state[5].cast<std::vector<Input>>()) {
    calibration.inputs.push_back({{noise, derivatives, reach}, evaluations});
    for (const auto& [value, status, reason] : failures)
      calibration.inputs.back().failures.push_back({value, choice_named<Status>(status), reason});
  }
  return calibration;
}

}  // namespace rollres
