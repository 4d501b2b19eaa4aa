# The Python package rollres: build/.../python/rollres, installed beside the other packages of Debian's Python. Without
# pybind11 or Python's headers (pybind11-dev, python3-dev), or with -D ROLLRES_PYTHON=OFF, there is none.

# Debian's interpreter has Debian's headers and numpy; another may stand before it on the PATH. -D Python_EXECUTABLE=...
# names another.
if(NOT DEFINED Python_EXECUTABLE AND EXISTS /usr/bin/python3)
  set(Python_EXECUTABLE /usr/bin/python3)
endif()
find_package(Python 3.9 QUIET COMPONENTS Interpreter Development.Module)
if(Python_FOUND)
  find_package(pybind11 2.9 QUIET CONFIG)
endif()
# Not kept in the cache unless it is given: what is installed later is found by the next cmake.
if(NOT DEFINED ROLLRES_PYTHON AND Python_FOUND AND pybind11_FOUND)
  set(ROLLRES_PYTHON ON)
endif()
if(NOT ROLLRES_PYTHON)
  return()
elseif(NOT Python_FOUND OR NOT pybind11_FOUND)
  message(FATAL_ERROR "the Python package needs pybind11 and Python's headers: apt-get install pybind11-dev python3-dev")
endif()

set(package_folder ${CMAKE_BINARY_DIR}/python/rollres)
pybind11_add_module(rollres_python MODULE NO_EXTRAS studies/python/module.cpp studies/program/processor_check.cpp)
set_target_properties(rollres_python PROPERTIES OUTPUT_NAME _rollres UNITY_BUILD OFF LIBRARY_OUTPUT_DIRECTORY ${package_folder}
                      BUILD_RPATH $ORIGIN INSTALL_RPATH $ORIGIN)
target_link_libraries(rollres_python PRIVATE rollres_studies nlohmann_json::nlohmann_json)
target_compile_options(rollres_python PRIVATE $<$<CONFIG:Release>:-O1>)
target_compile_definitions(rollres_python PRIVATE ROLLRES_VERSION="${PROJECT_VERSION}")
set(python_sources ${CMAKE_SOURCE_DIR}/studies/python/package/__init__.py ${CMAKE_SOURCE_DIR}/studies/python/stubs.py)
set_property(TARGET rollres_python APPEND PROPERTY LINK_DEPENDS ${python_sources})
# Type stubs of the same lists of quantities, written by the package itself.
add_custom_command(TARGET rollres_python POST_BUILD
  COMMAND ${CMAKE_COMMAND} -E copy ${CMAKE_SOURCE_DIR}/studies/python/package/__init__.py ${package_folder}
  COMMAND ${CMAKE_COMMAND} -E copy $<TARGET_FILE:rollres_ceres> ${package_folder}
  COMMAND ${CMAKE_COMMAND} -E touch ${package_folder}/py.typed
  COMMAND ${CMAKE_COMMAND} -E env PYTHONPATH=${CMAKE_BINARY_DIR}/python PYTHONDONTWRITEBYTECODE=1
          ${Python_EXECUTABLE} ${CMAKE_SOURCE_DIR}/studies/python/stubs.py ${package_folder}/__init__.pyi
  VERBATIM)

set(ROLLRES_PYTHON_FOLDER lib/python${Python_VERSION_MAJOR}/dist-packages CACHE STRING
    "where the Python package is installed, below the prefix")
install(TARGETS rollres_python rollres_ceres LIBRARY DESTINATION ${ROLLRES_PYTHON_FOLDER}/rollres COMPONENT python)
install(FILES ${package_folder}/__init__.py ${package_folder}/__init__.pyi ${package_folder}/py.typed
        DESTINATION ${ROLLRES_PYTHON_FOLDER}/rollres COMPONENT python)
