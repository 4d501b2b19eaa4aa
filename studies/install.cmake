# The program with its examples, schemas, manual page and completions, the reader of scenes for other programs, and the
# Debian packages that `cpack` makes of all.

# Written by the program itself, of what its commands declare. Debian wants manual pages and changes compressed.
set(written ${CMAKE_BINARY_DIR}/generated)
set(ROLLRES_MAINTAINER "the rollres developers <rollres@localhost>" CACHE STRING "who answers for the Debian package")
string(TIMESTAMP today "%a, %d %b %Y %H:%M:%S +0000" UTC)
file(CONFIGURE OUTPUT ${written}/changelog.Debian @ONLY CONTENT "rollres (${PROJECT_VERSION}-1) unstable; urgency=medium

  * Made by cpack; what changed stands in changelog.gz.

 -- ${ROLLRES_MAINTAINER}  ${today}
")
find_program(GZIP_PROGRAM gzip REQUIRED)
add_custom_command(TARGET rollres POST_BUILD
  COMMAND rollres manual > ${written}/rollres.1
  COMMAND ${GZIP_PROGRAM} -9nf ${written}/rollres.1
  COMMAND ${GZIP_PROGRAM} -9nc ${CMAKE_SOURCE_DIR}/CHANGELOG.md > ${written}/changelog.gz
  COMMAND ${GZIP_PROGRAM} -9nc ${written}/changelog.Debian > ${written}/changelog.Debian.gz
  COMMAND rollres completion bash > ${written}/rollres.bash
  COMMAND rollres completion zsh > ${written}/_rollres
  COMMAND rollres completion fish > ${written}/rollres.fish
  VERBATIM)
install(FILES ${written}/rollres.1.gz DESTINATION ${CMAKE_INSTALL_MANDIR}/man1 COMPONENT program)
install(FILES ${written}/rollres.bash DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions RENAME rollres
        COMPONENT program)
install(FILES ${written}/_rollres DESTINATION ${CMAKE_INSTALL_DATADIR}/zsh/vendor-completions COMPONENT program)
install(FILES ${written}/rollres.fish DESTINATION ${CMAKE_INSTALL_DATADIR}/fish/vendor_completions.d COMPONENT program)

install(TARGETS rollres RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR} COMPONENT program)
install(TARGETS rollres_ceres rollres_http LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR}/rollres COMPONENT program)
install(DIRECTORY studies/examples studies/schema DESTINATION ${CMAKE_INSTALL_DATADIR}/rollres COMPONENT program)
install(FILES README.md CITATION.cff ${written}/changelog.gz ${written}/changelog.Debian.gz DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT program)
install(FILES studies/guide.md studies/recipes.md studies/keys.md DESTINATION ${CMAKE_INSTALL_DOCDIR}/studies COMPONENT program)
# What is handed on is more than the sources: their licence is LICENSE, that of the binary is told above it.
file(READ LICENSE licence)
file(CONFIGURE OUTPUT ${written}/copyright @ONLY CONTENT "This binary is linked with FFTW and, for fits, with CHOLMOD, which are under the
GNU General Public License (version 2 or later), and with oneTBB (Apache 2.0): as
a whole it may be handed on under /usr/share/common-licenses/GPL-3 only. `rollres
--version --json` names all libraries. The sources of rollres are under the MIT
licence:

@licence@")
install(FILES ${written}/copyright DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT program)

add_custom_target(portable COMMAND sh ${CMAKE_SOURCE_DIR}/studies/portable.sh ${CMAKE_BINARY_DIR} DEPENDS rollres rollres_ceres rollres_http)
if(TARGET rollres_python)
  add_dependencies(portable rollres_python)
endif()

# rollres::scene_io, for programs that read scene files as this one does.
set_target_properties(rollres_scene_io PROPERTIES EXPORT_NAME scene_io)
install(TARGETS rollres_scene_io EXPORT rollres-targets ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT library)
install(FILES studies/scene_io/scene_file.hpp studies/scene_io/solution_json.hpp
        DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/rollres/studies/scene_io COMPONENT library)
install(FILES studies/text/units.hpp DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/rollres/studies/text COMPONENT library)

set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME rollres)
set(CPACK_DEBIAN_PACKAGE_RELEASE 1)
set(CPACK_PACKAGE_CONTACT ${ROLLRES_MAINTAINER})
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "rolling resistance of a cylinder or sphere on a viscoelastic layer")
set(CPACK_DEBIAN_PACKAGE_DESCRIPTION "rollres computes the rolling resistance of a rigid cylinder or sphere that
rolls in steady motion over a viscoelastic layer, with friction, by the
method of Zehil and Gavin (2013). It sweeps whole studies into an SQLite
database, draws them, writes reports, finds optima and fits materials to
measured values.
.
The library with its C++ headers is in the package too.")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_PRE_BUILD_SCRIPTS ${CMAKE_SOURCE_DIR}/studies/package_tools.cmake)
# Two packages: the program with the library, and the Python package.
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_ENABLE_COMPONENT_DEPENDS OFF)
set(CPACK_DEBIAN_ROLLRES_PACKAGE_NAME rollres)
set(CPACK_COMPONENT_GROUP_ROLLRES_DESCRIPTION "${CPACK_DEBIAN_PACKAGE_DESCRIPTION}")
set(CPACK_DEBIAN_ROLLRES_PACKAGE_RECOMMENDS "gnuplot-nox, fonts-dejavu-core")
# For those who build on the library.
set(CPACK_DEBIAN_ROLLRES_PACKAGE_SUGGESTS "cmake, pkg-config, libeigen3-dev, libfftw3-dev, libtbb-dev, libudunits2-dev")
set(components program library)
if(TARGET rollres_python)
  list(APPEND components python)
  math(EXPR next_minor "${Python_VERSION_MINOR} + 1")
  set(CPACK_DEBIAN_PYTHON_PACKAGE_NAME python3-rollres)
  set(CPACK_DEBIAN_PYTHON_PACKAGE_SECTION python)
  set(CPACK_DEBIAN_PYTHON_PACKAGE_DEPENDS "python3 (>= 3.${Python_VERSION_MINOR}), python3 (<< 3.${next_minor}), python3-numpy")
  set(CPACK_DEBIAN_PYTHON_PACKAGE_RECOMMENDS "python3-pandas")
  set(CPACK_DEBIAN_PYTHON_DESCRIPTION "rollres as a Python module: scenes, fields as arrays of numpy, many scenes by
threads, gradients for optimisers, studies, fits and stored results.")
  install(FILES ${written}/copyright DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/python3-rollres COMPONENT python)
  install(FILES ${written}/changelog.gz ${written}/changelog.Debian.gz DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/python3-rollres COMPONENT python)
endif()
set(CPACK_COMPONENTS_ALL ${components})
include(CPack)
cpack_add_component(program GROUP rollres)
cpack_add_component(library GROUP rollres)
cpack_add_component_group(rollres)
if(TARGET rollres_python)
  cpack_add_component(python)
endif()
