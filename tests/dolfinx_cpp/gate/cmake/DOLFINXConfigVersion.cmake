# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later

file(STRINGS "${DOLFINX_ROOT}/usr/lib/${DOLFINX_TRIPLET}/pkgconfig/dolfinx_real.pc" _lines
     REGEX "^Version:")
string(REGEX REPLACE "^Version: *" "" PACKAGE_VERSION "${_lines}")
if(PACKAGE_VERSION VERSION_GREATER_EQUAL PACKAGE_FIND_VERSION)
  set(PACKAGE_VERSION_COMPATIBLE TRUE)
endif()
