#include "core/algebra/dense_products.hpp"

ROLLRES_DENSE_PRODUCTS()
