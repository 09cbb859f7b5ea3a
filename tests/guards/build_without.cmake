# Configures and builds daylit without one of its halves, then makes sure that nothing of that half was linked.
#   cmake -DSOURCE=... -DBINARY=... -DWITHOUT=baker|gl -P build_without.cmake
if(WITHOUT STREQUAL "baker")
  # What is shared with the other half's build is compiled alone there.
  set(options -DDAYLIT_BAKER=OFF -DCMAKE_DISABLE_FIND_PACKAGE_embree=ON -DCMAKE_DISABLE_FIND_PACKAGE_Eigen3=ON
              -DCMAKE_UNITY_BUILD=ON -DCMAKE_PROJECT_INCLUDE=${CMAKE_CURRENT_LIST_DIR}/engine_alone.cmake)
  set(forbidden "libembree")
elseif(WITHOUT STREQUAL "gl")
  set(options -DDAYLIT_GL=OFF -DCMAKE_DISABLE_FIND_PACKAGE_glfw3=ON)
  set(forbidden "libEGL|libOSMesa|libglfw")
else()
  message(FATAL_ERROR "WITHOUT is 'baker' or 'gl', not '${WITHOUT}'")
endif()

function(must_run)
  execute_process(COMMAND ${ARGN} RESULT_VARIABLE status OUTPUT_VARIABLE output ERROR_VARIABLE output)
  if(NOT status EQUAL 0)
    message(FATAL_ERROR "${ARGN} failed:\n${output}")
  endif()
endfunction()

# Not optimised, for speed. Files that the release preset joins are compiled alone, in one of the two builds; joined in both
# are those of the command that draw.
must_run(${CMAKE_COMMAND} -S ${SOURCE} -B ${BINARY} -G Ninja -DCMAKE_BUILD_TYPE=Debug -DCMAKE_CXX_FLAGS_DEBUG=-O0
         -DDAYLIT_TESTS=OFF ${options})
must_run(${CMAKE_COMMAND} --build ${BINARY})
execute_process(COMMAND ldd ${BINARY}/demo/daylit OUTPUT_VARIABLE libraries COMMAND_ERROR_IS_FATAL ANY)
if(libraries MATCHES "${forbidden}")
  message(FATAL_ERROR "daylit without ${WITHOUT} still links ${CMAKE_MATCH_0}")
endif()
must_run(${BINARY}/demo/daylit make --list)
message(STATUS "daylit builds and starts without ${WITHOUT}")
