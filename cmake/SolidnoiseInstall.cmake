# What `cmake --install` puts where, and the package that find_package(solidnoise) finds. Each library is a component;
# what a component needs is read off its link libraries, so that nothing has to be listed twice.
include(CMakePackageConfigHelpers)
set(_package_folder ${CMAKE_INSTALL_LIBDIR}/cmake/solidnoise)
get_property(_libraries GLOBAL PROPERTY SOLIDNOISE_LIBRARIES)

set(SOLIDNOISE_COMPONENTS "")
set(SOLIDNOISE_REQUIREMENTS "")
foreach(_library IN LISTS _libraries)
  get_target_property(_component ${_library} EXPORT_NAME)
  list(APPEND SOLIDNOISE_COMPONENTS ${_component})

  get_target_property(_links ${_library} LINK_LIBRARIES)
  set(_own ${_links})
  list(FILTER _own INCLUDE REGEX "^solidnoise::")
  list(TRANSFORM _own REPLACE "^solidnoise::" "")
  set(_foreign ${_links})
  list(FILTER _foreign INCLUDE REGEX "^[^:$]+::")
  list(FILTER _foreign EXCLUDE REGEX "^solidnoise::")
  list(TRANSFORM _foreign REPLACE "::.*" "")
  list(REMOVE_DUPLICATES _foreign)
  string(APPEND SOLIDNOISE_REQUIREMENTS "set(_solidnoise_${_component}_components ${_own})\n"
                                        "set(_solidnoise_${_component}_packages ${_foreign})\n")

  # The files of an export set are loaded only when its component is asked for.
  install(TARGETS ${_library} EXPORT solidnoise-${_component}
    ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR} LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR})
  install(EXPORT solidnoise-${_component} NAMESPACE solidnoise:: DESTINATION ${_package_folder})
  install(DIRECTORY ${PROJECT_SOURCE_DIR}/src/solidnoise/${_component}
    DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/solidnoise
    FILES_MATCHING PATTERN "*.h" PATTERN "*-inl.h" EXCLUDE)
endforeach()

foreach(_tool vdbnoise meshnoise noisefit)
  if(TARGET ${_tool})
    install(TARGETS ${_tool} RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
  endif()
endforeach()

configure_package_config_file(${PROJECT_SOURCE_DIR}/cmake/solidnoise-config.cmake.in
  ${PROJECT_BINARY_DIR}/solidnoise-config.cmake INSTALL_DESTINATION ${_package_folder})
write_basic_package_version_file(${PROJECT_BINARY_DIR}/solidnoise-config-version.cmake
  COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/solidnoise-config.cmake ${PROJECT_BINARY_DIR}/solidnoise-config-version.cmake
  DESTINATION ${_package_folder})
