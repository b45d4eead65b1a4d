# `cmake --install build/release --prefix P`: the runtime with its headers, a package for find_package, the program.
# Nothing that is installed knows where it was built.
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)
set(package_folder ${CMAKE_INSTALL_LIBDIR}/cmake/surimi)

install(TARGETS surimi RUNTIME COMPONENT program)
install(TARGETS surimi_runtime EXPORT surimi ARCHIVE COMPONENT development)
# Without the headers that only our own sources include: they show tinygltf and Highway to who sees them.
install(DIRECTORY runtime DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/surimi COMPONENT development FILES_MATCHING PATTERN "*.h"
  PATTERN fit EXCLUDE
  PATTERN window EXCLUDE # a program's, not the library's
  REGEX "/scene/(gltf_[a-z]+|accessor|compressed)\\.h$" EXCLUDE
  REGEX "-inl\\.h$" EXCLUDE)

install(EXPORT surimi NAMESPACE surimi:: FILE surimi-targets.cmake DESTINATION ${package_folder} COMPONENT development)
write_basic_package_version_file(${CMAKE_BINARY_DIR}/surimi-config-version.cmake COMPATIBILITY SameMinorVersion)
install(FILES cmake/surimi-config.cmake cmake/libraries.cmake ${CMAKE_BINARY_DIR}/surimi-config-version.cmake
  DESTINATION ${package_folder} COMPONENT development)
install(FILES LICENSE README.md DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT program)
