#include "core/interior/interior_field.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

#include "core/interior/depth_response.hpp"
#include "core/interior/flow_loss.hpp"
#include "core/interior/interior_waves.hpp"
#include "core/interior/ring_depth_response.hpp"
#include "core/numerics/solution_limits.hpp"
#include "core/surface/ring_compliance.hpp"

namespace rollres {

using complex = std::complex<double>;
using Eigen::ArrayXd;
using Eigen::ArrayXXd;
using Eigen::Index;

namespace {

constexpr double vanished = DepthResponse::vanished;
constexpr double phase_per_panel = 32;

struct PlaneStrain {
  complex x, z, xz;
};

PlaneStrain strain_of(const PlaneStress& s, complex compliance, double nu) {
  return {.x = 0.5 * compliance * ((1 - nu) * s.x - nu * s.z),
          .z = 0.5 * compliance * ((1 - nu) * s.z - nu * s.x),
          .xz = compliance * s.xz};
}

/// E(sigma), real stresses.
double distortion(double x, double z, double xz, double nu) {
  return 0.5 * ((1 - nu) * (x * x + z * z) - 2 * nu * x * z) + xz * xz;
}

}  // namespace

InteriorField::InteriorField(LayeredMedium medium, double speed, double flow, const SurfaceFields& fields, double reach,
                             Detail detail)
    : medium_(std::move(medium)),
      speed_(flow < 0 ? -speed : speed),
      flow_(std::abs(flow)),
      highest_(highest_wavenumber(half_length_of(fields), detail)),
      half_space_(std::isinf(medium_.back().thickness)),
      closed_form_(detail == Detail::surface),
      tractions_(fields, highest_) {
  double longest = std::max(reach, finite_thickness(medium_));
  if (half_space_)
    for (const MediumLayer& layer : medium_)
      for (const CreepSpectrum::Term& term : layer.material.terms) longest = std::max(longest, speed * term.time);
  const double ends = std::max(std::abs(tractions_.from()), std::abs(tractions_.to()));
  if (comes_round(speed))
    add_harmonics();
  else
    add_waves((half_space_ ? 1e-6 : 1e-4) / longest, phase_per_panel / (reach + ends));
  short_compliance_ = medium_.front().material(highest_ * speed).real();
  if (fields.shear_y.empty()) return;
  InteriorWaves waves{ArrayXd(std::ssize(waves_)), ArrayXd(std::ssize(waves_))};
  for (Index i = 0; i < std::ssize(waves_); ++i) {
    waves.k(i) = waves_[static_cast<std::size_t>(i)].wavenumber;
    waves.weight(i) = waves_[static_cast<std::size_t>(i)].weight;
  }
  axial_.emplace(medium_, speed_, flow_, fields, std::move(waves));
}

double depth_of(const LayeredMedium& medium, const InteriorLine& line) {
  double depth = line.depth;
  for (std::size_t i = 0; i < line.layer; ++i) depth += medium[i].thickness;
  return depth;
}

/// The waves' sum in the making: their amplitudes on all lines, block by block, times e^{ikx} at all points.
class InteriorField::Sum {
 public:
  Sum(const InteriorField& field, const std::vector<double>& x, const std::vector<InteriorLine>& lines, Wanted wanted)
      : field_(field),
        wanted_(wanted),
        x_(Eigen::Map<const ArrayXd>(x.data(), static_cast<Index>(x.size()))),
        lines_(lines) {
    const bool density = wanted == Wanted::density;
    const auto points = static_cast<Index>(x.size()), count = static_cast<Index>(lines.size());
    f_.line_loss = ArrayXd::Zero(count);
    for (const MediumLayer& layer : field.medium_) creeps_.push_back(creeps(layer.material));
    for (const InteriorLine& line : lines) {
      depth_.push_back(field.depth_of(line));
      face_.push_back(FaceDepth::of(field.medium_.front().radius, depth_.back()));
      length_.push_back(1 - depth_.back() / field.medium_.front().radius);
      const std::size_t terms = field.medium_[line.layer].material.terms.size();
      memories_.push_back(ArrayXXd::Zero(3, static_cast<Index>(density && points > 1 ? terms : 0)));
    }
    if (density) f_.loss_density = Eigen::ArrayXXd::Zero(points, count);
    if (wanted == Wanted::strains) summed_ = of_strains;
    sums_ = Eigen::MatrixXd::Zero(points, summed_ * count);
    find_spacing();
  }

  VolumeFields run() {
    constexpr std::size_t in_block = 128;
    for (std::size_t first = 0; first < field_.waves_.size(); first += in_block)
      add(std::span(field_.waves_).subspan(first, std::min(in_block, field_.waves_.size() - first)));
    take_sums();
    add_half_space();
    if (f_.loss_density.size() > 0) measure_density();
    return std::move(f_);
  }

