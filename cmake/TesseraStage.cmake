# Targets of the project. Sources are globbed, so that adding a file is all it takes to add a part.

if(NOT CMAKE_BUILD_TYPE)
  set(CMAKE_BUILD_TYPE Release CACHE STRING "" FORCE)
endif()
set(CMAKE_EXPORT_COMPILE_COMMANDS ON)
set(CMAKE_POSITION_INDEPENDENT_CODE ON)
set(TESSERA_SANITIZE "" CACHE STRING "Sanitizers to build with, as in address,undefined")

add_library(tessera_flags INTERFACE)
target_compile_features(tessera_flags INTERFACE cxx_std_20)
target_include_directories(tessera_flags INTERFACE ${CMAKE_SOURCE_DIR})
# Contracting a*b-c*d into a fused multiply-add breaks the exact antisymmetry of edge functions
# that watertight coverage rests on; where fusing is wanted it is written out.
target_compile_options(tessera_flags INTERFACE -Wall -Wextra -Wshadow -Werror -ffp-contract=off)
# What some libraries ask for, everywhere, so that all can share precompiled headers.
target_compile_options(tessera_flags INTERFACE -pthread)
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
  # GCC 12 at -O3 warns of overflows inside std::vector that cannot happen; the sanitizers watch
  # for the real ones.
  target_compile_options(tessera_flags INTERFACE -Wno-array-bounds -Wno-stringop-overflow
                         -Wno-alloc-size-larger-than -Wno-stringop-overread)
endif()
# Fewer SIMD targets to compile: AVX-512 (AVX3), AVX2 and the SSE4 and SSE2 baselines remain, and
# under sanitizers, where kernels compile slowly, AVX2 and the baseline.
set(TESSERA_DISABLED_TARGETS "HWY_AVX3_DL|HWY_SSSE3")
if(TESSERA_SANITIZE)
  string(APPEND TESSERA_DISABLED_TARGETS "|HWY_AVX3|HWY_SSE4")
endif()
target_compile_definitions(tessera_flags INTERFACE
  "HWY_DISABLED_TARGETS=(${TESSERA_DISABLED_TARGETS})" GLM_ENABLE_EXPERIMENTAL GLM_FORCE_XYZW_ONLY)
if(TESSERA_SANITIZE)
  target_compile_options(tessera_flags INTERFACE -fsanitize=${TESSERA_SANITIZE} -fno-omit-frame-pointer
                         -fno-sanitize-recover=all)
  # Instrumented code makes GCC 12 see uninitialised members inside std::function.
  target_compile_options(tessera_flags INTERFACE -Wno-maybe-uninitialized)
  target_link_options(tessera_flags INTERFACE -fsanitize=${TESSERA_SANITIZE})
endif()

# Stage names become tessera_NAME; everything else is taken as a target name as it stands.
function(tessera_resolve OUT)
  set(resolved "")
  foreach(name ${ARGN})
    if(TARGET tessera_${name})
      list(APPEND resolved tessera_${name})
    else()
      list(APPEND resolved ${name})
    endif()
  endforeach()
  set(${OUT} ${resolved} PARENT_SCOPE)
endfunction()

