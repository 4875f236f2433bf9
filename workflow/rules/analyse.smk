# From runs to the datasets of the studies.


rule clusters:
    input:
        positions=lambda wildcards: f"{OUTPUT}/positions/{CLUSTERS[wildcards.clusters][0].address}.nc",
    output:
        f"{OUTPUT}/clusters/{{clusters}}.nc",
    log:
        f"{OUTPUT}/logs/clusters/{{clusters}}.log",
    params:
        distance_factors=lambda wildcards: CLUSTERS[wildcards.clusters][1],
        analysis=ANALYSIS,
    priority: 1  # as in each rule that figures wait for
    group: lambda wildcards: together("clusters", batch.of_clusters(*CLUSTERS[wildcards.clusters]))
    resources:
        mem_mb=lambda wildcards, attempt: batch.megabytes(memory_of(CLUSTERS[wildcards.clusters][0]), attempt),
        runtime=lambda wildcards, attempt: batch.minutes(batch.of_clusters(*CLUSTERS[wildcards.clusters]), attempt),
    script:
        "../scripts/clusters.py"


rule pool:
    input:
        runs=lambda wildcards: [f"{OUTPUT}/runs/{run.address}.nc" for run in STUDIES.studies[wildcards.study].runs],
        clusters=lambda wildcards: [
            f"{OUTPUT}/clusters/{address}.nc" for address in STUDIES.studies[wildcards.study].clusters()
        ],
    output:
        f"{OUTPUT}/studies/{{study}}.nc",
    log:
        f"{OUTPUT}/logs/pool/{{study}}.log",
    params:
        grid_keys=lambda wildcards: STUDIES.studies[wildcards.study].grid_keys,
        storage=STORAGE,
    priority: 1
    resources:
        mem_mb=lambda wildcards, attempt: batch.megabytes(batch.pooled_size(STUDIES.studies[wildcards.study].runs), attempt),
        runtime=lambda wildcards, attempt: batch.minutes(batch.of_pool(STUDIES.studies[wildcards.study].runs), attempt),
    wildcard_constraints:
        study="|".join(STUDIES.studies),
    script:
        "../scripts/pool.py"


rule check:
    input:
        expand(rules.pool.output[0], study=STUDIES.studies),
    output:
        f"{OUTPUT}/checks.txt",
    log:
        f"{OUTPUT}/logs/check.log",
    script:
        "../scripts/check.py"
