"""The package from the shell: `python -m granugas <command> ...`."""

import argparse
import json
import logging
import sys
from dataclasses import asdict
from pathlib import Path
from typing import TYPE_CHECKING, Any, NoReturn

from granugas.scene import LATTICES, Scene
from granugas.storage.damage import DamagedFile

if TYPE_CHECKING:
    from granugas.studies import Studies

BASE = "config/config.yaml"
"""The configuration that is always the first, as for a build."""


def main(arguments: list[str] | None = None) -> int:
    """Run one command; wrong values end in one line and exit code 2."""
    options = _parser().parse_args(arguments)
    logging.basicConfig(level=logging.INFO, format="%(message)s")
    try:
        return options.command(options)
    except (ValueError, OSError, DamagedFile) as error:
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
    print(f"{options.output}: {data.attrs['n_particles']} particles until t = {float(data['stop_time']):.6g} s "
          f"({data['stop_reason'].item()}), {int(data['events'])} collisions")  # fmt: skip
    return 0


def _bench(options: argparse.Namespace) -> int:
    from granugas.benchmark import time_collisions

    timing = time_collisions(_scene(options), options.collisions, begin=options.begin)
    print(json.dumps({"scene": _scene(options).as_dict(), **asdict(timing)}))
    return 0


def _compare(options: argparse.Namespace) -> int:
    from granugas.storage.compare import compare
    from granugas.storage.dataset import read

    found = compare(read(options.first), read(options.second))
    print(found)
    return 0 if found.agree else 1


def _export(options: argparse.Namespace) -> int:
    from granugas.storage.dataset import read
    from granugas.storage.export import export_snapshots

    frames = export_snapshots(read(options.run), options.output, options.snapshot)
    print(f"{options.output}: {frames} frame{'s' if frames != 1 else ''}")
    return 0


def _prune(options: argparse.Namespace) -> int:
    from granugas.storage.prune import leftovers, listing, no_build, remove

    asked, _ = _asked(options)
    with no_build(asked.output):
        paths = leftovers(asked.output, asked.names())
        print(listing(paths))
        on_terminal = sys.stdin.isatty()
        if paths and not options.yes and not (on_terminal and input("Remove them? y/N ").strip().lower() in ("y", "yes")):
            print("Nothing is removed" + ("." if on_terminal else ": --yes removes them."))
        elif paths:
            remove(paths)
            print(f"{len(paths)} files removed.")
    return 0


def _plan(options: argparse.Namespace) -> int:
    from granugas.configuration import unknown
    from granugas.digest import physics
    from granugas.planning.calibration import calibration
    from granugas.planning.plan import as_numbers, forecast, table

    asked, config = _asked(options)
    if options.study is not None and options.study not in asked.studies:
        raise unknown("--study", options.study, options.study, asked.studies, kind="study")
    if options.error is not None:
        return _choose(options, asked, config)
    found = forecast(asked, machine := calibration(), physics())
    found = {name: one for name, one in found.items() if options.study in (None, name)}
    print(json.dumps(as_numbers(found, machine)) if options.json else table(found, machine))
    return 0


def _choose(options: argparse.Namespace, asked: "Studies", config: dict[str, Any]) -> int:
    import yaml

    from granugas.planning.calibration import calibration
    from granugas.planning.choice import cheapest, overlay
    from granugas.storage.files import replacing

    if options.study is None:
        raise ValueError("--error: name the study it is asked of, --study")
    error = _share(options.error)
    choice = cheapest(asked.studies[options.study], error, options.of, calibration())
    name = f"{options.study}_{options.of}_{100 * error:g}".replace(".", "_") + "_percent"
    mine = overlay(config["studies"][options.study], choice, name)
    if options.json:
        print(json.dumps(asdict(choice)))
    else:
        print(f"{choice}")
    if options.output:
        with replacing(options.output) as path:
            path.write_text(yaml.safe_dump(mine, sort_keys=False), encoding="utf-8")
        files = " ".join(dict.fromkeys([BASE, *options.overlays, options.output]))
        print(f"snakemake --cores 2 {asked.output}/studies/{name}.nc --configfile {files}", file=sys.stderr)
    return 0


