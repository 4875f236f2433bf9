"""Collisions of direct simulation Monte Carlo in the cells of a step (see dsmc.py).

In a cell pairs are drawn, after waiting times as if all pairs were as fast as any can be, and each collides with a probability
that is its relative speed by the largest one. That is the diagonal of the box around all velocities of the cell, a bound that
holds: where a collision widens the box the waiting goes on with the new one. So each pair collides exactly at its rate, at
any length of the step and number of particles, and collisions have times that the TC rule can go by.

Random numbers are hashes of a key of the run, the step, the cell and a counter.
"""

import math

import numpy as np

from granugas.dynamics.events.composition import generic, implements, inline, outline
from granugas.dynamics.events.vectors import along, dot, mapped, mapped_three, minus, times

_ODD, _TWO, _THREE = np.uint64(0x9E3779B97F4A7C15), np.uint64(0xBF58476D1CE4E5B9), np.uint64(0x94D049BB133111EB)
_ONE, _27, _30, _31, _32, _LOW = (np.uint64(k) for k in (1, 27, 30, 31, 32, 2**32 - 1))
_20, _40, _LOW_20 = (np.uint64(k) for k in (20, 40, 2**20 - 1))


@inline
def hashed(z):
    """64 random bits from a number (the finalizer of SplitMix64: Steele, Lea & Flood 2014)."""
    z = (z ^ (z >> _30)) * _TWO
    z = (z ^ (z >> _27)) * _THREE
    return z ^ (z >> _31)


@inline
def _high(word):
    """A random number from 0 up to and without 1, from the higher half of random bits."""
    return float(word >> _32) * 2.0**-32


@inline
def _low(word):
    """The same from the lower half."""
    return float(word & _LOW) * 2.0**-32


@generic
def impact(u, word):
    """Draw where a pair touches; u: velocity of the second relative to the first, word: random bits.

    All places of the line (2D) or the disk (3D) across u are equally likely. Returns c, the cosine of the angle between -u and
    the unit vector n from the first to the second, and w = -|u| n.
    """


@generic
def mixed(w):
    """Products of different components: xy; yz, zx, xy."""


@implements(impact, 2)
def _impact_in_a_plane(u, word):
    b = 2.0 * _low(word) - 1.0
    c = math.sqrt(1.0 - b * b)
    return c, (c * u[0] - b * u[1], c * u[1] + b * u[0])


@implements(impact, 3)
def _impact_in_space(u, word):
    p, q, b_2 = 0.0, 0.0, 1.0
    while b_2 >= 1.0:
        word = hashed(word + _ODD)
        p, q = 2.0 * _high(word) - 1.0, 2.0 * _low(word) - 1.0
        b_2 = p * p + q * q
    c, across = math.sqrt(1.0 - b_2), math.sqrt(u[0] * u[0] + u[1] * u[1])
    x, y = (u[0] / across, u[1] / across) if across > 0.0 else (1.0, 0.0)
    p *= math.sqrt(dot(u, u))  # along (-y, x, 0) |u|, and q along (-x u_z, -y u_z, across)
    return c, (c * u[0] - p * y - q * u[2] * x, c * u[1] + p * x - q * u[2] * y, c * u[2] + q * across)


@implements(mixed, 2)
def _mixed_in_a_plane(w):
    return (w[0] * w[1],)


@implements(mixed, 3)
def _mixed_in_space(w):
    return w[1] * w[2], w[2] * w[0], w[0] * w[1]


@inline
def _less(a, b):
    return a if a < b else b


@inline
def _more(a, b):
    return a if a > b else b


@inline
def _least(a, b, c):
    return _less(a, _less(b, c))


@inline
def _most(a, b, c):
    return _more(a, _more(b, c))