 private:
  /// The components of the plane, strains first in the order of what is summed: strains, stresses, u and w.
  static constexpr std::array in_plane{Component::x, Component::z, Component::xz};
  static constexpr Index of_strains = in_plane.size(), of_plane = 2 * of_strains + 2;

  /// Of lines so near to the surface that their waves have not vanished at the shortest.
  bool near_surface(std::size_t line) const { return depth_[line] * field_.highest_ < vanished; }
  double fade(std::size_t line, double wavenumber) const {
    return near_surface(line) ? faded(wavenumber, field_.highest_) : 1;
  }

  void find_spacing() {
    constexpr double rounding = 1e-14;
    if (x_.size() < 3) return;
    const Index last = x_.size() - 1;
    const double step = (x_(last) - x_(0)) / static_cast<double>(last);
    const ArrayXd even = x_(0) + step * ArrayXd::LinSpaced(x_.size(), 0, static_cast<double>(last));
    if ((x_ - even).abs().maxCoeff() <= rounding * x_.abs().maxCoeff()) spacing_ = step;
  }

  /// Columns of cos(k x) and -sin(k x) of a block's waves, one a point.
  Eigen::MatrixXd waves_at_points(std::span<const Wave> waves) const {
    const auto count = static_cast<Index>(waves.size());
    ArrayXd k(count);
    for (Index i = 0; i < count; ++i) k(i) = waves[static_cast<std::size_t>(i)].wavenumber;
    Eigen::MatrixXd at(2 * count, x_.size());
    const auto turned = [&](double x) {
      Eigen::ArrayXXd turn(count, 2);
      turn << (k * x).cos(), -(k * x).sin();
      return turn;
    };
    const Eigen::ArrayXXd step = spacing_ > 0 ? turned(spacing_) : Eigen::ArrayXXd();
    constexpr Index afresh = 64;  // against the sum of roundings
    for (Index i = 0; i < x_.size(); ++i) {
      auto cosine = at.col(i).head(count).array(), sine = at.col(i).tail(count).array();
      if (!(spacing_ > 0) || i % afresh == 0) {
        const Eigen::ArrayXXd turn = turned(x_(i));
        cosine = turn.col(0);
        sine = turn.col(1);
        continue;
      }
      const auto cosine_before = at.col(i - 1).head(count).array(), sine_before = at.col(i - 1).tail(count).array();
      cosine = cosine_before * step.col(0) - sine_before * step.col(1);
      sine = sine_before * step.col(0) + cosine_before * step.col(1);
    }
    return at;
  }

  void add(std::span<const Wave> waves) {
    require_time();
    const auto count = static_cast<Index>(waves.size());
    std::size_t reached = 0;  // lines, of which the longest wave of the block counts
    for (std::size_t line = 0; line < lines_.size(); ++line)
      if (waves.front().wavenumber * depth_[line] <= vanished) reached = line + 1;
    const Index columns = summed_ * static_cast<Index>(reached);
    amplitudes_.setZero(2 * count, columns);
    for (Index i = 0; i < count; ++i) add(waves[static_cast<std::size_t>(i)], i, count);
    if (x_.size() > 0 && columns > 0)
      sums_.leftCols(columns).noalias() += waves_at_points(waves).transpose() * amplitudes_;
  }

  void take_sums() {
    const auto count = static_cast<Index>(lines_.size());
    const auto taken = [&](Index field) {
      ArrayXXd values = ArrayXXd::Zero(x_.size(), count);
      if (field < summed_)
        for (Index line = 0; line < count; ++line) values.col(line) = sums_.col(summed_ * line + field);
      return values;
    };
    for (Index i = 0; i < of_strains; ++i) {
      f_.strain_of(in_plane[static_cast<std::size_t>(i)]) = taken(i);
      f_.stress_of(in_plane[static_cast<std::size_t>(i)]) = taken(of_strains + i);
    }
    f_.u = taken(of_plane - 2);
    f_.w = taken(of_plane - 1);
  }

  void add(const Wave& wave, Index row, Index count) {
    if (is_ring(field_.medium_))
      add(RingDepthResponse(field_.medium_, wave.moduli, wave.wavenumber, wave.tractions), wave, row, count);
    else
      add(DepthResponse(field_.medium_, wave.moduli, wave.wavenumber, field_.speed_, wave.tractions), wave, row, count);
  }

