#include "studies/text/vtk_array.hpp"

#include "tests/catch.hpp"
#include "tests/studies/vtk_numbers.hpp"

using namespace rollres;
using Catch::Matchers::Contains;

TEST_CASE("arrays of VTK files hold the count of their bytes and each byte", "[studies][fields]") {
  CHECK(vtk_array("none", std::span<const double>()) ==
        "<DataArray type=\"Float64\" Name=\"none\" NumberOfComponents=\"1\" format=\"binary\">\nAAAAAAAAAAA=\n"
        "</DataArray>\n");
  // 1.0 is 3FF0000000000000, after the count 8; 16 bytes end with one "=" for two that are missing.
  CHECK_THAT(vtk_array("one", std::array{1.0}), Contains("\nCAAAAAAAAAAAAAAAAADwPw==\n"));
  std::vector<double> numbers;
  std::vector<std::int8_t> zones;
  for (int i = 0; i < 7; ++i) {
    numbers.push_back(1e300 / (i - 2.5));
    zones.push_back(static_cast<std::int8_t>(i - 3));
    CHECK(vtk_numbers<double>(vtk_array("a b [Pa]", numbers, 1), "a b [Pa]") == numbers);
    CHECK(vtk_numbers<std::int8_t>(vtk_array("zone", zones), "zone") == zones);
  }
}
