# Installs the Python package of BUILD into WORK, and compares it with that of the build tree, file by file.
# Run by ctest with -D BUILD=... -D WORK=...
file(REMOVE_RECURSE ${WORK})
execute_process(COMMAND ${CMAKE_COMMAND} --install ${BUILD} --prefix ${WORK} --component python OUTPUT_QUIET COMMAND_ERROR_IS_FATAL ANY)
file(GLOB_RECURSE module ${WORK}/_solidnoise.*.so)
cmake_path(GET module PARENT_PATH installed)
file(GLOB_RECURSE names RELATIVE ${BUILD}/python/solidnoise FOLLOW_SYMLINKS ${BUILD}/python/solidnoise/*.py* ${BUILD}/python/solidnoise/*.json)
foreach(name IN LISTS names)
  execute_process(COMMAND ${CMAKE_COMMAND} -E compare_files ${BUILD}/python/solidnoise/${name} ${installed}/${name} RESULT_VARIABLE differs)
  if(differs)
    message(FATAL_ERROR "${name} is installed as another file than that of the build tree")
  endif()
endforeach()
