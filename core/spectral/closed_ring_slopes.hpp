#pragma once

/// Slopes of a surface with a ring that has not recovered when it comes round again: those of a single passage and
/// those by the ring's earlier turns (earlier_turns.hpp).

#include <memory>

#include "core/spectral/slope_correction.hpp"
#include "core/surface/earlier_turns.hpp"
#include "core/surface/steady_surface.hpp"

namespace rollres {

class ClosedRingSlopes final : public SlopeCorrection {
 public:
  /// @param passage of the whole surface, once   @param ring alone, on a rigid base   @param radius its outer one [m]
  /// @param deep the spectrum by which elastic slopes turn into slopes   @param speed by which its times are lengths
  /// @param foundation whether the ring is what the body rolls on, not its coating: cross terms of these are opposite
  /// @param sheared whether the hoop's part is wanted
  ClosedRingSlopes(std::shared_ptr<const SlopeCorrection> passage, const SteadySurface& ring, double radius,
                   const CreepSpectrum& deep, double speed, bool foundation, bool sheared);

  LayerSlopes slope(double x) const override { return passage_->slope(x) + turns_(slopes_, x); }
  LayerSlopes memory(std::size_t term, double x) const override {
    return passage_->memory(term, x) + turns_(first_memory_ + term, x);
  }
  LayerSlopes displacement(double x) const override { return passage_->displacement(x) + turns_(displacements_, x); }
  RingLogarithms logarithms(double finest) const override { return passage_->logarithms(finest); }
  RingLogarithms memory_logarithms(std::size_t term, double finest) const override {
    return passage_->memory_logarithms(term, finest);
  }
  double depth() const override { return passage_->depth(); }
  double reach() const override { return passage_->reach(); }

 private:
  static constexpr std::size_t slopes_ = 0, displacements_ = 1, first_memory_ = 2;

  std::shared_ptr<const SlopeCorrection> passage_;
  EarlierTurns turns_;
};

}  // namespace rollres
