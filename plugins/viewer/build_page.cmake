# SPDX-License-Identifier: Apache-2.0
# Bundles the page: cmake -D NPM=... -D FROM=sources -D WORK=folder -D TO=folder -P build_page.cmake
# Packages are installed in WORK, anew only when the locked versions have changed.
file(MAKE_DIRECTORY ${WORK})
file(COPY ${FROM}/ DESTINATION ${WORK} PATTERN node_modules EXCLUDE PATTERN dist EXCLUDE)
file(SHA256 ${FROM}/package-lock.json lock)
set(stamp ${WORK}/.installed)
set(installed "")
if(EXISTS ${stamp})
  file(READ ${stamp} installed)
endif()

function(run_npm)
  execute_process(COMMAND ${NPM} ${ARGN} WORKING_DIRECTORY ${WORK} RESULT_VARIABLE failure
                  OUTPUT_VARIABLE output ERROR_VARIABLE output)
  if(failure)
    message(FATAL_ERROR "npm ${ARGN}:\n${output}")
  endif()
endfunction()

if(NOT installed STREQUAL lock)
  run_npm(ci --no-audit --no-fund --no-update-notifier)
  file(WRITE ${stamp} ${lock})
endif()
run_npm(run build)
file(MAKE_DIRECTORY ${TO})
file(COPY ${WORK}/dist/ DESTINATION ${TO})
file(TOUCH ${TO}/index.html)
