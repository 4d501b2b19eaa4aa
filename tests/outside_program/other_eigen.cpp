/// Solves beside algebra of its own, whose templates of Eigen are compiled for the least of processors and whose memory
/// is aligned for that: core must go on with its own ones.

#include <Eigen/LU>
#include <cstdio>
#include <cstdlib>
#include <rollres/core/rolling_contact.hpp>

#include "paper_cylinder.hpp"

int main() {
  const Eigen::MatrixXd matrix = Eigen::MatrixXd::Random(150, 150) + 20 * Eigen::MatrixXd::Identity(150, 150);
  const Eigen::VectorXd right = Eigen::VectorXd::Random(150);
  const double residual = (matrix * matrix.partialPivLu().solve(right) - right).norm();
  rollres::RollingScene scene = paper_cylinder();
  for (const rollres::Method method : {rollres::Method::spectral, rollres::Method::newton_dense}) {
    scene.method = method;
    const rollres::RollingSolution solution = rollres::solve(scene);
    std::printf("%.6g N/m, residual %.1e\n", solution.rolling_resistance, residual);
    if (solution.status != rollres::Status::converged) return EXIT_FAILURE;
  }
  return residual < 1e-10 ? EXIT_SUCCESS : EXIT_FAILURE;
}
