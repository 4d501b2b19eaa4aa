# Writes what the program is built from, at every build and only where it changed:
#   cmake -D SOURCE=... -D OUTPUT=... -D VERSION=... -D COMPILER=... -P provenance.cmake
execute_process(COMMAND git describe --always --dirty --abbrev=12 --exclude=* WORKING_DIRECTORY ${SOURCE}
                OUTPUT_VARIABLE git_hash OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET RESULT_VARIABLE failed)
if(failed OR NOT git_hash)
  set(git_hash unknown)
endif()
file(GLOB_RECURSE sources RELATIVE ${SOURCE} ${SOURCE}/core/*.hpp ${SOURCE}/core/*.cpp)
set(digests)
foreach(source IN LISTS sources)
  file(SHA256 ${SOURCE}/${source} digest)
  list(APPEND digests "${source} ${digest}")
endforeach()
string(SHA256 solver "${digests}")
string(SUBSTRING ${solver} 0 12 solver)
set(text "#define ROLLRES_VERSION \"${VERSION}\"
#define ROLLRES_GIT_HASH \"${git_hash}\"
#define ROLLRES_SOLVER_DIGEST \"${solver}\"
#define ROLLRES_COMPILER \"${COMPILER}\"
")
set(previous)
if(EXISTS ${OUTPUT})
  file(READ ${OUTPUT} previous)
endif()
if(NOT previous STREQUAL text)
  file(WRITE ${OUTPUT} "${text}")
endif()
