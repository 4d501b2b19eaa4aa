#include "core/algebra/block_tridiagonal.hpp"

#include "core/numerics/solution_limits.hpp"

namespace rollres {

BlockTridiagonal::BlockTridiagonal(Eigen::Index blocks, Eigen::Index size, Eigen::Index last, Eigen::Index shared)
    : size_(size), shared_(shared), unknowns_((blocks - 1) * size + last) {
  require_memory(8.0 * static_cast<double>(blocks) * static_cast<double>(size) * static_cast<double>(size + 2 * shared),
                 "the blocks of the system");
  for (Eigen::Index k = 0; k < blocks; ++k) {
    require_time();
    const Eigen::Index rows = k + 1 < blocks ? size : last;
    diagonal_.emplace_back(Eigen::MatrixXd::Zero(rows, rows));
    if (k == 0) continue;
    lower_.emplace_back(Eigen::MatrixXd::Zero(shared, size));
    upper_.emplace_back(Eigen::MatrixXd::Zero(size, shared));
  }
  decomposition_.resize(static_cast<std::size_t>(blocks));
}

void BlockTridiagonal::set_zero() {
  for (auto* const matrices : {&diagonal_, &lower_, &upper_})
    for (Eigen::MatrixXd& matrix : *matrices) matrix.setZero();
}

double& BlockTridiagonal::entry(Eigen::Index row, Eigen::Index column) {
  const auto row_block = static_cast<std::size_t>(row / size_), column_block = static_cast<std::size_t>(column / size_);
  const Eigen::Index i = row % size_, j = column % size_;
  if (row_block == column_block) return diagonal_[row_block](i, j);
  return row_block > column_block ? lower_[column_block](i, j) : upper_[row_block](i, j);
}

void BlockTridiagonal::factorise() {
  for (std::size_t k = 0; k < diagonal_.size(); ++k) {
    require_time();
    if (k > 0) diagonal_[k].topLeftCorner(shared_, shared_).noalias() -= lower_[k - 1] * upper_[k - 1];
    decomposition_[k].factorise(diagonal_[k]);
    if (k + 1 < diagonal_.size()) upper_[k] = decomposition_[k].solve(upper_[k]);
  }
}

Eigen::VectorXd BlockTridiagonal::solve(const Eigen::VectorXd& right_side) const {
  Eigen::VectorXd x = right_side;
  const auto blocks = static_cast<Eigen::Index>(diagonal_.size());
  const auto part = [&](Eigen::Index k) { return x.segment(k * size_, diagonal_[static_cast<std::size_t>(k)].rows()); };
  for (Eigen::Index k = 0; k < blocks; ++k) {
    const auto at = static_cast<std::size_t>(k);
    if (k > 0) x.segment(k * size_, shared_).noalias() -= lower_[at - 1] * part(k - 1);
    part(k) = decomposition_[at].solve(Eigen::VectorXd(part(k)));
  }
  for (Eigen::Index k = blocks - 2; k >= 0; --k)
    part(k).noalias() -= upper_[static_cast<std::size_t>(k)] * x.segment((k + 1) * size_, shared_);
  return x;
}

}  // namespace rollres
