#pragma once

/// The six coefficients as smooth functions of x and y, and their integrals over rectangles: Chebyshev interpolation on
/// the product of panels in x and in y, which may widen with the distance.

#include <Eigen/Core>
#include <functional>
#include <mutex>
#include <vector>

#include "core/elastic_kernel.hpp"

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

  /// Antiderivative, 0 at 0, by Chebyshev coefficients, of a function given by rows at the nodes.
  struct Antiderivative {
    const ChebyshevPanels* panels;
    Eigen::Array<double, 6, Eigen::Dynamic> coefficients;  // degree + 2 for each panel
    Coefficients operator()(double x) const;
  };
  Antiderivative antiderivative(const Eigen::Array<double, 6, Eigen::Dynamic>& values) const;

 private:
  std::vector<double> borders_, nodes_;
  Eigen::MatrixXd integration_;  // coefficients of the antiderivative, 0 at -1, from values at the nodes of [-1, 1]
};

/// Values are taken when a panel across is first asked for, whichever thread asks.
class PanelField {
 public:
  using Value = std::function<Coefficients(double x, double y)>;
  /// @param value at x, y >= 0; elsewhere as coefficient::mirror_x and mirror_y say
  PanelField(const std::vector<double>& borders, int degree, Value value);

  double end() const { return panels_.end(); }

  /// Integrals over rectangles with the same two borders in y, while the field lives.
  class Strip {
   public:
    /// |left|, |right| <= end
    Coefficients operator()(double left, double right) const { return from_0(right) - from_0(left); }

   private:
    friend PanelField;
    Coefficients from_0(double x) const;
    ChebyshevPanels::Antiderivative antiderivative_;
  };
  /// |below|, |above| <= end
  Strip strip(double below, double above) const;

 private:
  void sample(std::size_t panel) const;

  ChebyshevPanels panels_;
  Value value_;
  mutable std::vector<Eigen::Array<double, 6, Eigen::Dynamic>> values_;  // at the nodes along x, for each across
  mutable std::vector<std::once_flag> sampled_;                          // each panel across
};

}  // namespace rollres
