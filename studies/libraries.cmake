# The libraries that the program is linked with or is made of, with versions and licences (SPDX), for `rollres --version --json`.
# What tells no version when this is configured is named by its file: libcholmod.so.3.0.14.
pkg_check_modules(SQLITE3 QUIET sqlite3)
function(version_of_file name variable)
  find_library(${name}_file NAMES ${name} lib${name}.so.3 lib${name}.so.0)
  file(REAL_PATH "${${name}_file}" file)
  cmake_path(GET file FILENAME version)
  set(${variable} "${version}" PARENT_SCOPE)
endfunction()
version_of_file(cholmod cholmod_version)
version_of_file(udunits2 udunits_version)
version_of_file(glog glog_version)
version_of_file(ssl openssl_version)
version_of_file(xlsxwriter xlsxwriter_version)
set(rows "")
foreach(library IN ITEMS
    "FFTW|${FFTW3_fftw3_VERSION}|GPL-2.0-or-later" "CHOLMOD|${cholmod_version}|GPL-2.0-or-later" "Ceres Solver|${Ceres_VERSION}|BSD-3-Clause"
    "glog|${glog_version}|BSD-3-Clause" "oneTBB|${TBB_VERSION}|Apache-2.0" "NLopt|${NLOPT_VERSION}|LGPL-2.1-or-later"
    "muParser|${MUPARSER_VERSION}|BSD-2-Clause" "libxlsxwriter|${xlsxwriter_version}|BSD-2-Clause" "UDUNITS|${udunits_version}|UCAR"
    "SQLite|${SQLITE3_VERSION}|blessing" "SQLiteCpp|${SQLiteCpp_VERSION}|MIT" "zlib|${ZLIB_VERSION_STRING}|Zlib" "Eigen|${Eigen3_VERSION}|MPL-2.0"
    "Boost|${Boost_VERSION_STRING}|BSL-1.0" "nlohmann/json|${nlohmann_json_VERSION}|MIT" "CLI11|${CLI11_VERSION}|BSD-3-Clause"
    "cpp-httplib|${HTTPLIB_VERSION}|MIT" "OpenSSL|${openssl_version}|Apache-2.0"
    "libstdc++|${CMAKE_CXX_COMPILER_VERSION}|GPL-3.0-or-later WITH GCC-exception-3.1")
  string(REPLACE "|" "\", \"" row "${library}")
  string(APPEND rows "{\"${row}\"},\n")
endforeach()
file(CONFIGURE OUTPUT generated/libraries.inc CONTENT "${rows}" @ONLY)
