#pragma once

#include <cstdint>
#include <cstring>
#include <string>
#include <string_view>
#include <vector>

/// The numbers of an array of a VTK file that is "binary", as a reader finds it by its name: base64 of a count of bytes
/// (UInt64) and the bytes.
template <class Number>
std::vector<Number> vtk_numbers(const std::string& file, const std::string& name) {
  const std::size_t at = file.find("Name=\"" + name + "\" NumberOfComponents"), begin = file.find('>', at) + 2;
  constexpr std::string_view letters = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string bytes;
  unsigned bits = 0, held = 0;
  for (std::size_t i = begin; i < file.size() && letters.find(file[i]) != std::string_view::npos; ++i) {
    bits = bits << 6U | static_cast<unsigned>(letters.find(file[i]));
    if ((held += 6) < 8) continue;
    held -= 8;
    bytes += static_cast<char>(bits >> held & 0xffU);
  }
  std::uint64_t size = 0;
  if (bytes.size() < sizeof size) return {};
  std::memcpy(&size, bytes.data(), sizeof size);
  if (bytes.size() != sizeof size + size || size % sizeof(Number) != 0) return {};
  std::vector<Number> numbers(size / sizeof(Number));
  if (size > 0) std::memcpy(numbers.data(), bytes.data() + sizeof size, size);
  return numbers;
}
