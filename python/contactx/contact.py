# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Contact between two surfaces: options and results."""

from __future__ import annotations

import re
from collections.abc import Iterable, Sequence
from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt

import ufl
from contactx import cpp as core
from contactx._host import pictures
from contactx._host.bodies import Bodies
from contactx._host.checks import check_switch, described, is_number
from contactx._host.discrete_contact import DiscreteContact, Fields, NamedSurface
from contactx._host.forms import ContactForms
from contactx._host.nodal_values import ContactValues, NodalValue, check_weight, nodal_weight
from contactx._host.nodes import node_levels
from contactx._host.parallel import reduce
from contactx._host.parallel.halo import Halo
from contactx._host.parallel.reduce import agreed
from contactx._host.part import ContactPart, checked_tags, shares_of
from contactx._host.reaction import as_point
from contactx.laws import FrictionLaw
from contactx.obstacles import Obstacle
from contactx.surface import Surface, check_straight
from dolfinx import fem, mesh

_OPTIONS = (
    "slave",
    "master",
    "friction",
    "sliding",
    "method",
    "tied",
    "search_distance",
    "excluded_distance",
    "offset",
    "adjust",
    "smooth",
    "weight",
    "tangential_factor",
)
_SLIDING = ("finite", "small")
_METHODS = ("node-to-surface", "surface-to-surface")


