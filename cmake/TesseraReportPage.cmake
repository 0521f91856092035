# The page of report/: bundled by npm's esbuild from report/page/ and compiled into its stage.

# tessera_report_page(): gives tessera_report the function report_page() of report/page_template.h.
# What npm installs stays in the build folder; the network is needed only when package-lock.json
# has changed.
function(tessera_report_page)
  find_program(TESSERA_NODE node DOC "Node.js 18 or newer")
  find_program(TESSERA_NPM npm DOC "The package manager of Node.js")
  mark_as_advanced(TESSERA_NODE TESSERA_NPM)
  set(source ${CMAKE_SOURCE_DIR}/report/page)
  set(work ${CMAKE_BINARY_DIR}/report_page)
  set(generated ${work}/page_template.cpp)
  file(GLOB modules CONFIGURE_DEPENDS ${source}/src/* ${source}/build.mjs)
  if(TESSERA_NODE AND TESSERA_NPM)
    add_custom_command(
      OUTPUT ${work}/installed
      COMMAND ${CMAKE_COMMAND} -E copy ${source}/package.json ${source}/package-lock.json ${work}
      COMMAND ${TESSERA_NPM} ci --ignore-scripts --no-audit --no-fund --prefer-offline --loglevel=error
      COMMAND ${CMAKE_COMMAND} -E touch ${work}/installed
      DEPENDS ${source}/package.json ${source}/package-lock.json
      WORKING_DIRECTORY ${work} COMMENT "Installing the npm packages of the trade report"
      VERBATIM)
    add_custom_command(
      OUTPUT ${generated} ${work}/page.html
      COMMAND ${TESSERA_NODE} ${source}/build.mjs ${work}
      DEPENDS ${work}/installed ${modules}
      WORKING_DIRECTORY ${work} COMMENT "Bundling the page of the trade report"
      VERBATIM)
  else()
    add_custom_command(
      OUTPUT ${generated}
      COMMAND ${CMAKE_COMMAND} -E echo
              "error: the trade report needs Node.js 18 or newer and npm (Debian: nodejs, npm); install them and run cmake again"
      COMMAND ${CMAKE_COMMAND} -E false
      VERBATIM)
  endif()
  file(MAKE_DIRECTORY ${work})
  target_sources(tessera_report PRIVATE ${generated})
endfunction()

# tessera_report_browser_test(): opens a page that report_tests writes in headless Chromium.
function(tessera_report_browser_test)
  if(NOT TARGET report_tests OR NOT TESSERA_NODE)
    return()
  endif()
  add_test(NAME "report: the page works in a browser"
           COMMAND ${TESSERA_NODE} ${CMAKE_SOURCE_DIR}/report/page/test/browser.mjs
                   --modules ${CMAKE_BINARY_DIR}/report_page --fixture $<TARGET_FILE:report_tests>)
  set_tests_properties("report: the page works in a browser" PROPERTIES TIMEOUT 300)
endfunction()
