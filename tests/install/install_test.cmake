# Installs BUILD into a folder of its own, then configures, builds and runs the project CONSUMER against that copy.
# Run by ctest with -D BUILD=... -D CONSUMER=... -D WORK=...
set(prefix ${WORK}/prefix)
file(REMOVE_RECURSE ${WORK})

execute_process(COMMAND ${CMAKE_COMMAND} --install ${BUILD} --prefix ${prefix} OUTPUT_QUIET COMMAND_ERROR_IS_FATAL ANY)
execute_process(COMMAND ${CMAKE_COMMAND} -S ${CONSUMER} -B ${WORK}/consumer -D CMAKE_PREFIX_PATH=${prefix}
  COMMAND_ERROR_IS_FATAL ANY)
execute_process(COMMAND ${CMAKE_COMMAND} --build ${WORK}/consumer COMMAND_ERROR_IS_FATAL ANY)

# Every program of the consumer runs. What draws needs the image module, which is not beside it.
file(GLOB_RECURSE image_module ${prefix}/*/solidnoise_image_io.so)
set(programs variance write_volume)
if(image_module)
  list(APPEND programs draw_spectrum)
  set(ENV{SOLIDNOISE_IMAGE_MODULE} ${image_module})
endif()
foreach(program IN LISTS programs)
  if(EXISTS ${WORK}/consumer/${program})
    execute_process(COMMAND ${WORK}/consumer/${program} WORKING_DIRECTORY ${WORK} COMMAND_ERROR_IS_FATAL ANY)
  endif()
endforeach()

# What OpenMesh has written is a mesh with noise.
if(EXISTS ${WORK}/consumer/bake_mesh)
  execute_process(COMMAND ${WORK}/consumer/bake_mesh ${CONSUMER}/../../meshes/torus.obj ${WORK}/marble.om COMMAND_ERROR_IS_FATAL ANY)
  if(EXISTS ${prefix}/bin/meshnoise)
    execute_process(COMMAND ${prefix}/bin/meshnoise info ${WORK}/marble.om OUTPUT_VARIABLE info COMMAND_ERROR_IS_FATAL ANY)
    if(NOT info MATCHES "closed" OR NOT info MATCHES "noise +-" OR NOT info MATCHES "red")
      message(FATAL_ERROR "The mesh that OpenMesh has written should be closed, with colours and noise: ${info}")
    endif()
  endif()
endif()

# The installed vdbnoise runs, and finds the image module, without the build tree.
unset(ENV{SOLIDNOISE_IMAGE_MODULE})
if(EXISTS ${prefix}/bin/vdbnoise AND image_module)
  file(RENAME ${prefix} ${WORK}/moved)
  execute_process(COMMAND ${WORK}/moved/bin/vdbnoise --out cloud.vdb --preview cloud.png --dim 16 --quiet
    WORKING_DIRECTORY ${WORK} COMMAND_ERROR_IS_FATAL ANY)
  file(RENAME ${WORK}/moved ${prefix})
  if(NOT EXISTS ${WORK}/cloud.vdb OR NOT EXISTS ${WORK}/cloud.png)
    message(FATAL_ERROR "The installed vdbnoise made no cloud.vdb or no cloud.png")
  endif()
endif()

# A component that was not installed is refused by name.
file(WRITE ${WORK}/refused/CMakeLists.txt
  "cmake_minimum_required(VERSION 3.25)\nproject(refused LANGUAGES CXX)\n"
  "find_package(solidnoise REQUIRED COMPONENTS noise marzipan)\n")
execute_process(COMMAND ${CMAKE_COMMAND} -S ${WORK}/refused -B ${WORK}/refused/build -D CMAKE_PREFIX_PATH=${prefix}
  RESULT_VARIABLE status OUTPUT_QUIET ERROR_VARIABLE message)
if(status EQUAL 0 OR NOT message MATCHES "no component[ \n]+'marzipan'")
  message(FATAL_ERROR "A missing component should be refused by name; cmake said: ${message}")
endif()

# Its headers under other people's warnings, and without CMake.
execute_process(COMMAND /usr/bin/python3 ${CMAKE_CURRENT_LIST_DIR}/check_headers.py ${prefix} ${CONSUMER}/../.. ${WORK} COMMAND_ERROR_IS_FATAL ANY)
