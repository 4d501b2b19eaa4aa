#pragma once

/// Memory of a material that flows through a row of cells.
///
/// With T = V theta the memory length and s the way downstream, the mean over the past
///   r(s) = int_0^inf e^(-t/T)/T S(s - t) dt,   T r' + r = S,                                              (H5)
/// is exact for the quadratic through the values of S at the three Gauss points of each cell; S may jump between
/// cells.

#include <Eigen/Core>

namespace rollres {

/// Places of the three Gauss points along a cell, from 0 to 1, and their weights.
inline constexpr double gauss_places[3] = {0.11270166537925831148, 0.5, 0.88729833462074168852};
inline constexpr double gauss_weights[3] = {5.0 / 18, 8.0 / 18, 5.0 / 18};

/// r at the cell's points and where the material leaves it, from r where it comes in and S at the points:
///   r_i = decay_i r_in + sum_k weight_ik S_k,   r_out = through r_in + sum_k out_k S_k.
struct CellMemory {
  Eigen::Vector3d decay = Eigen::Vector3d::Zero(), out = Eigen::Vector3d::Zero();
  Eigen::Matrix3d weight = Eigen::Matrix3d::Zero();
  double through = 0;
};

/// @param length of the cell over the memory length [1]
CellMemory cell_memory(double length);

}  // namespace rollres
