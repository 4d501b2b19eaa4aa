#include "core/interior/volume_field.hpp"

#include <algorithm>
#include <stdexcept>

#include "core/interior/depth_response.hpp"
#include "core/interior/flow_loss.hpp"
#include "core/interior/interior_lines.hpp"
#include "core/interior/interior_waves.hpp"
#include "core/interior/transverse_response.hpp"
#include "core/numerics/solution_limits.hpp"
#include "core/numerics/threads.hpp"

namespace rollres {

using complex = std::complex<double>;
using Eigen::ArrayXd;
using Eigen::ArrayXXd;
using Eigen::Index;
using Eigen::MatrixXcd;
using Eigen::MatrixXd;

VolumeField::VolumeField(LayeredMedium medium, double speed, double flow, const SurfaceFields& fields, Detail detail)
    : medium_(std::move(medium)),
      speed_(flow < 0 ? -speed : speed),
      flow_(std::abs(flow)),
      detail_(detail),
      grid_(fields.grid),
      mirrored_(is_mirror_image(fields)) {
  const auto on_grid = [&](const std::vector<double>& values) {
    return MatrixXd(Eigen::Map<const MatrixXd>(values.data(), grid_.columns, grid_.rows));
  };
  pressure_ = on_grid(fields.pressure);
  shear_x_ = on_grid(fields.shear_x);
  shear_y_ = on_grid(fields.shear_y);
  for (int j = 0; j < grid_.rows; ++j)
    for (int i = 0; i < grid_.columns; ++i)
      if (fields.zone[static_cast<std::size_t>(grid_.index(i, j))] != Zone::free) {
        farthest_x_ = std::max(farthest_x_, std::abs(grid_.x(i)) + grid_.spacing_x);
        farthest_y_ = std::max(farthest_y_, std::abs(grid_.y(j)) + grid_.spacing_y);
      }
  if (!(farthest_x_ > 0 && std::isfinite(farthest_x_) && std::isfinite(farthest_y_)))
    throw std::domain_error("the fields hold no contact to look into");
}

/// The waves' sum in the making: those of one kx summed over ky at all places, block by block of kx, times e^{i kx x}
/// at all points.
class VolumeField::Sum {
 public:
  Sum(const VolumeField& field, const std::vector<double>& x, const std::vector<double>& y,
      const std::vector<InteriorLine>& lines, Wanted wanted)
      : field_(field),
        wanted_(wanted),
        x_(Eigen::Map<const ArrayXd>(x.data(), static_cast<Index>(x.size()))),
        y_(Eigen::Map<const ArrayXd>(y.data(), static_cast<Index>(y.size()))),
        lines_(lines),
        half_space_(std::isinf(field.medium_.back().thickness)),
        vanished_(field.detail_ == Detail::inside ? 14 : 25) {
    double shallowest = INFINITY;
    for (const InteriorLine& line : lines) {
      depth_.push_back(field.depth_of(line));
      shallowest = std::min(shallowest, depth_.back());
    }
    for (const MediumLayer& layer : field.medium_) creeps_.push_back(creeps(layer.material));
    const auto farthest = [](const ArrayXd& places) { return places.size() > 0 ? places.abs().maxCoeff() : 0; };
    choose_waves(farthest(x_), farthest(y_), shallowest);
    const auto places = static_cast<Index>(lines.size()) * y_.size();
    summed_ = wanted == Wanted::strains ? components : 2 * components + 3;
    require_memory(sizeof(double) * static_cast<double>(summed_) * static_cast<double>(places) *
                       static_cast<double>(x_.size() + 2 * in_block),
                   "fields in the layers");
    sums_ = MatrixXd::Zero(x_.size(), summed_ * places);
    f_.line_loss = ArrayXd::Zero(places);
    f_.plane_loss = ArrayXd::Zero(static_cast<Index>(lines.size()));
    if (wanted == Wanted::density)
      for (const InteriorLine& line : lines)
        ahead_.emplace_back(static_cast<std::size_t>(y_.size()), ArrayXXd::Zero(components, terms_of(line.layer)));
  }

