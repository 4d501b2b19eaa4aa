#pragma once

/// Fits a law of time-temperature superposition to a table of shift factors a(T): ln a is what is fitted, so that
/// deviations are relative ones of a.

#include <optional>
#include <string>
#include <vector>

#include "core/material/material_scale.hpp"
#include "fitting/fit/fit.hpp"

namespace rollres {

struct MeasuredShift {
  double temperature;  ///< [K]
  double factor;       ///< a(T) [1], > 0
  std::string place = {};
};

struct ShiftFit {
  FitReport report;  ///< its values: ln a
  TemperatureShift shift;
};

/// The temperature of the factor that is nearest to 1 [K]. @param data at least one
double reference_of(const std::vector<MeasuredShift>& data);

/// Takes out the row that is 1 by definition, not by measurement: to it the others are relative.
/// @return its temperature [K]; nothing if no row, or more than one, is 1
std::optional<double> take_reference(std::vector<MeasuredShift>& data);

/// @param law        which one, and its reference temperature
/// @param deviation  of ln a; NaN: not known, found from the scatter
/// @param relative_to  temperature at which the factors are 1 [K]; default: the law's reference
/// @throws std::invalid_argument if the data are too few
ShiftFit fit_shift(const std::vector<MeasuredShift>& data, const TemperatureShift& law, double deviation,
                   const FitOptions& options = {}, std::optional<double> relative_to = std::nullopt);

}  // namespace rollres
