#include "core/interior/interior_field.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>

#include "core/interior/depth_response.hpp"
#include "core/numerics/quadrature.hpp"
#include "core/numerics/solution_limits.hpp"

namespace rollres {

using complex = std::complex<double>;
using Eigen::ArrayXd;
using Eigen::Index;

namespace {

/// Wavenumber times depth beyond which waves have vanished.
constexpr double vanished = 38;
constexpr int nodes_per_panel = 12;
constexpr double phase_per_panel = 8;

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

double half_length_of(const SurfaceFields& fields) {
  const auto a_length = [](double half) {
    if (!(half > 0 && std::isfinite(half))) throw std::domain_error("the fields hold no contact to look into");
    return half;
  };
  if (!fields.panels.empty()) {
    double from = INFINITY, to = -INFINITY;
    for (const TractionPanel& panel : fields.panels) {
      from = std::min(from, panel.from);
      to = std::max(to, panel.to);
    }
    return a_length(0.5 * (to - from));
  }
  const auto nodes =
      std::count_if(fields.zone.begin(), fields.zone.end(), [](Zone zone) { return zone != Zone::free; });
  return a_length(0.5 * static_cast<double>(nodes) * fields.grid.spacing_x);
}

bool creeps(const CreepSpectrum& material) {
  return std::any_of(material.terms.begin(), material.terms.end(),
                     [](const CreepSpectrum::Term& term) { return term.compliance > 0; });
}

}  // namespace

double InteriorField::highest_wavenumber(double half_length, Detail detail) const {
  const double along = detail == Detail::surface ? 300 : 80;
  return std::max(along / half_length, vanished / medium_.front().thickness);
}

InteriorField::InteriorField(LayeredMedium medium, double speed, double flow, const SurfaceFields& fields, double reach,
                             Detail detail)
    : medium_(std::move(medium)),
      speed_(flow < 0 ? -speed : speed),
      highest_(highest_wavenumber(half_length_of(fields), detail)),
      half_space_(std::isinf(medium_.back().thickness)),
      closed_form_(detail == Detail::surface),
      tractions_(fields, highest_) {
  double longest = std::max(reach, finite_thickness(medium_));
  if (half_space_)
    for (const MediumLayer& layer : medium_)
      for (const CreepSpectrum::Term& term : layer.material.terms) longest = std::max(longest, speed * term.time);
  const double ends = std::max(std::abs(tractions_.from()), std::abs(tractions_.to()));
  add_waves((half_space_ ? 1e-6 : 1e-4) / longest, phase_per_panel / (reach + ends));
  short_compliance_ = medium_.front().material(highest_ * speed).real();
}

void InteriorField::add_waves(double lowest, double widest) {
  const QuadratureRule& rule = gauss_rule(nodes_per_panel);
  require_memory(highest_ / widest * nodes_per_panel * sizeof(Wave), "waves in the layers");
  double from = 0, to = lowest;
  while (from < highest_) {
    to = std::min(to, highest_);
    for (std::size_t i = 0; i < rule.nodes.size(); ++i) {
      const double k = from + (to - from) * rule.nodes[i];
      waves_.push_back({k, (to - from) * rule.weights[i], tractions_.transforms(k), moduli_at(medium_, -k * speed_)});
    }
    from = to;
    to += std::min(to, widest);
  }
}

double InteriorField::depth_of(const InteriorLine& line) const {
  double depth = line.depth;
  for (std::size_t i = 0; i < line.layer; ++i) depth += medium_[i].thickness;
  return depth;
}

/// The waves' sum in the making.
class InteriorField::Sum {
 public:
  Sum(const InteriorField& field, const std::vector<double>& x, const std::vector<InteriorLine>& lines, Wanted wanted)
      : field_(field),
        wanted_(wanted),
        x_(Eigen::Map<const ArrayXd>(x.data(), static_cast<Index>(x.size()))),
        lines_(lines) {
    const bool density = wanted == Wanted::density;
    const auto points = static_cast<Index>(x.size()), count = static_cast<Index>(lines.size());
    for (Eigen::ArrayXXd* const values :
         {&f_.u, &f_.w, &f_.sigma_x, &f_.sigma_z, &f_.tau_xz, &f_.strain_x, &f_.strain_z, &f_.shear_strain})
      *values = Eigen::ArrayXXd::Zero(points, count);
    f_.line_loss = ArrayXd::Zero(count);
    for (const InteriorLine& line : lines) {
      depth_.push_back(field.depth_of(line));
      const std::size_t terms = field.medium_[line.layer].material.terms.size();
      memories_.emplace_back(density && points > 1 ? terms : 0, std::array<double, 3>{});
    }
    if (density) f_.loss_density = Eigen::ArrayXXd::Zero(points, count);
  }

  InteriorFields run() {
    for (const Wave& wave : field_.waves_) add(wave);
    add_half_space();
    if (f_.loss_density.size() > 0) measure_density();
    return std::move(f_);
  }

 private:
  /// Of lines so near to the surface that their waves have not vanished at the shortest.
  bool near_surface(std::size_t line) const { return depth_[line] * field_.highest_ < vanished; }
  /// 1, and for lines near the surface smoothly 0 at the shortest wave.
  double fade(std::size_t line, double wavenumber) const {
    if (!near_surface(line)) return 1;
    return 0.5 * std::erfc(7 * (2 * (wavenumber / field_.highest_ - 0.7) / 0.3 - 1));
  }