  VolumeFields run() {
    const int threads = threads_for(static_cast<double>(kx_.k.size() * ky_.k.size() * f_.plane_loss.size()));
    for (Index first = 0; first < kx_.k.size(); first += in_block) {
      const Index count = std::min<Index>(in_block, kx_.k.size() - first);
      amplitudes_.setZero(2 * count, sums_.cols());
      lost_on_lines_.setZero(f_.line_loss.size(), count);
      lost_on_planes_.setZero(f_.plane_loss.size(), count);
      means_.assign(wanted_ == Wanted::density ? static_cast<std::size_t>(count) : 0, {});
      share_out(static_cast<int>(count), threads, [&](int i, int) { add(first + i, i, count); });
      const ArrayXXd phase = (kx_.k.segment(first, count).matrix() * x_.matrix().transpose()).array();
      MatrixXd turned(2 * count, x_.size());
      turned << phase.cos().matrix(), -phase.sin().matrix();
      if (x_.size() > 0) sums_.noalias() += turned.transpose() * amplitudes_;
      f_.line_loss += lost_on_lines_.rowwise().sum();
      f_.plane_loss += lost_on_planes_.rowwise().sum();
      for (const auto& of_wave : means_)
        for (std::size_t line = 0; line < of_wave.size(); ++line)
          for (std::size_t y = 0; y < of_wave[line].size(); ++y) ahead_[line][y] += of_wave[line][y];
    }
    take_sums();
    if (wanted_ == Wanted::density) measure_density();
    return std::move(f_);
  }

 private:
  static constexpr Index in_block = 32;

  /// Tractions whose mirror image in y is themselves, or their negative.
  struct Part {
    MatrixXcd pressure, shear_x, shear_y;  // (kx, ky)
    bool negative;
  };

  Index terms_of(std::size_t layer) const { return static_cast<Index>(field_.medium_[layer].material.terms.size()); }

  /// Which waves are summed, and their tractions.
  void choose_waves(double reach_x, double reach_y, double shallowest) {
    const SurfaceGrid& grid = field_.grid_;
    double memory = 0, layers = finite_thickness(field_.medium_);
    for (const MediumLayer& layer : field_.medium_)
      for (const CreepSpectrum::Term& term : layer.material.terms)
        memory = std::max(memory, field_.speed() * term.time);
    const double longest = std::max({reach_x, reach_y, layers, field_.farthest_x_});
    constexpr double phase_per_panel = 24;
    constexpr double along_contact = 60;  // of waves that count inside, over the contact's farthest place
    const double highest =
        field_.detail_ == Detail::inside ? along_contact / std::max(field_.farthest_x_, field_.farthest_y_) : INFINITY;
    const auto along = [&](double spacing, double reach, double end, double first) {
      return interior_waves(first, phase_per_panel / (reach + end),
                            std::min({M_PI / spacing, vanished_ / shallowest, highest}));
    };
    // Stresses of a half-space are not smooth at its longest waves, those of layers on a base are; memories are poles.
    const double first_y = half_space_ ? 1e-3 / longest : 1 / layers;
    const double first_x =
        std::min(first_y, half_space_ ? 1e-3 / std::max(longest, memory) : 1 / std::max(layers, memory));
    kx_ = along(grid.spacing_x, reach_x, field_.farthest_x_, first_x);
    ky_ = along(grid.spacing_y, reach_y, field_.farthest_y_, first_y);
    const auto phases = [](const ArrayXd& k, int count, auto place) {
      ArrayXXd phase(k.size(), count);
      for (int i = 0; i < count; ++i) phase.col(i) = k * place(i);
      return phase;
    };
    const ArrayXXd px = phases(kx_.k, grid.columns, [&](int i) { return grid.x(i); });
    const ArrayXXd py = phases(ky_.k, grid.rows, [&](int j) { return grid.y(j); });
    const MatrixXd cosine_x = px.cos().matrix(), sine_x = px.sin().matrix();
    const auto transform = [&](const MatrixXd& values, const MatrixXd& along_y) {
      const MatrixXd summed = grid.cell_area() * (values * along_y.transpose());
      MatrixXcd transformed(kx_.k.size(), ky_.k.size());
      transformed.real() = cosine_x * summed;
      transformed.imag() = -sine_x * summed;
      return transformed;
    };
    const MatrixXd cosine_y = py.cos().matrix(), sine_y = py.sin().matrix();
    const complex turn(0, -1);
    parts_.push_back({transform(field_.pressure_, cosine_y), transform(field_.shear_x_, cosine_y),
                      turn * transform(field_.shear_y_, sine_y), false});
    if (!field_.mirrored_)
      parts_.push_back({turn * transform(field_.pressure_, sine_y), turn * transform(field_.shear_x_, sine_y),
                        transform(field_.shear_y_, cosine_y), true});
    const ArrayXXd at_places = phases(ky_.k, static_cast<int>(y_.size()), [&](int j) { return y_(j); });
    cosine_ = at_places.transpose().cos().matrix();
    sine_ = at_places.transpose().sin().matrix();
  }

