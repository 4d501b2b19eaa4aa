# An outside program, built on the installed library, has the answer of the installed program; so builds the README's.
# cmake -D BUILD=tree -D FOLDER=scratch -D CXX=compiler [-D FLAGS=...] [-D PYTHON=interpreter] -P install_test.cmake; BUILD must be built.

function(run)
  execute_process(COMMAND ${ARGN} OUTPUT_VARIABLE output ERROR_VARIABLE output RESULT_VARIABLE status)
  if(NOT status EQUAL 0)
    message(FATAL_ERROR "${ARGN}\nended with ${status}:\n${output}")
  endif()
  set(output "${output}" PARENT_SCOPE)
endfunction()

file(REMOVE_RECURSE ${FOLDER})
set(prefix "${FOLDER}/a prefix")
run(${CMAKE_COMMAND} --install ${BUILD} --prefix ${prefix})
foreach(file man/man1/rollres.1.gz bash-completion/completions/rollres zsh/vendor-completions/_rollres
             fish/vendor_completions.d/rollres.fish)
  if(NOT EXISTS ${prefix}/share/${file})
    message(FATAL_ERROR "${prefix}/share/${file} is missing")
  endif()
endforeach()
run(${prefix}/bin/rollres solve ${prefix}/share/rollres/examples/paper_cylinder.json --json)
# As it is printed: string(JSON) would print it with digits of its own.
string(REGEX REPLACE ".*\"rolling_resistance\": ([^,]*),.*" "\\1" resistance "${output}")
# By the library that the first fit loads.
run(${prefix}/bin/rollres fit ${prefix}/share/rollres/examples/fit_cylinder.json --db ${FOLDER}/fit.db)

# Headers for others are those of scenes, solutions, `solve` and readers alone.
file(GLOB_RECURSE headers RELATIVE ${prefix}/include/rollres ${prefix}/include/rollres/studies/* ${prefix}/include/rollres/db/*)
if(NOT headers STREQUAL "studies/scene_io/scene_file.hpp;studies/scene_io/solution_json.hpp;studies/text/units.hpp")
  message(FATAL_ERROR "installed headers of studies: ${headers}")
endif()

if(PYTHON)
  run(${CMAKE_COMMAND} -E env PYTHONPATH=${prefix}/lib/python3/dist-packages ${PYTHON} -c
      "print(repr(__import__('rollres').solve(__import__('sys').argv[1]).rolling_resistance), end='')"
      ${prefix}/share/rollres/examples/paper_cylinder.json)
  if(NOT output STREQUAL resistance)
    message(FATAL_ERROR "Python says ${output}, the program ${resistance}")
  endif()
  run(${CMAKE_COMMAND} -E env PYTHONPATH=${prefix}/lib/python3/dist-packages ${PYTHON} -c
      "__import__('rollres').fit(__import__('sys').argv[1])" ${prefix}/share/rollres/examples/fit_cylinder.json)
endif()

# With the generator of our build: cmake's default one, make, need not be there.
file(STRINGS ${BUILD}/CMakeCache.txt generator REGEX "^CMAKE_GENERATOR:")
string(REGEX REPLACE ".*=" "" generator "${generator}")
file(READ ${CMAKE_CURRENT_LIST_DIR}/../README.md readme)
string(REGEX MATCH "```cpp\n([^`]*)```" block "${readme}")
file(WRITE ${FOLDER}/readme.cpp "${CMAKE_MATCH_1}")
run(${CMAKE_COMMAND} -G ${generator} -S ${CMAKE_CURRENT_LIST_DIR}/outside_program -B ${FOLDER}/outside
    -D CMAKE_PREFIX_PATH=${prefix} -D CMAKE_CXX_COMPILER=${CXX} -D CMAKE_CXX_FLAGS=${FLAGS} -D CMAKE_BUILD_TYPE=Release
    -D README_PROGRAM=${FOLDER}/readme.cpp)
run(${CMAKE_COMMAND} --build ${FOLDER}/outside)
run(${FOLDER}/outside/outside_program ${resistance})
run(${FOLDER}/outside/other_eigen)
run(${FOLDER}/outside/readme_program ${prefix}/share/rollres/examples/paper_cylinder.json)
if(NOT output MATCHES "^0.01 m/s: [0-9.]+ N/m\n0.1 m/s: [0-9.]+ N/m\n1 m/s: 20.276 N/m\n$")
  message(FATAL_ERROR "the README's program says ${output}")
endif()
file(REMOVE_RECURSE ${FOLDER})
