// Covers ceres_least_squares too.

#include "fitting/descent/least_squares.hpp"

#include "tests/catch.hpp"

using namespace rollres;

namespace {

/// y = a + b x^2 through five points, one far off.
class Parabola : public LeastSquares {
 public:
  Parabola() {
    residuals = x.size();
    parameters = {{0, -10, 10}, {0, -10, 10}};
  }
  void move_to(const double* at, bool) final {
    a = at[0], b = at[1];
    double squares = 0, value = 0;
    for (std::size_t row = 0; row < residuals; ++row) {
      residual(row, value, nullptr);
      squares += value * value;
    }
    if (squares < least) least = squares, best_a = a, best_b = b;
  }
  bool residual(std::size_t row, double& value, double* slopes) const final {
    value = a + b * x[row] * x[row] - y[row];
    if (slopes) slopes[0] = 1, slopes[1] = x[row] * x[row];
    return b < 5;
  }

  bool has_loss(std::size_t row) const final { return row < fully_counted; }
  Next after_iteration(int iteration, double sum, bool, const double* at) final {
    if (iteration == 0) first_sum = sum;
    CHECK(at[1] < 5);
    return iteration < most ? Next::step : Next::end;
  }

  std::size_t fully_counted = 5;
  int most = 60;
  double first_sum = 0;
  const std::vector<double> x{0, 1, 2, 3, 4}, y{1, 3, 9, 19, 83};  // 1 + 2 x^2 but for the last
  double a = 0, b = 0, least = 1e9, best_a = 0, best_b = 0;
};

}  // namespace

TEST_CASE("least squares of a linear problem are those of its normal equations", "[fitting][least_squares]") {
  Parabola problem;
  const LeastSquaresEnd end = minimise(problem);
  CHECK(end.converged);
  CHECK(end.iterations > 0);
  CHECK(end.parameters[1] == Approx(4240.0 / 870).epsilon(1e-6));
  CHECK(end.first_sum == Approx(1 + 9 + 81 + 361 + 83 * 83));
  CHECK(problem.first_sum == Approx(end.first_sum));
  CHECK(end.last_sum == Approx(problem.least));
  // 5 a + 30 b = 115 and 30 a + 354 b = 1538
  CHECK(problem.a == Approx(-5430.0 / 870).epsilon(1e-6));
  CHECK(problem.b == Approx(4240.0 / 870).epsilon(1e-6));
}

TEST_CASE("bounds, held parameters and losses are kept", "[fitting][least_squares]") {
  Parabola problem;
  SECTION("a bound") {
    problem.parameters[0].lowest = -1;
    minimise(problem);
    CHECK(problem.best_a == Approx(-1));
    CHECK(problem.best_b > 1568.0 / 354 + 0.05);  // what the header warns of
    problem.parameters = {{-1, -1, 10, true}, {problem.best_b, -10, 10}};
    CHECK(minimise(problem).converged);
    CHECK(problem.best_b == Approx(1568.0 / 354).epsilon(1e-6));
  }
  SECTION("a held parameter") {
    problem.parameters[0] = {1, -10, 10, true};
    CHECK(minimise(problem).converged);
    CHECK(problem.b == Approx(1508.0 / 354).epsilon(1e-6));
  }
  SECTION("Cauchy's loss leaves the one far off alone") {
    problem.loss = Loss::cauchy;
    problem.loss_scale = 1e-3;
    problem.parameters[0].start = 1.5;
    problem.parameters[1].start = 1.9;
    minimise(problem);
    CHECK(problem.a == Approx(1).margin(1e-4));
    CHECK(problem.b == Approx(2).margin(1e-4));
    problem.fully_counted = 0;
    CHECK(minimise(problem).parameters[1] == Approx(4240.0 / 870).epsilon(1e-6));
  }
  SECTION("an end that is asked for") {
    problem.most = 1;
    problem.tolerance = 1e-14;
    const LeastSquaresEnd end = minimise(problem);
    CHECK(end.iterations == 2);  // the start and a step
    CHECK(end.last_sum < end.first_sum);
    CHECK(end.radius > 0);
  }
}
