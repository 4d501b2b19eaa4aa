# The program with its examples and schemas, and the Debian package that `cpack` makes of it all.

# Manual page and completions, written by the program itself.
set(words_folder ${CMAKE_BINARY_DIR}/generated)
add_custom_command(TARGET rollres POST_BUILD
  COMMAND rollres manual > ${words_folder}/rollres.1
  COMMAND rollres completion bash > ${words_folder}/rollres.bash
  COMMAND rollres completion zsh > ${words_folder}/_rollres
  COMMAND rollres completion fish > ${words_folder}/rollres.fish
  VERBATIM)
install(FILES ${words_folder}/rollres.1 DESTINATION ${CMAKE_INSTALL_MANDIR}/man1 COMPONENT program)
install(FILES ${words_folder}/rollres.bash DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions
        RENAME rollres COMPONENT program)
install(FILES ${words_folder}/_rollres DESTINATION ${CMAKE_INSTALL_DATADIR}/zsh/vendor-completions COMPONENT program)
install(FILES ${words_folder}/rollres.fish DESTINATION ${CMAKE_INSTALL_DATADIR}/fish/vendor_completions.d
        COMPONENT program)

install(TARGETS rollres RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR} COMPONENT program)
install(DIRECTORY studies/examples studies/schema DESTINATION ${CMAKE_INSTALL_DATADIR}/rollres COMPONENT program)
install(FILES README.md CHANGELOG.md DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT program)
install(FILES LICENSE DESTINATION ${CMAKE_INSTALL_DOCDIR} RENAME copyright COMPONENT program)

set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME rollres)
set(CPACK_PACKAGE_CONTACT "the rollres developers <rollres@localhost>")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "rolling resistance of a cylinder or sphere on a viscoelastic layer")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_RECOMMENDS "gnuplot-nox, fonts-dejavu-core")
# For those who build on the library.
set(CPACK_DEBIAN_PACKAGE_SUGGESTS "cmake, pkg-config, libeigen3-dev, libfftw3-dev, libtbb-dev")
include(CPack)
