#include "fitting/material/vertical_shifts.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "core/messages/message_text.hpp"
#include "fitting/errors/information_criteria.hpp"

namespace rollres {

namespace {

double aicc_of(const FitReport& report) {
  constexpr double exact = 1e-4;  // a relative misfit that counts as none
  const auto values = static_cast<double>(report.values.size());
  const double chi_squared =
      report.deviations_known ? report.chi_squared : std::max(report.chi_squared, values * exact * exact);
  return information_criteria(chi_squared, report.values.size(), static_cast<int>(report.parameters.size()),
                              report.deviations_known)
      .aicc;
}

}  // namespace

MaterialFit with_vertical_shifts(const MaterialFitOptions& options,
                                 const std::function<MaterialFit(const MaterialFitOptions&)>& fit_with) {
  MaterialFit plain = fit_with(options);
  if (options.vertical == VerticalShift::none || !plain.report.slopes.found()) return plain;
  MaterialFitOptions wanted = options;
  wanted.shift = plain.shift;
  wanted.shift.table.moduli.assign(plain.shift.table.temperatures.size(), 1);
  MaterialFit scaled = fit_with(wanted);
  const double gain = aicc_of(plain.report) - aicc_of(scaled.report);
  const bool converged = scaled.report.slopes.found() && scaled.report.status != FitStatus::not_converged;
  const bool asked = converged && gain >= wanted_gain;
  const bool taken = asked || options.vertical == VerticalShift::free;
  MaterialFit& best = taken ? scaled : plain;
  best.notes.push_back(message_text<3>("vertical shifts b_T are ", taken ? "taken" : "left out", ": with them AICc ",
                                       gain >= 0 ? "falls" : "rises", " by ", std::abs(gain),
                                       !converged ? ", but that fit did not converge"
                                       : gain < wanted_gain
                                           ? message_text<3>("; the data ask for them from a fall of ", wanted_gain)
                                           : std::string()));
  return std::move(best);
}

}  // namespace rollres