# ccache sees through precompiled headers only if it is told that macros and times do not matter.
if(CMAKE_CXX_COMPILER_LAUNCHER STREQUAL "ccache" AND CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
  set(CMAKE_CXX_COMPILER_LAUNCHER env CCACHE_SLOPPINESS=pch_defines,time_macros ccache)
  target_compile_options(tessera_flags INTERFACE -fpch-preprocess)
endif()

# Headers of others that most sources read, compiled once: a third of the time that small sources
# take. `provider` compiles them, with `ARGN` besides, and shares them with targets of its kind.
function(tessera_precompile target provider)
  if(target STREQUAL provider)
    target_precompile_headers(${target} PRIVATE <algorithm> <cmath> <functional> <memory> <span>
                              <string> <vector> <fmt/format.h> <glm/glm.hpp> ${ARGN})
  elseif(TARGET ${provider})
    target_precompile_headers(${target} REUSE_FROM ${provider})
  endif()
endfunction()

# tessera_stage(NAME [FOLDER folder] USES targets...): a static library of folder/*.cpp.
function(tessera_stage NAME)
  cmake_parse_arguments(ARG "" "FOLDER" "USES" ${ARGN})
  if(NOT ARG_FOLDER)
    set(ARG_FOLDER ${NAME})
  endif()
  file(GLOB sources CONFIGURE_DEPENDS ${ARG_FOLDER}/*.cpp)
  list(FILTER sources EXCLUDE REGEX "/main\\.cpp$")
  tessera_resolve(uses ${ARG_USES})
  if(NOT sources)
    add_library(tessera_${NAME} INTERFACE)
    target_link_libraries(tessera_${NAME} INTERFACE tessera_flags ${uses})
    return()
  endif()
  add_library(tessera_${NAME} STATIC ${sources})
  target_link_libraries(tessera_${NAME} PUBLIC tessera_flags ${uses})
  tessera_precompile(tessera_${NAME} tessera_base)
endfunction()

# tessera_module(NAME folder USES targets...): a shared object loaded at run time when it is needed.
function(tessera_module NAME FOLDER)
  cmake_parse_arguments(ARG "" "" "USES" ${ARGN})
  file(GLOB sources CONFIGURE_DEPENDS ${FOLDER}/*.cpp)
  if(NOT sources)
    return()
  endif()
  tessera_resolve(uses ${ARG_USES})
  add_library(tessera_${NAME}_module MODULE ${sources})
  target_link_libraries(tessera_${NAME}_module PRIVATE tessera_flags ${uses})
  set_target_properties(tessera_${NAME}_module PROPERTIES PREFIX "" OUTPUT_NAME tessera_${NAME}
                        LIBRARY_OUTPUT_DIRECTORY ${CMAKE_BINARY_DIR})
endfunction()

# tessera_registry(STAGE name Type header folder): every folder/STEM.cpp defines
#   Type name_STEM();
# and the generated source defines  std::span<const Type> name_registry();  declared in `header`.
# Adding an entry is adding a file.
function(tessera_registry STAGE NAME TYPE HEADER FOLDER)
  file(GLOB sources CONFIGURE_DEPENDS ${FOLDER}/*.cpp)
  get_target_property(kind tessera_${STAGE} TYPE)
  if(NOT sources OR kind STREQUAL "INTERFACE_LIBRARY")
    return()
  endif()
  set(declarations "")
  set(calls "")
  foreach(source ${sources})
    get_filename_component(stem ${source} NAME_WE)
    string(APPEND declarations "${TYPE} ${NAME}_${stem}();\n")
    string(APPEND calls "${NAME}_${stem}(), ")
  endforeach()
  set(content "// Generated from the files of ${FOLDER}/.\n#include <span>\n#include \"${HEADER}\"\n\nnamespace tessera {\n${declarations}\nstd::span<const ${TYPE}> ${NAME}_registry() {\n  static const ${TYPE} table[] = {${calls}};\n  return table;\n}\n}  // namespace tessera\n")
  set(generated ${CMAKE_BINARY_DIR}/generated/${NAME}_registry.cpp)
  file(CONFIGURE OUTPUT ${generated} CONTENT "${content}" @ONLY)
  target_sources(tessera_${STAGE} PRIVATE ${sources} ${generated})
endfunction()

function(tessera_executable NAME)
  cmake_parse_arguments(ARG "" "" "USES" ${ARGN})
  foreach(source ${ARG_UNPARSED_ARGUMENTS})
    if(NOT EXISTS ${CMAKE_SOURCE_DIR}/${source})
      return()
    endif()
  endforeach()
  tessera_resolve(uses ${ARG_USES})
  add_executable(${NAME} ${ARG_UNPARSED_ARGUMENTS})
  target_link_libraries(${NAME} PRIVATE ${uses})
  set_target_properties(${NAME} PROPERTIES RUNTIME_OUTPUT_DIRECTORY ${CMAKE_BINARY_DIR})
  foreach(module oiio embree)
    if(TARGET tessera_${module}_module)
      add_dependencies(${NAME} tessera_${module}_module)
    endif()
  endforeach()
endfunction()

# bench/harness/ is the harness; every bench/STEM.cpp is a benchmark.
function(tessera_benchmarks)
  tessera_stage(bench_harness FOLDER bench/harness USES engine)
  tessera_registry(bench_harness benchmark BenchmarkDefinition bench/harness/benchmark.h bench)
  tessera_executable(tessera_bench bench/harness/main.cpp USES bench_harness Embree::embree)
endfunction()

# tests/STAGE/*.cpp become one Catch2 program per stage, tests/main.cpp compiled once for all.
function(tessera_tests)
  find_package(Catch2 2 REQUIRED)
  include(Catch)
  if(NOT EXISTS ${CMAKE_SOURCE_DIR}/tests/main.cpp)
    return()
  endif()
  add_library(tessera_test_main OBJECT tests/main.cpp)
  target_link_libraries(tessera_test_main PUBLIC Catch2::Catch2 tessera_flags)
  foreach(stage base images report cameras scenes rib dice hide shade rays reconstruct engine trade)
    file(GLOB sources CONFIGURE_DEPENDS tests/${stage}/*.cpp)
    if(NOT sources)
      continue()
    endif()
    # tessera_NAME is the library, or a program whose library is tessera_NAME_stage.
    set(library tessera_${stage})
    if(TARGET tessera_${stage}_stage)
      set(library tessera_${stage}_stage)
    endif()
    add_executable(${stage}_tests ${sources})
    target_link_libraries(${stage}_tests PRIVATE tessera_test_main ${library} Embree::embree)
    target_compile_definitions(${stage}_tests PRIVATE
      TESSERA_SOURCE_DIR="${CMAKE_SOURCE_DIR}" TESSERA_BINARY_DIR="${CMAKE_BINARY_DIR}")
    tessera_precompile(${stage}_tests base_tests <catch2/catch.hpp>)
    catch_discover_tests(${stage}_tests TEST_PREFIX "${stage}: " PROPERTIES TIMEOUT 300)
    if(stage STREQUAL "engine" AND TARGET tessera)
      add_dependencies(engine_tests tessera)
    endif()
    if(stage STREQUAL "trade" AND TARGET tessera_trade)
      add_dependencies(trade_tests tessera tessera_trade)
    endif()
    foreach(module oiio embree)
      if(TARGET tessera_${module}_module)
        add_dependencies(${stage}_tests tessera_${module}_module)
      endif()
    endforeach()
  endforeach()
endfunction()