class Contact:
    """Contact of a slave surface with a master surface or a rigid obstacle.

    The gap g = n . (x_s - x_m) of a slave node is positive where it is open, with the outward
    normal n of the master; the pressure p >= 0 is positive in compression. Exactly one of them is
    not zero: g >= 0, p >= 0, p g = 0. With friction the traction t along the surface obeys
    |t| <= friction p, and only where they are equal the node slips, against t. The results below
    exist as soon as the contact belongs to a ContactProblem, and change when a step is accepted.
    Equations and sources are in the manual, theory/gap and theory/friction.
    """

    def __init__(
        self,
        slave: Surface,
        master: Surface | Obstacle,
        *,
        friction: float | fem.Constant | fem.Function | FrictionLaw = 0.0,
        sliding: str = "finite",
        method: str = "node-to-surface",
        tied: bool = False,
        search_distance: float | None = None,
        excluded_distance: float | None = None,
        offset: float | fem.Constant | fem.Function = 0.0,
        adjust: float | None = None,
        smooth: bool = False,
        weight: float | ufl.core.expr.Expr = 1.0,
        tangential_factor: float = 1.0,
        name: str | None = None,
    ):
        """Create a contact.

        Args:
            slave: Surface whose nodes must not penetrate the master; take the finer or the softer
                one of the two.
            master: Surface that they are measured against, or a rigid obstacle: Plane, Sphere,
                Cylinder or LevelSet. The same surface as the slave is self-contact: of two places
                that face each other one is the slave, see ``search/self/self_order.h``, and pairs
                are found as the surface folds. It takes node-to-surface and finite sliding.
            friction: Coulomb's coefficient: a number, a ``fem.Constant`` or a ``fem.Function`` of
                a scalar Lagrange space, which may change from step to step. With the number 0
                nothing along the surface is computed. Or a ``FrictionLaw`` of your own.
            sliding: "finite": pairs, normals and projections follow the deformation. "small": they
                are those of the reference configuration, which is linear and cheap, and right
                where bodies neither slide nor turn by much.
            method: "node-to-surface": each slave node is measured against the master facet that it
                projects on. It is cheap and its forces are exact, but pressures scatter where
                meshes do not match. "surface-to-surface": the gap is integrated over the parts of
                the slave facets in front of each master facet, with dual multipliers (Popp et al.,
                2010). Pressures are smooth, and a uniform pressure is exact. With a quadratic
                displacement contact with an obstacle constrains the slave nodes by both methods.
            tied: Whether the slave nodes keep their place on the master, in compression and
                tension: each keeps its position relative to its projection on the master in the
                reference configuration, in the frame of the facet, which turns with the facet
                (with small sliding it does not). A tie has no friction; a positive offset makes
                it longer.
            search_distance: Largest distance at which a slave node is paired; by default the
                diameter of the larger surface, and unlimited for a rigid obstacle.
            excluded_distance: In self-contact the length along the surface, in the reference
                configuration, within which a node is not paired with a facet; by default its own
                facets and those that share a node with them are left out. A node is never paired
                with a facet that lies behind its own body.
            offset: Length that is taken off the gap: positive where the bodies interfere by it or
                carry a layer of that thickness, negative where they are that much farther apart. A
                number, a ``fem.Constant`` or a ``fem.Function`` of a scalar Lagrange space.
            adjust: Gaps and overlaps of the reference configuration that are at most this length
                count as none, which puts no strain on the bodies: those that chords of round
                surfaces make, and small ones of the mesh. They are taken off the gap of each slave
                node for good; ``offset`` comes on top of that. Not for ties and self-contact.
            smooth: Whether linear facets stand for smooth surfaces through their nodes, so that
                round things stay round as they slide: gaps and normals are those of patches
                (Nagata, 2005) that turn with their facets. Facets that meet at more than 50 degrees
                keep their edge. Not for ties, self-contact, obstacles and quadratic elements; give
                the latter a curved mesh.
            weight: Factor of contact's integrals, the same as in the bulk's forms: ``2 * pi * r``
                in an axisymmetric model, the thickness in a plane one. A number, or a UFL
                expression of the reference position; its values at the slave nodes are taken once,
                when the problem is created, and interpolated between them. Forces then are
                integrals with it, pressures and tractions still force per true area.
            tangential_factor: Ratio of the tangential complementarity factor to the normal one,
                which is the stiffness of the cells; with friction only. It changes the iterations,
                not the solution. Stiff thin bodies that friction alone supports, such as slabs on
                soft ground, converge with 0.05 and not with 1.
            name: Name in messages and files, of letters, digits, ``_`` and ``-``; the numbers of
                contacts if there is none.

        Raises:
            TypeError: If an argument is of another kind.
            ValueError: If the surfaces share some of their facets, an option is out of its range,
                or is none of self-contact.
        """
        _check_options(
            slave,
            master,
            friction=friction,
            sliding=sliding,
            method=method,
            tied=tied,
            search_distance=search_distance,
            excluded_distance=excluded_distance,
            offset=offset,
            adjust=adjust,
            smooth=smooth,
            tangential_factor=tangential_factor,
            name=name,
        )
        check_weight(weight)
        self.slave = slave
        self.master = master
        self.sliding = sliding
        self.method = method
        self.search_distance = search_distance
        self.excluded_distance = excluded_distance
        self.offset = offset
        self.adjust = adjust
        self.smooth = bool(smooth)
        self.weight = weight
        self.tangential_factor = tangential_factor
        self.friction = friction
        self.tied = bool(tied)
        self.name = name
        self._core_options().check(is_self=self.is_self)
        self._discrete: DiscreteContact | None = None
        self._values: ContactValues | None = None
        # What of each node is of facets with some tags
        self._shares: dict[tuple[int, ...], npt.NDArray[np.float64]] = {}
        self._fields: Fields | None = None

    def __setattr__(self, name: str, value: object) -> None:
        """Refuse names that do not exist, and options that have been read already."""
        is_made = "_fields" in vars(self)
        if is_made and not (name in vars(self) or hasattr(type(self), name)):
            raise AttributeError(f"a Contact has no {name!r}: check the spelling")
        if name in _OPTIONS and vars(self).get("_discrete") is not None:
            raise AttributeError(
                f"{name} cannot be replaced once the contact belongs to a ContactProblem: give "
                "friction and offset as a fem.Constant or fem.Function and change its value"
            )
        checked = (*_OPTIONS, "name")
        if not is_made or name not in checked:
            super().__setattr__(name, value)
            return
        before = getattr(self, name)
        given = {key: getattr(self, key) for key in checked} | {name: value}
        check_weight(given.pop("weight"))
        _check_options(**given)
        super().__setattr__(name, value)
        try:
            self._core_options().check(is_self=self.is_self)
        except ValueError:
            super().__setattr__(name, before)
            raise

    def __repr__(self) -> str:
        """Name the contact, or its surfaces."""
        if self.name is not None:
            return self.name
        if self.is_self:
            return f"Contact of {self.slave} with itself"
        master = self.master if isinstance(self.master, Surface) else type(self.master).__name__
        return f"Contact(slave={self.slave}, master={master}, sliding={self.sliding!r})"

    @classmethod
    def all(
        cls,
        where: mesh.MeshTags | Surface | Sequence[Surface],
        *more: int | Iterable[int] | Surface,
        **options: Any,
    ) -> Contact:
        """Contact of every pair of bodies, or parts of one, that can meet.

        One contact has all pairs: self-contact of the surface that everything given makes up.
        Bodies may meet that are far apart at first, and each may fold onto itself. Of two bodies
        the softer one, or the one of smaller facets, is the slave where they differ by a factor of
        2 in the product of stiffness and size; see ``search/self/self_order.h``. Write
        ``Contact.all(facet_tags)`` for all tags, ``Contact.all(facet_tags, 1, 2)`` for some, or
        ``Contact.all([arm, hook])`` for surfaces.

        Args:
            where: The facet tags, or a surface or several of the same facet tags.
            more: Of facet tags the values that make up the surface, all that there are if none is
                given; of surfaces further ones.
            options: Options of a Contact: friction, search_distance and others.

        Returns:
            The contact.

        Raises:
            TypeError: If an argument is of another kind.
            ValueError: If surfaces have different facet tags; as ``Surface`` and ``Contact`` do.
        """
        surface = _joined(where, more)
        return cls(surface, surface, **options)

    def attach(self, halo: Halo, markers: npt.NDArray[np.int8], bodies: Bodies) -> DiscreteContact:
        """Make the discrete contact; ContactProblem calls this.

        Args:
            halo: Nodes of this rank.
            markers: 1 at dofs with a Dirichlet condition, shape (num_dofs,).
            bodies: Bodies of the mesh.

        Returns:
            The discrete contact.

        Raises:
            RuntimeError: If the contact belongs to a problem already.
        """
        if self._discrete is not None:
            raise RuntimeError(
                f"{self} belongs to a ContactProblem already: create one Contact a problem"
            )
        V = bodies.V
        check_straight("slave", self.slave, V, halo)
        if isinstance(self.master, Surface):
            check_straight("master", self.master, V, halo)
        weight = None
        if self.is_weighted:
            weight = nodal_weight(
                self.weight, V, np.arange(halo.num_owned, dtype=np.int32)
            ).__getitem__
        slave = _named(self.slave, V)
        master = _named(self.master, V) if isinstance(self.master, Surface) else self.master
        discrete = DiscreteContact(
            core.ReferenceMesh(halo.nodes, bodies, bodies.linear_cells),
            slave,
            master,
            halo,
            options=self._core_options(),
            is_self=self.is_self,
            level=node_levels(V),
            weight=weight,
            markers=markers,
        )
        with agreed(halo.comm):
            nodes = discrete.slaves
            is_law = isinstance(self.friction, FrictionLaw)
            takes = self._has_friction and not is_law
            friction = NodalValue(self.friction, "friction", V, nodes) if takes else None
            offset = NodalValue(self.offset, "offset", V, nodes)
            self._values = ContactValues(friction, offset, len(nodes))
        self._fields = Fields(discrete, V)
        self._discrete = discrete
        return discrete

    def _core_options(self) -> core.ContactOptions:
        """The options as the core has them."""
        return core.ContactOptions(
            is_mortar=self.method == "surface-to-surface",
            is_small=self.sliding == "small",
            tied=self.tied,
            has_friction=self._has_friction,
            bound=self.friction.values if isinstance(self.friction, FrictionLaw) else None,
            search_distance=self.search_distance,
            excluded_distance=self.excluded_distance,
            adjust=self.adjust,
            smooth=self.smooth,
            tangential_factor=self.tangential_factor,
        )

    @property
    def _has_friction(self) -> bool:
        """True if friction may act: a constant of the value 0 may become another one."""
        return not (is_number(self.friction) and self.friction == 0)

    @property
    def values(self) -> ContactValues:
        """Friction and offset as the core reads them."""
        assert self._values is not None
        return self._values

    @property
    def is_self(self) -> bool:
        """True if the surface is in contact with itself."""
        return _is_self(self.slave, self.master)

    @property
    def is_weighted(self) -> bool:
        """True if contact is integrated with a weight other than 1."""
        return not (is_number(self.weight) and self.weight == 1)

    def detach(self) -> None:
        """Free the contact for another problem; ContactProblem calls this if it is refused."""
        self._discrete = self._values = self._fields = None
        self._shares.clear()

    @property
    def active(self) -> bool:
        """True if the contact is switched on; may be set between steps."""
        return self.discrete.active

    @active.setter
    def active(self, active: bool) -> None:
        check_switch("active", active)
        self.discrete.active = bool(active)

    @property
    def discrete(self) -> DiscreteContact:
        """The discrete contact, for a Newton loop of your own.

        Raises:
            RuntimeError: If the contact belongs to no problem yet.
        """
        if self._discrete is None:
            raise RuntimeError(f"{self} has no results yet: pass it to a ContactProblem first")
        return self._discrete

    @property
    def fields(self) -> Fields:
        """Results as functions.

        Raises:
            RuntimeError: If the contact belongs to no problem yet.
        """
        if self._fields is None:
            raise RuntimeError(f"{self} has no results yet: pass it to a ContactProblem first")
        return self._fields

    def forms(self) -> ContactForms:
        """Residual and Jacobian of the contact as forms of DOLFINx; all ranks must take part.

        They are made at the first call, and anew where pairs have changed since. They read the
        state as it is at the last call: ask again after each ``settle`` or ``update``.

        Returns:
            The forms, always the same object.

        Raises:
            RuntimeError: If the contact belongs to no problem yet.
        """
        return self.discrete.forms()

    @property
    def slave_nodes(self) -> npt.NDArray[np.int32]:
        """Slave nodes of this rank, as the blocks of the displacement's dofmap, shape (n,)."""
        return self.discrete.slaves

    @property
    def area(self) -> npt.NDArray[np.float64]:
        """Reference area of each slave node of this rank (length in 2D), shape (n,).

        The integral of its shape function with the contact's weight.
        """
        return self.discrete.nodes.area

    @property
    def closed_area(self) -> float:
        """Reference area of the slave nodes in contact, on all ranks, which must take part.

        It is the sum of their nodal areas, as in ``CSVOutput``.
        """
        return self.fields.totals().area

    @property
    def multiplier(self) -> npt.NDArray[np.float64]:
        """Multiplier of each slave node of this rank, force/reference area, as it was solved for.

        Without friction its pressure, shape (n,); with friction, or tied, the traction that the
        master exerts on it, shape (n, gdim). The contact laws and equilibrium hold for it; it
        scatters more than ``pressure`` and ``traction``.
        """
        nodes = self.discrete.nodes
        return nodes.multiplier if nodes.size == 1 else nodes.multiplier.reshape(-1, nodes.size)

    @property
    def pressure(self) -> fem.Function:
        """Contact pressure, force/area, zero off the slave surface and on open nodes.

        For either method, tied or not, it is recovered from the multipliers: nodes in contact
        exchange force with their neighbours, which keeps its sum; see ``results/recovery.h``.
        Where it rises towards an edge of the contact it goes on as a line, up to the edge.
        """
        return self.fields.pressure

    @property
    def master_pressure(self) -> fem.Function:
        """Contact pressure at the nodes of the master surface, zero elsewhere, for forms over it.

        The value of a node is the mean over the slave nodes in front of it, weighted by the areas
        in contact with it. With a rigid obstacle it is zero.
        """
        return self.fields.master_pressure

    @property
    def traction(self) -> fem.Function:
        """Traction that the master exerts on the slave, force/area, zero off the slave surface.

        It is p n + t with the pressure above, the master's normal n and the tangential traction t,
        recovered in the same way: |t| <= friction p holds where the coefficient is uniform. Where
        normals differ from node to node the total force changes a little, which the report states.
        """
        return self.fields.traction

    @property
    def gap(self) -> fem.Function:
        """Gap, a length; NaN off the slave surface and where no master facet is in reach."""
        return self.fields.gap

    @property
    def status(self) -> fem.Function:
        """Status: -1 off the slave surface, 0 open, 1 stick or tied, 2 slip or frictionless."""
        return self.fields.status

    @property
    def slip(self) -> fem.Function:
        """Slip increment of the last step, a length; zero off the slave surface.

        For a node that comes into contact in the first Newton step of a load step, slip is counted
        from where the straight line between its positions at its start and at its end, both
        relative to the master, crosses the master's surface; for all others from the step's start.

        Slip is measured with friction only. With ``friction=0.0`` this is zero although nodes
        slide; a ``fem.Constant`` of value 0 measures slip without a force along the surface.

        Raises:
            RuntimeError: If the contact is tied.
        """
        return self._measured(self.fields.slip)

    @property
    def slip_total(self) -> fem.Function:
        """Accumulated length of slip, zero off the slave surface, and with ``friction=0.0``.

        Slip is measured with friction only, a ``fem.Constant`` of value 0 among it: see ``slip``.

        Raises:
            RuntimeError: If the contact is tied.
        """
        return self._measured(self.fields.slip_total)

    def _measured(self, field: fem.Function | None) -> fem.Function:
        if field is None:
            raise RuntimeError(
                f"{self} is tied: its nodes do not slip, leave slip and slip_total out"
            )
        return field

    @property
    def force(self) -> npt.NDArray[np.float64]:
        """Total force on the slave side of all ranks, shape (gdim,).

        In self-contact it is that on the nodes that are slaves at present.
        """
        return self.fields.force

    def on_both(self, f: fem.Function, missing: float = 0.0) -> fem.Function:
        """A field of the slave surface on both surfaces, without NaN: for forms over either.

        ``contact.on_both(contact.gap, missing=1.0)`` is the gap, and 1 where there is none. Nodes
        of the master have the mean of the slave nodes in front of them. All ranks must take part.

        Args:
            f: A result of the contact, or another function of the same space.
            missing: Value where nothing is in front of a node, off the surfaces, and for NaN.

        Returns:
            A new function, of the contact as it is now.

        Raises:
            ValueError: If f is of another space, or the master is a rigid obstacle.
        """
        return self.fields.on_both(f, missing)

    def across(self, f: fem.Function) -> fem.Function:
        """Value of a field on the opposite surface, such as the temperature of a Robin condition.

        At slave nodes it is the master's value in front of them, by their pairs; at nodes of the
        master the mean of the slave nodes in front of them; elsewhere f itself. Fluxes of forms
        with it balance as the mesh is refined; those of a ``Conductance`` balance exactly. All
        ranks must take part.

        Args:
            f: A function of the space of the contact's results.

        Returns:
            A new function, of f and the contact as they are now.

        Raises:
            ValueError: If f is of another space, or the master is a rigid obstacle.
        """
        return self.fields.across(f)

    def moment(self, point: npt.ArrayLike) -> float | npt.NDArray[np.float64]:
        """Moment of the contact forces on the slave side about a point; all ranks must take part.

        Forces act where the slave nodes are now, as of the last accepted step.

        Args:
            point: The point, shape (gdim,).

        Returns:
            The moment, force times length: in 2D a number, positive counter-clockwise, in 3D of
            shape (3,).

        Raises:
            TypeError: If the point is not of real numbers.
            ValueError: If it has another shape, or is not finite.
            RuntimeError: If the model is axisymmetric: forces on a ring have no moment about a
                point in the plane of the mesh.
        """
        moment = self.fields.moment(as_point(point, len(self.force)))
        return float(moment[0]) if len(moment) == 1 else moment

    def part(self, *tags: int) -> ContactPart:
        """What contact does on the facets of some tags alone; all ranks must take part.

        ``contact.part(31).force`` is the force on one roller of many that have tags of their own;
        it is that on the slave or on the master, whichever has the tag, and in self-contact on
        both. ``area``, pressure, gap and the numbers of nodes are those of slave nodes.

        Args:
            tags: Tags of facets of the slave or the master.

        Returns:
            Force, moment about a point, area and others, as of the last accepted step.

        Raises:
            RuntimeError: If the contact belongs to no problem yet.
            TypeError: If a tag is no integer.
            ValueError: If neither surface has a tag.
        """
        surfaces = [self.slave]
        if isinstance(self.master, Surface) and not self.is_self:
            surfaces.append(self.master)
        some = checked_tags(tags, surfaces)
        if some not in self._shares:
            V = self.fields.traction.function_space
            self._shares[some] = shares_of(self.fields, surfaces, some, V)
        return ContactPart(self.fields, self._shares[some])

    def plot(
        self,
        path: str | Path | None = None,
        *,
        scale: float = 1.0,
        camera: Sequence[float] | None = None,
    ) -> None:
        """Draw the deformed bodies, the obstacle and the contact pressure, by PyVista.

        In 2D the pressure stands upon the slave surface as a strip as high as it is; in 3D the
        slave facets have its colours, and one looks at them through the front of the bodies, of
        which the insides are drawn. All ranks must take part; rank 0 draws.

        Args:
            path: The picture, ``.png`` or ``.jpg``; a window if None.
            scale: Factor of the displacement; obstacles stay where they are.
            camera: Direction from the bodies to the viewer in 3D, shape (3,).

        Raises:
            ImportError: If PyVista is not installed.
            OSError: If the folder of the picture cannot be made.
            RuntimeError: If the contact belongs to no problem yet.
            TypeError: If an argument is of another kind.
            ValueError: If the suffix is another one, or a number is out of its range.
        """
        pictures.plot([self], path, scale, camera)


