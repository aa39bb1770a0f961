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
endfunction()
