# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""What the C++ core takes for granted is checked before: errors name the argument."""

import numpy as np
import pytest

from contactx import cpp as core

_SLAVE = ([0, 3], [0, 2, 1])
_MASTER = ([0, 3, 7], [3, 4, 5, 4, 6, 5, 7])
_X = np.array(
    [
        [[0.1, 0.1, 0.1], [0.6, 0.1, 0.1], [0.1, 0.6, 0.1]],
        [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]],
        [[2.0, 0.0, 0.0], [2.0, 1.0, 0.0], [9.0, 9.0, 9.0]],
    ]
).reshape(-1, 3)[:8]


def _ints(values):
    return np.array(values, dtype=np.int32)


def _lists(slave=_SLAVE, master=_MASTER):
    return [_ints(values) for values in (*slave, *master)]


def _pairing():
    pairing = core.Pairing(*_lists(), 3)
    pairing.update(_X, np.inf, np.zeros(3, dtype=np.int8))
    return pairing


BAD_FACETS = [
    ([], [], "offsets must begin with 0"),
    ([1, 3], [0, 1, 2], "offsets must begin with 0"),
    ([-2, 0], [], "offsets must begin with 0"),
    ([0, 3], [0, 1], "offsets must end at 2"),
    ([0, 4, 3], [0, 1, 2], "offsets must give.*three or four in 3D: facet 1 has -1"),
    ([0, 2], [0, 1], "offsets must give.*three or four in 3D: facet 0 has 2"),
    ([0, 3], [0, -1, 2], "nodes must be node numbers.*there is -1"),
    ([0, 3], [0, 1, 2**31 - 1], "nodes must be node numbers"),
]


@pytest.mark.parametrize(("offsets", "nodes", "message"), BAD_FACETS)
def test_facets(offsets, nodes, message):
    bad = _ints(offsets), _ints(nodes)
    for call in (
        lambda: core.nodal_areas(*bad, _X, 3),
        lambda: core.nodal_normals(*bad, _X, 3),
        lambda: core.Finder(*bad, 3),
        lambda: _pairing().set_master(*bad),
    ):
        with pytest.raises(ValueError, match=message):
            call()
    for side, lists in (("slave", _lists(slave=bad)), ("master", _lists(master=bad))):
        for kind in (core.Pairing, core.FacetSearch):
            with pytest.raises(ValueError, match=f"{side}_{message}"):
                kind(*lists, 3)


@pytest.mark.parametrize("gdim", [-1, 0, 1, 4])
def test_dimension(gdim):
    for call in (
        lambda: core.nodal_areas(*_lists()[:2], _X, gdim),
        lambda: core.Finder(*_lists()[:2], gdim),
        lambda: core.FacetSearch(*_lists(), gdim),
        lambda: core.coefficients("frictionless", 3, gdim),
        lambda: core.rigid_mortar_layout(3, gdim),
    ):
        with pytest.raises(ValueError, match=f"gdim must be 2 or 3, not {gdim}"):
            call()


def test_positions():
    closed = np.zeros(3, dtype=np.int8)
    none, no_values = _ints([]), np.zeros(0)
    pairing, search = _pairing(), core.FacetSearch(*_lists(), 3)
    pairs = search.find(_X, np.inf, 0.0)
    for x in (_X[:7], np.append(_X, 0.0), np.zeros(0)):
        for call in (
            lambda x: core.nodal_areas(*_lists()[2:], x, 3),
            lambda x: core.Finder(*_lists()[2:], 3).find(x, _X, _X, np.ones(8)),
            lambda x: pairing.update(x, 1.0, closed),
            lambda x: pairing.seek(x, 1.0),
            lambda x: pairing.feet(x, _X[:3]),
            lambda x: pairing.places(x, np.zeros((3, 2))),
            lambda x: pairing.settle(none, none, none, no_values, no_values, x, 1.0, closed),
            lambda x: search.find(x, 1.0, 0.0),
            lambda x: search.integrals(pairs, x, _X),
        ):
            with pytest.raises(ValueError, match=r"^x must hold 3 coordinates for each of 8 nodes"):
                call(x)
        with pytest.raises(ValueError, match="reference must hold 3 coordinates"):
            search.integrals(pairs, _X, x)


