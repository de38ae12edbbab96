# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""What contact needs to know of a rigid obstacle."""

from __future__ import annotations

from abc import ABC, abstractmethod
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

import ufl
from contactx.arguments import is_number
from dolfinx import fem

type Parameter = npt.ArrayLike | fem.Constant


@dataclass(frozen=True)
class Geometry:
    """An obstacle seen from n points.

    Attributes:
        gap: Signed distance, or what is one to first order: positive outside, shape (n,).
        gradient: Gradient of the gap, shape (n, gdim).
        normal: Outward unit normal, shape (n, gdim).
        curvature: Derivative of the normal by the position, shape (n, gdim, gdim).
    """

    gap: npt.NDArray[np.float64]
    gradient: npt.NDArray[np.float64]
    normal: npt.NDArray[np.float64]
    curvature: npt.NDArray[np.float64]


@dataclass(frozen=True)
class Placement:
    """Where a rigid obstacle is.

    Attributes:
        point: A point that moves with it, shape (gdim,).
        direction: A unit vector that turns with it, shape (gdim,); None where none is known.
    """

    point: npt.NDArray[np.float64]
    direction: npt.NDArray[np.float64] | None = None

    def carry(self, x: npt.NDArray[np.float64], to: Placement) -> npt.NDArray[np.float64]:
        """Carry points of the obstacle's material from this placement to another one.

        It turns on the shortest way from one direction to the other, and does not spin about it.

        Args:
            x: Points, shape (n, gdim).
            to: The other placement.

        Returns:
            Points, shape (n, gdim).
        """
        carried: npt.NDArray[np.float64] = to.point + (x - self.point) @ self.turn(to).T
        return carried

    def turn(self, to: Placement) -> npt.NDArray[np.float64]:
        """Rotation to another placement, shape (gdim, gdim)."""
        if self.direction is None or to.direction is None:
            return np.eye(len(self.point))
        return _rotation(self.direction, to.direction)


def _rotation(a: npt.NDArray[np.float64], b: npt.NDArray[np.float64]) -> npt.NDArray[np.float64]:
    """Shortest rotation from unit vector a to b: I + K + K^2 / (1 + a.b), K = b a^T - a b^T."""
    K = np.outer(b, a) - np.outer(a, b)
    cosine = float(a @ b)
    if cosine <= -1 + 1e-12:
        raise ValueError(
            "an obstacle turns by 180 degrees within a step, which has no shortest way: take "
            "smaller steps"
        )
    rotation: npt.NDArray[np.float64] = np.eye(len(a)) + K + K @ K / (1 + cosine)
    return rotation


class Obstacle(ABC):
    """Rigid body, a master without degrees of freedom.

    Its parameters may be numbers or ``fem.Constant``; a constant is read anew in every evaluation,
    so that changing its value moves the obstacle.

    Attributes:
        usual_mistake: What is probably wrong where a whole body is inside: a sentence.
        tells_movement: Whether ``placement`` says how its material moves.
        extent: Size of the largest surface that is measured against it, the same on all ranks;
            zero if none is known.
    """

    usual_mistake = "It is probably in the wrong place"
    tells_movement = True
    extent = 0.0

    @abstractmethod
    def evaluate(self, x: npt.NDArray[np.float64]) -> Geometry:
        """See the obstacle from points.

        Args:
            x: Points, shape (n, gdim).

        Returns:
            Gap, normal and their derivatives.
        """

    @abstractmethod
    def placement(self, gdim: int) -> Placement:
        """Where the obstacle is: its movement enters the slip of what touches it.

        Args:
            gdim: Geometric dimension.
        """

    def size(self) -> float:
        """Its diameter, infinite where none is known."""
        return float(np.inf)

    def parameters(self) -> npt.NDArray[np.float64]:
        """Current values of what moves it although ``placement`` does not tell, shape (n,)."""
        return np.zeros(0)

    def distance(self, x: npt.NDArray[np.float64]) -> npt.NDArray[np.float64]:
        """Gap alone, infinite where there is none.

        Args:
            x: Points, shape (n, gdim).

        Returns:
            Gaps, shape (n,).
        """
        return self.evaluate(x).gap

    def normals(self, x: npt.NDArray[np.float64]) -> npt.NDArray[np.float64]:
        """Outward unit normals alone, zero where there is none.

        Args:
            x: Points, shape (n, gdim).

        Returns:
            Normals, shape (n, gdim).
        """
        return self.evaluate(x).normal

    def level(self, x: npt.NDArray[np.float64]) -> npt.NDArray[np.float64]:
        """Function of the sign of the gap, of any scale, also where there is no normal.

        Args:
            x: Points, shape (n, gdim).

        Returns:
            Its values, shape (n,).
        """
        return self.distance(x)


def vector(value: Parameter, gdim: int, name: str) -> npt.NDArray[np.float64]:
    """Current value of a vector parameter.

    Args:
        value: Numbers or a constant.
        gdim: Geometric dimension.
        name: Name of the parameter.

    Returns:
        The value, shape (gdim,).

    Raises:
        TypeError: If it does not consist of real numbers.
        ValueError: If it is not finite or of another size.
    """
    given = value.value if isinstance(value, fem.Constant) else value
    try:
        array = np.array([]) if isinstance(given, ufl.core.expr.Expr) else np.array(given, float)
    except (TypeError, ValueError):
        array = np.array([])
    if array.size == 0:
        raise TypeError(
            f"{name} is {given!r}: give {gdim} finite numbers, or a fem.Constant of them"
        )
    if array.shape != (gdim,) or not np.all(np.isfinite(array)):
        raise ValueError(f"{name} is {array}: give {gdim} finite numbers, as the mesh has")
    return array


def direction(value: Parameter, gdim: int, name: str) -> npt.NDArray[np.float64]:
    """Current value of a direction, as a unit vector.

    Args:
        value: Numbers or a constant.
        gdim: Geometric dimension.
        name: Name of the parameter.

    Returns:
        Unit vector, shape (gdim,).

    Raises:
        ValueError: If it is zero, not finite or of another size.
    """
    array = vector(value, gdim, name)
    largest = np.abs(array).max()
    if largest == 0:
        raise ValueError(f"{name} is a zero vector: give a direction")
    # Squares of very small and very large components are none
    array = array / largest if not 1e-100 < largest < 1e100 else array
    unit: npt.NDArray[np.float64] = array / np.linalg.norm(array)
    return unit


def positive(value: float | fem.Constant, name: str) -> float:
    """Current value of a positive number.

    Args:
        value: A number or a constant.
        name: Name of the parameter.

    Returns:
        The number.

    Raises:
        TypeError: If it is no real number.
        ValueError: If it is not finite and positive.
    """
    given = value.value if isinstance(value, fem.Constant) else value
    if not is_number(given):
        raise TypeError(f"{name} is {given!r}: give a positive number, or a fem.Constant of one")
    number = float(given)
    if not (np.isfinite(number) and number > 0):
        raise ValueError(f"{name} is {number}: give a positive number")
    return number