def _share(text: str) -> float:
    """Of "1%" or "0.01" .01."""
    try:
        return float(text[:-1]) / 100 if text.endswith("%") else float(text)
    except ValueError:
        raise ValueError(f"--error {text}: allowed is a number, or a percentage, as in 1%") from None


def _asked(options: argparse.Namespace) -> "tuple[Studies, dict[str, Any]]":
    """What the configuration asks for with the overlays on top, checked, and the configuration itself."""
    import yaml

    from granugas import declared, studies
    from granugas.configuration import merged

    schema = yaml.safe_load((options.workflow / "schemas/config.schema.yaml").read_text(encoding="utf-8"))
    config = merged([BASE, *options.overlays])
    return studies.load(config, schema, declared.studies_in(options.workflow / "figures")), config


def _scene(options: argparse.Namespace) -> Scene:
    times = options.contact_time
    values: dict[str, Any] = {
        "n_particles": options.n,
        "area_fraction": options.area_fraction,
        "restitution": options.restitution,
        "contact_time": times[0] if len(times) == 1 else tuple(times),
        "diameter": options.diameter,
        "lattice": options.lattice,
        "dimensions": options.dimensions,
    }
    return Scene(**values)


class _Parser(argparse.ArgumentParser):
    """Says what is wrong in one line, without all that would be right."""

    def error(self, message: str) -> NoReturn:
        self.exit(2, f"granugas: {message}; {self.prog} --help says more\n")


def _parser() -> argparse.ArgumentParser:
    default = Scene()
    scene = _Parser(add_help=False)
    scene.add_argument("--n", type=int, default=default.n_particles, help="number of particles")
    scene.add_argument("--area-fraction", type=float, default=default.area_fraction)
    scene.add_argument("--restitution", type=float, default=default.restitution)
    scene.add_argument("--contact-time", type=float, nargs="+", default=[default.contact_time], help="s; several at r = 1")
    scene.add_argument("--diameter", type=float, default=default.diameter, help="m")
    scene.add_argument("--lattice", default=default.lattice, help=f"start lattice: {', '.join(LATTICES)}")
    scene.add_argument("--dimensions", type=int, default=default.dimensions, help="of space: 1, 2, 3")
    parser = _Parser(prog="python -m granugas", description=__doc__)
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

    compare = commands.add_parser("compare", help="whether two datasets agree; exit code 0 if they do, 1 if not")
    compare.add_argument("first", metavar="A.nc")
    compare.add_argument("second", metavar="B.nc")
    compare.set_defaults(command=_compare)

    export = commands.add_parser("export", help="snapshots of a run as extended XYZ, which OVITO and ASE read")
    export.add_argument("run", metavar="RUN.nc")
    export.add_argument("output", metavar="OUT.xyz")
    export.add_argument("--snapshot", type=float, help="time, s; all of them unless it is given")
    export.set_defaults(command=_export)

    prune = commands.add_parser("prune", help="remove files of runs that no study names any more, after listing them")
    prune.add_argument("overlays", nargs="*", metavar="mine.yaml", help=f"configurations on top of {BASE}")
    prune.add_argument("--yes", action="store_true", help="do not ask")
    prune.add_argument("--workflow", type=Path, default=Path("workflow"), help="folder of the schema and the figures")
    prune.set_defaults(command=_prune)

    plan = commands.add_parser("plan", help="what studies cost and how good they will be, before anything runs")
    plan.add_argument("--configfile", nargs="+", default=[], dest="overlays", metavar="FILE", help=f"laid on top of {BASE}")
    plan.add_argument("--study", help="of this study alone")
    plan.add_argument("--json", action="store_true", help="numbers for programs")
    plan.add_argument("--error", metavar="1%", help="the cheapest N, t_c and realizations with this relative error instead")
    plan.add_argument("--of", default="kinetic_energy", help="kinetic_energy, pressure or mean_cluster_size, with --error")
    plan.add_argument("--output", metavar="mine.yaml", help="write them as a configuration to lay on top, with --error")
    plan.add_argument("--workflow", type=Path, default=Path("workflow"), help="folder of the schema and the figures")
    plan.set_defaults(command=_plan)
    return parser


if __name__ == "__main__":
    sys.exit(main())
