# Installs daylit into a folder of its own, then builds and runs the consumer against it.
#   cmake -DBUILD=... -DSOURCE=... -DBINARY=... -P build.cmake
file(REMOVE_RECURSE ${BINARY})
foreach(command IN ITEMS
        "${CMAKE_COMMAND};--install;${BUILD};--prefix;${BINARY}/installed"
        "${CMAKE_COMMAND};-S;${SOURCE};-B;${BINARY}/build;-G;Ninja;-DCMAKE_PREFIX_PATH=${BINARY}/installed"
        "${CMAKE_COMMAND};--build;${BINARY}/build"
        "${BINARY}/build/consumer")
  execute_process(COMMAND ${command} RESULT_VARIABLE status OUTPUT_VARIABLE output ERROR_VARIABLE output)
  if(NOT status EQUAL 0)
    message(FATAL_ERROR "${command} failed:\n${output}")
  endif()
endforeach()
message(STATUS "${output}")