  /// @param row of the wave among the block's `count`
  void add(const auto& response, const Wave& wave, Index row, Index count) {
    const double k = wave.wavenumber;
    compliances_.clear();
    for (const complex modulus : wave.moduli) compliances_.push_back(1.0 / modulus);
    for (std::size_t line = 0; line < lines_.size(); ++line) {
      if (k * depth_[line] > vanished) continue;
      const std::size_t layer = lines_[line].layer;
      const double nu = field_.medium_[layer].poisson_ratio;
      const DepthState state = response.at(layer, lines_[line].depth);
      PlaneStress stress = state.stress;
      PlaneStrain strain = strain_of(stress, compliances_[layer], nu);
      const double lost =
          (std::conj(stress.x) * strain.x + std::conj(stress.z) * strain.z + std::conj(stress.xz) * strain.xz).imag();
      const auto column = static_cast<Index>(line);
      if (creeps_[layer])  // what does not loses nothing, no rounding either
        f_.line_loss(column) += wave.weight / M_PI * field_.flow_ * field_.speed_ * k * lost * length_[line];
      if (x_.size() == 0) continue;
      const double weight = wave.weight / M_PI * fade(line, k);
      if (memories_[line].cols() > 0)
        add_memories(memories_[line], field_.medium_[layer].material, k, field_.speed_,
                     weight * std::polar(1.0, k * first_passed(x_, field_.speed_)),
                     std::array{stress.x, stress.z, stress.xz});
      if (field_.closed_form_ && near_surface(line)) {
        const PlaneStress deep = half_space_wave(k, face_[line], wave.tractions.pressure, wave.tractions.shear);
        const PlaneStrain moved = strain_of(deep, field_.short_compliance_, nu);
        stress = {stress.x - deep.x, stress.z - deep.z, stress.xz - deep.xz};
        strain = {strain.x - moved.x, strain.z - moved.z, strain.xz - moved.xz};
      }
      const bool at_rest_far_away = !field_.half_space_;
      const complex amplitudes[] = {strain.x,
                                    strain.z,
                                    strain.xz,
                                    stress.x,
                                    stress.z,
                                    stress.xz,
                                    at_rest_far_away ? state.u : complex(0),
                                    at_rest_far_away ? state.w : complex(0)};
      for (Index field = 0; field < summed_; ++field) {
        amplitudes_(row, summed_ * column + field) = weight * amplitudes[field].real();
        amplitudes_(count + row, summed_ * column + field) = weight * amplitudes[field].imag();
      }
    }
  }

  void add_half_space() {
    if (!field_.closed_form_) return;
    const double nu = field_.medium_.front().poisson_ratio;
    for (std::size_t line = 0; line < lines_.size(); ++line) {
      if (!near_surface(line)) continue;
      require_time();
      const auto column = static_cast<Index>(line);
      for (Index i = 0; i < x_.size(); ++i) {
        const PlaneStress deep = field_.tractions_.stresses(x_(i), face_[line]);
        const PlaneStrain moved = strain_of(deep, field_.short_compliance_, nu);
        f_.stress_of(Component::x)(i, column) += deep.x.real();
        f_.stress_of(Component::z)(i, column) += deep.z.real();
        f_.stress_of(Component::xz)(i, column) += deep.xz.real();
        f_.strain_of(Component::x)(i, column) += moved.x.real();
        f_.strain_of(Component::z)(i, column) += moved.z.real();
        f_.strain_of(Component::xz)(i, column) += moved.xz.real();
      }
    }
  }

  void measure_density() {
    if (x_.size() < 2) return;
    for (std::size_t line = 0; line < lines_.size(); ++line) {
      const MediumLayer& layer = field_.medium_[lines_[line].layer];
      const auto column = static_cast<Index>(line);
      ArrayXXd stress(of_strains, x_.size());
      for (Index c = 0; c < of_strains; ++c)
        stress.row(c) = f_.stress_of(in_plane[static_cast<std::size_t>(c)]).col(column).transpose();
      f_.loss_density.col(column) =
          density_on_line(stress, memories_[line], layer.material, x_(1) - x_(0), field_.speed_, field_.flow_,
                          [&](const ArrayXd& s) { return distortion(s(0), s(1), s(2), layer.poisson_ratio); });
    }
  }

  const InteriorField& field_;
  Wanted wanted_;
  ArrayXd x_;
  const std::vector<InteriorLine>& lines_;
  std::vector<double> depth_;
  std::vector<FaceDepth> face_;     // the same
  std::vector<double> length_;      // of each line, over that of the face: less of rings
  std::vector<bool> creeps_;        // layers
  std::vector<ArrayXXd> memories_;  // of each line: (stress, term)
  Index summed_ = of_plane;         // fields
  Eigen::MatrixXd amplitudes_;      // of a block: (real, then imaginary part of each wave; fields of each line)
  Eigen::MatrixXd sums_;            // (point; fields of each line)
  std::vector<complex> compliances_;
  double spacing_ = 0;  // of evenly spaced points, 0 of others
  VolumeFields f_;
};

VolumeFields InteriorField::at(const std::vector<double>& x, const std::vector<InteriorLine>& lines,
                               Wanted wanted) const {
  VolumeFields f = Sum(*this, x, lines, wanted).run();
  if (axial_) axial_->add_to(f, x, lines);
  return f;
}

}  // namespace rollres
