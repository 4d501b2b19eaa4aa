#include "core/algebra/fixed_point.hpp"

#include <cmath>

#include "tests/catch.hpp"

using namespace rollres;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

struct Counted {
  FixedPointProblem problem;
  int evaluations = 0;
  double missed = INFINITY;

  explicit Counted(const std::function<std::optional<VectorXd>(const VectorXd&)>& map) {
    problem.map = [this, map](const VectorXd& x) {
      ++evaluations;
      const auto mapped = map(x);
      missed = mapped ? (*mapped - x).cwiseAbs().maxCoeff() : INFINITY;
      return mapped;
    };
    problem.near = [](const VectorXd& x, const VectorXd& mapped) { return (mapped - x).cwiseAbs().maxCoeff() < 1e-10; };
    problem.difference = 1e-5;
    problem.most_evaluations = 60;
  }
};

}  // namespace

// Plain iteration of any of these grows: the fixed points are known beforehand.
TEST_CASE("a linear map that drives away has its fixed point found in one evaluation more than unknowns",
          "[core][algebra]") {
  MatrixXd slopes(3, 3);
  slopes << -1.3, 0.4, 0, 0.2, -3, 0.5, 0, 0.7, 2;
  const VectorXd fixed = VectorXd::LinSpaced(3, 1, 5);
  Counted counted([&](const VectorXd& x) { return VectorXd(fixed + slopes * (x - fixed)); });
  const auto found = fixed_point(counted.problem, VectorXd::Zero(3));
  REQUIRE(found);
  CHECK((*found - fixed).norm() < 1e-9);
  CHECK(counted.evaluations <= 6);
}

TEST_CASE("where mixing goes round, and where the map has no value, differences find the fixed point",
          "[core][algebra]") {
  // x = 2 - y^3, y = x exists at 1; beyond 1.5 there is no value.
  Counted counted([](const VectorXd& x) -> std::optional<VectorXd> {
    if (x.maxCoeff() > 1.5) return std::nullopt;
    return VectorXd((VectorXd(2) << 2 - 8 * (std::pow(x(1), 3) - 1) - 1, x(0)).finished());
  });
  for (const double start : {0.2, 0.6, 1.4}) {
    counted.evaluations = 0;
    const auto found = fixed_point(counted.problem, VectorXd::Constant(2, start));
    REQUIRE(found);
    CAPTURE(start, counted.evaluations, counted.missed);
    CHECK((*found - VectorXd::Ones(2)).norm() < 1e-9);
  }
}

TEST_CASE("without a fixed point the evaluation that missed least is the last, and without a start there is none",
          "[core][algebra]") {
  Counted counted([](const VectorXd& x) { return VectorXd(x.array() + 1 + x.array().square()); });
  const auto found = fixed_point(counted.problem, VectorXd::Constant(1, 0.7));
  REQUIRE(found);
  CHECK(counted.evaluations <= 70);
  CHECK(counted.missed == Approx(1 + (*found)(0) * (*found)(0)));
  CHECK(counted.missed < 1.49);
  Counted none([](const VectorXd&) -> std::optional<VectorXd> { return std::nullopt; });
  CHECK_FALSE(fixed_point(none.problem, VectorXd::Zero(1)));
}
