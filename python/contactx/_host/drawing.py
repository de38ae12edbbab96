# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Pictures of deformed bodies and contact pressures for a first look, drawn by PyVista."""

from __future__ import annotations

import importlib
from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np
import numpy.typing as npt

import basix
from contactx import cpp as core
from contactx._host.nodal_values import matching_nodes
from contactx._host.nodes import cells_of, geometry_of, in_cells, linear_cells, parts_of_cells
from contactx._host.parallel.reduce import agreed
from dolfinx import fem, mesh

if TYPE_CHECKING:
    from contactx.contact import Contact

type Array = npt.NDArray[np.float64]
type Index = npt.NDArray[np.integer]

_BODY, _EDGE, _RIGID, _INK = "#e6e9ed", "#8b95a1", "#b3aa9b", "#22262b"
# From the smallest pressure to the largest one, and of ties under tension
_SHADES = ("#fbd992", "#f4973f", "#d1372c", "#5e0d2a")
_BELOW = ("#14315c", "#2b6cb0", "#5b9bc7", "#a9cbe0")
# Width of a picture, its lowest and largest height, and the part below for the colours
_WIDTH, _LOWEST, _HIGHEST, _BAR = 1200, 400, 1100, 130
# Free space around the bodies, and obstacles around them, over their size
_MARGIN, _AROUND = 0.06, {2: 0.6, 3: 0.1}
# Points of an obstacle along an axis
_POINTS = {2: 400, 3: 60}
# Height of the largest pressure in 2D over the size of the picture
_HEIGHT = 0.15
# By how much what is drawn upon something lies before it, over the size of the picture
_BEFORE = 0.01
# From the bodies to the viewer in 3D
_CAMERA = (0.55, -1.5, 0.55)


@dataclass(frozen=True)
class Scene:
    """Deformed bodies with their contacts, on rank 0.

    Attributes:
        gdim: Geometric dimension.
        x: Positions of the nodes, shape (n, 3).
        pressure: Contact pressure at the nodes, shape (n,).
        faces: Faces of bodies, all cells in 2D and the boundary in 3D, shape (num_faces, k).
        edges: In 2D edges of the cells: their nodes, from one end to the other, shape (m, 2 or 3).
        outline: Edges of the boundary, of the same shape.
        slaves: Facets of slave surfaces, oriented outward.
        rigid: Rigid obstacles, as PyVista's meshes.
    """

    gdim: int
    x: Array
    pressure: Array
    faces: Index
    edges: Index
    outline: Index
    slaves: Index
    rigid: list[Any]

    @property
    def limits(self) -> tuple[float, float]:
        """Lowest and highest pressure, at least from zero."""
        return min(0.0, float(self.pressure.min())), max(0.0, float(self.pressure.max()))


def import_pyvista() -> Any:
    """PyVista, or an error that says how to get it.

    Raises:
        ImportError: If it is not installed.
    """
    try:
        return importlib.import_module("pyvista")
    except ImportError as error:
        raise ImportError(
            "pictures need pyvista, which is not here: pip install pyvista; results for other "
            "programs are written by contactx.VTKOutput"
        ) from error


