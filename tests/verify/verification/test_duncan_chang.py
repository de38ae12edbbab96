# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Rockfill of the E-B model: its curves in closed form, and a dam of it."""

import numpy as np
import pytest

from dam_results import laws
from dam_scene import Dam, DamSetting, run
from duncan_chang import ATMOSPHERE, DuncanChang
from meshes import DamFace

ROCK = DuncanChang()
MODEL = DamFace(
    slabs=3, height=16.0, rows=8, layers=2, joint_size=0.8, rockfill_cells=3, rockfill_rows=8
)
STAGES = 1


@pytest.mark.parametrize("confining", [0.1, 0.4, 1.5])
def test_triaxial_test(confining):
    """Tangents of a test at one confining stress add up to the hyperbola of Kondner."""
    initial = ROCK.K * ATMOSPHERE * (confining / ATMOSPHERE) ** ROCK.n
    phi = np.radians(ROCK.phi - ROCK.phi_loss * np.log10(confining / ATMOSPHERE))
    strength = 2 * confining * np.sin(phi) / (1 - np.sin(phi))
    shear, strain = 0.0, 0.0
    steps = 4000
    for _ in range(steps):
        young, _ = ROCK.moduli(np.array([confining + shear]), np.array([confining]), np.zeros(1))
        shear += 0.9 * strength / steps
        strain += 0.9 * strength / steps / float(young[0])
    expected = 1 / (1 / initial + ROCK.failure_ratio * strain / strength)
    assert shear / strain == pytest.approx(expected, rel=1e-3)


def test_unloading_is_stiffer():
    largest, least = np.array([1.2, 0.5]), np.array([0.3, 0.3])
    most = np.full(2, ROCK.state(largest[:1], least[:1])[0])
    young, nu = ROCK.moduli(largest, least, most)
    assert young[1] == pytest.approx(
        ROCK.K_ur * ATMOSPHERE * (least[1] / ATMOSPHERE) ** ROCK.n, rel=1e-12
    )
    assert young[1] > 3 * young[0]
    assert np.all((nu >= 0.05) & (nu <= 0.45))


def test_volume_follows_the_bulk_modulus():
    least = np.array([0.5])
    young, nu = ROCK.moduli(least + 1.0, least, np.zeros(1))
    bulk = ROCK.K_b * ATMOSPHERE * (least / ATMOSPHERE) ** ROCK.m
    assert young / (3 * (1 - 2 * nu)) == pytest.approx(bulk, rel=1e-12)


def solved(**options):
    dam = Dam(DamSetting(MODEL, ROCK))
    found = []
    run(dam, STAGES, each=lambda *_: found.append(laws(dam)), progress=False, **options)
    return dam, found


@pytest.fixture(scope="module")
def dam():
    return solved()


def test_laws_hold_in_all_stages(dam):
    for stage in dam[1]:
        assert stage.balance < 1e-7
        assert stage.reactions < 1e-8
        assert stage.penetration < 1e-9
        assert stage.coulomb < 1e-8


def test_the_own_weight_makes_deep_rockfill_stiff(dam):
    """By a power of the depth; what the water presses on has yielded since."""
    new = Dam(DamSetting(MODEL, ROCK))
    rock = new.is_rockfill.x.array > 0
    least, _, largest = new.increments.principal_stresses().T
    assert least == pytest.approx(ROCK.at_rest * largest)
    young = new.young.x.array[rock]
    deep = least > 0.1
    factor = young[deep] / least[deep] ** ROCK.n
    assert np.ptp(factor) < 0.2 * factor.max()
    assert young.max() > 2 * young.min()
    assert dam[0].young.x.array[rock].min() < 0.8 * young.min()


def test_a_restart_goes_on(dam, tmp_path):
    """The same displacements, stresses and moduli from a checkpoint of the full reservoir."""

    class StopError(Exception):
        pass

    def stop(_, step):
        if step.t == 2:
            raise StopError

    file = tmp_path / "dam.npz"
    first = Dam(DamSetting(MODEL, ROCK))
    with pytest.raises(StopError):
        run(first, STAGES, each=stop, progress=False, checkpoint=file)
    second = Dam(DamSetting(MODEL, ROCK))
    run(second, STAGES, progress=False, restart=file)
    pairs = [(second.u, dam[0].u)]
    pairs += zip(second.increments.history, dam[0].increments.history, strict=True)
    for one, other in pairs:
        most = np.abs(other.x.array).max()
        assert np.abs(one.x.array - other.x.array).max() <= 1e-7 * most
