# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later

from collections.abc import Callable, Sequence
from typing import Any, Literal

import numpy as np
from numpy.typing import NDArray

OPEN: int
STICK: int
SLIP: int
margin: float
pair_layout: dict[str, int]
slip_layout: dict[str, int]
rigid_layout: dict[str, int]
rigid_slip_layout: dict[str, int]

def nodal_areas(
    offsets: NDArray[np.int32], nodes: NDArray[np.int32], x: NDArray[np.float64], gdim: int
) -> NDArray[np.float64]: ...
def nodal_normals(
    offsets: NDArray[np.int32], nodes: NDArray[np.int32], x: NDArray[np.float64], gdim: int
) -> NDArray[np.float64]: ...
def facing_nodes(
    offsets: NDArray[np.int32],
    nodes: NDArray[np.int32],
    x: NDArray[np.float64],
    normal: NDArray[np.float64],
    gdim: int,
) -> NDArray[np.int8]: ...
def facing_areas(
    offsets: NDArray[np.int32],
    nodes: NDArray[np.int32],
    reference: NDArray[np.float64],
    x: NDArray[np.float64],
    normal: NDArray[np.float64],
    gdim: int,
) -> NDArray[np.float64]: ...
def nodal_curvatures(
    offsets: NDArray[np.int32],
    nodes: NDArray[np.int32],
    x: NDArray[np.float64],
    normal: NDArray[np.float64],
    gdim: int,
) -> NDArray[np.float64]: ...
def facet_turns(
    offsets: NDArray[np.int32],
    nodes: NDArray[np.int32],
    x: NDArray[np.float64],
    normal: NDArray[np.float64],
    gdim: int,
) -> NDArray[np.float64]: ...
def facet_sizes(
    offsets: NDArray[np.int32], nodes: NDArray[np.int32], x: NDArray[np.float64], gdim: int
) -> NDArray[np.float64]: ...
def explained_depths(
    size: NDArray[np.float64],
    curvature: NDArray[np.float64],
    contact: NDArray[np.int8],
    extent: NDArray[np.float64],
) -> NDArray[np.float64]: ...
def far_side(
    own_before: NDArray[np.float64],
    own_after: NDArray[np.float64],
    before: NDArray[np.float64],
    after: NDArray[np.float64],
    gdim: int,
) -> NDArray[np.int8]: ...

class FacetSampling:
    def __init__(
        self,
        offsets: NDArray[np.int32],
        nodes: NDArray[np.int32],
        x: NDArray[np.float64],
        gdim: int,
        allowed: NDArray[np.float64],
        levels: int,
    ) -> None: ...
    @property
    def points(self) -> NDArray[np.float64]: ...
    def take(self, gap: NDArray[np.float64]) -> None: ...
    @property
    def gaps(self) -> NDArray[np.float64]: ...
    @property
    def deepest(self) -> NDArray[np.float64]: ...

def nodal_area_vectors(
    offsets: NDArray[np.int32], nodes: NDArray[np.int32], x: NDArray[np.float64], gdim: int
) -> NDArray[np.float64]: ...
def unit_normals(
    vector: NDArray[np.float64], area: NDArray[np.float64], gdim: int
) -> NDArray[np.float64]: ...
def shape_functions(num_nodes: int, xi: NDArray[np.float64]) -> NDArray[np.float64]: ...

class Finder:
    def __init__(self, offsets: NDArray[np.int32], nodes: NDArray[np.int32], gdim: int) -> None: ...
    def find(
        self,
        x: NDArray[np.float64],
        points: NDArray[np.float64],
        normals: NDArray[np.float64],
        reach: NDArray[np.float64],
    ) -> dict[str, NDArray[Any]]: ...
    def outer_margins(
        self, facet: NDArray[np.int32], xi: NDArray[np.float64]
    ) -> NDArray[np.float64]: ...