def _named(surface: Surface, V: fem.FunctionSpace) -> NamedSurface:
    """Name and facets of a surface."""
    facets = surface.facet_nodes(V)
    return str(surface), facets.offsets, facets.nodes


def check_contacts(contacts: Any) -> None:
    """Check that there are contacts and each is listed once.

    Args:
        contacts: Contacts of a problem.

    Raises:
        TypeError: If they are no list, or something else is among them.
        ValueError: If there is none, or one appears twice.
    """
    if isinstance(contacts, Contact):
        raise TypeError("contacts must be a list: write contacts=[contact]")
    if not isinstance(contacts, Sequence):
        kind = "None" if contacts is None else type(contacts).__name__
        raise TypeError(f"contacts must be a list of contactx.Contact, not {kind}")
    for contact in contacts:
        if not isinstance(contact, Contact):
            raise TypeError(
                f"contacts holds a {type(contact).__name__}: pass a list of contactx.Contact"
            )
    if len(contacts) == 0:
        raise ValueError("contacts is empty: pass at least one Contact")
    if len(set(map(id, contacts))) < len(contacts):
        raise ValueError("contacts lists the same Contact twice: list each once")


def _check_options(
    slave: Any,
    master: Any,
    *,
    friction: Any,
    sliding: Any,
    method: Any,
    tied: Any,
    search_distance: Any,
    excluded_distance: Any,
    offset: Any,
    adjust: Any,
    smooth: Any,
    tangential_factor: Any,
    name: Any,
) -> None:
    """Check the kinds of the arguments of a Contact; they are described there.

    Raises:
        TypeError: If an argument is of another kind.
        ValueError: If the surfaces share facets, or an option is out of its range.
    """
    if name is not None and not (isinstance(name, str) and re.fullmatch(r"[\w-]+", name)):
        kind = TypeError if not isinstance(name, str) else ValueError
        raise kind(f"name is {name!r}: give a text of letters, digits, _ and -, such as 'seal'")
    if not isinstance(slave, Surface):
        raise TypeError(
            f"slave must be a contactx.Surface, not {type(slave).__name__}: "
            "write Surface(facet_tags, tag)"
        )
    if not isinstance(master, Surface | Obstacle):
        is_class = isinstance(master, type)
        given = f"the class {master.__name__}" if is_class else type(master).__name__
        raise TypeError(
            f"master must be a contactx.Surface or a rigid obstacle, not {given}: write "
            "Surface(facet_tags, tag), or Plane, Sphere, Cylinder or LevelSet"
        )
    if (
        isinstance(master, Surface)
        and slave.facet_tags.topology is master.facet_tags.topology
        and not _is_self(slave, master)
    ):
        topology = slave.facet_tags.topology
        shared = np.intersect1d(slave.facets, master.facets)
        owned = shared < topology.index_map(slave.facet_tags.dim).size_local
        count = reduce.total(topology.comm, np.count_nonzero(owned))
        if count > 0:
            raise ValueError(
                f"slave and master overlap: {slave} and {master} have {count} facets in common. "
                "Give each surface its own tags; for self-contact the same surface twice"
            )
    if not isinstance(sliding, str) or sliding not in _SLIDING:
        raise ValueError(f'sliding must be "finite" or "small", not {sliding!r}')
    if not isinstance(method, str) or method not in _METHODS:
        raise ValueError(
            f'method must be "node-to-surface" or "surface-to-surface", not {method!r}'
        )
    numbers = "a number, a fem.Constant or a fem.Function"
    for name, value in (("friction", friction), ("offset", offset)):
        is_law = name == "friction" and isinstance(value, FrictionLaw)
        if not (is_law or is_number(value) or isinstance(value, fem.Constant | fem.Function)):
            raise TypeError(f"{name} must be {numbers}, not {described(value)}")
    for name, value in (("friction", friction), ("offset", offset)):
        if is_number(value) and not (np.isfinite(value) and (name == "offset" or value >= 0)):
            wanted = "a finite number" if name == "offset" else "a number of at least 0"
            raise ValueError(f"{name} is {value}: give {wanted}")
    check_switch("tied", tied)
    check_switch("smooth", smooth)
    lengths = (
        ("search_distance", search_distance, "length"),
        ("excluded_distance", excluded_distance, "length along the surface"),
        ("adjust", adjust, "length"),
    )
    for name, value, what in lengths:
        if not (value is None or is_number(value)):
            raise TypeError(f"{name} is {described(value)}: give a {what}, or None")
    if not is_number(tangential_factor):
        raise TypeError(
            f"tangential_factor is {described(tangential_factor)}: give a number, such as 0.05"
        )


