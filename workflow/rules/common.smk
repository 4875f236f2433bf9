# The checked configuration, and what the rules of the other files look up in it. No rules here.
import os
import sys
import time
from functools import cache
from pathlib import Path

import yaml

from granugas import declared, digest, studies
from granugas.planning import batch
from granugas.build import Job, claim, damaged, date_now, failures, pass_on_termination, tell_progress, wake, warm_up
from granugas.configuration import ConfigError, refuse_duplicate_keys
from granugas.cost import entries, renew_table, summary
from granugas.dynamics.events.effects import modules_of
from granugas.explored import explored
from granugas.report import entry_of
from granugas.resources import memory_of

HERE = Path(workflow.current_basedir.get_path_or_uri(secret_free=True)).parents[1]  # also where another workflow uses this one
STARTED = time.time()

try:
    refuse_duplicate_keys([*workflow.configfiles, *(workflow.overwrite_configfiles or [])])
    STUDIES = studies.load(
        config,
        schema=yaml.safe_load((HERE / "workflow/schemas/config.schema.yaml").read_text()),
        figures=declared.studies_in(HERE / "workflow/figures"),
    )
    DECLARED = {kind: declared.studies_in(HERE / f"workflow/{kind}") for kind in ("tables", "claims")}
    DRAWN = [path for kind in ("figures", "tables") for path in sorted((HERE / f"workflow/{kind}").glob("[!_]*.py"))]
    PLACES = {path.relative_to(HERE).as_posix(): entry_of(path) for path in DRAWN}
    declared.check_captions(HERE / "workflow/figures", HERE / "workflow/report")
    EXPERIMENTS = digest.SOURCES / "experiments"
    MEASURED = {kind: declared.experiments_in(HERE / f"workflow/{kind}", EXPERIMENTS) for kind in ("figures", "tables", "claims")}
except ConfigError as error:
    sys.exit(f"configuration: {error}")

OUTPUT = STUDIES.output
STATES, RUNS, CLUSTERS, KEEPING = STUDIES.states(), STUDIES.runs(), STUDIES.clusters(), STUDIES.keeping()
DRAWINGS, DRAWN_TABLES = MEASURED["figures"], declared.tables_in(HERE / "workflow/figures")
FIRST_TO_ASK = STUDIES.first_to_ask()
TABLES, CLAIMS = (STUDIES.possible(products) for products in DECLARED.values())
STYLE = sorted({*(digest.SOURCES / "plotting").glob("*.*")} - {digest.SOURCES / "plotting/animation.py"})
ANALYSIS = digest.digest(digest.ANALYSIS)
FORMULAS = digest.digest(["granugas.analysis.*"])
STORAGE = digest.digest(["granugas.storage.*"])
EXPLORED = explored(STUDIES)

if STUDIES.all_wanted and workflow.is_main_process:
    OTHERS = {f"{kind}/{name}": STUDIES.missing(needs) for kind, files in DECLARED.items() for name, needs in files.items()}
    for name, missing in (STUDIES.left_out | OTHERS).items():
        if missing:
            print(f"Left out: {name} needs {', '.join(missing)}, not in the configuration.", file=sys.stderr)


REMOVED = []
if workflow.is_main_process and not {"-n", "--dry-run", "--dryrun"} & {*sys.argv}:
    NAMES = STUDIES.names()
    STORED = {folder: NAMES[folder] for folder in ("runs", "positions", "clusters")} | {"studies": STUDIES.studies}
    STORED["experiments"] = {name for of in MEASURED.values() for names in of.values() for name in names}
    REMOVED = damaged(Path(f"{OUTPUT}/{folder}/{name}.nc") for folder, names in STORED.items() for name in sorted(names))
    for path in REMOVED:
        path.unlink(missing_ok=True)
        print(f"{path} was damaged: removed, to be made again.", file=sys.stderr)
    for path in damaged(Path(f"{OUTPUT}/states/{name}.nc") for name in NAMES["states"]):
        os.utime(path, (0, 0))  # no run is out of date for it
        print(f"{path} is damaged: a run that needs it makes it again.", file=sys.stderr)
    if number := date_now(OUTPUT):
        print(f"{number} files in {OUTPUT} are dated in the future (was the clock set back?): corrected.", file=sys.stderr)


