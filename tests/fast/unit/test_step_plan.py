# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Which t load steps attempt."""

import numpy as np
import pytest

from contactx.steps import make_plan


def walk(plan, fails=lambda start, t: False, iterations=lambda start, t: 5):
    """All t that are attempted, failed ones negative, until the end or the last failure."""
    tried = []
    while not plan.finished:
        start, t = plan.t, plan.next
        if fails(start, t):
            tried.append(-t)
            if not plan.cut():
                break
        else:
            tried.append(t)
            plan.accept(iterations(start, t))
            assert plan.t == t
    return tried


def test_equal_steps_end_at_one():
    assert walk(make_plan(10, 6, 10)) == [k / 10 for k in range(1, 11)]
    assert walk(make_plan(np.int64(1), 0, 10)) == [1.0]


def test_given_t_are_met_exactly():
    given = [0.1, 0.30000000000000004, 0.7]
    assert walk(make_plan(given, 6, 10)) == given
    assert walk(make_plan(np.array(given), 6, 10)) == given
    tried = walk(make_plan(given, 6, 10), lambda start, t: t - start > 0.07)
    assert set(given) <= set(tried)


def test_a_failed_step_is_halved_until_it_must_not_be():
    tried = walk(make_plan(2, 3, 10), lambda *_: True)
    assert tried == [-0.5, -0.25, -0.125, -0.0625]
    assert walk(make_plan(2, 0, 10), lambda *_: True) == [-0.5]


def test_halved_steps_grow_back_after_easy_ones():
    """Not at once: twice as long is what has just failed."""
    tried = walk(make_plan(2, 6, 10), lambda start, t: start == 0 and t > 0.1)
    assert tried == [-0.5, -0.25, -0.125, 0.0625, 0.125, 0.25, 0.5, 1.0]


def test_they_do_not_grow_after_hard_ones():
    hard = walk(make_plan(2, 6, 10), lambda s, t: s == 0 and t > 0.2, lambda *_: 11)
    assert hard == [-0.5, -0.25, *(k / 8 for k in range(1, 9))]
    assert walk(make_plan(2, 6, 11), lambda s, t: s == 0 and t > 0.2, lambda *_: 11) == [
        *(-0.5, -0.25, 0.125, 0.25, 0.5, 1.0)
    ]


def test_the_rest_of_a_step_is_halved_where_it_fails():
    """The step has grown beyond the given t; the next attempt must be shorter than the rest."""
    given = [1.0]
    tried = walk(make_plan(given, 6, 10), lambda s, t: t - s > (0.3 if s < 0.75 else 0.1))
    assert tried == [-1.0, -0.5, 0.25, 0.5, -1.0, 0.75, -1.0, -0.875, 0.8125, *tried[9:]]
    assert tried[-1] == 1.0
    sizes = np.diff([0.0, *(t for t in tried if t > 0)])
    assert np.all(np.log2(sizes) == np.round(np.log2(sizes)))


def test_steps_that_were_cut_stay_short_in_the_next_given_one():
    hard = walk(make_plan(2, 6, 4), lambda start, t: t - start > 0.3)
    assert hard == [-0.5, 0.25, 0.5, 0.75, 1.0]


@pytest.mark.parametrize("fails_at", [2.0, 0.3])
def test_a_saved_place_is_gone_on_from(fails_at):
    def fails(start, t):
        return start == 0 and t > fails_at

    whole, place = walk(make_plan(3, 6, 4), fails), make_plan(3, 6, 4)
    for _ in range(2):
        while fails(place.t, place.next):
            place.cut()
        place.accept(5)
    saved = loaded(make_plan(3, 6, 4), place)
    assert saved == place
    assert saved.t == place.t
    rest = walk(saved, fails)
    assert 0 < len(rest) < len(whole)
    assert rest == whole[-len(rest) :]


def loaded(plan, place):
    """A plan that goes on from the place of another one."""
    plan.load(np.array(place.given), place.place)
    return plan


def test_a_saved_place_serves_other_given_t():
    place = make_plan(4, 6, 10)
    place.accept(5)
    place.accept(5)
    assert walk(loaded(make_plan([0.2, 0.5, 0.6, 1.0], 6, 10), place)) == [0.6, 1.0]
    assert loaded(make_plan([0.2, 0.5], 6, 10), place).finished
    with pytest.raises(ValueError, match=r"at t = 0\.5, beyond the last given t = 0\.4"):
        loaded(make_plan([0.2, 0.4], 6, 10), place)
    place.accept(5)
    place.accept(5)
    assert loaded(make_plan(4, 6, 10), place).finished


@pytest.mark.parametrize(
    ("steps", "error", "message"),
    [
        ([0.0, 1.0], ValueError, "holds t = 0: each t must be above 0"),
        ([0.5, 0.5], ValueError, r"0\.5 after 0\.5: each t must be larger"),
    ],
)
def test_wrong_steps(steps, error, message):
    with pytest.raises(error, match=message):
        make_plan(steps, 6, 10)


def test_steps_may_end_in_the_users_time():
    assert walk(make_plan(4, 6, 10, 10.0)) == [2.5, 5.0, 7.5, 10.0]
    assert walk(make_plan([3, 20], 6, 10, 20)) == [3.0, 20.0]
    for wrong, error in (("10", TypeError), (0, ValueError), (np.inf, ValueError)):
        with pytest.raises(error, match="t_end is"):
            make_plan(4, 6, 10, wrong)
    with pytest.raises(ValueError, match="t = 21: each t must be above 0 and at most 20"):
        make_plan([3, 21], 6, 10, 20)
    with pytest.raises(ValueError, match="at most 1, or give t_end"):
        make_plan([3, 21], 6, 10)
