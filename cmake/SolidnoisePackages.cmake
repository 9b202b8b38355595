# The Debian packages that scripts/package.sh makes by CPack, a component of the installation each: tools, dev, python and blender.
set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME solidnoise)
set(CPACK_PACKAGE_HOMEPAGE_URL "")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_COMPONENTS_ALL tools dev python blender)
set(CPACK_COMPONENTS_GROUPING IGNORE)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_STRIP_FILES ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)
set(CPACK_INSTALL_DEFAULT_DIRECTORY_PERMISSIONS
  OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ GROUP_EXECUTE WORLD_READ WORLD_EXECUTE)

# Version and maintainer are those of the changelog; DEBFULLNAME and DEBEMAIL, as of Debian's own tools, name who makes the packages
# in place of the maintainer.
set(_debian ${PROJECT_SOURCE_DIR}/cmake/packages)
file(READ ${_debian}/changelog _changelog)
string(REGEX MATCH "\n -- ([^\n]*>)  " _ "${_changelog}")
set(CPACK_PACKAGE_CONTACT ${CMAKE_MATCH_1})
if(DEFINED ENV{DEBFULLNAME} AND DEFINED ENV{DEBEMAIL})
  set(CPACK_PACKAGE_CONTACT "$ENV{DEBFULLNAME} <$ENV{DEBEMAIL}>")
endif()
if(NOT _changelog MATCHES "^solidnoise \\(${PROJECT_VERSION}\\)")
  message(FATAL_ERROR "${_debian}/changelog does not begin with version ${PROJECT_VERSION}")
endif()
execute_process(COMMAND gzip --best --no-name --stdout ${_debian}/changelog
  OUTPUT_FILE ${PROJECT_BINARY_DIR}/changelog.gz COMMAND_ERROR_IS_FATAL ANY)

# solidnoise_package(COMPONENT NAME SECTION DEPENDS DESCRIPTION): the package of a component. What programs and modules link is found by
# dpkg-shlibdeps and added. The description's first line says what it is.
macro(solidnoise_package component name section depends description)
  string(TOUPPER ${component} _upper)
  set(CPACK_DEBIAN_${_upper}_PACKAGE_NAME ${name})
  set(CPACK_DEBIAN_${_upper}_PACKAGE_SECTION ${section})
  set(CPACK_DEBIAN_${_upper}_PACKAGE_DEPENDS "${depends}")
  set(CPACK_DEBIAN_${_upper}_PACKAGE_SHLIBDEPS ON)
  set(CPACK_DEBIAN_${_upper}_DESCRIPTION "${description}")
  install(FILES ${_debian}/copyright ${PROJECT_BINARY_DIR}/changelog.gz DESTINATION share/doc/${name}
    COMPONENT ${component} EXCLUDE_FROM_ALL)
endmacro()

solidnoise_package(tools solidnoise-tools graphics fonts-dejavu-core
"procedural solid noise as OpenVDB volumes and on meshes
vdbnoise makes clouds, smoke, fire and other noise as OpenVDB volumes,
meshnoise bakes noise onto meshes, noisefit learns noises from photographs.
Their statistics are known in closed form, and the same recipe gives the same
values on every machine.")
set(CPACK_DEBIAN_TOOLS_PACKAGE_SUGGESTS blender)

# What the headers include and the static libraries link.
set(_debian_glm libglm-dev)
set(_debian_hwy libhwy-dev)
set(_debian_Eigen3 libeigen3-dev)
set(_debian_fmt libfmt-dev)
set(_debian_nlohmann_json nlohmann-json3-dev)
set(_debian_OpenMesh libopenmesh-dev)
set(_debian_OpenVDB libopenvdb-dev libboost-iostreams-dev zlib1g-dev)
set(_debian_TBB libtbb-dev)
set(_debian_embree libembree-dev)
set(_depends "")
list(REMOVE_DUPLICATES SOLIDNOISE_FOREIGN)
foreach(_package IN LISTS SOLIDNOISE_FOREIGN)
  if(NOT _debian_${_package})
    message(FATAL_ERROR "It is not known which Debian package ${_package} is of")
  endif()
  list(APPEND _depends ${_debian_${_package}})
endforeach()
list(JOIN _depends ", " _depends)
solidnoise_package(dev libsolidnoise-dev libdevel "${_depends}"
"procedural solid noise with a known spectrum (development files)
Headers and static libraries, for CMake and pkg-config: noises in 1 to 4
dimensions with values, gradients and spectra in closed form, OpenVDB volumes,
noise on meshes.
.
Programs that read or write pictures need the module of solidnoise-tools.")
set(CPACK_DEBIAN_DEV_PACKAGE_RECOMMENDS "solidnoise-tools (= ${PROJECT_VERSION})")

set(_python "")
if(Python_FOUND)
  math(EXPR _next "${Python_VERSION_MINOR} + 1")
  set(_python "python3 (>= 3.${Python_VERSION_MINOR}~), python3 (<< 3.${_next}~), python3-numpy, ")
endif()
solidnoise_package(python python3-solidnoise python "${_python}solidnoise-tools (= ${PROJECT_VERSION})"
"procedural solid noise as functions of NumPy arrays
Makes and measures the volumes of vdbnoise, bakes the meshes of meshnoise and
learns the noises of noisefit, with the same values to the last bit.")
set(CPACK_DEBIAN_PYTHON_PACKAGE_SUGGESTS python3-openvdb)
set(CPACK_DEBIAN_PYTHON_PACKAGE_CONTROL_EXTRA ${_debian}/postinst ${_debian}/prerm)

solidnoise_package(blender solidnoise-blender graphics "blender, python3-solidnoise (= ${PROJECT_VERSION})"
"procedural solid noise in Blender
An add-on: clouds, smoke, fire and other noise as volumes that keep their
recipes and can be made again with other options.")
set(CPACK_DEBIAN_BLENDER_PACKAGE_ARCHITECTURE all)

if(NOT TARGET solidnoise_python)
  list(REMOVE_ITEM CPACK_COMPONENTS_ALL python blender)
endif()
include(CPack)
