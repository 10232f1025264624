# What find_package(Reprise) finds: the client library for drivers in C++, and kernel and replay for who embeds
# them. ./dev install puts it beside the programs; tests/package/ is somebody who uses it.
include(CMakePackageConfigHelpers)
set(client_rooms world process remote)
set(kernel_rooms files ground walkers towns scripting traffic drivers replay kernel)
set(package_folder ${CMAKE_INSTALL_LIBDIR}/cmake/Reprise)
set(header_folder ${CMAKE_INSTALL_INCLUDEDIR}/reprise)

install(TARGETS reprise_build ${client_rooms} EXPORT RepriseClient ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR}/reprise)
install(TARGETS ${kernel_rooms} EXPORT RepriseKernel ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR}/reprise)
foreach(set Client Kernel)
  install(EXPORT Reprise${set} NAMESPACE Reprise:: DESTINATION ${package_folder})
endforeach()

foreach(room IN LISTS client_rooms kernel_rooms)
  install(DIRECTORY ${PROJECT_SOURCE_DIR}/${room}/ DESTINATION ${header_folder}/${room} FILES_MATCHING PATTERN "*.h")
endforeach()
install(DIRECTORY ${PROJECT_BINARY_DIR}/generated/world/ DESTINATION ${header_folder}/world
        FILES_MATCHING PATTERN "*_generated.h")
install(FILES ${PROJECT_BINARY_DIR}/generated/remote/remote/wire_generated.h DESTINATION ${header_folder}/remote)

configure_package_config_file(cmake/RepriseConfig.cmake.in ${PROJECT_BINARY_DIR}/generated/RepriseConfig.cmake
                              INSTALL_DESTINATION ${package_folder})
write_basic_package_version_file(${PROJECT_BINARY_DIR}/generated/RepriseConfigVersion.cmake
                                 COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/generated/RepriseConfig.cmake
              ${PROJECT_BINARY_DIR}/generated/RepriseConfigVersion.cmake
              ${PROJECT_SOURCE_DIR}/cmake/PlainLibrary.cmake ${PROJECT_SOURCE_DIR}/cmake/PortableFunctions.cmake
        DESTINATION ${package_folder})
install(FILES ${portable_math_linked} DESTINATION ${package_folder} RENAME portable_math.o)
