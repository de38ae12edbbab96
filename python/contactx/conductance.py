# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Flow of heat, charge or fluid across a contact."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from petsc4py import PETSc

import numpy as np
import numpy.typing as npt

import basix.ufl
from contactx import cpp as core
from contactx._host.checks import described, is_number
from contactx._host.nodal_values import matching_nodes
from contactx._host.nodes import degree_of
from contactx.contact import Contact
from contactx.obstacles import Obstacle
from dolfinx import fem

type Array = npt.NDArray[np.float64]
type Index = npt.NDArray[np.int64]
type Coefficient = float | Callable[[Array, Array], npt.ArrayLike]


class Conductance:
    """Flow from the slave to the master of a contact, q = h(p, g) (T_slave - T_master) per area.

    T is a scalar field such as a temperature, p the recovered contact pressure and g the gap. What
    leaves the slave arrives at the master, whether the meshes match or not: see
    ``results/conductance.h`` and theory/conductance of the manual. Flows are integrals with
    the contact's weight, and over reference areas.

    Given to a ``ContactProblem`` that solves for displacement and T together, it is part of that
    system, with its derivatives by T, by the pressure and by the gap. Where T is solved for by
    itself, after the contact, ``matrix`` and ``residual`` must be added to its system.

    Attributes:
        contact: The contact.
        field: The field T.
        coefficient: The coefficient h.
        obstacle_value: Value of T at a rigid obstacle.
    """

    def __init__(
        self,
        contact: Contact,
        field: fem.Function,
        coefficient: Coefficient,
        *,
        obstacle_value: float | fem.Constant | None = None,
    ):
        """Create a conductance.

        Args:
            contact: The contact.
            field: Field in the scalar Lagrange space of the displacement's degree and mesh.
            coefficient: Flow per area and difference of T: a number, or a function of the contact
                pressures (force/area) and gaps (a length) of some nodes, arrays of shape (n,) of
                numbers that are at least 0, that returns as many values. They must be finite and
                not negative. Nodes that have no master in front of them are left out.
            obstacle_value: T of a rigid obstacle; only there, and needed there.

        Raises:
            TypeError: If an argument is of another kind.
            ValueError: If the coefficient is negative or not finite, or obstacle_value is missing
                or has no place.
        """
        if not isinstance(contact, Contact):
            raise TypeError(f"contact must be a contactx.Contact, not {described(contact)}")
        if not isinstance(field, fem.Function):
            raise TypeError(f"field must be a dolfinx.fem.Function, not {described(field)}")
        if not (callable(coefficient) or is_number(coefficient)):
            raise TypeError(
                f"coefficient is {described(coefficient)}: give a number, or a function of the "
                "pressures and gaps"
            )
        if obstacle_value is not None and not (
            is_number(obstacle_value) or isinstance(obstacle_value, fem.Constant)
        ):
            raise TypeError(
                f"obstacle_value is {described(obstacle_value)}: give a number or a fem.Constant"
            )
        self.contact = contact
        self.field = field
        self.coefficient = coefficient
        self.obstacle_value = obstacle_value
        core.Coefficient(coefficient)
        core.check_obstacle_value(self._obstacle_value, isinstance(contact.master, Obstacle))
        # Node of the field at each of the bulk's nodes
        self._nodes: npt.NDArray[np.int32] | None = None

    def check(self) -> None:
        """Check that the field is one of the contact's nodes; all ranks must take part.

        Raises:
            RuntimeError: If the contact belongs to no problem yet.
            ValueError: If it is of another space or mesh.
        """
        if self._nodes is not None:
            return
        V = self.contact.discrete.halo.host.space
        Q = self.field.function_space
        element, degree = Q.ufl_element(), degree_of(V)
        fits = (
            not isinstance(element, basix.ufl._MixedElement)
            and element.element_family == basix.ElementFamily.P
            and element.degree == degree
            and element.block_size == 1
            and not element.discontinuous
        )
        if Q.mesh is not V.mesh or not fits:
            raise ValueError(
                f"the field of a conductance is of {element}: take "
                f'functionspace(mesh, ("Lagrange", {degree})) on the displacement\'s mesh, whose '
                "nodes are those of contact"
            )
        self._nodes = matching_nodes(V, Q)

    @property
    def flow(self) -> float:
        """Flow from the slave to the master, of all ranks, for field and contact as they are now.

        All ranks must take part.
        """
        return self._core().flow(self._values())

    def residual(self) -> Array:
        """Flow out of each of the field's dofs that this rank owns; all ranks must take part.

        It belongs to the left-hand side of a balance: the residual of UFL's
        ``inner(k * grad(T), grad(v)) * dx - Q * v * dx`` plus this is zero.

        Returns:
            Flow from the slave's dofs, negative into the master's, shape (num_owned,): the unit of
            the coefficient times T times area.
        """
        sums = self._core().residual(self._values())
        residual: Array = np.empty_like(sums)
        assert self._nodes is not None
        residual[self._nodes[: len(sums)]] = sums
        return residual

    def matrix(self) -> PETSc.Mat:
        """Derivative of the residual by the field, over the dofs of its space.

        It is symmetric and positive semidefinite. All ranks must take part. Rows of Dirichlet
        conditions are not treated; add it before these are::

            A = fem.petsc.assemble_matrix(a, bcs=bcs)
            A.assemble()
            C = conductance.matrix()
            C.zeroRowsColumnsLocal(bc.dof_indices()[0], diag=0.0)
            A.axpy(1.0, C)

        Returns:
            A new matrix, flow per unit of T.
        """
        entries = self._core().by_field()
        dofs = self._numbers()
        index_map = self.field.function_space.dofmap.index_map
        size = (index_map.size_local, None)
        C = PETSc.Mat().createAIJ((size, size), comm=self._halo.comm)
        places = (
            dofs[numbers].astype(PETSc.IntType) for numbers in (entries.rows, entries.columns)
        )
        C.setPreallocationCOO(*places)
        C.setValuesCOO(entries.values, addv=PETSc.InsertMode.INSERT)
        ghosts = np.arange(index_map.size_local + index_map.num_ghosts, dtype=np.int32)
        numbers = index_map.local_to_global(ghosts).astype(PETSc.IntType)
        lgmap = PETSc.LGMap().create(numbers, comm=self._halo.comm)
        C.setLGMap(lgmap, lgmap)
        return C

    def derivatives(self) -> tuple[core.Triplets, core.Triplets, core.Triplets]:
        """Derivatives of the flows out of the nodes; all ranks must take part.

        Returns:
            Those by the field, nodes by nodes; by the displacement, nodes by displacements; by the
            contact's multipliers, nodes by multipliers of this rank's slave nodes.
        """
        return self._core().derivatives(self._values())

    @property
    def _halo(self) -> Any:
        return self.contact.discrete.halo

    def at_nodes(self, values: npt.NDArray[Any]) -> npt.NDArray[Any]:
        """Values of the field's owned dofs at all nodes; all ranks must take part.

        Args:
            values: Values, shape (at least num_owned,).

        Returns:
            Values of this rank's nodes, ghosts included, shape (num_nodes,).
        """
        assert self._nodes is not None
        own = np.ascontiguousarray(values[self._nodes[: self._halo.num_owned]])
        every: npt.NDArray[Any] = self._halo.scatter_forward(own)
        return every

    def _numbers(self) -> Index:
        """Numbers of the field's dofs over the ranks at all nodes."""
        index_map = self.field.function_space.dofmap.index_map
        first, last = index_map.local_range
        return self.at_nodes(np.arange(first, last, dtype=np.int64))

    def _values(self) -> Array:
        """Values of the field at the nodes that this rank owns, shape (num_owned,)."""
        assert self._nodes is not None
        values: Array = self.field.x.array[self._nodes[: self._halo.num_owned]]
        return values

    @property
    def _obstacle_value(self) -> float | None:
        value = self.obstacle_value
        if value is None:
            return None
        return float(value.value if isinstance(value, fem.Constant) else value)

    def _core(self) -> core.Conductance:
        """The core's, with the coefficient and the obstacle's value of now."""
        self.check()
        return core.Conductance(
            self.contact.discrete,
            self.contact.fields.results,
            core.Coefficient(self.coefficient),
            self._obstacle_value,
        )