def gather(contacts: Sequence[Contact], scale: float) -> Scene | None:
    """Bring what a picture shows to rank 0; all ranks must take part.

    Args:
        contacts: Contacts of a problem.
        scale: Factor of the displacement.

    Returns:
        The scene; None on other ranks.

    Raises:
        ImportError: If rank 0 has no PyVista, on all ranks.
    """
    halo = contacts[0].discrete.halo
    with agreed(halo.comm):
        if halo.comm.rank == 0:
            import_pyvista()
    V = contacts[0].fields.traction.function_space
    halo.update_ghosts()
    owned = halo.num_owned
    x = np.zeros((owned, 3))
    displacement = halo.displacement.array.reshape(-1, halo.gdim)[:owned]
    x[:, : halo.gdim] = halo.x[:owned] + scale * displacement
    pressure = np.zeros(owned)
    for contact in contacts:
        at = matching_nodes(V, contact.fields.pressure.function_space)[:owned]
        own = contact.fields.pressure.x.array[at]
        pressure = np.where(np.abs(own) > np.abs(pressure), own, pressure)
    slaves = [contact.slave.facet_nodes(V) for contact in contacts]
    # Of a rank without facets nobody knows how many nodes they have
    found = [_round(_rows(s.offsets, s.nodes)) for s in slaves if len(s.nodes)]
    none: Index = np.zeros((0, 2), dtype=np.int32)
    tables = [*(_plane(V) if halo.gdim == 2 else _solid(V)), np.concatenate(found or [none])]
    number = V.dofmap.index_map.local_to_global
    tables = [number(t.astype(np.int32).ravel()).reshape(t.shape) for t in tables]
    parts = halo.comm.gather((x, pressure, *tables))
    scene = None
    with agreed(halo.comm):
        if parts is not None:
            x, pressure, *tables = (
                np.concatenate([a for a in arrays if len(a)] or arrays[:1])
                for arrays in zip(*parts, strict=True)
            )
            masters = [getattr(contact.discrete.master, "obstacle", None) for contact in contacts]
            obstacles = {id(obstacle): obstacle for obstacle in masters if obstacle is not None}
            rigid = [_rigid(obstacle, x[:, : halo.gdim]) for obstacle in obstacles.values()]
            faces, edges, outline, facets = tables
            scene = Scene(halo.gdim, x, pressure, faces, edges, outline, facets, rigid)
    return scene


def _boundary(V: fem.FunctionSpace) -> tuple[npt.NDArray[np.int32], npt.NDArray[np.int32]]:
    """Cells of the boundary's facets that this rank has, and the number of the facet in each."""
    topology = V.mesh.topology
    topology.create_connectivity(topology.dim - 1, topology.dim)
    return in_cells(V.mesh, mesh.exterior_facet_indices(topology))


def _plane(V: fem.FunctionSpace) -> tuple[Index, Index, Index]:
    """Cells of the linear mesh of all nodes, edges of cells, and those of the boundary, in 2D."""
    topology = V.mesh.topology
    owned = topology.index_map(2).size_local
    layout, dofs = V.dofmap.dof_layout, V.dofmap.list
    nodes = []
    for i, (a, b) in enumerate(basix.topology(V.mesh.basix_cell())[1]):
        ends = layout.entity_dofs(0, a), layout.entity_dofs(0, b)
        nodes.append([*ends[0], *layout.entity_dofs(1, i), *ends[1]])
    cells, local = _boundary(V)
    edges = dofs[:owned, nodes].reshape(-1, len(nodes[0]))
    outline = dofs[cells[:, None], np.array(nodes)[local]]
    return _round(linear_cells(V)[: owned * parts_of_cells(V)]), edges, outline


def _solid(V: fem.FunctionSpace) -> tuple[Index, Index, Index]:
    """Facets of the boundary of the linear mesh of all nodes, oriented outward; no edges."""
    offsets, nodes = core.oriented_facets(*cells_of(V), *_boundary(V), geometry_of(V.mesh))
    none = np.zeros((0, 2), dtype=np.int64)
    return _round(_rows(offsets, nodes)), none, none


def _rows(offsets: Index, nodes: Index) -> Index:
    """Facets that all have as many nodes."""
    return nodes.reshape(-1, offsets[1] if len(offsets) > 1 else 1)


def _round(faces: Index) -> Index:
    """Faces with their nodes one behind the other: DOLFINx has those of quadrilaterals in rows."""
    return faces[:, [0, 1, 3, 2]] if faces.shape[1] == 4 else faces


def _rigid(obstacle: core.Obstacle, x: Array) -> Any:
    """What is inside of an obstacle in 2D, around points; its surface in 3D."""
    pyvista = import_pyvista()
    gdim = x.shape[1]
    low, high = x.min(axis=0), x.max(axis=0)
    around = _AROUND[gdim] * (high - low).max()
    sizes, none = (high - low + 2 * around) / (_POINTS[gdim] - 1), [0.0] * (3 - gdim)
    grid = pyvista.ImageData(
        dimensions=[_POINTS[gdim]] * gdim + [1] * (3 - gdim),
        spacing=[*sizes, *none],
        origin=[*(low - around), *none],
    )
    grid.point_data["level"] = np.nan_to_num(obstacle.level(grid.points[:, :gdim].copy()), nan=1.0)
    if gdim == 2:
        return grid.clip_scalar(scalars="level", value=0.0, invert=True)
    return grid.contour([0.0], scalars="level")


