#include "studies/drawing/contour_levels.hpp"

#include <cmath>
#include <sstream>

#include "tests/catch.hpp"

using namespace rollres;

namespace {

ContourLoop circle(double level, double radius) {
  ContourLoop loop;
  loop.level = level;
  for (int i = 0; i < 60; ++i) loop.points.push_back({radius * std::cos(0.1 * i), radius * std::sin(0.1 * i)});
  return loop;
}

/// The texts and places of labels.
std::vector<std::tuple<std::string, double, double>> labels(const std::string& script) {
  std::vector<std::tuple<std::string, double, double>> found;
  std::istringstream lines(script);
  for (std::string line; std::getline(lines, line);) {
    std::string set, label, text, at, first;
    double x = 0, y = 0;
    char comma = 0;
    std::istringstream words(line);
    words >> set >> label >> text >> at >> first >> x >> comma >> first >> y;
    if (label == "label") found.emplace_back(text, x, y);
  }
  return found;
}

}  // namespace

TEST_CASE("contours bear their values, apart from each other and from what must stay free", "[studies][chart]") {
  const Span span{-1, 1};
  std::ostringstream script;
  write_contour_levels(script, {circle(2, 0.8), circle(-4, 0.5), circle(9, 0.05)}, span, span, {{0.8, 0}});
  const auto found = labels(script.str());
  REQUIRE(found.size() == 2);  // the smallest loop has no room
  CHECK(std::get<0>(found[0]) == "'2'");
  CHECK(std::get<0>(found[1]) == "'-4'");
  for (const auto& [text, x, y] : found) CHECK((std::abs(x - 0.8) > 0.2 || std::abs(y) > 0.1));
  CHECK(std::hypot(std::get<1>(found[0]), std::get<2>(found[0])) == Approx(0.8));
  CHECK(std::hypot(std::get<1>(found[0]) - std::get<1>(found[1]), std::get<2>(found[0]) - std::get<2>(found[1])) > 0.1);
}