def check_conductances(
    conductances: Any, contacts: list[Contact], functions: list[fem.Function], displacement: Any
) -> list[Conductance]:
    """Check the argument ``conductances`` of a problem.

    Args:
        conductances: Conductances.
        contacts: Contacts of the problem.
        functions: Functions that are solved for.
        displacement: The displacement among that.

    Raises:
        TypeError: If it is no list of conductances.
        ValueError: If one is of another contact, or of a field that is not solved for.
    """
    if conductances is None:
        return []
    if isinstance(conductances, Conductance):
        raise TypeError("conductances must be a list: write conductances=[conductance]")
    if not isinstance(conductances, list | tuple):
        raise TypeError(f"conductances must be a list, not {described(conductances)}")
    for k, c in enumerate(conductances):
        if not isinstance(c, Conductance):
            raise TypeError(f"conductances[{k}] must be a Conductance, not {described(c)}")
        if not any(c.contact is contact for contact in contacts):
            raise ValueError(
                f"conductances[{k}] is of {c.contact}, which is none of the problem's contacts: "
                "list it in contacts"
            )
        if not any(c.field is w for w in functions) or c.field is displacement:
            raise ValueError(
                f"the field of conductances[{k}] is not solved for: give it among the functions "
                "u=[displacement, field]; a part of a mixed space will not do. Where it is solved "
                "for by itself, leave conductances out and take matrix() and residual()"
            )
    return list(conductances)
