#pragma once

/// A polynomial in place of a costly function of numbers that scatter: sparse polynomial chaos (Blatman and Sudret,
/// 2011, J. Comput. Phys. 230, 2345, "Adaptive sparse polynomial chaos expansion based on least angle regression").
///
/// Each independent number is a germ: standard normal, with Hermite's polynomials, or uniform from -1 to 1, with
/// Legendre's; normalised, they are orthonormal under its distribution. y = sum_k c_k psi_k(germs), the c_k by least
/// squares. Terms are taken one by one, that which the rest of y hangs together with most first (orthogonal matching
/// pursuit: Pati, Rezaiifar and Krishnaprasad, 1993), from products of polynomials up to a total degree; degree and
/// number of terms are those with the smallest error of cross-validation,
///
///     e^2 = T/n sum_i ((y_i - f(x_i)) / (1 - h_i))^2,    T = n/(n - P) (1 + P/n),
///
/// where f is fitted to all n points, h_i is the i-th number on the diagonal of the hat matrix, so that each quotient
/// is what a fit to all points but the i-th misses it by, and T corrects for P chosen terms (Chapelle, Vapnik and
/// Bengio, 2002, Mach. Learn. 48, 9).

#include <Eigen/Core>
#include <cstddef>
#include <vector>

namespace rollres {

enum class Germ { normal, uniform };

/// Points of germs: a row for each point, a column for each number.
struct GermPoints {
  std::vector<Germ> germs;
  Eigen::MatrixXd points;
};

class PolynomialChaos {
 public:
  /// @param values  one for each point; at least 8 points
  PolynomialChaos(const GermPoints& at, const Eigen::VectorXd& values);

  /// The terms at some points, a column for each: values there are the product with coefficients.
  Eigen::MatrixXd terms_at(const Eigen::MatrixXd& points) const;
  const Eigen::VectorXd& coefficients() const { return coefficients_; }

  double error() const { return error_; }  ///< e [unit of the values]
  int degree() const { return degree_; }
  std::size_t terms() const { return powers_.size(); }

 private:
  std::vector<Germ> germs_;
  std::vector<std::vector<int>> powers_;  ///< of each term
  Eigen::VectorXd coefficients_;
  double error_ = 0;
  int degree_ = 0;
};

}  // namespace rollres
