"""A SLURM of one node for a test: its daemons with their files in one folder, on free ports, ended with it."""

import getpass
import os
import shutil
import socket
import subprocess
import time
from collections.abc import Iterator
from contextlib import ExitStack, contextmanager
from dataclasses import dataclass
from pathlib import Path

PATH = f"{os.environ['PATH']}:/usr/sbin"

CONFIGURATION = """
ClusterName=small
SlurmctldHost={host}(127.0.0.1)
SlurmctldPort={ports[0]}
SlurmdPort={ports[1]}
SlurmUser={user}
SlurmdUser={user}
AuthType=auth/munge
AuthInfo=socket={folder}/munge.socket
CredType=cred/munge
StateSaveLocation={folder}/state
SlurmdSpoolDir={folder}/spool
SlurmctldPidFile={folder}/slurmctld.pid
SlurmdPidFile={folder}/slurmd.pid
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
MpiDefault=none
SelectType=select/cons_tres
SelectTypeParameters=CR_CPU_Memory
SlurmdParameters=config_overrides
SchedulerParameters=sched_interval=1,batch_sched_delay=0
MinJobAge=600
KillWait=10
ReturnToService=2
NodeName={host} NodeAddr=127.0.0.1 CPUs={cpus} RealMemory=16000 State=UNKNOWN
PartitionName=main Nodes={host} Default=YES MaxTime=INFINITE State=UP
"""


@dataclass(frozen=True)
class SmallCluster:
    """A SLURM that runs.

    Attributes:
        folder: of its files and logs.
    """

    folder: Path

    @property
    def environment(self) -> dict[str, str]:
        """In which its commands find it."""
        return os.environ | {"SLURM_CONF": str(self.folder / "slurm.conf"), "PATH": f"{self.folder}/bin:{PATH}"}

    def call(self, *words: str) -> str:
        """What one of its commands says."""
        done = subprocess.run(words, env=self.environment, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
        assert done.returncode == 0, f"{' '.join(words)}: {done.stdout}"
        return done.stdout

    def jobs(self, *states: str) -> dict[str, dict[str, str]]:
        """Its jobs by number, what it knows of each; in these states only, if any are named."""
        lines = self.call("scontrol", "--oneliner", "show", "jobs").splitlines()
        found = [dict(word.split("=", 1) for word in line.split(" ") if "=" in word) for line in lines if "JobId=" in line]
        return {job["JobId"]: job for job in found if not states or job["JobState"] in states}


@contextmanager
def small_cluster(folder: Path, cpus: int = 2) -> Iterator[SmallCluster]:
    """Start it, and end what was started."""
    cluster = SmallCluster(folder)
    for name in ("state", "spool"):
        (folder / name).mkdir()
    folder.chmod(0o755)
    host = socket.gethostname().split(".")[0]
    text = CONFIGURATION.format(folder=folder, host=host, user=getpass.getuser(), cpus=cpus, ports=_free_ports(2))
    (folder / "slurm.conf").write_text(text)
    srun = folder / "bin/srun"  # jobs of the executor lose SLURM_CONF, which a cluster does without
    srun.parent.mkdir()
    srun.write_text(f'#!/bin/sh\nSLURM_CONF={folder}/slurm.conf exec {shutil.which("srun")} "$@"\n')
    srun.chmod(0o755)
    key = folder / "munge.key"
    key.write_bytes(os.urandom(1024))
    key.chmod(0o400)
    munge = ["munged", "--foreground", "--force", f"--key-file={key}", f"--socket={folder}/munge.socket"]
    munge += [f"--pid-file={folder}/munged.pid", f"--seed-file={folder}/munge.seed", f"--log-file={folder}/munged.log"]
    with ExitStack() as daemons:
        daemons.enter_context(_daemon(cluster, *munge))
        _wait_for((folder / "munge.socket").exists, folder)
        daemons.enter_context(_daemon(cluster, "slurmctld", "-D", "-c"))
        daemons.enter_context(_daemon(cluster, "slurmd", "-D", "-c", "-N", host))
        _wait_for(lambda: "idle" in _said(cluster, "sinfo", "--noheader", "--format=%T"), folder)
        try:
            yield cluster
        finally:
            _said(cluster, "scancel", "--partition=main")
            _wait_for(lambda: not cluster.jobs("PENDING", "RUNNING", "COMPLETING"), folder)


@contextmanager
def _daemon(cluster: SmallCluster, name: str, *words: str) -> Iterator[None]:
    """A process that stays in the foreground, until the end of the block."""
    with open(cluster.folder / f"{name}.said", "w") as said:
        program = shutil.which(name, path=PATH)
        assert program, f"{name} is missing: make test-slurm says which packages it needs"
        process = subprocess.Popen([program, *words], env=cluster.environment, stdout=said, stderr=said, start_new_session=True)
    try:
        yield
    finally:
        process.terminate()
        try:
            process.wait(20)
        except subprocess.TimeoutExpired:
            process.kill()
            process.wait()


def _said(cluster: SmallCluster, *words: str) -> str:
    """What a command says, of a cluster that may not be there yet."""
    return subprocess.run(words, env=cluster.environment, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True).stdout


def _wait_for(condition, folder: Path, seconds: float = 60.0) -> None:
    end = time.monotonic() + seconds
    while not condition():
        if time.monotonic() > end:
            said = "\n".join(f"{path.name}:\n{path.read_text()[-2000:]}" for path in sorted(folder.glob("*.said")))
            raise AssertionError(f"SLURM does not start:\n{said}")
        time.sleep(0.2)


def _free_ports(number: int) -> list[int]:
    sockets = [socket.socket() for _ in range(number)]
    for one in sockets:
        one.bind(("127.0.0.1", 0))
    ports = [one.getsockname()[1] for one in sockets]
    for one in sockets:
        one.close()
    return ports