@cache
def physics(scene):
    """The digest of what decides the numbers of a scene's runs, their start states included."""
    return digest.physics(modules_of(scene, scene.at_start()))


def grouped():
    """Whether jobs go together in groups: a profile for a batch system says so, and it is not known yet when rules are read."""
    return bool(workflow.group_settings.group_components)


def together(what, seconds):
    """The group of a job that is too short to go to a batch system alone; none where there are no groups."""
    kind = batch.kind(seconds) if grouped() else None
    return kind and f"{what}_{kind}"


def with_figures(wildcards):
    """The group of figures, each a second; none where there are no groups."""
    return "figures" if grouped() else None


def runs_alone(wildcards):
    """Whether nothing may run beside an experiment; the times of a small plan mean nothing."""
    return not STUDIES.small_experiments and declared.runs_alone(EXPERIMENTS / f"{wildcards.experiment}.py")


def datasets(names, experiments):
    """The files of studies and experiments."""
    return [f"{OUTPUT}/studies/{name}.nc" for name in names] + [f"{OUTPUT}/experiments/{name}.nc" for name in experiments]


def placed(file, name):
    """Section, part and label in the report of a figure or table with this name, as its file says."""
    section, part, about = PLACES[file]
    return {"category": section, "subcategory": part, "labels": labelled(name, about)}


def labelled(name, about):
    """The label of an entry: one, as in a section of two entries a second label would be taken for a switch between them."""
    return {"shows": f"{name}: {about}"}


def tables():
    """The tables that the configuration asks for: with all figures, all tables."""
    return [f"{OUTPUT}/{name}.csv" for name in (*TABLES, *(["claims"] if CLAIMS else []))] if STUDIES.all_wanted else []


def draws_costs(name):
    """Whether a figure draws on what all others cost, so that it is made after them."""
    return "cost" in DRAWN_TABLES.get(name, ())


def figures(with_costs):
    """The files of the figures that are wanted: those that draw on costs, or the others."""
    names = [name for name in STUDIES.wanted if draws_costs(name) == with_costs]
    return [f"{OUTPUT}/figures/{name}.{kind}" for name in names for kind in ("png", "pdf")]


def animations():
    """The animations that the configuration asks for: with all figures, all animations."""
    return [f"{OUTPUT}/figures/{name}.mp4" for name in STUDIES.animations] if STUDIES.all_wanted else []


def explorer():
    """The explorer: with all figures, if there is a run that it can show."""
    return [f"{OUTPUT}/explorer.html"] if STUDIES.all_wanted and EXPLORED else []


def costs():
    """Write what everything that is there cost, and say it in a line."""
    return summary(entries(OUTPUT), STARTED, renew_table(OUTPUT, FIRST_TO_ASK))


def planned(dag):
    """The jobs that Snakemake wants to run."""
    return [
        Job(job.rule.name, tuple(map(Path, job.output)), Path(job.log[0]) if job.log else None)
        for job in dag.needrun_jobs()
    ]


def begin(jobs):
    """One build at a time; compile before jobs run side by side; say how far the runs are."""
    try:
        claim(OUTPUT)
    except BlockingIOError:
        sys.exit(f"Another build is writing to {OUTPUT}: wait for its end, or choose another output.")
    except OSError as error:
        sys.exit(f"output = {OUTPUT!r}: nothing can be written there ({error.strerror}); choose another folder.")
    pass_on_termination()
    made = {Path(f"{OUTPUT}/runs/{address}.nc"): run for address, run in RUNS.items()}
    began = {Path(f"{OUTPUT}/states/{address}.nc"): run for address, run in STATES.items()}
    runs = {job: made[job.outputs[0]] for job in jobs if job.outputs and job.outputs[0] in made}
    started = [began[job.outputs[0]] for job in jobs if job.outputs and job.outputs[0] in began]
    if scenes := [run.scene for run in (*runs.values(), *started)]:
        warm_up(f"{OUTPUT}/logs/warm_up.log", scenes, workflow.cores)
    tell_progress({job: run.cost for job, run in runs.items()}, STARTED)
    if workflow.local_exec:
        # Its limit on starts wakes the scheduler once a second for each job that ever started: half a core of a large build.
        workflow.scheduler.job_rate_limiter = None
        wake(workflow.scheduler._open_jobs)
