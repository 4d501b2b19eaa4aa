#include "core/edge/contact_edge.hpp"

#include <algorithm>
#include <cmath>

#include "core/edge/edge_cells.hpp"
#include "core/model/contact_surface.hpp"

namespace rollres {

namespace {

/// The cells at the edge and what they do.
class EdgeAssembly {
 public:
  EdgeAssembly(const ContactModel& model, const SurfaceGrid& grid, const EdgeCurve& curve,
               const std::vector<char>& in_contact)
      : grid_(grid), cells_(grid, curve, in_contact) {
    // The half-space that waves of a few cells see.
    const SteadySurface surface = steady_surface(model);
    const SurfaceCompliance near = surface.half_spaces(surface.moduli(1 / grid.spacing_x));
    in_plane_ = near.longitudinal.real();
    more_across_ = near.transverse.real() - in_plane_;
  }

  /// @param add takes target, source, xx, xy, yx, yy
  template <class Add>
  void uneven_cells(const Add& add) const {
    const double per = 1 / (2 * M_PI * grid_.spacing_x);
    for (const EdgeCell& cell : cells_.all())
      for (const bool image : {false, true}) {
        if (!cells_.loaded(cell.column, cell.row) || (image && !cells_.mirrored(cell))) continue;
        const int from = image ? -cell.row : cell.row;
        const double parity = image ? -1 : 1;
        for (int row = std::max(0, from - reach); row <= std::min(grid_.rows - 1, from + reach); ++row) {
          Reach ahead;  // none beyond `reach`, so that all slips together are none
          for (int column = cell.column + reach; column >= cell.column - reach - 1; --column) {
            const Reach here = column < cell.column - reach ? Reach() : cells_.unevenness(cell, column, row, image);
            Reach slope = ahead;
            slope.add(-1, here);
            ahead = here;
            if (!cells_.loaded(column, row)) continue;
            const double even = in_plane_ * slope.over_r, cross = more_across_ * slope.xy;
            add(grid_.index(column, row), grid_.index(cell.column, cell.row), per * (even + more_across_ * slope.xx),
                per * parity * cross, per * cross, per * parity * (even + more_across_ * (slope.over_r - slope.xx)));
          }
        }
      }
  }

  template <class Add>
  void surface_ahead(const Add& add) const {
    for (const EdgeCell& cell : cells_.all()) {
      const CurveRow& row = cells_.row(cell.row);
      const double x = grid_.x(cell.column);
      if (!cells_.loaded(cell.column, cell.row) || x < row.centre || row.level(x + grid_.spacing_x) >= 0) continue;
      const Lifted here = lifted(row, x), next = lifted(row, x + grid_.spacing_x);
      const double xx = here.xx - next.xx, xy = here.xy - next.xy, yy = here.yy - next.yy;
      // As the traction over sqrt(F) of this cell and of the next one behind says.
      const EdgeCell* const behind =
          cells_.loaded(cell.column - 1, cell.row) ? cells_.at(cell.column - 1, cell.row) : nullptr;
      const double of_behind = behind ? behind->borne : 0;
      // In a row that the contact just touches there is none behind, and what little lies in this one tells nothing.
      constexpr double told = 0.05;  // of sqrt(F) a cell inside of the edge
      const double inside = std::abs(row.along(x + grid_.spacing_x)) * grid_.spacing_x;
      const double squares = std::max(cell.borne * cell.borne + of_behind * of_behind, told * told * inside);
      const Eigen::Index node = grid_.index(cell.column, cell.row);
      const auto from = [&](Eigen::Index source, double mean) {
        const double per = mean / (squares * grid_.spacing_x);
        add(node, source, per * xx, per * xy, per * xy, per * yy);
      };
      from(node, cell.borne);
      if (behind) from(node - 1, of_behind);
    }
  }

 private:
  /// (N26) for tractions sqrt(F) [m/Pa].
  struct Lifted {
    double xx = 0, xy = 0, yy = 0;
  };
  Lifted lifted(const CurveRow& row, double x) const {
    if (row.level(x) >= 0) return {};
    const double steep = row.steepness(x), n_x = row.along(x) / steep, n_y = row.across(x) / steep;
    const double amount = 2.0 / 3 * std::pow(-row.level(x), 1.5) / steep;
    return {amount * (in_plane_ + more_across_ * n_y * n_y), -amount * more_across_ * n_x * n_y,
            amount * (in_plane_ + more_across_ * n_x * n_x)};
  }

  const SurfaceGrid& grid_;
  EdgeCells cells_;
  double in_plane_ = 0, more_across_ = 0;
};

}  // namespace

EdgeSlip::EdgeSlip(const ContactModel& model, const SurfaceGrid& grid, const EdgeCurve& curve,
                   const std::vector<char>& in_contact) {
  constexpr double coarsest = 9;  // rows; steps on coarser grids do not always converge
  if (!curve.known() || curve.unit < coarsest * grid.spacing_y) return;
  curve_ = curve;
  const EdgeAssembly assembly(model, grid, curve, in_contact);
  const auto add = [this](Eigen::Index target, Eigen::Index source, double xx, double xy, double yx, double yy) {
    terms_.push_back({target, source, xx, xy, yx, yy});
  };
  assembly.uneven_cells(add);
  assembly.surface_ahead(add);
}

}  // namespace rollres
