#pragma once

/// The six coefficients of several surfaces as smooth functions of x and y, and their integrals over rectangles:
/// Chebyshev interpolation on the product of panels in x and in y, which may widen with the distance.

#include <Eigen/Core>
#include <functional>
#include <mutex>
#include <vector>

#include "core/influence/elastic_kernel.hpp"

namespace rollres {

/// Panels of Chebyshev nodes on [0, end] and integrals of what is interpolated there.
class ChebyshevPanels {
 public:
  ChebyshevPanels(std::vector<double> borders, int degree);

  const std::vector<double>& nodes() const { return nodes_; }
  double end() const { return borders_.back(); }
  std::size_t panel_of(double x) const;
  std::size_t count() const { return borders_.size() - 1; }
  std::size_t nodes_each() const { return nodes_.size() / count(); }

  /// Weights of the nodes' values in the integral from 0 to 0 <= x <= end.
  Eigen::VectorXd integral_weights(double x) const;

  /// Antiderivatives, 0 at 0, by Chebyshev coefficients, of functions given by rows at the nodes.
  struct Antiderivatives {
    const ChebyshevPanels* panels;
    Eigen::MatrixXd coefficients;  // degree + 2 for each panel
    Eigen::VectorXd operator()(double x) const;
    /// Of their integrals from left to right, 0 <= left <= right.
    Eigen::VectorXd between(double left, double right) const;
  };
  Antiderivatives antiderivatives(const Eigen::MatrixXd& values) const;

 private:
  Eigen::VectorXd images(std::size_t panel, double x) const;

  std::vector<double> borders_, nodes_;
  Eigen::MatrixXd integration_;  // coefficients of the antiderivative, 0 at -1, from values at the nodes of [-1, 1]
};

/// Values are taken when a panel across is first asked for, whichever thread asks.
class PiecewiseField {
 public:
  /// The coefficients of one surface after the other.
  using Value = std::function<Eigen::VectorXd(double x, double y)>;
  /// @param value at x, y >= 0; elsewhere as coefficient::mirror_x and mirror_y say
  PiecewiseField(const std::vector<double>& borders, int degree, Value value);

  double end() const { return panels_.end(); }

  /// Integrals over rectangles with the same two borders in y, while the field lives.
  class Strip {
   public:
    /// |left| <= right <= end
    Eigen::VectorXd operator()(double left, double right) const;

   private:
    friend PiecewiseField;
    ChebyshevPanels::Antiderivatives antiderivatives_;
  };
  /// |below|, |above| <= end
  Strip strip(double below, double above) const;

 private:
  void sample(std::size_t panel) const;

  ChebyshevPanels panels_;
  Value value_;
  mutable std::vector<Eigen::MatrixXd> values_;  // at the nodes along x, for each across
  mutable std::vector<std::once_flag> sampled_;  // each panel across
};

}  // namespace rollres
