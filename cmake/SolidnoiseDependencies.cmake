# Every package the project uses, found once. The work-arounds are for Debian 12's packages.
find_package(Threads REQUIRED)
find_package(TBB 2021 CONFIG REQUIRED)
find_package(glm CONFIG REQUIRED)
find_package(hwy 1.0 CONFIG REQUIRED)
find_package(fmt CONFIG REQUIRED)
find_package(Eigen3 3.4 CONFIG REQUIRED)
find_package(nlohmann_json 3.11 CONFIG REQUIRED)

# KissFFT's C++ header, for transforms in double precision: Debian's library is in single precision.
find_path(KISSFFT_INCLUDE_DIR kissfft/kissfft.hh REQUIRED)

# Debian's package has no version file: asking for a version would always fail. Its targets have no namespace.
find_package(OpenMesh CONFIG REQUIRED)
add_library(OpenMesh::OpenMesh INTERFACE IMPORTED)
target_link_libraries(OpenMesh::OpenMesh INTERFACE OpenMeshCore OpenMeshTools)

# A header alone, with nlohmann_json's: reads glTF.
find_path(TINYGLTF_INCLUDE_FOLDER tiny_gltf.h REQUIRED)

if(SOLIDNOISE_BUILD_VOLUME)
  # OpenVDB ships a find module, not a config file, in a folder of its own.
  file(GLOB _openvdb_modules /usr/lib/*/cmake/OpenVDB)
  list(APPEND CMAKE_MODULE_PATH ${_openvdb_modules})
  # It also turns shared libraries on for everybody.
  set(_shared ${BUILD_SHARED_LIBS})
  find_package(OpenVDB 10 REQUIRED COMPONENTS openvdb)
  set(BUILD_SHARED_LIBS ${_shared})
  # Headers alone.
  find_path(NANOVDB_INCLUDE_FOLDER nanovdb/NanoVDB.h REQUIRED)
endif()

# Casts the rays of meshes' previews; without it there are none.
find_package(embree 3 CONFIG QUIET)
if(embree_FOUND)
  add_library(embree::embree INTERFACE IMPORTED)
  target_link_libraries(embree::embree INTERFACE embree)
endif()

if(SOLIDNOISE_BUILD_PYTHON)
  # The system's Python, which Blender's is too: the first one on the path may have neither NumPy nor pyopenvdb.
  if(NOT DEFINED Python_EXECUTABLE AND EXISTS /usr/bin/python3)
    set(Python_EXECUTABLE /usr/bin/python3)
  endif()
  find_package(Python 3.9 QUIET COMPONENTS Interpreter Development.Module NumPy)
  if(Python_FOUND)
    find_package(pybind11 2.10 CONFIG QUIET)
  endif()
endif()

if(SOLIDNOISE_BUILD_IMAGE)
  # Not by its config file: Debian's refuses to load unless OpenImageIO's own tools, and Qt with them, are installed,
  # and names an include folder that does not exist.
  find_path(OPENIMAGEIO_INCLUDE_FOLDER OpenImageIO/imageio.h REQUIRED)
  find_library(OPENIMAGEIO_LIBRARY OpenImageIO REQUIRED)
  find_library(OPENIMAGEIO_UTIL_LIBRARY OpenImageIO_Util REQUIRED)
  add_library(OpenImageIO::OpenImageIO UNKNOWN IMPORTED)
  set_target_properties(OpenImageIO::OpenImageIO PROPERTIES
    IMPORTED_LOCATION ${OPENIMAGEIO_LIBRARY}
    INTERFACE_LINK_LIBRARIES ${OPENIMAGEIO_UTIL_LIBRARY}
    INTERFACE_INCLUDE_DIRECTORIES ${OPENIMAGEIO_INCLUDE_FOLDER})
endif()

if(SOLIDNOISE_BUILD_TESTS)
  find_package(GTest CONFIG REQUIRED)
endif()
if(SOLIDNOISE_BUILD_BENCH)
  find_package(benchmark CONFIG REQUIRED)
endif()
