# cmake -DBUILD=... -DWORK=... -DSOURCE=... -DGENERATOR=... -DCOMPILER=... -P run.cmake
# Installs the build into an empty prefix, then configures, builds and runs the consumer against it.
file(REMOVE_RECURSE ${WORK})
function(tissu_do)
  execute_process(COMMAND ${ARGN} RESULT_VARIABLE status OUTPUT_VARIABLE text ERROR_VARIABLE text)
  if(NOT status EQUAL 0)
    list(JOIN ARGN " " command)
    message(FATAL_ERROR "${command}\n${text}")
  endif()
  set(text "${text}" PARENT_SCOPE)
endfunction()

tissu_do(${CMAKE_COMMAND} --install ${BUILD} --prefix ${WORK}/prefix --component development)
tissu_do(${CMAKE_COMMAND} -S ${SOURCE} -B ${WORK}/build -G ${GENERATOR} -DCMAKE_CXX_COMPILER=${COMPILER}
         -DCMAKE_BUILD_TYPE=Release -DCMAKE_PREFIX_PATH=${WORK}/prefix)
tissu_do(${CMAKE_COMMAND} --build ${WORK}/build)
tissu_do(${WORK}/build/consumer)
if(NOT text MATCHES "27 nodes, 48 cells")
  message(FATAL_ERROR "the consumer printed '${text}', expected '27 nodes, 48 cells'")
endif()