@outline
def meet(gas, cell, into, cut):
    """The collisions of a cell within `cut` (s) after the begin of a step."""
    disks, row, clock = gas.disks, gas.order.row, gas.clock
    first = gas.begin.at[cell]
    n, stop = gas.begin.at[cell + 1] - first, _less(clock.step, cut)
    if n < 2:
        return
    low = high = disks.v[row[first]]
    for k in range(first + 1, first + n):
        v = disks.v[row[k]]
        low, high = mapped(low, v, _less), mapped(high, v, _more)
    extent = minus(high, low)
    fastest_2 = dot(extent, extent)
    if fastest_2 == 0.0:
        return
    rate = 0.5 * n * (n - 1) * gas.rates.value[min(n, gas.model.most)]
    word = hashed(hashed(clock.key + np.uint64(clock.steps) * _ODD) + np.uint64(cell) * _THREE)
    many, others = np.uint64(n), np.uint64(n - 1)
    fastest = math.sqrt(fastest_2)
    width, now, left = 1.0 / (rate * fastest), 0.0, 1.0  # mean waiting time; exp(- what is waited / width)
    while True:
        word += _ODD + _ODD
        drawn, more = hashed(word), hashed(word + _ODD)
        left *= (float(more & _LOW) + 1.0) * 2.0**-32
        if left < 1e-200:
            now, left = now - width * math.log(left), 1.0
            if now >= stop:
                return
        i = np.int64(((drawn & _LOW_20) * many) >> _20)  # fewer than 2^20 particles are in a cell
        j = np.int64((((drawn >> _20) & _LOW_20) * others) >> _20)
        i, j = row[first + i], row[first + j + (j >= i)]
        u = minus(disks.v[j], disks.v[i])
        u_2 = dot(u, u)
        asked = fastest * (float(drawn >> _40) * 2.0**-24)
        if asked * asked < u_2:
            now, left = now - width * math.log(left), 1.0
            if now >= stop:
                return
            _collide(gas, i, j, u, u_2, more >> _32, clock.time + now, into)
            v_i, v_j = disks.v[i], disks.v[j]
            low, high = mapped_three(low, v_i, v_j, _least), mapped_three(high, v_i, v_j, _most)
            extent = minus(high, low)
            if dot(extent, extent) > fastest_2:
                fastest_2 = dot(extent, extent)
                fastest = math.sqrt(fastest_2)
                width = 1.0 / (rate * fastest)


@inline
def _collide(gas, i, j, u, u_2, drawn, now, into):
    """Rows i and j collide where it is drawn: A Eqs. 2, 3, 4 and 15, as in events/collisions.py."""
    disks, clocks, sums, lasting, several = gas.disks, gas.clocks, gas.sums, gas.lasting, gas.model.several
    since_i, since_j = now - clocks.last[i], now - clocks.last[j]
    since = _less(since_i, since_j)
    r = 1.0 if since <= gas.times.t_c[0] else gas.model.restitution
    c, w = impact(u, drawn)
    push = 0.5 * (1.0 + r) * c  # along n it is (1 + r) u.n / 2, where u.n = -c |u|
    disks.v[i] = along(disks.v[i], push, w)
    disks.v[j] = along(disks.v[j], -push, w)
    clocks.last[i] = clocks.last[j] = now
    clocks.interval[i], clocks.interval[j] = since_i, since_j
    clocks.collisions[i] += 1
    clocks.collisions[j] += 1
    loss = 0.25 * (1.0 - r * r) * c * c * u_2
    sums.collisions[into] += 1
    sums.loss[into] += loss
    sums.loss_time[into] += loss * now
    passed_on = -push / math.sqrt(u_2)
    sums.squares[into] = along(sums.squares[into], passed_on, times(w, w))
    sums.mixed[into] = along(sums.mixed[into], passed_on, mixed(w))
    for k in range(several):
        t_c, at = gas.times.t_c[k], into * several + k
        lasting.elastic[at] += since <= t_c
        lasting.held[at] += _less(since_i, t_c) + _less(since_j, t_c)