class View:
    """A parallel projection that holds scenes, with room for the colours below."""

    def __init__(self, scenes: Sequence[Scene], camera: Sequence[float] | None = None):
        """Find directions and extent.

        Args:
            scenes: The scenes.
            camera: Direction from the bodies to the viewer in 3D.
        """
        flat = scenes[0].gdim == 2
        towards = np.array(
            (0, 0, 1) if flat else _CAMERA if camera is None else camera, dtype=np.float64
        )
        self.towards = towards / np.linalg.norm(towards)
        # The last axis points up, unless one looks along it
        up = np.eye(3)[1 if abs(self.towards[2]) > 0.95 else 2]
        right = np.cross(up, self.towards)
        right /= np.linalg.norm(right)
        self.up = np.cross(self.towards, right)
        basis = np.stack([right, self.up, self.towards])
        corners = [pick(s.x @ basis.T, axis=0) for s in scenes for pick in (np.min, np.max)]
        low, high = np.min(corners, axis=0), np.max(corners, axis=0)
        self.depth = high[2] - low[2]
        self.size = high[:2] - low[:2]
        margin = _MARGIN * self.size.max()
        # Height of the largest pressure, for which there is room
        self.strip = _HEIGHT * np.sqrt(np.prod(self.size + margin)) if flat else 0.0
        width, height = self.size + 2 * max(margin, self.strip)
        # Length of a pixel
        rows = int(np.clip(_WIDTH * height / width, _LOWEST, _HIGHEST))
        self.pixel = max(width / _WIDTH, height / rows)
        self.window = [_WIDTH, rows + _BAR]
        middle = (low + high) / 2
        # Lowest place above the colours
        self.bottom = middle[1] - self.pixel * rows / 2
        middle[1] -= self.pixel * _BAR / 2
        self.focus = middle @ basis

    def aim(self, plotter: Any) -> None:
        """Set the camera of a plotter."""
        distance = 10 * (self.depth + self.size.max())
        plotter.camera_position = [self.focus + distance * self.towards, self.focus, self.up]
        plotter.camera.parallel_projection = True
        plotter.camera.parallel_scale = self.pixel * self.window[1] / 2
        plotter.camera.clipping_range = (0.1 * distance, 2 * distance)


def draw(
    scene: Scene,
    view: View,
    limits: tuple[float, float],
    *,
    title: str = "contact pressure",
    note: str = "",
    off_screen: bool = True,
) -> Any:
    """Draw a scene.

    Args:
        scene: The scene.
        view: Where it is seen from.
        limits: Pressures of the first and the last colour.
        title: Name of the colours.
        note: Text at the top.
        off_screen: Whether there is no window.

    Returns:
        A PyVista plotter, which has the pressures under the name "pressure".
    """
    pyvista = import_pyvista()
    plotter = pyvista.Plotter(off_screen=off_screen, window_size=view.window)
    plotter.set_background("white")
    flat = scene.gdim == 2
    for rigid in scene.rigid:
        if flat:
            rigid = rigid.clip("-y", origin=(0, view.bottom, 0))
            rigid = rigid.translate(-_BEFORE * view.size.max() * view.towards)
        if rigid.n_cells:
            plotter.add_mesh(rigid, color=_RIGID, lighting=not flat, opacity=1.0 if flat else 0.5)
    bodies = pyvista.PolyData.from_regular_faces(scene.x, scene.faces)
    # In 3D one looks through the front into the bodies, where the pressures are
    look: dict[str, Any] = {} if flat else {"culling": "front", "ambient": 0.55, "diffuse": 0.5}
    lines = scene.edges if flat else scene.faces
    lengths = np.linalg.norm(scene.x[lines[:, 0]] - scene.x[lines[:, 1]], axis=1)
    pixels = float(lengths.mean()) / view.pixel * (len(scene.edges[0]) - 1 if flat else 1)
    # Lines of fine meshes would be one grey
    opacity = min(1.0, pixels / 20) if pixels > 3 else 0.0
    if not flat:
        look |= {"show_edges": opacity > 0, "edge_color": _EDGE, "edge_opacity": opacity}
    plotter.add_mesh(bodies, color=_BODY, lighting=not flat, **look)
    if flat and opacity > 0:
        plotter.add_mesh(
            _lines(scene, scene.edges), color=_EDGE, line_width=1, opacity=opacity, lighting=False
        )
    outline = (
        _lines(scene, scene.outline)
        if flat
        else bodies.extract_feature_edges(
            feature_angle=40, boundary_edges=False, non_manifold_edges=False, manifold_edges=False
        )
    )
    if outline.n_cells:
        plotter.add_mesh(outline, color=_INK, line_width=1.5, lighting=False)
    marks = _strips(scene, view, max(map(abs, limits))) if flat else _patches(scene, view)
    if marks is None:
        note = f"{note}   no contact" if note else "no contact"
    else:
        if limits[0] < 0:
            limits = -max(-limits[0], limits[1]), max(-limits[0], limits[1])
        actor = plotter.add_mesh(
            marks,
            scalars="pressure",
            cmap=_colours(limits[0] < 0),
            clim=list(limits),
            lighting=False,
            show_scalar_bar=False,
        )
        rows = view.window[1]
        plotter.add_scalar_bar(
            "",
            mapper=actor.mapper,
            n_labels=5,
            fmt="%.3g",
            width=0.5,
            height=70 / rows,
            position_x=0.25,
            position_y=12 / rows,
            color=_INK,
            label_font_size=22,
        )
        # PyVista's own title would lie upon the labels
        text = plotter.add_text(
            title, position=(0.5, 92 / rows), viewport=True, font_size=14, color=_INK
        )
        text.prop.justification_horizontal = "center"
    if note:
        plotter.add_text(note, position="upper_left", font_size=14, color=_INK)
    view.aim(plotter)
    plotter.enable_anti_aliasing("ssaa")
    return plotter