def _joined(
    where: mesh.MeshTags | Surface | Sequence[Surface],
    more: tuple[int | Iterable[int] | Surface, ...],
) -> Surface:
    """Join the surfaces that ``Contact.all`` is given.

    Raises:
        TypeError: If an argument is of another kind.
        ValueError: If there is no surface, or they have different facet tags.
    """
    if isinstance(where, Surface):
        surfaces: list[Any] = [where, *more]
    elif isinstance(where, Sequence):
        surfaces = [*where, *more]
    else:
        values: tuple[Any, ...] = more
        if not more and isinstance(where, mesh.MeshTags):
            present = where.topology.comm.allgather(np.unique(where.values).tolist())
            values = (sorted({value for theirs in present for value in theirs}),)
        return Surface(where, *values)
    if not surfaces:
        raise ValueError("Contact.all has no surface: pass at least one")
    for surface in surfaces:
        if not isinstance(surface, Surface):
            raise TypeError(
                f"Contact.all takes surfaces alone or facet tags first, not {described(surface)} "
                "among surfaces: write Contact.all([surface, other]) or Contact.all(facet_tags, 1)"
            )
        if surface.facet_tags is not surfaces[0].facet_tags:
            raise ValueError(
                f"{surfaces[0]} and {surface} have different facet tags: put the tags of all "
                "surfaces into one dolfinx MeshTags"
            )
    tags = dict.fromkeys(tag for surface in surfaces for tag in surface.tags)
    return Surface(surfaces[0].facet_tags, *tags)


def _is_self(slave: Surface, master: Surface | Obstacle) -> bool:
    """True if slave and master are the same surface: the same tags."""
    if not isinstance(master, Surface):
        return False
    return slave is master or (
        slave.facet_tags is master.facet_tags and set(slave.tags) == set(master.tags)
    )
