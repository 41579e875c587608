"""What follows from the table of the channels of energy in the C++ library."""

from __future__ import annotations

import dataclasses
import pickle

import numpy as np
import pytest

import footfall
from footfall import ContactLaw, _channels, _core, plot

NAMES = [channel.name for channel in _core.CHANNELS]


def test_a_run_has_every_channel(rolling: footfall.Run) -> None:
    fields = [field.name for field in dataclasses.fields(footfall.Energy)]
    first = fields.index(NAMES[0])
    assert fields[first : first + len(NAMES)] == NAMES
    for name in NAMES:
        assert getattr(rolling.energy, name) == float(rolling.dataset[f"energy_{name}"][-1])
        assert rolling.dataset[f"sphere_energy_{name}"].dims == ("time", "sphere")
        assert f"- {name}: energy " in (footfall.Energy.__doc__ or "")


def test_what_is_worked_from_outside_is_all_that_a_total_is_less_than_its_channels(rolling: footfall.Run) -> None:
    data = rolling.dataset
    signs = {channel.name: -1 if channel.kind == "worked" else 1 for channel in _core.CHANNELS}
    total = data["energy_kinetic"] + data["energy_potential"] + sum(s * data[f"energy_{n}"] for n, s in signs.items())
    np.testing.assert_allclose(total, data["energy_total"], rtol=1e-14)


def test_a_response_has_every_channel(paper_law: ContactLaw) -> None:
    response = paper_law.evaluate([1e-4, 2e-4], 0.1, [0.1, 0], [1e-6, 0])
    fields = [field.name for field in dataclasses.fields(response)]
    assert fields[-len(NAMES) :] == [channel.response for channel in _core.CHANNELS]
    for channel in _core.CHANNELS:
        assert channel.response == channel.name + ("" if channel.kind == "held" else "_power")
        assert getattr(response, channel.response).shape == (2,)
        assert f"- {channel.response}: " in (footfall.Response.__doc__ or "")


def test_the_stack_of_energies_has_every_channel_and_what_comes_back_on_top() -> None:
    shown = {name: label for name, label, _ in plot.ENERGIES}
    assert [*shown][-2:] == ["potential", "kinetic"] and {*shown} == {*NAMES, "potential", "kinetic"}
    kinds = {channel.name: channel.kind for channel in _core.CHANNELS}
    order = [kinds[name] == "held" for name in shown if name in kinds]
    assert order == sorted(order)
    assert all(shown[channel.name] == channel.label for channel in _core.CHANNELS)


# As a program that has no extension reads it, and one that is older than the file.
def test_channels_that_the_table_does_not_have_are_those_of_the_file(
    rolling: footfall.Run, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(_channels, "TABLE", ())
    read = _channels.of_dataset(rolling.dataset)
    assert [channel.name for channel in read] == NAMES
    for channel, known in zip(read, _core.CHANNELS):
        assert (channel.kind, channel.label, channel.response) == (known.kind, known.label, known.response)


def test_a_run_of_a_newer_version_has_its_channels(rolling: footfall.Run) -> None:
    data = rolling.dataset
    added = {
        "sphere_energy_gears": data["sphere_energy_clutch"].assign_attrs(long_name="energy taken by the gears"),
        "energy_gears": data["energy_clutch"],
    }
    energy = footfall.Run(data.assign(added)).energy
    assert isinstance(energy, footfall.Energy)
    assert energy.gears == rolling.energy.clutch  # type: ignore[attr-defined]
    assert pickle.loads(pickle.dumps(energy)) == energy
    assert dataclasses.asdict(energy) == {**dataclasses.asdict(rolling.energy), "gears": rolling.energy.clutch}
