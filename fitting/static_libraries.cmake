# SuiteSparse, LAPACK and glog, which Ceres needs, as static libraries in executables: a program loads fourteen dynamic
# libraries less, which is a third of the time of its start. The Python module cannot hold them, and where one is missing
# all are dynamic as Ceres wants them.
include(CheckCSourceCompiles)

set(static_libraries)
foreach(name IN ITEMS glog gflags cholmod ccolamd camd colamd amd suitesparseconfig cxsparse lapack f77blas blas atlas)
  list(APPEND static_libraries -l:lib${name}.a)
endforeach()
# Of these there are no static ones that an executable takes, or that come with Ceres.
list(APPEND static_libraries -Wl,--as-needed -l:libunwind.so.8 -l:libmetis.so.5 -l:libgfortran.so.5 -lgomp)

set(CMAKE_REQUIRED_LIBRARIES ${static_libraries} -lstdc++ -lpthread -lm)
set(CMAKE_REQUIRED_QUIET ON)
check_c_source_compiles("
  int cholmod_analyze(void), cs_di_dupl(void), dgels_(void), dpotrf_(void);
  int main(void) { return cholmod_analyze() + cs_di_dupl() + dgels_() + dpotrf_(); }" ROLLRES_STATIC_LIBRARIES)
unset(CMAKE_REQUIRED_LIBRARIES)
unset(CMAKE_REQUIRED_QUIET)
if(ROLLRES_STATIC_LIBRARIES)
  list(TRANSFORM static_libraries REPLACE "(.+)" "$<$<STREQUAL:$<TARGET_PROPERTY:TYPE>,EXECUTABLE>:\\1>")
  get_target_property(libraries Ceres::ceres INTERFACE_LINK_LIBRARIES)
  set_target_properties(Ceres::ceres PROPERTIES INTERFACE_LINK_LIBRARIES "${static_libraries};${libraries}")
endif()
