# What `cmake --install` puts where, and the package that find_package(solidnoise) finds. Each library is a component;
# what a component needs is read off its link libraries, so that nothing has to be listed twice.
include(CMakePackageConfigHelpers)
set(_package_folder ${CMAKE_INSTALL_LIBDIR}/cmake/solidnoise)
get_property(_libraries GLOBAL PROPERTY SOLIDNOISE_LIBRARIES)

# solidnoise_headers_of(HEADER OUT): this header of the library and all that it includes, directly or not.
function(solidnoise_headers_of header out)
  set(_found "")
  set(_left ${header})
  while(_left)
    list(POP_FRONT _left _header)
    if(_header IN_LIST _found)
      continue()
    endif()
    list(APPEND _found ${_header})
    file(STRINGS ${PROJECT_SOURCE_DIR}/src/${_header} _includes REGEX "^#include \"solidnoise/")
    list(TRANSFORM _includes REPLACE "^#include \"([^\"]+)\".*" "\\1")
    list(APPEND _left ${_includes})
  endwhile()
  set(${out} ${_found} PARENT_SCOPE)
endfunction()

# solidnoise_pkg_config(COMPONENT OWN FOREIGN): solidnoise-COMPONENT.pc, for builds without CMake. Debian has .pc files of some packages;
# of the others the libraries are named.
set(_pc_fmt fmt)
set(_pc_hwy libhwy)
set(_pc_TBB tbb)
set(_pc_OpenMesh openmesh)
set(_pc_OpenVDB Imath)
set(_libs_OpenVDB -lopenvdb)
set(_libs_embree -lembree3)
function(solidnoise_pkg_config component own foreign)
  list(TRANSFORM own PREPEND solidnoise- OUTPUT_VARIABLE _requires)
  set(_libs -lsolidnoise_${component})
  foreach(_package IN LISTS foreign)
    list(APPEND _requires ${_pc_${_package}})
    list(APPEND _libs ${_libs_${_package}})
  endforeach()
  if(component STREQUAL "image")
    # Where a program outside of the installed tree finds the module.
    list(APPEND _libs -ldl -Wl,-rpath,\${prefix}/${CMAKE_INSTALL_LIBDIR}/solidnoise)
  endif()
  list(JOIN _requires " " _requires)
  list(JOIN _libs " " _libs)
  # Seen from lib/ARCHITECTURE/pkgconfig or lib/pkgconfig: what is installed may be moved.
  file(RELATIVE_PATH _up /${CMAKE_INSTALL_LIBDIR}/pkgconfig /)
  string(REGEX REPLACE "/$" "" _up ${_up})
  file(WRITE ${PROJECT_BINARY_DIR}/pkgconfig/solidnoise-${component}.pc
    "prefix=\${pcfiledir}/${_up}\n"
    "Name: solidnoise-${component}\n"
    "Description: ${PROJECT_DESCRIPTION} (${component})\n"
    "Version: ${PROJECT_VERSION}\n"
    "Requires: ${_requires}\n"
    "Cflags: -std=c++20 -I\${prefix}/${CMAKE_INSTALL_INCLUDEDIR}\n"
    "Libs: -L\${prefix}/${CMAKE_INSTALL_LIBDIR} ${_libs}\n")
  install(FILES ${PROJECT_BINARY_DIR}/pkgconfig/solidnoise-${component}.pc DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig)
endfunction()

set(SOLIDNOISE_COMPONENTS "")
set(SOLIDNOISE_REQUIREMENTS "")
set(SOLIDNOISE_FOREIGN "")
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
  list(APPEND SOLIDNOISE_FOREIGN ${_foreign})
  string(APPEND SOLIDNOISE_REQUIREMENTS "set(_solidnoise_${_component}_components ${_own})\n"
                                        "set(_solidnoise_${_component}_packages ${_foreign})\n")

  # The files of an export set are loaded only when its component is asked for.
  install(TARGETS ${_library} EXPORT solidnoise-${_component}
    ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR} LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR})
  install(EXPORT solidnoise-${_component} NAMESPACE solidnoise:: DESTINATION ${_package_folder})
  solidnoise_pkg_config(${_component} "${_own}" "${_foreign}")

  # A component's header, solidnoise/COMPONENT.h, says what is public.
  solidnoise_headers_of(solidnoise/${_component}.h _headers)
  foreach(_header IN LISTS _headers)
    get_filename_component(_folder ${_header} DIRECTORY)
    install(FILES ${PROJECT_SOURCE_DIR}/src/${_header} DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/${_folder})
  endforeach()
endforeach()

foreach(_tool vdbnoise meshnoise noisefit)
  if(TARGET ${_tool})
    install(TARGETS ${_tool} RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR} COMPONENT tools)
    # A shell looks for what completes a program's command lines by the program's name.
    install(FILES ${PROJECT_SOURCE_DIR}/tools/shell/solidnoise.bash RENAME ${_tool}
      DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions COMPONENT tools)
  endif()
endforeach()
if(SOLIDNOISE_BUILD_TOOLS)
  # Debian's zsh looks in another folder of /usr than of /usr/local.
  install(CODE "set(_zsh site-functions)
    if(CMAKE_INSTALL_PREFIX MATCHES \"/usr$\")
      set(_zsh vendor-completions)
    endif()" COMPONENT tools)
  install(FILES ${PROJECT_SOURCE_DIR}/tools/shell/_solidnoise DESTINATION ${CMAKE_INSTALL_DATADIR}/zsh/\${_zsh} COMPONENT tools)
endif()

configure_package_config_file(${PROJECT_SOURCE_DIR}/cmake/solidnoise-config.cmake.in
  ${PROJECT_BINARY_DIR}/solidnoise-config.cmake INSTALL_DESTINATION ${_package_folder})
write_basic_package_version_file(${PROJECT_BINARY_DIR}/solidnoise-config-version.cmake
  COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/solidnoise-config.cmake ${PROJECT_BINARY_DIR}/solidnoise-config-version.cmake
  DESTINATION ${_package_folder})
