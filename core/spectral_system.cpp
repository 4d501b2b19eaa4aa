#include "core/spectral_system.hpp"

#include <Eigen/LU>
#include <cmath>
#include <optional>
#include <utility>

#include "core/chebyshev_rule.hpp"
#include "core/memory_functions.hpp"
#include "core/quadrature.hpp"
#include "core/sliding_base.hpp"

namespace rollres {

namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::RowVectorXd;
using Eigen::VectorXd;

/// The exponential e^{rate (t - 1)} on an interval and the memory beyond its leading end.
struct Exponentials {
  MatrixXd series;  // [n, j]: Chebyshev coefficients of the exponential, n = 0 ... order
  MatrixXd memory;  // [n, m]: b_n, n = 0 ... order
  MatrixXd tails;   // [j, m]: mean of the field of what the series leaves out, over the memory

  Exponentials(const SpectralProblem& problem, double half_length, int order) {
    const Index terms = problem.terms();
    series.resize(order + 1, terms);
    memory.resize(order + 1, terms);
    tails.resize(terms, terms);
    for (Index m = 0; m < terms; ++m)
      memory.col(m) = edge_memory(half_length / problem.creep_length[static_cast<std::size_t>(m)], order + 1);
    for (Index j = 0; j < terms; ++j) {
      const double rate = half_length / problem.relaxation_length[static_cast<std::size_t>(j)];
      const VectorXd bessel = scaled_bessel_i(rate, order + 1);
      series.col(j) = 2 * bessel;
      series(0, j) = bessel(0);
      // All orders together in closed form; without a tail that is worth it, no difference of large numbers.
      const bool resolved = std::abs(bessel(order)) < 1e-17;
      for (Index m = 0; m < terms; ++m) {
        const double decay = half_length / problem.creep_length[static_cast<std::size_t>(m)];
        const ScaledBesselK k = scaled_bessel_k(decay);
        const double all =
            decay * (rate * (bessel(1) * k.order_0 + bessel(0) * k.order_1) - 1) / (rate - decay) - bessel(0);
        tails(j, m) = resolved ? 0 : all - series.col(j).tail(order).dot(memory.col(m).tail(order));
      }
    }
  }
};

/// Solutions r_j of r - rho r' = slope of the body, at points and at the leading edge.
class SlopeMemory {
 public:
  SlopeMemory(const SpectralProblem& problem, const SpectralEdges& edges, std::size_t term)
      : problem_(problem),
        length_(problem.relaxation_length[term]),
        end_(edges.leading),
        // A short memory of the slope as if the body went on; a long one from the edge.
        goes_on_(edges.half_length() > 8 * length_ && edges.leading + 40 * length_ < 0.9 * problem.radius) {}

  double at_edge() const { return goes_on_ ? (*this)(end_) : 0; }
  double operator()(double x) const {
    static const QuadratureRule rule = gauss_legendre(32);
    const double range = goes_on_ ? 40 : std::min((end_ - x) / length_, 40.0);
    double sum = 0;
    for (std::size_t q = 0; q < rule.nodes.size(); ++q) {
      const double s = range * rule.nodes[q];
      sum += rule.weights[q] * std::exp(-s) * problem_.slope(x + length_ * s);
    }
    return range * sum;
  }

 private:
  const SpectralProblem& problem_;
  double length_, end_;
  bool goes_on_;
};

class System {
 public:
  System(const SpectralProblem& given_problem, const SlipPattern& given_pattern, const SpectralEdges& given_edges,
         const SpectralOrders& orders)
      : problem_(given_problem),
        pattern_(given_pattern),
        edges_(given_edges),
        friction_(given_pattern.shear ? given_problem.scene.friction_coefficient : 0),
        n_(orders.contact),
        stick_n_(given_pattern.stick ? orders.stick : 0),
        terms_(given_problem.terms()),
        rule_(chebyshev_rule(orders.contact)),
        exponentials_(given_problem, given_edges.half_length(), orders.contact),
        phi_(0),
        slack_(n_),
        amplitude_(n_ + 1),
        psi_(n_ + 1 + terms_),
        stick_slack_(psi_ + stick_n_),
        rotation_(stick_slack_ + 1),
        stick_amplitude_(rotation_ + 1),
        size_(pattern_.stick ? stick_amplitude_ + terms_ : psi_) {
    place_sources();
  }

  SpectralState solve() {
    matrix_ = MatrixXd::Zero(size_, size_);
    right_ = VectorXd::Zero(size_);
    collocate_normal();
    remember_normal();
    if (pattern_.stick) {
      collocate_stick();
      remember_stick();
      drive();
    }
    solution_ = matrix_.partialPivLu().solve(right_);
    return state();
  }

