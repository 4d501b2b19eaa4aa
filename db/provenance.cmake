# Writes what the program is built from, at every build and only where it changed:
#   cmake -D SOURCE=... -D OUTPUT=... -D VERSION=... -D COMPILER=... -P provenance.cmake
#
# The digest of the solver is part of the keys of stored results: it changes with what may change answers, and with
# nothing else.
#   in    every source of core, its text without comments (// and /* */) and white space; those of a new chapter too
#   out   core/derivatives, which asks the solver and is asked by nothing in it, and core/reference, but for the sources
#         there that a source that counts includes (the estimate of the contact, hence the grid, starts from Hertz)
#   out   compiler, its options and the processor: they move the last digits, far below the error that a result states,
#         and parts of a study are solved on machines of many kinds and brought together by key. The compiler is stored
#         beside each result.
set(left_out core/derivatives core/reference)

# The text of a source without comments (of both kinds, of several lines too) and white space. Texts and letters in quotes
# are read first, so that what looks like a comment in one stays.
function(read_bare_source source result)
  file(READ ${SOURCE}/${source} text)
  string(REGEX REPLACE "([0-9])'([0-9])" "\\1\\2" text "${text}")  # 1'000
  string(ASCII 1 mark)
  set(quoted "\"([^\"\\\n]|\\\\.)*\"|'([^'\\\n]|\\\\.)*'")
  set(comment "//[^\n]*|/\\*([^*]|\\*+[^*/])*\\*+/")
  string(REGEX REPLACE "(${quoted}|${comment})" "${mark}\\1" text "${text}")
  string(REGEX REPLACE "${mark}(${comment})" "" text "${text}")
  string(REPLACE "${mark}" "" text "${text}")
  string(REGEX REPLACE "[ \t\r\n]+" "" text "${text}")
  set(${result} "${text}" PARENT_SCOPE)
endfunction()

execute_process(COMMAND git describe --always --dirty --abbrev=12 --exclude=* WORKING_DIRECTORY ${SOURCE}
                OUTPUT_VARIABLE git_hash OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET RESULT_VARIABLE failed)
if(failed OR NOT git_hash)
  set(git_hash unknown)
endif()

file(GLOB_RECURSE sources RELATIVE ${SOURCE} ${SOURCE}/core/*.hpp ${SOURCE}/core/*.cpp)
string(REPLACE ";" "|" chapters "${left_out}")
list(FILTER sources EXCLUDE REGEX "^(${chapters})/")
set(digests)
set(read)  # of the chapters that are left out
while(sources)
  list(POP_FRONT sources source)
  read_bare_source(${source} text)
  string(SHA256 digest "${text}")
  list(APPEND digests "${source} ${digest}")
  string(REGEX MATCHALL "#include\"(${chapters})/[a-z_/]+" included "${text}")
  foreach(stem IN LISTS included)
    string(REPLACE "#include\"" "" stem ${stem})
    file(GLOB found RELATIVE ${SOURCE} ${SOURCE}/${stem}.hpp ${SOURCE}/${stem}.cpp)
    list(REMOVE_ITEM found ${read})
    list(APPEND sources ${found})
    list(APPEND read ${found})
  endforeach()
endwhile()
list(SORT digests)
list(REMOVE_DUPLICATES digests)
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