class Pairing:
    def __init__(
        self,
        slave_offsets: NDArray[np.int32],
        slave_nodes: NDArray[np.int32],
        master_offsets: NDArray[np.int32],
        master_nodes: NDArray[np.int32],
        gdim: int,
        num_owned: int = ...,
    ) -> None: ...
    @property
    def slaves(self) -> NDArray[np.int32]: ...
    @property
    def facet(self) -> NDArray[np.int32]: ...
    @property
    def feature(self) -> NDArray[np.int32]: ...
    @property
    def xi(self) -> NDArray[np.float64]: ...
    @property
    def cone(self) -> NDArray[np.float64]: ...
    @property
    def normal(self) -> NDArray[np.float64]: ...
    def begin_step(self) -> None: ...
    def restore(
        self,
        facet: NDArray[np.int32],
        feature: NDArray[np.int32],
        xi: NDArray[np.float64],
        cone: NDArray[np.float64],
        normal: NDArray[np.float64],
    ) -> None: ...
    def update(self, x: NDArray[np.float64], reach: float, closed: NDArray[np.int8]) -> int: ...
    def frozen(self) -> NDArray[np.int32]: ...
    def set_master(self, offsets: NDArray[np.int32], nodes: NDArray[np.int32]) -> None: ...
    def seek(self, x: NDArray[np.float64], reach: float) -> NDArray[np.int32]: ...
    def settle(
        self,
        which: NDArray[np.int32],
        facet: NDArray[np.int32],
        feature: NDArray[np.int32],
        xi: NDArray[np.float64],
        normal: NDArray[np.float64],
        x: NDArray[np.float64],
        reach: float,
        closed: NDArray[np.int8],
    ) -> int: ...
    def feet(
        self, x: NDArray[np.float64], points: NDArray[np.float64]
    ) -> tuple[NDArray[np.float64], NDArray[np.float64]]: ...
    def places(
        self, x: NDArray[np.float64], xi: NDArray[np.float64]
    ) -> tuple[NDArray[np.float64], NDArray[np.float64]]: ...

class FacetPairs:
    @property
    def slave(self) -> NDArray[np.int32]: ...
    @property
    def master(self) -> NDArray[np.int32]: ...
    def without(self, dropped: NDArray[np.int8]) -> FacetPairs: ...
    def contains(self, part: FacetPairs) -> bool: ...

class FacetSearch:
    def __init__(
        self,
        slave_offsets: NDArray[np.int32],
        slave_nodes: NDArray[np.int32],
        master_offsets: NDArray[np.int32],
        master_nodes: NDArray[np.int32],
        gdim: int,
    ) -> None: ...
    def find(
        self, x: NDArray[np.float64], reach: float, margin: float, all_layers: bool = ...
    ) -> FacetPairs: ...
    def integrals(
        self,
        pairs: FacetPairs,
        x: NDArray[np.float64],
        reference: NDArray[np.float64],
        normal: NDArray[np.float64] = ...,
    ) -> dict[str, NDArray[np.float64]]: ...

def normal_status(
    pressure: NDArray[np.float64],
    gap: NDArray[np.float64],
    c: NDArray[np.float64],
    status: NDArray[np.int8],
) -> int: ...
def normal_complementarity(
    pressure: NDArray[np.float64],
    gap: NDArray[np.float64],
    c: NDArray[np.float64],
    area: NDArray[np.float64],
    status: NDArray[np.int8],
    value: NDArray[np.float64],
    d_pressure: NDArray[np.float64],
    d_gap: NDArray[np.float64],
    softness: float = ...,
) -> None: ...
def frictional_status(
    traction: NDArray[np.float64],
    gap: NDArray[np.float64],
    normal: NDArray[np.float64],
    slip: NDArray[np.float64],
    c: NDArray[np.float64],
    friction: NDArray[np.float64],
    reach: float,
    status: NDArray[np.int8],
) -> int: ...
def frictional_complementarity(
    traction: NDArray[np.float64],
    gap: NDArray[np.float64],
    normal: NDArray[np.float64],
    slip: NDArray[np.float64],
    c: NDArray[np.float64],
    friction: NDArray[np.float64],
    area: NDArray[np.float64],
    status: NDArray[np.int8],
    mobile: NDArray[np.float64],
    value: NDArray[np.float64],
    by_traction: NDArray[np.float64],
    by_gap: NDArray[np.float64],
    by_slip: NDArray[np.float64],
    by_normal: NDArray[np.float64],
) -> None: ...
def mortar_layout(num_slaves: int, num_nodes: int) -> dict[str, int]: ...
def rigid_mortar_layout(num_slaves: int, gdim: int) -> dict[str, int]: ...
def coefficients(
    law: str, num_nodes: int, gdim: int, num_slaves: int = 1
) -> tuple[tuple[str, str, int], ...]: ...
def terms(law: str, sliding: str, num_nodes: int, gdim: int, num_slaves: int = 1) -> list[str]: ...
def kernel(
    law: str, sliding: str, term: str, num_nodes: int, gdim: int, num_slaves: int = 1
) -> tuple[int, NDArray[np.int8]]: ...
def look_at_step(
    pressure: NDArray[np.float64],
    gap: NDArray[np.float64],
    c: NDArray[np.float64],
    area: NDArray[np.float64],
    status: NDArray[np.int8],
    change: NDArray[np.float64],
) -> tuple[float, float, float, float]: ...

