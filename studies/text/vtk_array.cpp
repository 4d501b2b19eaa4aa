#include "studies/text/vtk_array.hpp"

#include <bit>
#include <cstring>

namespace rollres {

namespace {

static_assert(std::endian::native == std::endian::little);

/// As RFC 4648, section 4.
std::string base64(const std::string& bytes) {
  constexpr const char* letters = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  text.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    std::uint32_t three = 0;
    for (std::size_t j = i; j < i + 3; ++j)
      three = three << 8U | (j < bytes.size() ? static_cast<unsigned char>(bytes[j]) : 0U);
    for (std::size_t letter = 0; letter < 4; ++letter)
      text += i + letter <= bytes.size() ? letters[three >> (18 - 6 * letter) & 63U] : '=';
  }
  return text;
}

template <class Number>
std::string array(const std::string& type, const std::string& name, std::span<const Number> values, int components) {
  const std::uint64_t size = values.size_bytes();
  std::string bytes(sizeof size + size, '\0');
  std::memcpy(bytes.data(), &size, sizeof size);
  if (size > 0) std::memcpy(bytes.data() + sizeof size, values.data(), size);
  return "<DataArray type=\"" + type + "\" Name=\"" + name + "\" NumberOfComponents=\"" + std::to_string(components) +
         "\" format=\"binary\">\n" + base64(bytes) + "\n</DataArray>\n";
}

}  // namespace

std::string vtk_head(const std::string& type) {
  return "<?xml version=\"1.0\"?>\n<VTKFile type=\"" + type +
         "\" version=\"1.0\" byte_order=\"LittleEndian\" header_type=\"UInt64\">\n";
}

std::string vtk_array(const std::string& name, std::span<const double> values, int components) {
  return array("Float64", name, values, components);
}

std::string vtk_array(const std::string& name, std::span<const std::int8_t> values) {
  return array("Int8", name, values, 1);
}

}  // namespace rollres
