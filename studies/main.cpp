#include <algorithm>
#include <iostream>

#include "studies/commands.hpp"
#include "studies/evaluate.hpp"

int main(int count, char** words) {
  return rollres::run_program({words + std::min(count, 1), words + count},
                              {.out = std::cout,
                               .err = std::cerr,
                               .evaluate = rollres::solve_in_turn,
                               .cold = [](const rollres::RollingScene& scene) { return rollres::solve(scene); }});
}
