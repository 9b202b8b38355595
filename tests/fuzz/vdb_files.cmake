# Of the folder volume/ no more than what reads and writes files: the whole takes many times as long to build with sanitizers.
file(GLOB _vdb_sources CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/src/solidnoise/volume/vdb/*.cpp)
add_library(vdb_files STATIC ${_vdb_sources})
target_link_libraries(vdb_files PUBLIC solidnoise_settings solidnoise::core OpenVDB::openvdb TBB::tbb fmt::fmt)
target_include_directories(vdb_files SYSTEM PUBLIC ${NANOVDB_INCLUDE_FOLDER})
solidnoise_compile_together(vdb_files 6)
if(NOT SOLIDNOISE_BUILD_FUZZERS)
  target_compile_options(vdb_files PRIVATE -O0) # optimising takes half of the time, and replays are short
endif()
