# Start states, and the runs that begin with them.


rule equilibrate:
    output:
        f"{OUTPUT}/states/{{state}}.nc",
    log:
        f"{OUTPUT}/logs/equilibrate/{{state}}.log",
    params:
        run=lambda wildcards: STATES[wildcards.state],
        physics=lambda wildcards: digest.physics(modules_of(STATES[wildcards.state].scene.at_start())),
    priority: lambda wildcards: STATES[wildcards.state].cost
    group: lambda wildcards: together("states", batch.of_states(STATES[wildcards.state]))
    resources:
        mem_mb=lambda wildcards, attempt: batch.megabytes(memory_of(STATES[wildcards.state]), attempt),
        runtime=lambda wildcards, attempt: batch.minutes(batch.of_states(STATES[wildcards.state]), attempt),
    script:
        "../scripts/equilibrate.py"


rule simulate:
    input:
        state=lambda wildcards: f"{OUTPUT}/states/{RUNS[wildcards.run].state_address}.nc",
    output:
        run=f"{OUTPUT}/runs/{{run}}.nc",
        positions=f"{OUTPUT}/positions/{{run}}.nc",
    log:
        f"{OUTPUT}/logs/simulate/{{run}}.log",
    params:
        run=lambda wildcards: RUNS[wildcards.run],
        physics=lambda wildcards: physics(RUNS[wildcards.run].scene),
        keeping=lambda wildcards: KEEPING[wildcards.run],
        checkpoints=f"{OUTPUT}/checkpoints",
    wildcard_constraints:
        run=".+_xy",
    priority: lambda wildcards: RUNS[wildcards.run].cost
    group: lambda wildcards: together("runs", batch.of_run(RUNS[wildcards.run]))
    resources:
        mem_mb=lambda wildcards, attempt: batch.megabytes(memory_of(RUNS[wildcards.run]), attempt),
        runtime=lambda wildcards, attempt: batch.minutes(batch.of_run(RUNS[wildcards.run]), attempt),
    script:
        "../scripts/simulate.py"


use rule simulate as simulate_without_positions with:
    output:
        run=f"{OUTPUT}/runs/{{run}}.nc",
    wildcard_constraints:
        run=".+(?<!_xy)",


# Measurements that are no study of a gas: one ball on a plate, two soft disks, ... Nothing runs beside one that times something.
rule experiment:
    output:
        f"{OUTPUT}/experiments/{{experiment}}.nc",
    log:
        f"{OUTPUT}/logs/experiments/{{experiment}}.log",
    params:
        physics=lambda wildcards: digest.experiment(wildcards.experiment),
        small=STUDIES.small_experiments,
    priority: 1  # before figures: one of its own waits for each
    threads: lambda wildcards: workflow.cores if runs_alone(wildcards) else 1
    resources:
        slurm_extra=lambda wildcards: "--exclusive" if runs_alone(wildcards) else "",
    script:
        "../scripts/experiment.py"