  static constexpr std::size_t with_displacements = components + 3;
  /// Stresses and displacements along x, y and z of a wave whose direction has this cosine and sine.
  static std::array<complex, with_displacements> turned_back(const DepthState& p, const TransverseResponse::State& t,
                                                             double nu, double cosine, double sine) {
    const complex out = nu * (p.stress.x + p.stress.z);
    const double c2 = cosine * cosine, s2 = sine * sine, cs = cosine * sine;
    return {c2 * p.stress.x + s2 * out - 2 * cs * t.along,
            s2 * p.stress.x + c2 * out + 2 * cs * t.along,
            p.stress.z,
            sine * p.stress.xz + cosine * t.across_z,
            cosine * p.stress.xz - sine * t.across_z,
            cs * (p.stress.x - out) + (c2 - s2) * t.along,
            cosine * p.u - sine * t.u,
            sine * p.u + cosine * t.u,
            p.w};
  }

  /// All waves of one kx, summed over ky at places.
  void add(Index wave, Index row, Index count) {
    require_time();
    const std::vector<complex> moduli = moduli_at(field_.medium_, -kx_.k(wave) * field_.speed_);
    const Index kept = wanted_ == Wanted::strains ? Index(components) : Index(with_displacements);
    Eigen::ArrayXXcd summed = Eigen::ArrayXXcd::Zero(f_.line_loss.size(), kept);
    for (const Part& part : parts_) add_part(part, wave, row, moduli, summed);
    put(wave, row, count, moduli, summed);
  }

  /// @param summed of each place and component
  void add_part(const Part& part, Index wave, Index row, const std::vector<complex>& moduli, Eigen::ArrayXXcd& summed) {
    const double kx = kx_.k(wave);
    const Index ys = y_.size(), waves = ky_.k.size(), kept = summed.cols();
    // (ky; real, then imaginary part of each component) of each line, and how many ky have not vanished there.
    std::vector<MatrixXd> amplitudes(ys > 0 ? lines_.size() : 0, MatrixXd(waves, 2 * kept));
    std::vector<Index> reached(lines_.size(), 0);
    for (Index i = 0; i < waves; ++i) {
      const double ky = ky_.k(i), k = std::hypot(kx, ky), cosine = kx / k, sine = ky / k;
      const complex qx = part.shear_x(wave, i), qy = part.shear_y(wave, i);
      const double speed = field_.speed_ * cosine;
      const DepthResponse in_plane(field_.medium_, moduli, k, speed,
                                   {.pressure = part.pressure(wave, i), .shear = cosine * qx + sine * qy});
      const TransverseResponse across(field_.medium_, moduli, k, speed, cosine * qy - sine * qx);
      for (std::size_t line = 0; line < lines_.size(); ++line) {
        if (k * depth_[line] > vanished_) continue;
        reached[line] = i + 1;
        const std::size_t layer = lines_[line].layer;
        const double nu = field_.medium_[layer].poisson_ratio;
        const DepthState p = in_plane.at(layer, lines_[line].depth);
        const TransverseResponse::State t = across.at(layer, lines_[line].depth);
        const std::array<complex, with_displacements> f = turned_back(p, t, nu, cosine, sine);
        const double weight = ky_.weight(i) / M_PI;
        if (creeps_[layer]) lost_on_planes_(static_cast<Index>(line), row) += weight * distortion_of(f, nu);
        if (ys == 0) continue;
        MatrixXd& of_line = amplitudes[line];
        for (Index c = 0; c < kept; ++c) {
          of_line(i, 2 * c) = weight * f[static_cast<std::size_t>(c)].real();
          of_line(i, 2 * c + 1) = weight * f[static_cast<std::size_t>(c)].imag();
        }
      }
    }
    for (std::size_t line = 0; line < amplitudes.size(); ++line) {
      const auto of_line = amplitudes[line].topRows(reached[line]);
      const MatrixXd even = cosine_.leftCols(reached[line]) * of_line, odd = sine_.leftCols(reached[line]) * of_line;
      for (Index c = 0; c < kept; ++c) {
        auto places = summed.col(c).segment(static_cast<Index>(line) * ys, ys);
        if (is_odd(c) != part.negative) {
          places.real() -= odd.col(2 * c + 1).array();
          places.imag() += odd.col(2 * c).array();
        } else {
          places.real() += even.col(2 * c).array();
          places.imag() += even.col(2 * c + 1).array();
        }
      }
    }
  }

  /// tau_yz, tau_xy, v, of tractions that are their own mirror image
  static bool is_odd(Index c) { return c == 3 || c == 5 || c == 7; }