class SoftPath:
    def begin_step(self) -> None: ...
    def begins(self, work: float, local: float, closed: float, opening: float) -> bool: ...
    def advance(self, changes: int, closed: int, is_full: bool) -> None: ...
    def harden(self) -> None: ...
    @property
    def softness(self) -> float: ...

def deformed_cells(
    cells: NDArray[np.int32], X: NDArray[np.float64], u: NDArray[np.float64], gdim: int
) -> tuple[float, int, int]: ...
def longest_way(
    cells: NDArray[np.int32],
    X: NDArray[np.float64],
    u: NDArray[np.float64],
    du: NDArray[np.float64],
    gdim: int,
    part: float,
) -> float: ...
def moments(
    offsets: NDArray[np.int32],
    nodes: NDArray[np.int32],
    x0: NDArray[np.float64],
    x1: NDArray[np.float64],
    gdim: int,
    origin0: NDArray[np.float64],
    origin1: NDArray[np.float64],
) -> NDArray[np.float64]: ...
def crossings(
    offsets: NDArray[np.int32],
    nodes: NDArray[np.int32],
    x0: NDArray[np.float64],
    x1: NDArray[np.float64],
    gdim: int,
    moments: NDArray[np.float64],
    origin0: NDArray[np.float64],
    origin1: NDArray[np.float64],
    points0: NDArray[np.float64],
    points1: NDArray[np.float64],
    normals0: NDArray[np.float64],
    normals1: NDArray[np.float64],
    tolerance: NDArray[np.float64],
    node: NDArray[np.int32],
) -> NDArray[Any]: ...
def passed(crossings: NDArray[Any], tolerance: NDArray[np.float64]) -> NDArray[np.int32]: ...

class NodeMap: ...

class PythonNodes(NodeMap):
    def __init__(self, adapter: Any) -> None: ...

class Pairs:
    @property
    def slaves(self) -> NDArray[np.int32]: ...
    @property
    def nodes(self) -> NDArray[np.int32]: ...
    @property
    def data(self) -> NDArray[np.float64]: ...
    @property
    def slip(self) -> NDArray[np.float64] | None: ...
    @property
    def normal(self) -> NDArray[np.float64]: ...
    @property
    def num_nodes(self) -> int: ...
    @property
    def is_movement(self) -> bool: ...
    def same(self, other: Any) -> bool: ...

class Weights:
    @property
    def slaves(self) -> NDArray[np.int32]: ...
    @property
    def nodes(self) -> NDArray[np.int32]: ...
    @property
    def values(self) -> NDArray[np.float64]: ...

