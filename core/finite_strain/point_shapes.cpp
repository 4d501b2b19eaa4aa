#include "core/finite_strain/point_shapes.hpp"

#include "core/finite_strain/line_memory.hpp"

namespace rollres {

namespace {

/// Values and derivatives of the quadratics that are 1 at one of 0, 1/2, 1.
struct Quadratics {
  Eigen::Vector3d value, slope;
};
Quadratics quadratics(double s) {
  return {{(1 - s) * (1 - 2 * s), 4 * s * (1 - s), s * (2 * s - 1)}, {4 * s - 3, 4 - 8 * s, 4 * s - 1}};
}

}  // namespace

const PointShapes& point_shapes() {
  static const PointShapes shapes = [] {
    PointShapes made;
    for (int i = 0; i < 3; ++i)
      for (int k = 0; k < 3; ++k) {
        const auto g = static_cast<std::size_t>(3 * i + k);
        const Quadratics a = quadratics(gauss_places[i]), d = quadratics(gauss_places[k]);
        for (int n = 0; n < 9; ++n) {
          made.along[g](n) = a.slope(n / 3) * d.value(n % 3);
          made.down[g](n) = a.value(n / 3) * d.slope(n % 3);
        }
        made.pressure[g] = {1, 2 * gauss_places[i] - 1, 2 * gauss_places[k] - 1};
        made.weight[g] = gauss_weights[i] * gauss_weights[k];
      }
    return made;
  }();
  return shapes;
}

Eigen::Matrix<double, 3, 18> strain_rows(const Eigen::Matrix2d& f, const PointShapes::Nodes& x,
                                         const PointShapes::Nodes& z) {
  Eigen::Matrix<double, 3, 18> rows;
  for (int n = 0; n < 9; ++n)
    for (int c = 0; c < 2; ++c) {
      rows(0, 2 * n + c) = f(c, 0) * x(n);
      rows(1, 2 * n + c) = f(c, 1) * z(n);
      rows(2, 2 * n + c) = f(c, 0) * z(n) + f(c, 1) * x(n);
    }
  return rows;
}

Eigen::Matrix2d gradient_of(const Eigen::Matrix<double, 18, 1>& field, const PointShapes::Nodes& x,
                            const PointShapes::Nodes& z) {
  Eigen::Matrix2d gradient = Eigen::Matrix2d::Zero();
  for (int n = 0; n < 9; ++n)
    for (int c = 0; c < 2; ++c) {
      gradient(c, 0) += field(2 * n + c) * x(n);
      gradient(c, 1) += field(2 * n + c) * z(n);
    }
  return gradient;
}

}  // namespace rollres
