# SPDX-License-Identifier: BSD-3-Clause
# bedscope_room(NAME HEADERS ... SOURCES ... LINK ... PRIVATE_LINK ...): one library of the project,
# the only place that knows flags, header sets and what is exported.
set(CMAKE_CXX_STANDARD 20)
set(CMAKE_CXX_STANDARD_REQUIRED ON)
set(CMAKE_CXX_EXTENSIONS OFF)
set(CMAKE_POSITION_INDEPENDENT_CODE ON)
if(NOT CMAKE_BUILD_TYPE)
  set(CMAKE_BUILD_TYPE Release)
endif()

add_library(bedscope_flags INTERFACE)
# Designated initialisers leave the rest at their defaults on purpose.
# -ffp-contract=off: the same bits with and without FMA in the instruction set.
target_compile_options(bedscope_flags INTERFACE -Wall -Wextra -Wpedantic -Wshadow -Wconversion
                       -Wno-sign-conversion -Wno-missing-field-initializers -ffp-contract=off)
if(BEDSCOPE_FUZZ)
  target_compile_definitions(bedscope_flags INTERFACE BEDSCOPE_FUZZING)  # small windows, see source.hpp
endif()
if(BEDSCOPE_SANITIZE)
  target_compile_options(bedscope_flags INTERFACE -fsanitize=${BEDSCOPE_SANITIZE}
                         -fno-sanitize-recover=all -fno-omit-frame-pointer)
  target_link_options(bedscope_flags INTERFACE -fsanitize=${BEDSCOPE_SANITIZE})
endif()

# Every header compiles alone. That of a source is the source's first line (lint.own_header_first), so the build shows
# it; the others are compiled by target headers_alone.
function(bedscope_headers_alone target headers sources)
  set(alone "")
  file(RELATIVE_PATH room ${PROJECT_SOURCE_DIR} ${CMAKE_CURRENT_SOURCE_DIR})
  foreach(header IN LISTS headers)
    string(REGEX REPLACE "hpp$" "cpp" source ${header})
    if(NOT source IN_LIST sources)
      set(file ${CMAKE_CURRENT_BINARY_DIR}/headers_alone/${source})
      file(CONFIGURE OUTPUT ${file} CONTENT "#include \"${room}/${header}\"\n")
      list(APPEND alone ${file})
    endif()
  endforeach()
  if(NOT TARGET headers_alone)
    add_custom_target(headers_alone)
  endif()
  if(alone)
    add_library(${target}_headers OBJECT EXCLUDE_FROM_ALL ${alone})
    target_link_libraries(${target}_headers PRIVATE ${target} bedscope_flags)
    add_dependencies(headers_alone ${target}_headers)
  endif()
endfunction()

function(bedscope_room name)
  cmake_parse_arguments(ARG "" "" "HEADERS;SOURCES;LINK;PRIVATE_LINK" ${ARGN})
  set(target bedscope_${name})
  add_library(${target} STATIC ${ARG_SOURCES})
  add_library(bedscope::${name} ALIAS ${target})
  set_target_properties(${target} PROPERTIES EXPORT_NAME ${name})
  target_sources(${target} PUBLIC FILE_SET HEADERS BASE_DIRS ${PROJECT_SOURCE_DIR} FILES ${ARG_HEADERS})
  target_compile_features(${target} PUBLIC cxx_std_20)
  target_link_libraries(${target} PUBLIC ${ARG_LINK} PRIVATE ${ARG_PRIVATE_LINK}
                        $<BUILD_INTERFACE:bedscope_flags>)
  set_property(GLOBAL APPEND PROPERTY BEDSCOPE_ROOMS ${target})
  if(BEDSCOPE_TESTS)
    bedscope_headers_alone(${target} "${ARG_HEADERS}" "${ARG_SOURCES}")
  endif()
endfunction()
