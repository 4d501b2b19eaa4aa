#pragma once

/// The kernels of Eigen's products of real matrices and vectors, compiled once (dense_products.cpp) instead of in every
/// chapter that multiplies. Part of the precompiled headers: no source includes it.

#include <Eigen/Core>

/// Declares the kernels with `extern` before each of them, and compiles them with nothing.
#define ROLLRES_DENSE_PRODUCTS(EXTERN)                                                                  \
  namespace Eigen::internal {                                                                           \
  EXTERN template struct gebp_kernel<double, double, Index, blas_data_mapper<double, Index, ColMajor>,  \
                                     gebp_traits<double, double>::mr, gebp_traits<double, double>::nr>; \
  ROLLRES_PRODUCTS_OF(EXTERN, ColMajor, ColMajor)                                                       \
  ROLLRES_PRODUCTS_OF(EXTERN, ColMajor, RowMajor)                                                       \
  ROLLRES_PRODUCTS_OF(EXTERN, RowMajor, ColMajor)                                                       \
  ROLLRES_PRODUCTS_OF(EXTERN, RowMajor, RowMajor)                                                       \
  ROLLRES_PACKS_OF(EXTERN, ColMajor)                                                                    \
  ROLLRES_PACKS_OF(EXTERN, RowMajor)                                                                    \
  }

#define ROLLRES_PRODUCTS_OF(EXTERN, LEFT, RIGHT)                                                                       \
  EXTERN template struct general_matrix_matrix_product<Index, double, LEFT, false, double, RIGHT, false, ColMajor, 1>; \
  EXTERN template struct general_matrix_vector_product<Index, double, const_blas_data_mapper<double, Index, LEFT>,     \
                                                       LEFT, false, double,                                            \
                                                       const_blas_data_mapper<double, Index, RIGHT>, false>;

#define ROLLRES_PACKS_OF(EXTERN, ORDER)                                                                           \
  EXTERN template struct gemm_pack_lhs<double, Index, const_blas_data_mapper<double, Index, ORDER>,               \
                                       gebp_traits<double, double>::mr, gebp_traits<double, double>::LhsProgress, \
                                       gebp_traits<double, double>::LhsPacket4Packing, ORDER>;                    \
  EXTERN template struct gemm_pack_rhs<double, Index, const_blas_data_mapper<double, Index, ORDER>,               \
                                       gebp_traits<double, double>::nr, ORDER>;

ROLLRES_DENSE_PRODUCTS(extern)