 private:
  /// Points at which smooth functions of x are integrated against the tractions.
  void place_sources() {
    const Index p = n_, s = stick_n_;
    const bool own_base = pattern_.shear && !pattern_.one_direction();
    if (pattern_.shear && (pattern_.stick || own_base)) base_.emplace(pattern_, edges_, static_cast<int>(n_), static_cast<int>(stick_n_));
    const Index b = own_base ? base_->nodes.size() : 0;
    sources_.resize(p + s + b);
    of_pressure_ = MatrixXd::Zero(p + s + b, size_);
    of_shear_ = MatrixXd::Zero(p + s + b, size_);
    sources_.head(p) = edges_.centre() + edges_.half_length() * rule_.nodes.array();
    of_pressure_.topLeftCorner(p, n_) = edges_.half_length() * rule_.densities;
    if (pattern_.shear && pattern_.one_direction())
      of_shear_.topLeftCorner(p, n_) = friction_ * pattern_.trailing * of_pressure_.topLeftCorner(p, n_);
    if (s > 0) {
      const ChebyshevRule& stick = chebyshev_rule(static_cast<int>(stick_n_));
      sources_.segment(p, s) = edges_.stick_centre() + edges_.stick_half_length() * stick.nodes.array();
      of_shear_.block(p, psi_, s, s) = edges_.stick_half_length() * stick.densities;
    }
    if (b > 0) {
      sources_.tail(b) = base_->nodes;
      of_shear_.bottomLeftCorner(b, n_) = friction_ * base_->densities;
    }
  }

  /// Rows of g_w (component 0) or g_u (1) of the layer's correction, at x or over a memory beyond it.
  template <class Kernel>
  std::pair<RowVectorXd, RowVectorXd> correction(const Kernel& kernel, double x) const {
    VectorXd normal(sources_.size()), tangential(sources_.size()), cross(sources_.size());
    for (Index q = 0; q < sources_.size(); ++q) {
      const LayerSlopes k = kernel(x - sources_(q));
      normal(q) = k(0);
      tangential(q) = k(1);
      cross(q) = k(2);
    }
    RowVectorXd w = -normal.transpose() * of_pressure_, u;
    if (pattern_.shear) {
      w -= cross.transpose() * of_shear_;
      u = tangential.transpose() * of_shear_ - cross.transpose() * of_pressure_;
    }
    return {w, u};
  }

  void collocate_normal() {
    const auto layer = [&](double x) { return layer_slope_correction(x, problem_.thickness); };
    matrix_.topLeftCorner(n_ + 1, n_) = 0.5 * rule_.images.rightCols(n_);
    matrix_.block(0, slack_, n_ + 1, 1).setOnes();
    if (terms_ > 0) matrix_.block(0, amplitude_, n_ + 1, terms_) = -rule_.images * exponentials_.series;
    for (Index i = 0; i <= n_; ++i) {
      const double x = edges_.centre() + edges_.half_length() * rule_.points(i);
      if (problem_.layered()) matrix_.row(i) += correction(layer, x).first;
      right_(i) = problem_.glassy * problem_.slope(x);
    }
    for (std::size_t j = 0; j < static_cast<std::size_t>(terms_); ++j) {
      const SlopeMemory memory(problem_, edges_, j);
      for (Index i = 0; i <= n_; ++i)
        right_(i) -= problem_.relaxation_modulus[j] *
                     memory(edges_.centre() + edges_.half_length() * rule_.points(i));
      right_(amplitude_ + static_cast<Index>(j)) = problem_.relaxation_modulus[j] * memory.at_edge();
    }
  }

  void remember_normal() {
    means_w_ = MatrixXd::Zero(terms_, size_);
    for (Index m = 0; m < terms_; ++m) {
      means_w_.row(m).head(n_) = 0.5 * exponentials_.memory.col(m).tail(n_).transpose();
      means_w_.row(m).segment(amplitude_, terms_) = exponentials_.tails.col(m).transpose();
      if (problem_.layered())
        means_w_.row(m) += correction(problem_.memories[static_cast<std::size_t>(m)], edges_.leading).first;
    }
    for (Index j = 0; j < terms_; ++j) {
      matrix_.row(amplitude_ + j) = problem_.relaxation_modulus[static_cast<std::size_t>(j)] *
                                    (problem_.memory_factor.row(j) * means_w_);
      matrix_(amplitude_ + j, amplitude_ + j) += 1;
    }
  }

