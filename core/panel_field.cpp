#include "core/panel_field.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace rollres {

using Eigen::Index;
using SixByNodes = Eigen::Array<double, 6, Eigen::Dynamic>;

ChebyshevPanels::ChebyshevPanels(std::vector<double> borders, int degree) : borders_(std::move(borders)) {
  const int count = degree + 1;
  for (std::size_t panel = 0; panel + 1 < borders_.size(); ++panel)
    for (int node = 0; node < count; ++node)
      nodes_.push_back(borders_[panel] +
                       0.5 * (borders_[panel + 1] - borders_[panel]) * (1 + std::cos(M_PI * (node + 0.5) / count)));
  integration_ = Eigen::MatrixXd::Zero(count + 1, count);
  for (int node = 0; node < count; ++node) {
    Eigen::VectorXd series = Eigen::VectorXd::Zero(count + 2);  // of the function that is 1 at the node
    for (int k = 0; k < count; ++k)
      series(k) = (k == 0 ? 1.0 : 2.0) / count * std::cos(k * M_PI * (node + 0.5) / count);
    double at_start = 0;
    for (int k = 1; k <= count; ++k) {
      integration_(k, node) = ((k == 1 ? 2 : 1) * series(k - 1) - series(k + 1)) / (2 * k);
      at_start += (k % 2 == 0 ? 1 : -1) * integration_(k, node);
    }
    integration_(0, node) = -at_start;
  }
}

std::size_t ChebyshevPanels::panel_of(double x) const {
  const auto after = std::upper_bound(borders_.begin() + 1, borders_.end() - 1, x);
  return static_cast<std::size_t>(after - borders_.begin() - 1);
}

Eigen::VectorXd ChebyshevPanels::integral_weights(double x) const {
  Eigen::VectorXd weights = Eigen::VectorXd::Zero(static_cast<Index>(nodes_.size()));
  const Index count = integration_.cols();
  for (std::size_t panel = 0, last = panel_of(x); panel <= last; ++panel) {
    const double half = 0.5 * (borders_[panel + 1] - borders_[panel]);
    const double t = panel < last ? 1 : (x - borders_[panel]) / half - 1;
    Eigen::VectorXd images(count + 1);
    for (Index k = 0; k <= count; ++k)
      images(k) = std::cos(static_cast<double>(k) * std::acos(std::clamp(t, -1.0, 1.0)));
    weights.segment(static_cast<Index>(panel) * count, count) = half * integration_.transpose() * images;
  }
  return weights;
}

ChebyshevPanels::Antiderivative ChebyshevPanels::antiderivative(const SixByNodes& values) const {
  const Index count = integration_.cols(), panels = static_cast<Index>(borders_.size()) - 1;
  Antiderivative result{this, SixByNodes(6, panels * (count + 1))};
  Coefficients before = Coefficients::Zero();
  for (Index panel = 0; panel < panels; ++panel) {
    const auto p = static_cast<std::size_t>(panel);
    auto series = result.coefficients.middleCols(panel * (count + 1), count + 1);
    series = (0.5 * (borders_[p + 1] - borders_[p]) *
              (values.middleCols(panel * count, count).matrix() * integration_.transpose()))
                 .array();
    series.col(0) += before;
    before = series.rowwise().sum();  // at the panel's end
  }
  return result;
}

Coefficients ChebyshevPanels::Antiderivative::operator()(double x) const {
  const std::size_t panel = panels->panel_of(x);
  const double from = panels->borders_[panel], to = panels->borders_[panel + 1];
  const double t = 2 * (x - from) / (to - from) - 1;
  const Index count = panels->integration_.rows();
  const auto series = coefficients.middleCols(static_cast<Index>(panel) * count, count);
  Coefficients b1 = Coefficients::Zero(), b2 = b1;
  for (Index k = count - 1; k > 0; --k) {  // Clenshaw
    const Coefficients b0 = series.col(k) + 2 * t * b1 - b2;
    b2 = b1;
    b1 = b0;
  }
  return series.col(0) + t * b1 - b2;
}

PanelField::PanelField(const std::vector<double>& borders, int degree, Value value)
    : panels_(borders, degree), value_(std::move(value)), values_(panels_.nodes().size()), sampled_(panels_.count()) {}

void PanelField::sample(std::size_t panel) const {
  const std::vector<double>& nodes = panels_.nodes();
  const std::size_t each = panels_.nodes_each();
  for (std::size_t j = panel * each; j < (panel + 1) * each; ++j) {
    values_[j].resize(6, static_cast<Index>(nodes.size()));
    for (std::size_t i = 0; i < nodes.size(); ++i) values_[j].col(static_cast<Index>(i)) = value_(nodes[i], nodes[j]);
  }
}

PanelField::Strip PanelField::strip(double below, double above) const {
  const Eigen::VectorXd to = panels_.integral_weights(std::abs(above)),
                        from = panels_.integral_weights(std::abs(below));
  const double to_sign = above < 0 ? -1 : 1, from_sign = below < 0 ? -1 : 1;
  const std::size_t last = panels_.panel_of(std::max(std::abs(below), std::abs(above)));
  const std::size_t first = below < 0 ? 0 : panels_.panel_of(below);
  for (std::size_t panel = first; panel <= last; ++panel) std::call_once(sampled_[panel], [&] { sample(panel); });
  SixByNodes along = SixByNodes::Zero(6, to.size());
  const std::size_t each = panels_.nodes_each();
  for (std::size_t j = first * each; j < (last + 1) * each; ++j) {
    // The antiderivative of what is even is odd.
    const auto at = static_cast<Index>(j);
    const double even = to_sign * to(at) - from_sign * from(at), odd = to(at) - from(at);
    const Coefficients weights = (coefficient::mirror_y > 0).select(Coefficients::Constant(even), odd);
    along += values_[j].colwise() * weights;
  }
  Strip strip;
  strip.antiderivative_ = panels_.antiderivative(along);
  return strip;
}

Coefficients PanelField::Strip::from_0(double x) const {
  if (x >= 0) return antiderivative_(x);
  return -coefficient::mirror_x * antiderivative_(-x);
}

}  // namespace rollres
