#pragma once

/// Numbers in the XML files of VTK, which ParaView reads: base64 of the count of bytes and the bytes, both
/// little-endian.

#include <cstdint>
#include <span>
#include <string>

namespace rollres {

/// The first lines of such a file. @param type "ImageData", "RectilinearGrid"
std::string vtk_head(const std::string& type);

/// An array at the points. @param components of each point's vector; 1 for numbers
std::string vtk_array(const std::string& name, std::span<const double> values, int components = 1);
std::string vtk_array(const std::string& name, std::span<const std::int8_t> values);

}  // namespace rollres