  void collocate_stick() {
    const ChebyshevRule& stick = chebyshev_rule(static_cast<int>(stick_n_));
    stick_exponentials_.emplace(problem_, edges_.stick_half_length(), static_cast<int>(stick_n_));
    const auto layer = [&](double x) { return layer_slope_correction(x, problem_.thickness); };
    matrix_.block(psi_, psi_, stick_n_ + 1, stick_n_) = -0.5 * stick.images.rightCols(stick_n_);
    matrix_.block(psi_, stick_slack_, stick_n_ + 1, 1).setOnes();
    matrix_.block(psi_, rotation_, stick_n_ + 1, 1).setConstant(-1);
    MatrixXd kept;
    if (terms_ > 0) {
      kept = stick.images * stick_exponentials_->series;
      matrix_.block(psi_, stick_amplitude_, stick_n_ + 1, terms_) = -kept;
    }
    for (Index i = 0; i <= stick_n_; ++i) {
      const double x = edges_.stick_centre() + edges_.stick_half_length() * stick.points(i);
      auto row = matrix_.row(psi_ + i);
      row.head(n_) += friction_ * base_->slope(x);
      if (problem_.layered()) row += correction(layer, x).second;
      if (terms_ > 0 && pattern_.one_direction()) {
        // The base follows the pressure's tails; without leading slip they are tails of the stick as well.
        const double t = (x - edges_.centre()) / edges_.half_length();
        const RowVectorXd kept_by_pressure =
            chebyshev_images(t, static_cast<int>(n_) + 1).transpose() * exponentials_.series;
        for (Index j = 0; j < terms_; ++j) {
          const double whole =
              pattern_.leading_slip()
                  ? std::exp((x - edges_.leading) / problem_.relaxation_length[static_cast<std::size_t>(j)])
                  : kept(i, j);
          row(amplitude_ + j) -= friction_ * pattern_.trailing * (whole - kept_by_pressure(j));
        }
      }
    }
  }

  void remember_stick() {
    const double direction = friction_ * pattern_.trailing;
    means_u_ = MatrixXd::Zero(terms_, size_);
    for (Index m = 0; m < terms_; ++m) {
      const double length = problem_.creep_length[static_cast<std::size_t>(m)];
      auto row = means_u_.row(m);
      row.segment(psi_, stick_n_) = -0.5 * stick_exponentials_->memory.col(m).tail(stick_n_).transpose();
      row.segment(stick_amplitude_, terms_) = stick_exponentials_->tails.col(m).transpose();
      if (pattern_.leading_slip()) {
        row.head(n_) += friction_ * memory_of_base(*base_, edges_, length, static_cast<int>(n_));
      } else {
        row.head(n_) -= direction * 0.5 * exponentials_.memory.col(m).tail(n_).transpose();
        row.segment(amplitude_, terms_) +=
            direction * (stick_exponentials_->tails.col(m) - exponentials_.tails.col(m)).transpose();
      }
      if (problem_.layered())
        row += correction(problem_.memories[static_cast<std::size_t>(m)], edges_.stick_to).second;
    }
    for (Index j = 0; j < terms_; ++j) {
      const double modulus = problem_.relaxation_modulus[static_cast<std::size_t>(j)];
      auto row = matrix_.row(stick_amplitude_ + j);
      row = modulus * (problem_.memory_factor.row(j) * means_u_);
      row(stick_amplitude_ + j) += 1;
      row(rotation_) -= modulus / problem_.rubbery;
    }
  }

  RowVectorXd resultant(double (*of_pressure)(const SpectralProblem&, double),
                        double (*of_shear)(const SpectralProblem&, double)) const {
    RowVectorXd row = RowVectorXd::Zero(size_);
    for (Index q = 0; q < sources_.size(); ++q)
      row += of_pressure(problem_, sources_(q)) * of_pressure_.row(q) + of_shear(problem_, sources_(q)) * of_shear_.row(q);
    return row;
  }
  RowVectorXd load_row() const {
    return resultant([](const SpectralProblem& p, double x) { return p.cosine(x); },
                     [](const SpectralProblem& p, double x) { return -x / p.radius; });
  }
  RowVectorXd force_row() const {
    return resultant([](const SpectralProblem& p, double x) { return x / p.radius; },
                     [](const SpectralProblem& p, double x) { return p.cosine(x); });
  }
  RowVectorXd torque_row() const {  // T/R
    return resultant([](const SpectralProblem&, double) { return 0.0; },
                     [](const SpectralProblem&, double) { return -1.0; });
  }

  void drive() {
    const RollingScene& scene = problem_.scene;
    auto row = matrix_.row(rotation_);
    if (scene.drive == Drive::rotation) {
      row(rotation_) = 1;
      right_(rotation_) = problem_.rubbery * (*scene.rotation_ratio - 1);
      return;
    }
    row = torque_row() / edges_.half_length();
    if (scene.drive == Drive::top_force) row -= force_row() / edges_.half_length();
    if (scene.drive == Drive::torque) right_(rotation_) = *scene.driving_torque / scene.radius / edges_.half_length();
  }