class Master:
    @property
    def reach(self) -> float: ...
    @property
    def is_rigid(self) -> bool: ...
    @property
    def saved_rows(self) -> dict[str, Literal["slave", "node", "global"]]: ...
    def accept(self, x: NDArray[np.float64]) -> None: ...
    def begin_step(self) -> None: ...
    def rebuild(self) -> None: ...
    def nodes_changed(self) -> None: ...
    def turn(self, x: NDArray[np.float64]) -> NDArray[np.float64] | None: ...
    def touch(
        self, which: NDArray[np.bool_], x: NDArray[np.float64], offset: NDArray[np.float64]
    ) -> None: ...
    def search(self, x: NDArray[np.float64], closed: NDArray[np.int8]) -> int: ...
    @property
    def paired(self) -> NDArray[np.bool_]: ...
    def pairs(self) -> list[Pairs]: ...
    def update(
        self, x: NDArray[np.float64], frozen: bool, offset: NDArray[np.float64]
    ) -> list[Pairs] | None: ...
    def normals(self) -> NDArray[np.float64]: ...
    def weights(self) -> Weights: ...
    def area(self, whole: NDArray[np.float64]) -> NDArray[np.float64]: ...
    def take_front(self, faces: NDArray[np.bool_]) -> None: ...
    @property
    def origin(self) -> NDArray[np.float64]: ...
    def compliance(self, nodal: NDArray[np.float64]) -> NDArray[np.float64]: ...
    def mobility(
        self, free: NDArray[np.bool_]
    ) -> tuple[NDArray[np.float64], NDArray[np.float64]]: ...
    def identity(self) -> dict[str, NDArray[Any]]: ...
    def save(self) -> dict[str, NDArray[Any]]: ...
    def load(self, saved: dict[str, NDArray[Any]]) -> None: ...
    def distance(self, x: NDArray[np.float64]) -> float: ...
    @property
    def frozen_pairs(self) -> NDArray[np.int32]: ...
    def reset_flips(self) -> None: ...
    def deepest_frozen_pair(self, x: NDArray[np.float64]) -> tuple[float, float]: ...

class Geometry:
    @property
    def gap(self) -> NDArray[np.float64]: ...
    @property
    def gradient(self) -> NDArray[np.float64]: ...
    @property
    def normal(self) -> NDArray[np.float64]: ...
    @property
    def curvature(self) -> NDArray[np.float64]: ...

class Placement:
    @property
    def point(self) -> NDArray[np.float64]: ...
    def turn(self, to: Placement) -> NDArray[np.float64]: ...
    def carry(self, x: NDArray[np.float64], to: Placement) -> NDArray[np.float64]: ...

class Obstacle:
    extent: float
    def evaluate(self, x: NDArray[np.float64]) -> Geometry: ...
    def placement(self, gdim: int) -> Placement: ...
    def size(self, gdim: int) -> float: ...
    def parameters(self, gdim: int) -> NDArray[np.float64]: ...
    def distance(self, x: NDArray[np.float64]) -> NDArray[np.float64]: ...
    def normals(self, x: NDArray[np.float64]) -> NDArray[np.float64]: ...
    def level(self, x: NDArray[np.float64]) -> NDArray[np.float64]: ...
    @property
    def tells_movement(self) -> bool: ...
    @property
    def usual_mistake(self) -> str: ...

class Plane(Obstacle):
    def __init__(self) -> None: ...
    def place(self, point: Sequence[float], normal: Sequence[float]) -> None: ...

class Sphere(Obstacle):
    def __init__(self, hollow: bool) -> None: ...
    def place(self, centre: Sequence[float], radius: float) -> None: ...

class Cylinder(Obstacle):
    def __init__(self, hollow: bool) -> None: ...
    def place(self, point: Sequence[float], axis: Sequence[float], radius: float) -> None: ...

class LevelSet(Obstacle):
    def __init__(
        self,
        function: Callable[
            [NDArray[np.float64], int],
            tuple[NDArray[np.float64], NDArray[np.float64], NDArray[np.float64] | None],
        ],
        parameters: Callable[[int], NDArray[np.float64]],
    ) -> None: ...

class ObstacleMaster(Master):
    def __init__(
        self,
        obstacle: Obstacle,
        nodes: NodeMap,
        offsets: NDArray[np.int32],
        facet_nodes: NDArray[np.int32],
        owned: NDArray[np.int32],
        x: NDArray[np.float64],
        reach: float | None,
        measures_slip: bool,
    ) -> None: ...
    @property
    def obstacle(self) -> Obstacle: ...
    def inside(self, x: NDArray[np.float64]) -> NDArray[np.float64]: ...
    def moves_untold(self, tolerance: float) -> bool: ...

class ObstacleTie(ObstacleMaster):
    def __init__(
        self,
        obstacle: Obstacle,
        nodes: NodeMap,
        offsets: NDArray[np.int32],
        facet_nodes: NDArray[np.int32],
        owned: NDArray[np.int32],
        x: NDArray[np.float64],
        reach: float | None,
    ) -> None: ...

class MortarObstacle(ObstacleMaster): ...