def _lines(scene: Scene, edges: Index) -> Any:
    cells = np.insert(edges, 0, edges.shape[1], axis=1)
    return import_pyvista().PolyData(scene.x, lines=cells.ravel())


def _colours(is_signed: bool) -> list[str]:
    """A colour map as a list of shades."""
    shades = (*_BELOW, *_SHADES) if is_signed else _SHADES
    rgb = np.array([[int(s[k : k + 2], 16) for k in (1, 3, 5)] for s in shades], dtype=float)
    at = np.linspace(0, len(shades) - 1, 256)
    mixed = [np.interp(at, np.arange(len(shades)), rgb[:, k]) for k in range(3)]
    return [f"#{r:02x}{g:02x}{b:02x}" for r, g, b in np.rint(mixed).astype(int).T]


def _loaded(scene: Scene) -> Index:
    """Slave facets with a pressure at a node."""
    loaded: Index = scene.slaves[(scene.pressure[scene.slaves] != 0).any(axis=1)]
    return loaded


def _strips(scene: Scene, view: View, largest: float) -> Any:
    """Pressures in 2D as heights over the slave surface; None where there are none."""
    facets = _loaded(scene)
    if not len(facets):
        return None
    along = np.diff(scene.x[facets], axis=1)[:, 0]
    outward = np.stack([along[:, 1], -along[:, 0], np.zeros(len(along))], axis=1)
    normal = np.zeros_like(scene.x)
    for k in range(2):
        np.add.at(normal, facets[:, k], outward)
    nodes = np.unique(facets)
    normal[nodes] /= np.linalg.norm(normal[nodes], axis=1)[:, None]
    height = view.strip / largest
    # Before edges and outlines
    foot = scene.x + _BEFORE * view.size.max() * view.towards
    top = foot + height * np.abs(scene.pressure)[:, None] * normal
    quads = np.hstack([facets, facets[:, ::-1] + len(foot)])
    strips = import_pyvista().PolyData.from_regular_faces(np.concatenate([foot, top]), quads)
    strips.point_data["pressure"] = np.tile(scene.pressure, 2)
    return strips.clean()


def _patches(scene: Scene, view: View) -> Any:
    """Facets in 3D with a pressure; None where there are none."""
    facets = _loaded(scene)
    if not len(facets):
        return None
    # Before the faces of the bodies and obstacles that they are on
    before = scene.x + _BEFORE * view.size.max() * view.towards
    patches = import_pyvista().PolyData.from_regular_faces(before, facets)
    patches.point_data["pressure"] = scene.pressure
    return patches.clean()
