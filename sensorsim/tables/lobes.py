"""Sun lobes: the direct sun of the last hours, which acts on a wall all but linearly, told apart from all the rest.

A lobe is a direction d_k of the sun and a weight w_k [K]: a surface of normal n and absorptance a is warmer by a w_k
max(0, n . d_k) for the sun that stood there, in the variable of `straighten` and times a gain that goes by n. Tables
keep what goes with a as powers 0 and 1 of the reflectance. The lobes end where the sun sets on the surface, as the sun
itself does, so that what is left to the standard orientations has no such edge. Light is that of
`heat_balance.directional_irradiance`.

The first lobe is the sun of the moment and moves with it. The others stand where the sun is at certain clock times of
the image day, its nodes; light between two nodes goes to both, to each the more the nearer it is, and that since the
last node to it and to the sun of the moment. Light of earlier days goes to the nodes of its clock time. Weights are
zero before a node's time and straight between slices, so that no temperature jumps. Of light that is some hours old
every second node, later every fourth, holds what its neighbours had.
"""

from dataclasses import dataclass

import numpy as np

from sensorsim.constants import SECONDS_PER_DAY
from sensorsim.effects import EVERYTHING, EffectPlan
from sensorsim.environment import Environment
from sensorsim.tables.orientations import FloatArray, IntArray
from sensorsim.thermal.heat_balance import directional_irradiance

COARSER = ((4, 2), (16, 4))  # age in nodes, from which only every second and every fourth one is kept
LEAST_WEIGHT = 1e-3  # [K] of a black surface, below which a lobe is left out


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Lobes:
    """Directions and weights of the lobes of all wall types over a day; lobe 0 is the sun of the moment."""

    sun: FloatArray  # (t, 3) direction of lobe 0 at the slices, unit
    direction: FloatArray  # (k, 3) of the others, unit
    weight: FloatArray  # (t, w, k + 1, 2) powers 0 and 1 of the reflectance [K]
    gain: FloatArray  # (t, w, 5) by where a surface faces, see `lobe_gain`

    def at(self, index: int, share: float) -> tuple[FloatArray, FloatArray]:
        """Directions (l, 3) and weights (w, l, 2) [K] of the lobes that count at a share of the slice after `index`."""
        sun = (1.0 - share) * self.sun[index] + share * self.sun[index + 1]
        first, second = self.weight[index].astype(np.float64), self.weight[index + 1].astype(np.float64)
        direction = np.vstack([sun / np.linalg.norm(sun), self.direction])
        counts = np.any(np.stack([first, second]), axis=(0, 1, 3))
        return direction[counts], np.asarray(first + share * (second - first))[:, counts]

    def gain_at(self, index: int, share: float) -> FloatArray:
        """Gains (w, 5) at a share of the slice after `index`."""
        return np.asarray(self.gain[index] + share * (self.gain[index + 1] - self.gain[index]))

    @property
    def most(self) -> int:
        """Largest number of lobes that count at one time."""
        counts = np.any(self.weight, axis=(1, 3))
        return int(np.max(np.sum(counts[:-1] | counts[1:], axis=1)))


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class LobeSources:
    """The light of the lobes as sources of heat for a black surface that faces it."""

    interval: float  # [s] between nodes
    node: IntArray  # (k,) lit ones, counted from midnight
    direction: FloatArray  # (k, 3) unit
    sun: FloatArray  # (t, 3) at the slices
    clock: FloatArray  # (t,) of the slices [s]
    first: int  # sample that the sources begin with
    light: FloatArray  # (s, m) [W m-2]: of each interval today, that times the share of it gone by, each node's before


def lobe_gain(gain: FloatArray, normal: FloatArray) -> FloatArray:
    """What all lobes of surfaces with unit normals (m, 3) are multiplied by (..., m), from gains (..., 5)."""
    return np.asarray(gain @ gain_terms(normal).T)


def gain_terms(normal: FloatArray) -> FloatArray:
    """Terms (m, 5) of the gain: constant, along east, north and up, and the edge along the horizon, |up|."""
    return np.column_stack([np.ones(normal.shape[0]), normal, np.abs(normal[:, 2])])


