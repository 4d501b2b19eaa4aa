# Gives what a library holds of Eigen names of its own: cmake -D LIBRARY=file.a -D NM=nm -D OBJCOPY=objcopy -P own_eigen.cmake
#
# Its templates are compiled for ROLLRES_PROCESSOR. Another program, or a library that it links (libceres.a), may hold the
# same ones compiled for another processor: the linker would keep either for both, and memory aligned for one would crash
# the other.

execute_process(COMMAND ${NM} -a ${LIBRARY} OUTPUT_VARIABLE symbols COMMAND_ERROR_IS_FATAL ANY)
string(REGEX MATCHALL "[^ \n]*5Eigen[^ \n]*" names "${symbols}")
list(REMOVE_DUPLICATES names)
set(renamed "")
foreach(name IN LISTS names)
  string(REPLACE "5Eigen" "12rollresEigen" own "${name}")
  string(APPEND renamed "${name} ${own}\n")
endforeach()
file(WRITE ${LIBRARY}.names "${renamed}")
execute_process(COMMAND ${OBJCOPY} --redefine-syms=${LIBRARY}.names ${LIBRARY} COMMAND_ERROR_IS_FATAL ANY)
file(REMOVE ${LIBRARY}.names)
