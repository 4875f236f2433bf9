"""What a run needs of the machine, estimated before it starts, and what the machine has."""

import os
import resource
from contextlib import suppress
from pathlib import Path

from granugas.runs import Run

ENGINE = {1: 220, 2: 260, 3: 370}
"""Bytes a particle of the engine's tables, and of the states that it takes and gives back, by the dimensions of space
(measured: 125, 130, 215, and 24 + 16 D a state)."""

START = 16
"""Bytes a particle of a start state, and as many for each axis."""

SOFT = {1: 250, 2: 380, 3: 600}
"""The same of soft spheres, and what makes their cells (measured; the list of pairs grows with t_c)."""

DSMC = {2: 310, 3: 400}
"""The same of direct simulation Monte Carlo, with the copies by which it looks into a step."""

UNEQUAL, HEATED = 48, 48
"""Bytes a particle more where sizes differ (in the tables, two states and the record), and while kicks are drawn."""

SNAPSHOT, WINDOW = 24, 8
"""Bytes a particle of a snapshot, besides 16 for each axis, and of the count of collisions before it."""

FRAME, MOTION = 8, 4
"""Bytes a particle and axis of the positions at a sampling time, and of the motion that an animation wants (and 4 once)."""

MODE = 16
"""Bytes of an internal mode of a disk."""

SAMPLE, OF_CONTACT_TIME = 240, 40
"""Bytes a sample, measured: what a run writes down and where it stops; and more for each contact time."""


def memory_of(run: Run) -> int:
    """Bytes that a run needs at most: its realizations one after the other, then all of them as one dataset."""
    n, samples, realizations = run.scene.n_particles, run.samples["count"] + 1, len(run.realizations)
    axes = run.scene.dimensions
    frame = FRAME * axes * run.keep_positions + (MOTION * axes + 4) * run.keep_motion
    of_disks = n * (8 + frame * samples + (SNAPSHOT + 16 * axes + WINDOW) * len(run.snapshots))
    kept = of_disks + samples * (SAMPLE + OF_CONTACT_TIME * len(run.scene.contact_times))
    copies = 2 if realizations > 1 else 1
    of_method = {"events": ENGINE, "soft_spheres": SOFT, "dsmc": DSMC}[run.scene.dynamics][axes]
    engine = of_method + UNEQUAL * (run.scene.sizes != "equal") + HEATED * (run.scene.heating > 0)
    engine += MODE * run.scene.internal_modes
    return n * (engine + START * (1 + axes) * realizations) + kept * realizations * copies


def memory_at_hand() -> int:
    """Bytes that a process may have: of the machine, or less where a limit is set (of the container, of the shell)."""
    limits = [os.sysconf("SC_PAGE_SIZE") * os.sysconf("SC_PHYS_PAGES")]
    of_shell = resource.getrlimit(resource.RLIMIT_AS)[0]
    if of_shell != resource.RLIM_INFINITY:
        limits.append(of_shell)
    with suppress(OSError, ValueError):  # no such file, or "max"
        limits.append(int(Path("/sys/fs/cgroup/memory.max").read_text()))
    return min(limits)