def lobe_sources(
    environment: Environment, record: IntArray, *, interval: float, sky: str, plan: EffectPlan = EVERYTHING
) -> LobeSources:
    """Sources of lobes with nodes `interval` [s] apart, for slices at the samples `record` (t,)."""
    window = environment.image_window
    a_day = round(SECONDS_PER_DAY / environment.step)
    first = max(window.start - a_day, 0)
    offset = np.arange(first, window.stop) - window.start
    position = (offset % a_day) * environment.step / interval
    count = round(SECONDS_PER_DAY / interval)
    light = directional_irradiance(environment, sky=sky, plan=plan)[first : window.stop]
    before = np.floor(position + 1e-9).astype(np.int64)
    later, today = position - before, (offset >= 0) & (offset < a_day)
    within = np.zeros((offset.size, count))
    within[np.arange(offset.size), before] = light
    nodes = np.zeros((offset.size, count + 1))
    nodes[:, :count] += within * (1.0 - later)[:, None]
    nodes[:, 1:] += within * later[:, None]
    lit = np.flatnonzero(np.any(nodes > 0.0, axis=0))
    sources = [within * today[:, None], within * (today * later)[:, None], nodes[:, lit] * ~today[:, None]]
    towards = sun_at(environment, window.start + lit * interval / environment.step)
    return LobeSources(
        interval=interval,
        node=lit,
        direction=towards,
        sun=environment.sun_direction[record],
        clock=(record - window.start) * environment.step,
        first=first,
        light=np.ascontiguousarray(
            np.hstack([sources[0][:, lit[lit < count]], sources[1][:, lit[lit < count]], sources[2]])
        ),
    )


def facing_lobes(sources: LobeSources, normal: FloatArray) -> FloatArray:
    """Cosine (t, k + 1, o) of normals (o, 3) to the lobes at the slices, 0 behind them; lobe 0 is the sun."""
    still = sources.direction @ normal.T
    whole = np.concatenate(
        [(sources.sun @ normal.T)[:, None], np.broadcast_to(still, (sources.sun.shape[0], *still.shape))], axis=1
    )
    return np.asarray(np.maximum(whole, 0.0))


def sun_at(environment: Environment, position: FloatArray) -> FloatArray:
    """Direction (k, 3) of the sun, unit, at positions (k,) among the environment's samples, whole or between."""
    sample = np.arange(environment.sun_direction.shape[0])
    direction = np.stack([np.interp(position, sample, axis) for axis in environment.sun_direction.T], axis=1)
    return np.asarray(direction / np.linalg.norm(direction, axis=1, keepdims=True))


def lobe_weights(sources: LobeSources, response: FloatArray) -> FloatArray:
    """Weights (t, k + 1) [K] of a black surface from its response (t, m) to the sources' light."""
    position, count = sources.clock / sources.interval, sources.node.size
    begun = sources.node[sources.node < round(SECONDS_PER_DAY / sources.interval)]
    answer = np.ascontiguousarray(response.T)  # by sources: whole rows are handed on
    whole, late = answer[: begun.size], answer[begun.size : 2 * begun.size]
    gone = np.clip(position - begun[:, None], 0.0, 1.0)  # share of the interval that is over
    late = np.where(gone > 0.0, late / np.maximum(gone, 1e-9), 0.0)
    weight = np.zeros((count + 1, position.size))
    weight[1 : begun.size + 1] = whole - late
    weight[1:] += answer[2 * begun.size :]
    current = (gone > 0.0) & (gone < 1.0)
    weight[0] = np.sum(late * current, axis=0)
    late[current] = 0.0
    after = np.searchsorted(sources.node, begun + 1)
    known = sources.node[np.minimum(after, count - 1)] == begun + 1
    weight[after[known] + 1] += late[known]
    weight[np.flatnonzero(~known) + 1] += late[~known]
    _coarsen(weight[1:], sources.node, position)
    weight[np.abs(weight) < LEAST_WEIGHT] = 0.0
    return np.ascontiguousarray(weight.T)


def _coarsen(weight: FloatArray, node: IntArray, position: FloatArray) -> None:
    """Hand what old nodes hold (k, t) to coarser ones on both sides, in place, where both are lit."""
    for age, stride in COARSER:
        half = stride // 2
        finer = node[node % stride == half]
        place = np.searchsorted(node, finer + np.array([[-half], [0], [half]]))
        between = np.all(node[np.minimum(place, node.size - 1)][[0, 2]] - finer == [[-half], [half]], axis=0)
        before, own, after = place[:, between]
        since = position - finer[between, None]
        moved = np.where((since >= age) | (since < 0.0), 0.5 * weight[own], 0.0)
        weight[after] += moved
        weight[before] += moved
        weight[own] -= 2.0 * moved
