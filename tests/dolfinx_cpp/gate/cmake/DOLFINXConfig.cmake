# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
#
# DOLFINx out of packages that were unpacked, not installed: DOLFINX_ROOT is the folder that stands
# for "/". Its own CMake files name places below the real "/usr"; its pkg-config file does so too,
# but can be read.

set(_dolfinx_libraries "${DOLFINX_ROOT}/usr/lib/${DOLFINX_TRIPLET}")
file(STRINGS "${_dolfinx_libraries}/pkgconfig/dolfinx_real.pc" _dolfinx_lines)
foreach(_line IN LISTS _dolfinx_lines)
  if(_line MATCHES "^(definitions|Version|Cflags|Libs)[:=] *(.*)$")
    set(_dolfinx_${CMAKE_MATCH_1} "${CMAKE_MATCH_2}")
  endif()
endforeach()
set(DOLFINX_VERSION "${_dolfinx_Version}")

set(_dolfinx_flags "${_dolfinx_Cflags} ${_dolfinx_Libs}")
string(REPLACE "\${definitions}" "${_dolfinx_definitions}" _dolfinx_flags "${_dolfinx_flags}")
string(REPLACE "\${includedir}" "/usr/include" _dolfinx_flags "${_dolfinx_flags}")
string(REPLACE "\${libdir}" "/usr/lib/${DOLFINX_TRIPLET}" _dolfinx_flags "${_dolfinx_flags}")
separate_arguments(_dolfinx_flags NATIVE_COMMAND "${_dolfinx_flags}")

set(_dolfinx_include "")
set(_dolfinx_define "DOLFINX_VERSION=\"${DOLFINX_VERSION}\"")
set(_dolfinx_link "-L${_dolfinx_libraries}")
foreach(_flag IN LISTS _dolfinx_flags)
  if(_flag MATCHES "^-I(/usr/.*)$")
    list(APPEND _dolfinx_include "${DOLFINX_ROOT}${CMAKE_MATCH_1}")
  elseif(_flag MATCHES "^-L(/usr/.*)$")
    list(APPEND _dolfinx_link "-L${DOLFINX_ROOT}${CMAKE_MATCH_1}")
  elseif(_flag MATCHES "^-l")
    list(APPEND _dolfinx_link "${_flag}")
  elseif(_flag MATCHES "^-D(MDSPAN.*|HAS_PETSC|HAS_SLEPC|HAS_PTSCOTCH)$")
    # ADIOS2, whose headers it does not say the place of, is not needed; the
    # others are strings of the build
    list(APPEND _dolfinx_define "${CMAKE_MATCH_1}")
  endif()
endforeach()
list(REMOVE_ITEM _dolfinx_include "${DOLFINX_ROOT}/usr/include")

if(NOT TARGET dolfinx)
  add_library(dolfinx INTERFACE IMPORTED)
  target_include_directories(dolfinx SYSTEM INTERFACE ${_dolfinx_include})
  target_compile_definitions(dolfinx INTERFACE ${_dolfinx_define}
    "UFCX_SIGNATURE=\"\"" "DOLFINX_GIT_COMMIT_HASH=\"\"")
  target_compile_features(dolfinx INTERFACE cxx_std_20)
  target_link_libraries(dolfinx INTERFACE ${_dolfinx_link} -lbasix -lspdlog -lfmt -lhdf5_openmpi)
  # In what is above already
  add_library(PkgConfig::PETSC INTERFACE IMPORTED)
endif()
