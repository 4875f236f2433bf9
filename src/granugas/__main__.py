"""The package from the shell: `python -m granugas run ...`, `python -m granugas bench ...`."""

import argparse
import json
import logging
import sys
from dataclasses import asdict
from typing import Any

from granugas.scene import Scene


def main(arguments: list[str] | None = None) -> int:
    """Run one command; wrong values end in one line and exit code 2."""
    options = _parser().parse_args(arguments)
    logging.basicConfig(level=logging.INFO, format="%(message)s")
    try:
        return options.command(options)
    except (ValueError, OSError) as error:
        print(f"granugas: {error}", file=sys.stderr)
        return 2


def _run(options: argparse.Namespace) -> int:
    from granugas.simulate import simulate
    from granugas.storage.dataset import write

    limits = {"time": options.time, "collisions_per_particle": options.collisions_per_particle}
    until = {key: value for key, value in limits.items() if value is not None}
    if not until:
        raise ValueError("name --time or --collisions-per-particle (or both)")
    scene = _scene(options)
    data = simulate(
        scene,
        until,
        seed=options.seed,
        realization=options.realization,
        samples={"count": options.samples},
        snapshots=options.snapshots,
        keep_positions=options.keep_positions,
    )
    write(data, options.output, {"scene": scene.as_dict(), "until": until, "seed": options.seed})
    print(f"{options.output}: {data.attrs['n_particles']} disks until t = {float(data['stop_time']):.6g} s "
          f"({data['stop_reason'].item()}), {int(data['events'])} collisions")  # fmt: skip
    return 0


def _bench(options: argparse.Namespace) -> int:
    from granugas.benchmark import time_collisions

    timing = time_collisions(_scene(options), options.collisions, begin=options.begin)
    print(json.dumps({"scene": _scene(options).as_dict(), **asdict(timing)}))
    return 0


def _scene(options: argparse.Namespace) -> Scene:
    times = options.contact_time
    values: dict[str, Any] = {
        "n_particles": options.n,
        "area_fraction": options.area_fraction,
        "restitution": options.restitution,
        "contact_time": times[0] if len(times) == 1 else tuple(times),
        "diameter": options.diameter,
        "lattice": options.lattice,
    }
    return Scene(**values)


def _parser() -> argparse.ArgumentParser:
    default = Scene()
    scene = argparse.ArgumentParser(add_help=False)
    scene.add_argument("--n", type=int, default=default.n_particles, help="number of disks")
    scene.add_argument("--area-fraction", type=float, default=default.area_fraction)
    scene.add_argument("--restitution", type=float, default=default.restitution)
    scene.add_argument("--contact-time", type=float, nargs="+", default=[default.contact_time], help="s; several at r = 1")
    scene.add_argument("--diameter", type=float, default=default.diameter, help="m")
    scene.add_argument("--lattice", default=default.lattice, help="start lattice: auto, triangular, square")
    parser = argparse.ArgumentParser(prog="python -m granugas", description=__doc__)
    commands = parser.add_subparsers(required=True)

    run = commands.add_parser("run", parents=[scene], help="one run, written as netCDF")
    run.add_argument("--time", type=float, help="end, s")
    run.add_argument("--collisions-per-particle", type=float, help="end")
    run.add_argument("--samples", type=int, default=200, help="number of sampling times")
    run.add_argument("--snapshots", type=float, nargs="*", default=[], help="times at which all disks are kept, s")
    run.add_argument("--keep-positions", action="store_true", help="keep the positions at all sampling times")
    run.add_argument("--seed", type=int, default=0)
    run.add_argument("--realization", type=int, default=0)
    run.add_argument("--output", default="run.nc")
    run.set_defaults(command=_run)

    bench = commands.add_parser("bench", parents=[scene], help="time collisions, print one line of JSON")
    bench.add_argument("--collisions", type=int, default=2_000_000)
    bench.add_argument("--begin", type=float, default=0.0, help="time from which collisions are timed, s")
    bench.set_defaults(command=_bench)
    return parser


if __name__ == "__main__":
    sys.exit(main())
