// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#pragma once

#include <contactx/geometry/cylinder.h>
#include <contactx/geometry/level_set.h>
#include <contactx/geometry/plane.h>
#include <contactx/geometry/sphere.h>

namespace contactx_dolfinx
{
// Rigid obstacles by the names that they have in Python
using contactx::geometry::Cylinder;
using contactx::geometry::LevelSet;
using contactx::geometry::LevelValues;
using contactx::geometry::Obstacle;
using contactx::geometry::Plane;
using contactx::geometry::Sphere;
} // namespace contactx_dolfinx
