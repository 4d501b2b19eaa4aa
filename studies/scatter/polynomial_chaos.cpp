#include "studies/scatter/polynomial_chaos.hpp"

#include <Eigen/QR>
#include <cmath>
#include <limits>
#include <numeric>

namespace rollres {

namespace {

using Powers = std::vector<int>;

constexpr int highest_degree = 12;
constexpr std::size_t most_candidates = 300;

/// Values of the normalised polynomials of degrees 0 to `degree`, a column for each.
Eigen::MatrixXd polynomials(Germ germ, const Eigen::VectorXd& x, int degree) {
  Eigen::MatrixXd values = Eigen::MatrixXd::Ones(x.size(), degree + 1);
  if (degree >= 1) values.col(1) = x;
  for (int n = 1; n < degree; ++n) {  // recurrences of He_n and P_n
    if (germ == Germ::normal)
      values.col(n + 1) = x.cwiseProduct(values.col(n)) - n * values.col(n - 1);
    else
      values.col(n + 1) = ((2 * n + 1) * x.cwiseProduct(values.col(n)) - n * values.col(n - 1)) / (n + 1);
  }
  double factorial = 1;
  for (int n = 1; n <= degree; ++n) {
    factorial *= n;
    values.col(n) *= germ == Germ::normal ? 1 / std::sqrt(factorial) : std::sqrt(2.0 * n + 1);
  }
  return values;
}

/// Products of the polynomials with these powers, a column for each.
Eigen::MatrixXd products(const std::vector<Germ>& germs, const Eigen::MatrixXd& points,
                         const std::vector<Powers>& powers) {
  Eigen::MatrixXd terms = Eigen::MatrixXd::Ones(points.rows(), static_cast<Eigen::Index>(powers.size()));
  for (std::size_t i = 0; i < germs.size(); ++i) {
    int degree = 0;
    for (const Powers& one : powers) degree = std::max(degree, one[i]);
    const Eigen::MatrixXd values = polynomials(germs[i], points.col(static_cast<Eigen::Index>(i)), degree);
    for (std::size_t k = 0; k < powers.size(); ++k)
      if (powers[k][i] > 0) terms.col(static_cast<Eigen::Index>(k)).array() *= values.col(powers[k][i]).array();
  }
  return terms;
}

void add_powers(std::vector<Powers>& all, Powers& begun, std::size_t place, int left) {
  if (place == begun.size()) {
    all.push_back(begun);
    return;
  }
  for (int power = 0; power <= left; ++power) {
    begun[place] = power;
    add_powers(all, begun, place + 1, left - power);
  }
  begun[place] = 0;
}

/// All powers up to a total degree; the first are all 0.
std::vector<Powers> powers_up_to(std::size_t inputs, int degree) {
  std::vector<Powers> all;
  Powers begun(inputs, 0);
  add_powers(all, begun, 0, degree);
  return all;
}

struct Choice {
  std::vector<std::size_t> terms;
  double square = std::numeric_limits<double>::infinity();  ///< e^2
};

double cross_validated(const Eigen::VectorXd& rest, const Eigen::VectorXd& leverage, std::size_t terms) {
  constexpr double most_leverage = 1 - 1e-9;
  const auto n = static_cast<double>(rest.size()), p = static_cast<double>(terms);
  if (leverage.maxCoeff() >= most_leverage) return std::numeric_limits<double>::infinity();
  const double mean = (rest.array() / (1 - leverage.array())).square().mean();
  return n / (n - p) * (1 + p / n) * mean;
}

/// The terms with the smallest error among those of a pursuit.
Choice pursued(const Eigen::MatrixXd& terms, const Eigen::VectorXd& values) {
  const Eigen::Index n = values.size();
  const auto most = static_cast<std::size_t>(std::min<Eigen::Index>({terms.cols(), n / 2, 80}));
  Eigen::MatrixXd basis(n, static_cast<Eigen::Index>(most));  // orthonormal, of the chosen ones
  Eigen::VectorXd rest = values, leverage = Eigen::VectorXd::Zero(n);
  const Eigen::VectorXd lengths = terms.colwise().norm();
  std::vector<bool> taken(static_cast<std::size_t>(terms.cols()), false);
  Choice all, best;
  for (std::size_t k = 0; k < most; ++k) {
    Eigen::Index next = 0;
    if (k > 0) {  // the constant comes first
      Eigen::VectorXd tie = (terms.transpose() * rest).cwiseAbs().cwiseQuotient(lengths);
      for (Eigen::Index i = 0; i < tie.size(); ++i)
        if (taken[static_cast<std::size_t>(i)]) tie[i] = -1;
      tie.maxCoeff(&next);
    }
    taken[static_cast<std::size_t>(next)] = true;
    const auto chosen = static_cast<Eigen::Index>(all.terms.size());
    Eigen::VectorXd direction = terms.col(next);
    for (int twice = 0; twice < 2; ++twice)
      direction -= basis.leftCols(chosen) * (basis.leftCols(chosen).transpose() * direction);
    constexpr double dependent = 1e-8;
    if (direction.norm() <= dependent * lengths[next]) continue;
    direction.normalize();
    basis.col(chosen) = direction;
    rest -= direction * direction.dot(rest);
    leverage += direction.cwiseAbs2();
    all.terms.push_back(static_cast<std::size_t>(next));
    all.square = cross_validated(rest, leverage, all.terms.size());
    if (all.square < best.square) best = all;
    constexpr std::size_t patience = 12;  // terms without a gain
    if (all.terms.size() > best.terms.size() + patience) break;
  }
  return best;
}

}  // namespace

PolynomialChaos::PolynomialChaos(const GermPoints& at, const Eigen::VectorXd& values) : germs_(at.germs) {
  double best = std::numeric_limits<double>::infinity();
  for (int degree = 1; degree <= highest_degree; ++degree) {
    const std::vector<Powers> powers = powers_up_to(germs_.size(), degree);
    if (degree > 1 && powers.size() > most_candidates) break;
    const Choice choice = pursued(products(germs_, at.points, powers), values);
    constexpr double rounding = 1e-24;  // of the sum of squares
    if (choice.terms.empty() || choice.square >= best) {
      if (degree > degree_ + 2) break;
      continue;
    }
    best = choice.square;
    degree_ = degree;
    powers_.clear();
    for (const std::size_t term : choice.terms) powers_.push_back(powers[term]);
    if (best <= rounding * values.squaredNorm()) break;
  }
  if (powers_.empty()) powers_.emplace_back(germs_.size(), 0);
  error_ = std::sqrt(best);
  coefficients_ = terms_at(at.points).colPivHouseholderQr().solve(values);
}

Eigen::MatrixXd PolynomialChaos::terms_at(const Eigen::MatrixXd& points) const {
  return products(germs_, points, powers_);
}

}  // namespace rollres
