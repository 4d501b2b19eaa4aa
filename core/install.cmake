# The library for other programs: find_package(rollres), target rollres::core, #include <rollres/core/rolling_contact.hpp>.

include(CMakePackageConfigHelpers)
set(package_folder ${CMAKE_INSTALL_LIBDIR}/cmake/rollres)

# Headers include one another as "core/...", hence the second folder.
target_include_directories(rollres_core INTERFACE $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>
                           $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}/rollres>)
target_compile_features(rollres_core INTERFACE cxx_std_20)
set_target_properties(rollres_core PROPERTIES EXPORT_NAME core)

install(TARGETS rollres_core EXPORT rollres-targets ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT library)
install(CODE "set(LIBRARY \"\$ENV{DESTDIR}\${CMAKE_INSTALL_PREFIX}/${CMAKE_INSTALL_LIBDIR}/librollres_core.a\")
  set(NM \"${CMAKE_NM}\")
  set(OBJCOPY \"${CMAKE_OBJCOPY}\")
  include(\"${CMAKE_CURRENT_LIST_DIR}/own_eigen.cmake\")" COMPONENT library)
# What a program needs to ask: a scene, its solution and `solve`. The other headers stay inside.
install(FILES core/rolling_contact.hpp core/scene.hpp core/solution.hpp
        DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/rollres/core COMPONENT library)
install(FILES core/solve/rolling_contact.hpp DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/rollres/core/solve COMPONENT library)
install(DIRECTORY core/scene DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/rollres/core COMPONENT library
        FILES_MATCHING PATTERN "*.hpp" PATTERN "contact_state.hpp" EXCLUDE)
install(EXPORT rollres-targets NAMESPACE rollres:: DESTINATION ${package_folder} COMPONENT library)
configure_file(core/rollres-config.cmake.in generated/rollres-config.cmake COPYONLY)
write_basic_package_version_file(${CMAKE_BINARY_DIR}/generated/rollres-config-version.cmake
                                 COMPATIBILITY SameMinorVersion)
install(FILES ${CMAKE_BINARY_DIR}/generated/rollres-config.cmake
              ${CMAKE_BINARY_DIR}/generated/rollres-config-version.cmake
        DESTINATION ${package_folder} COMPONENT library)
