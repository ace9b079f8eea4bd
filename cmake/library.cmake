# SPDX-License-Identifier: GPL-3.0-or-later
# libflexwright: the rooms up to study/ behind include/flexwright.h, as a shared library. The program is
# linked with the rooms themselves, so that it starts without it.
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)

add_library(flexwright_library SHARED $<TARGET_OBJECTS:fw_plan> $<TARGET_OBJECTS:fw_study>)
target_link_libraries(flexwright_library PRIVATE fw_study)
target_include_directories(flexwright_library INTERFACE $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>)
set_target_properties(flexwright_library PROPERTIES OUTPUT_NAME flexwright EXPORT_NAME flexwright
                      VERSION ${PROJECT_VERSION} SOVERSION 0 LINKER_LANGUAGE C)
target_link_options(flexwright_library PRIVATE -Wl,--as-needed)
if(NOT FW_SANITIZE)
    target_link_options(flexwright_library PRIVATE -Wl,-z,defs)
endif()

install(TARGETS flexwright_library EXPORT flexwrightTargets LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR})
install(FILES ${PROJECT_SOURCE_DIR}/include/flexwright.h DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})

# CMake: find_package(flexwright) gives flexwright::flexwright
set(package ${CMAKE_INSTALL_LIBDIR}/cmake/flexwright)
install(EXPORT flexwrightTargets NAMESPACE flexwright:: DESTINATION ${package})
configure_package_config_file(cmake/flexwrightConfig.cmake.in ${PROJECT_BINARY_DIR}/flexwrightConfig.cmake
                              INSTALL_DESTINATION ${package} NO_SET_AND_CHECK_MACRO)
write_basic_package_version_file(${PROJECT_BINARY_DIR}/flexwrightConfigVersion.cmake
                                 COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/flexwrightConfig.cmake ${PROJECT_BINARY_DIR}/flexwrightConfigVersion.cmake
        DESTINATION ${package})

# pkg-config, relative to itself so that an installed tree can be moved
file(RELATIVE_PATH FW_PC_PREFIX ${CMAKE_INSTALL_FULL_LIBDIR}/pkgconfig ${CMAKE_INSTALL_PREFIX})
configure_file(cmake/flexwright.pc.in ${PROJECT_BINARY_DIR}/flexwright.pc @ONLY)
install(FILES ${PROJECT_BINARY_DIR}/flexwright.pc DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig)
