# The Debian packages hold the program and the Python package, and name the packages of their libraries.
# cmake -D BUILD=tree -D FOLDER=scratch [-D PYTHON=1] -P package_test.cmake; BUILD must be built.

get_filename_component(bin ${CMAKE_COMMAND} DIRECTORY)
function(run)
  execute_process(COMMAND ${ARGN} OUTPUT_VARIABLE output ERROR_VARIABLE output RESULT_VARIABLE status)
  set(output "${output}" PARENT_SCOPE)
  set(status "${status}" PARENT_SCOPE)
endfunction()

# Letters beyond ASCII in the folder's name need a locale that knows them.
set(ENV{LC_ALL} C.UTF-8)
file(REMOVE_RECURSE ${FOLDER})
run(${bin}/cpack --config ${BUILD}/CPackConfig.cmake -B ${FOLDER})
if(NOT status EQUAL 0)
  message(FATAL_ERROR "${status}: ${output}")
endif()

# check(NAME depends PACKAGE... holds FILE...)
function(check name)
  cmake_parse_arguments(PARSE_ARGV 1 "" "" "" "depends;holds")
  file(GLOB package ${FOLDER}/${name}_*.deb)
  run(dpkg-deb --field ${package} Depends)
  foreach(library IN LISTS _depends)
    if(NOT output MATCHES "${library}( |,|\n)")
      message(FATAL_ERROR "${name} does not depend on ${library}: ${output}")
    endif()
  endforeach()
  run(dpkg-deb --contents ${package})
  foreach(file IN LISTS _holds)
    if(NOT output MATCHES " [.]/usr/${file}\n")
      message(FATAL_ERROR "${file} is not in ${name}: ${output}")
    endif()
  endforeach()
endfunction()
check(rollres depends libc6 libfftw3-double3 libnlopt0 libsqlite3-0 libtbb12 libudunits2-0 libxlsxwriter4
      holds bin/rollres share/rollres/examples/paper_cylinder.json share/man/man1/rollres.1.gz include/rollres/core/scene.hpp)
if(PYTHON)
  check(python3-rollres depends libc6 libfftw3-double3 python3 python3-numpy
        holds lib/python3/dist-packages/rollres/__init__.py lib/python3/dist-packages/rollres/librollres_ceres.so share/doc/python3-rollres/copyright)
endif()
file(REMOVE_RECURSE ${FOLDER})
