#include <algorithm>
#include <iostream>

#include "studies/program/commands.hpp"

int main(int count, char** words) {
  return rollres::run_program({words + std::min(count, 1), words + count}, {std::cout, std::cerr, rollres::solve});
}
