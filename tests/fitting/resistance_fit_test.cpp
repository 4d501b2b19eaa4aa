#include "fitting/resistance_fit.hpp"

#include <atomic>
#include <cmath>
#include <cstdio>

#include "tests/catch.hpp"
#include "tests/fitting/measured_hunter.hpp"

using namespace rollres;

TEST_CASE("scratch", "[fitting]") {
  auto scenes = measured_hunter(spread_speeds(0.003, 3, 12), {1e4, 3e4}, 0.02);
  FitProblem problem = resistance_problem(scenes, zener_inputs(), hunter_resistance);
  problem.deviations_known = true;
  const FitReport report = fit(problem);
  std::printf("%s %s it %d chi2 %g dof %d p %g evals %zu agree %d/%d noise %g\n", std::string(name_of(report.status)).c_str(), report.reason.c_str(), report.iterations,
              report.chi_squared, report.degrees, report.p_value, report.evaluations, report.agreeing, report.starts, report.noise);
  for (auto& w : report.warnings) std::printf("  %s\n", w.c_str());
  for (auto& p : report.parameters)
    std::printf("%s %g +- %g [%g %g] [%g %g] %zu step %g doubt %g %s\n", p.parameter.name.c_str(), p.value, p.standard_error, p.linear.lowest,
                p.linear.highest, p.profile.interval.lowest, p.profile.interval.highest, p.profile.points.size(), p.step, p.slope_doubt, p.flag.c_str());
  std::printf("%s\n", report.weakest_direction.c_str());
}