def test_slave_nodes_that_are_paired_elsewhere_have_positions_too():
    pairing = core.Pairing(_ints([0, 3]), _ints([0, 1, 9]), *_lists()[2:], 3, 2)
    with pytest.raises(ValueError, match="each of 10 nodes"):
        pairing.update(_X, 1.0, np.zeros(2, dtype=np.int8))


def test_what_is_found():
    pairing = _pairing()
    good = {"which": [0], "facet": [0], "feature": [0], "xi": [0, 0], "normal": [0, 0, 1]}
    for name, value, message in (
        ("which", [3], "which must be numbers of slave nodes, of which there are 3: there is 3"),
        ("which", [-1], "which must be numbers"),
        ("facet", [2], "facet must be numbers of master facets"),
        ("facet", [-2], "facet must be numbers"),
        ("facet", [0, 0], "facet must have 1 values"),
        ("feature", [7], "feature must be from 0 to 6, not 7"),
        ("feature", [-1], "feature must be from 0 to 6"),
        ("xi", [0], "xi must have 2 values"),
        ("normal", [0], "normal must have 3 values"),
    ):
        given = good | {name: value}
        kinds = [np.int32] * 3 + [np.float64] * 2
        arrays = [np.array(v, dtype=t) for v, t in zip(given.values(), kinds, strict=True)]
        with pytest.raises(ValueError, match=message):
            pairing.settle(*arrays, _X, 1.0, np.zeros(3, dtype=np.int8))


def test_one_value_a_slave_node():
    pairing = _pairing()
    with pytest.raises(ValueError, match="closed must have 3 values"):
        pairing.update(_X, 1.0, np.zeros(2, dtype=np.int8))
    with pytest.raises(ValueError, match="points must have 9 values"):
        pairing.feet(_X, _X)
    with pytest.raises(ValueError, match="xi must have 6 values"):
        pairing.places(_X, np.zeros(5))
    finder = core.Finder(*_lists()[2:], 3)
    with pytest.raises(ValueError, match="points must have 6 values, 3 for each reach"):
        finder.find(_X, _X, _X[:2], np.ones(2))
    with pytest.raises(ValueError, match="normals must have 24 values"):
        finder.find(_X, _X, _X[:2], np.ones(8))


def test_pairs_with_facets_that_are_gone_are_restored_first():
    pairing = core.Pairing(*_lists(), 3)
    pairs = _ints([1, -1, 1]), _ints([0, 0, 0]), np.zeros(6), np.zeros(9), np.zeros(9)
    pairing.restore(*pairs)
    pairing.set_master(_ints([0, 3]), _ints([3, 4, 5]))
    for call in (
        lambda: pairing.seek(_X, 1.0),
        lambda: pairing.update(_X, 1.0, np.zeros(3, dtype=np.int8)),
        lambda: pairing.feet(_X, _X[:3]),
        lambda: pairing.places(_X, np.zeros((3, 2))),
    ):
        with pytest.raises(ValueError, match="facet must be numbers of master facets"):
            call()
    pairing.restore(_ints([0, -1, 0]), *pairs[1:])
    assert len(pairing.seek(_X, np.inf)) <= 3


def test_pairs_of_another_search():
    lists = _lists()
    search = core.FacetSearch(*lists, 3)
    pairs = search.find(_X, np.inf, 0.0)
    assert len(pairs.slave) > 0
    none = core.FacetSearch(_ints([0]), _ints([]), *lists[2:], 3)
    with pytest.raises(ValueError, match=r"pairs\.slave must be numbers of slave facets"):
        none.integrals(pairs, _X, _X)
    none = core.FacetSearch(*lists[:2], _ints([0]), _ints([]), 3)
    with pytest.raises(ValueError, match=r"pairs\.master must be numbers of master facets"):
        none.integrals(pairs, _X, _X)
    with pytest.raises(ValueError, match="normal must have 3 values, 3 for each slave facet"):
        search.integrals(pairs, _X, _X, np.zeros((2, 3)))


