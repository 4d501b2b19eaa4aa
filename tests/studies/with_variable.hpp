#pragma once

#include <cstdlib>
#include <optional>
#include <string>

/// A variable of the environment for a while.
struct WithVariable {
  std::string name;
  std::optional<std::string> before;

  WithVariable(const std::string& variable, const std::string& value) : name(variable) {
    if (const char* const old = std::getenv(name.c_str())) before = old;
    ::setenv(name.c_str(), value.c_str(), 1);
  }
  WithVariable(const WithVariable&) = delete;
  WithVariable& operator=(const WithVariable&) = delete;
  ~WithVariable() {
    if (before)
      ::setenv(name.c_str(), before->c_str(), 1);
    else
      ::unsetenv(name.c_str());
  }
};