  void add(const Wave& wave) {
    require_time();
    const double k = wave.wavenumber;
    const DepthResponse response(field_.medium_, wave.moduli, k, field_.speed_, wave.tractions);
    const ArrayXd cosine = (k * x_).cos(), sine = (k * x_).sin();
    for (std::size_t line = 0; line < lines_.size(); ++line) {
      if (k * depth_[line] > vanished) continue;
      const std::size_t layer = lines_[line].layer;
      const double nu = field_.medium_[layer].poisson_ratio;
      const DepthState state = response.at(layer, lines_[line].depth);
      PlaneStress stress = state.stress;
      PlaneStrain strain = strain_of(stress, 1.0 / wave.moduli[layer], nu);
      const double lost =
          (std::conj(stress.x) * strain.x + std::conj(stress.z) * strain.z + std::conj(stress.xz) * strain.xz).imag();
      const auto column = static_cast<Index>(line);
      if (creeps(field_.medium_[layer].material))  // what does not loses nothing, no rounding either
        f_.line_loss(column) += wave.weight / M_PI * field_.speed_ * k * lost;
      if (x_.size() == 0) continue;
      const double weight = wave.weight / M_PI * fade(line, k);
      add_memories(line, wave, stress, weight);
      if (field_.closed_form_ && near_surface(line)) {
        const PlaneStress deep = half_space_wave(k, depth_[line], wave.tractions.pressure, wave.tractions.shear);
        const PlaneStrain moved = strain_of(deep, field_.short_compliance_, nu);
        stress = {stress.x - deep.x, stress.z - deep.z, stress.xz - deep.xz};
        strain = {strain.x - moved.x, strain.z - moved.z, strain.xz - moved.xz};
      }
      const auto put = [&](Eigen::ArrayXXd& values, complex amplitude) {
        values.col(column) += weight * (amplitude.real() * cosine - amplitude.imag() * sine);
      };
      put(f_.strain_x, strain.x);
      put(f_.strain_z, strain.z);
      put(f_.shear_strain, strain.xz);
      if (wanted_ == Wanted::strains) continue;
      put(f_.sigma_x, stress.x);
      put(f_.sigma_z, stress.z);
      put(f_.tau_xz, stress.xz);
      if (field_.half_space_) continue;
      put(f_.u, state.u);
      put(f_.w, state.w);
    }
  }

  /// The places of x in the order in which material passes them, from the last to the first.
  Index place(Index i) const { return field_.speed_ < 0 ? x_.size() - 1 - i : i; }

  /// Memory means of the stress at the point farthest ahead.
  void add_memories(std::size_t line, const Wave& wave, const PlaneStress& stress, double weight) {
    if (memories_[line].empty()) return;
    const complex turned = weight * std::polar(1.0, wave.wavenumber * x_(place(x_.size() - 1)));
    const auto& terms = field_.medium_[lines_[line].layer].material.terms;
    for (std::size_t m = 0; m < terms.size(); ++m) {
      const complex mean = turned / complex(1, -wave.wavenumber * field_.speed_ * terms[m].time);
      memories_[line][m][0] += (mean * stress.x).real();
      memories_[line][m][1] += (mean * stress.z).real();
      memories_[line][m][2] += (mean * stress.xz).real();
    }
  }

  void add_half_space() {
    if (!field_.closed_form_) return;
    const double nu = field_.medium_.front().poisson_ratio;
    for (std::size_t line = 0; line < lines_.size(); ++line) {
      if (!near_surface(line)) continue;
      const auto column = static_cast<Index>(line);
      for (Index i = 0; i < x_.size(); ++i) {
        const PlaneStress deep = field_.tractions_.stresses(x_(i), depth_[line]);
        const PlaneStrain moved = strain_of(deep, field_.short_compliance_, nu);
        f_.sigma_x(i, column) += deep.x.real();
        f_.sigma_z(i, column) += deep.z.real();
        f_.tau_xz(i, column) += deep.xz.real();
        f_.strain_x(i, column) += moved.x.real();
        f_.strain_z(i, column) += moved.z.real();
        f_.shear_strain(i, column) += moved.xz.real();
      }
    }
  }

  /// From ahead to behind, with stresses that are linear between points.
  void measure_density() {
    if (x_.size() < 2) return;
    const double step = x_(1) - x_(0), speed = std::abs(field_.speed_);
    for (std::size_t line = 0; line < lines_.size(); ++line) {
      const MediumLayer& layer = field_.medium_[lines_[line].layer];
      const auto column = static_cast<Index>(line);
      const auto stress = [&](Index i) {
        return Eigen::Array3d(f_.sigma_x(place(i), column), f_.sigma_z(place(i), column), f_.tau_xz(place(i), column));
      };
      for (std::size_t m = 0; m < layer.material.terms.size(); ++m) {
        const auto& [compliance, time] = layer.material.terms[m];
        if (!(compliance > 0 && time > 0)) continue;
        const double length = speed * time, kept = std::exp(-step / length);
        Eigen::Array3d mean(memories_[line][m].data());
        for (Index i = x_.size() - 1; i >= 0; --i) {
          const Eigen::Array3d here = stress(i);
          if (i + 1 < x_.size()) {
            const Eigen::Array3d slope = (stress(i + 1) - here) / step;
            mean = kept * (mean - stress(i + 1) - length * slope) + here + length * slope;
          }
          const Eigen::Array3d above = here - mean;
          f_.loss_density(place(i), column) +=
              compliance / time * distortion(above(0), above(1), above(2), layer.poisson_ratio);
        }
      }
    }
  }

  const InteriorField& field_;
  Wanted wanted_;
  ArrayXd x_;
  const std::vector<InteriorLine>& lines_;
  std::vector<double> depth_;
  std::vector<std::vector<std::array<double, 3>>> memories_;
  InteriorFields f_;
};

InteriorFields InteriorField::at(const std::vector<double>& x, const std::vector<InteriorLine>& lines,
                                 Wanted wanted) const {
  return Sum(*this, x, lines, wanted).run();
}

}  // namespace rollres