def test_state_of_the_slave_nodes():
    for arguments, message in (
        ((-1, 2, True), "num_nodes must not be negative"),
        ((2, 4, True), "gdim must be 2 or 3, not 4"),
    ):
        with pytest.raises(ValueError, match=message):
            core.NodeState(*arguments)
    state = core.NodeState(2, 3, True)
    for bad in (-1, 2):
        with pytest.raises(ValueError, match="nodes must be numbers of slave nodes"):
            state.close(np.array([0, bad]))
    assert not state.closed.any()
    with pytest.raises(ValueError, match="origin must have 6 values"):
        state.project(np.zeros(1))


def test_arrays_of_the_slave_nodes_are_the_state_itself():
    state = core.NodeState(2, 3, True)
    multiplier, ceded = state.multiplier, state.ceded
    state.gap[:] = -1.0
    multiplier[:], ceded[:] = np.arange(6.0), [False, True]
    state.normal[:] = [0, 0, 1]
    assert np.array_equal(state.pressure, [2, 5])
    assert np.array_equal(state.closing(), [True, False])
    # They outlive the name
    del state
    assert multiplier[5] == 5
    assert ceded[1]


def test_laws_of_other_multipliers():
    scalar, vector = core.NodeState(2, 3, False), core.NodeState(2, 3, True)
    for law, state in (
        (core.Frictionless(), vector),
        (core.Coulomb(), scalar),
        (core.Tied(), scalar),
    ):
        with pytest.raises(ValueError, match="multipliers for the law"):
            law.evaluate(state)
    with pytest.raises(ValueError, match="friction must have a coefficient for each of 2"):
        core.Coulomb().evaluate(vector)


def test_sizes_of_layouts():
    with pytest.raises(ValueError, match="num_nodes must be from 0 to 9, not -1"):
        core.coefficients("tied", -1, 3)
    with pytest.raises(ValueError, match="num_slaves must be from 1 to 9, not 2147483647"):
        core.mortar_layout(2**31 - 1, 3)
    with pytest.raises(ValueError, match="num_nodes must be from 2 to 4, not 5"):
        core.shape_functions(5, np.zeros((1, 2)))
    with pytest.raises(ValueError, match="xi must have 2 values"):
        core.shape_functions(3, np.zeros(3))


def _one_pair():
    """A slave node over a triangle."""
    layout = core.pair_layout
    data = np.zeros((1, layout["size"]))
    data[0, layout["xi"] : layout["xi"] + 2] = 0.25
    data[0, layout["normal"] + 2] = 1
    return core.Pairs(_ints([[0]]), _ints([[3, 0, 1, 2]]), data)


def test_pairs_look_at_their_arrays():
    pairs = _one_pair()
    assert pairs.num_nodes == 3
    assert pairs.slip is None
    assert not pairs.is_movement
    data, normal = pairs.data, pairs.normal
    del pairs
    assert np.array_equal(normal, [[0, 0, 1]])
    assert np.shares_memory(normal, data)
    assert not data.flags.writeable
    for shapes in (((1, 1), (2, 4), (1, 9)), ((1, 1), (1, 4), (9,)), ((1, 2), (1, 1), (1, 9))):
        slaves, nodes, data = (np.zeros(shape) for shape in shapes)
        with pytest.raises(ValueError, match=r"row for each pair|begin with the slave nodes"):
            core.Pairs(slaves.astype(np.int32), nodes.astype(np.int32), data)


def test_kernels_that_there_are_not():
    for name in ("medium", "x"):
        with pytest.raises(ValueError, match=f"no kernel for {name} sliding"):
            core.kernel("frictionless", name, "gap", 3, 3)
    with pytest.raises(ValueError, match="no contact law sticky"):
        core.terms("sticky", "finite", 3, 3)