  double approach() const {
    if (!problem_.layered()) return NAN;
    const double half = edges_.half_length(), leading = edges_.leading;
    double w = 0;  // of unit modulus
    for (Index n = 0; n < n_; ++n) {
      const double mean = n == 0 ? 0.5 - std::log(2 / half) : 1.0 / static_cast<double>(n + 2) - 1.0 / static_cast<double>(n);
      w += half / 4 * solution_(n) * mean;
    }
    for (Index q = 0; q < sources_.size(); ++q) {
      const LayerSlopes k = layer_displacement_correction(leading - sources_(q), problem_.thickness);
      w -= k(0) * of_pressure_.row(q).dot(solution_) + k(2) * of_shear_.row(q).dot(solution_);
    }
    w *= problem_.rubbery_compliance;
    const VectorXd means = means_w_ * solution_;
    for (Index m = 0; m < terms_; ++m) {
      const auto i = static_cast<std::size_t>(m);
      w += problem_.creep_compliance[i] * problem_.creep_length[i] * means(m);
    }
    return problem_.profile(leading) - w;
  }

  SpectralState state() const {
    const RollingScene& scene = problem_.scene;
    SpectralState state;
    state.pattern = pattern_;
    state.edges = edges_;
    state.pressure = {solution_.head(n_), solution_.segment(amplitude_, terms_)};
    state.load = load_row().dot(solution_);
    state.driving_force = force_row().dot(solution_);
    state.driving_torque = torque_row().dot(solution_) * scene.radius;
    state.approach = approach();
    state.edge_means = means_w_ * solution_;
    state.sources = sources_;
    state.pressure_forces = of_pressure_ * solution_;
    state.shear_forces = of_shear_ * solution_;
    const double scale = state.load / edges_.half_length();
    state.residuals.resize(pattern_.unknowns());
    state.residuals(0) = solution_(slack_) / scale;
    state.residuals(1) =
        scene.load ? (state.load - *scene.load) / *scene.load : (state.approach - *scene.approach) / *scene.approach;
    if (pattern_.stick) {
      state.stick = {solution_.segment(psi_, stick_n_), solution_.segment(stick_amplitude_, terms_)};
      if (pattern_.leading == 0) state.stick.amplitudes += friction_ * pattern_.trailing * state.pressure.amplitudes;
      state.rotation_ratio = 1 + solution_(rotation_) / problem_.rubbery;
      if (pattern_.trailing_slip()) state.residuals(2) = solution_(stick_slack_) / scale;
      if (pattern_.leading_slip()) {
        // Bounded slip at the leading border: no root of the distance in the shear, be it the base's or the rest's.
        double end = 0;
        if (!pattern_.one_direction()) {
          const double angle = std::acos((edges_.stick_to - edges_.centre()) / edges_.half_length());
          for (Index n = 0; n < n_; ++n) end += solution_(n) * std::sin(static_cast<double>(n + 1) * angle);
          end *= friction_ * (pattern_.trailing - pattern_.leading) / M_PI;
        }
        for (Index n = 0; n < stick_n_; ++n) end += static_cast<double>(n + 1) * solution_(psi_ + n);
        for (Index j = 0; j < terms_; ++j) {
          const VectorXd& series = stick_exponentials_->series.col(j);
          const double rate =
              edges_.stick_half_length() / problem_.relaxation_length[static_cast<std::size_t>(j)];
          double rest = rate * (series(0) + 0.5 * series(1));
          for (Index n = 1; n <= stick_n_; ++n) rest -= static_cast<double>(n) * series(n);
          end -= 2 * state.stick.amplitudes(j) * rest;
        }
        state.residuals(3) = end / scale;
      }
    } else {
      if (scene.drive == Drive::rotation) state.rotation_ratio = *scene.rotation_ratio;
    }
    return state;
  }

  const SpectralProblem& problem_;
  SlipPattern pattern_;
  SpectralEdges edges_;
  double friction_;
  Index n_, stick_n_, terms_;
  const ChebyshevRule& rule_;
  Exponentials exponentials_;
  std::optional<Exponentials> stick_exponentials_;
  std::optional<SlidingBase> base_;
  Index phi_, slack_, amplitude_, psi_, stick_slack_, rotation_, stick_amplitude_, size_;  // places of the unknowns
  VectorXd sources_;
  MatrixXd of_pressure_, of_shear_;  // [source, unknown]
  MatrixXd matrix_, means_w_, means_u_;
  VectorXd right_, solution_;
};

}  // namespace

SpectralState solve_inside(const SpectralProblem& problem, const SlipPattern& pattern, const SpectralEdges& edges,
                           const SpectralOrders& orders) {
  return System(problem, pattern, edges, orders).solve();
}

}  // namespace rollres