  /// What is summed over ky becomes rows of the block: strains, stresses, displacements.
  void put(Index wave, Index row, Index count, const std::vector<complex>& moduli, const Eigen::ArrayXXcd& summed) {
    const double kx = kx_.k(wave), weight = kx_.weight(wave) / M_PI;
    const Index ys = y_.size();
    if (wanted_ == Wanted::density) means_[static_cast<std::size_t>(row)].resize(lines_.size());
    for (std::size_t line = 0; line < lines_.size(); ++line) {
      const std::size_t layer = lines_[line].layer;
      const double nu = field_.medium_[layer].poisson_ratio;
      const complex compliance = 1.0 / moduli[layer];
      const double lost = creeps_[layer] ? weight * field_.flow_ * field_.speed_ * kx * compliance.imag() : 0;
      lost_on_planes_(static_cast<Index>(line), row) *= lost;
      for (Index y = 0; y < ys; ++y) {
        const Index place = static_cast<Index>(line) * ys + y;
        const Eigen::Array<complex, components, 1> stress = summed.row(place).head<components>().transpose();
        if (lost != 0) lost_on_lines_(place, row) = lost * distortion_of(stress, nu);
        if (wanted_ == Wanted::density) add_means(wave, row, line, stress);
        if (x_.size() == 0) continue;
        const complex mean = nu / (1 + nu) * (stress(0) + stress(1) + stress(2));
        const auto take = [&](Index c, complex value) {
          amplitudes_(row, c * f_.line_loss.size() + place) = weight * value.real();
          amplitudes_(count + row, c * f_.line_loss.size() + place) = weight * value.imag();
        };
        for (Index c = 0; c < Index(components); ++c)
          take(c, c < 3 ? 0.5 * compliance * (stress(c) - mean) : compliance * stress(c));
        for (Index c = components; c < summed_; ++c) {
          const bool far_from_rest = half_space_ && c >= Index(2 * components);
          take(c, far_from_rest ? complex(0) : summed(place, c - Index(components)));
        }
      }
    }
  }

  /// Memory means of the stress at the point farthest ahead.
  template <class Stress>
  void add_means(Index wave, Index row, std::size_t line, const Stress& stress) {
    const double kx = kx_.k(wave);
    const CreepSpectrum& material = field_.medium_[lines_[line].layer].material;
    ArrayXXd mean = ArrayXXd::Zero(components, terms_of(lines_[line].layer));
    add_memories(mean, material, kx, field_.speed_,
                 kx_.weight(wave) / M_PI * std::polar(1.0, kx * first_passed(x_, field_.speed_)),
                 std::span(stress.data(), components));
    means_[static_cast<std::size_t>(row)][line].push_back(mean);
  }

  void take_sums() {
    const Index places = f_.line_loss.size();
    const auto taken = [&](Index c) {
      return c < summed_ ? ArrayXXd(sums_.middleCols(c * places, places).array()) : ArrayXXd();
    };
    for (Index c = 0; c < Index(components); ++c) {
      f_.strain[static_cast<std::size_t>(c)] = taken(c);
      f_.stress[static_cast<std::size_t>(c)] = taken(c + Index(components));
    }
    constexpr Index first = 2 * components;
    f_.u = taken(first);
    f_.v = taken(first + 1);
    f_.w = taken(first + 2);
  }

  void measure_density() {
    const Index ys = y_.size();
    f_.loss_density = ArrayXXd::Zero(x_.size(), f_.line_loss.size());
    if (x_.size() < 2) return;
    for (Index place = 0; place < f_.line_loss.size(); ++place) {
      const auto line = static_cast<std::size_t>(place / ys), y = static_cast<std::size_t>(place % ys);
      const MediumLayer& layer = field_.medium_[lines_[line].layer];
      ArrayXXd along(components, x_.size());
      for (std::size_t c = 0; c < components; ++c)
        along.row(static_cast<Index>(c)) = f_.stress[c].col(place).transpose();
      f_.loss_density.col(place) =
          density_on_line(along, ahead_[line][y], layer.material, x_(1) - x_(0), field_.speed_, field_.flow_,
                          [&](const ArrayXd& stress) { return distortion_of(stress, layer.poisson_ratio); });
    }
  }

  const VolumeField& field_;
  Wanted wanted_;
  ArrayXd x_, y_;
  const std::vector<InteriorLine>& lines_;
  bool half_space_;
  double vanished_;  // k z of a wave
  std::vector<double> depth_;
  std::vector<bool> creeps_;  // layers
  InteriorWaves kx_, ky_;
  std::vector<Part> parts_;
  MatrixXd cosine_, sine_;                   // of ky y, (y, ky)
  Index summed_;                             // fields
  MatrixXd amplitudes_;                      // of a block: (real, then imaginary parts; places of each field)
  ArrayXXd lost_on_lines_, lost_on_planes_;  // of a block: (place or line, wave)
  std::vector<std::vector<std::vector<ArrayXXd>>> means_;  // of a block, of each line and y
  std::vector<std::vector<ArrayXXd>> ahead_;               // of each line and y: (component, term)
  MatrixXd sums_;                                          // (point; places of each field)
  VolumeFields f_;
};

VolumeFields VolumeField::at(const std::vector<double>& x, const std::vector<double>& y,
                             const std::vector<InteriorLine>& lines, Wanted wanted) const {
  return Sum(*this, x, y, lines, wanted).run();
}

}  // namespace rollres
