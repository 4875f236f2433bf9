"""What a job says and leaves, and what it does not load."""

import signal
import subprocess
import sys
from pathlib import Path

import pytest
from workflow.project import is_running, run_logged, wait_for


def test_all_output_goes_to_the_log(tmp_path: Path) -> None:
    code = "import os, logging; print('said'); os.system('echo shell'); logging.getLogger('granugas.x').info('logged')"
    done = run_logged(code, tmp_path / "logs/job.log")
    said = (tmp_path / "logs/job.log").read_text()
    assert (done.stdout, done.stderr, done.returncode) == ("", "", 0)
    assert all(word in said for word in ("said", "shell", "job: logged", "done"))


def test_a_job_runs_kernels_without_loading_scipy_and_has_it_when_it_asks(tmp_path: Path) -> None:
    loaded = "[name for name in sys.modules if name.startswith('scipy')]"
    code = f"import sys; from granugas import Scene, warm_up; warm_up([Scene(4)]); print({loaded}); import scipy.linalg"
    assert run_logged(code, tmp_path / "job.log").returncode == 0
    assert "[]" in (tmp_path / "job.log").read_text()


def test_warnings_of_the_package_reach_the_terminal_too(tmp_path: Path) -> None:
    code = "import logging; [logging.getLogger(name).warning('from ' + name) for name in ('granugas.x', 'other')]"
    done = run_logged(code, tmp_path / "job.log")
    assert "from granugas.x" in done.stderr and "from other" not in done.stderr
    assert "from granugas.x" in (tmp_path / "job.log").read_text()


def test_the_terminal_gets_the_first_warning_of_a_kind_and_the_log_all(tmp_path: Path) -> None:
    code = (
        "import logging; warn = logging.getLogger('granugas').warning; "
        "[warn('%d disks (%s) collapse', k, ', '.join('9' * k)) for k in range(1, 65)]; [warn('too cold') for k in range(2)]"
    )
    done, log = run_logged(code, tmp_path / "job.log"), tmp_path / "job.log"
    said = [line.partition(" job: ")[2] for line in done.stderr.splitlines()]
    assert said == ["1 disks (9) collapse", "too cold", f"64 more warnings like that: {log}"]
    assert log.read_text().count("collapse") == 64 and log.read_text().count("too cold") == 2


def test_the_terminal_is_told_of_the_rest_where_a_job_fails(tmp_path: Path) -> None:
    code = "import logging; [logging.getLogger('granugas').warning('no. %d', k) for k in range(3)]; raise ValueError('no')"
    done = run_logged(code, tmp_path / "job.log")
    assert done.stderr.count("\n") == 2 and "2 more warnings like that: " in done.stderr
    assert (tmp_path / "job.log").read_text().splitlines()[-1] == "ValueError: no"


def test_an_error_is_the_last_line_of_the_log(tmp_path: Path) -> None:
    done = run_logged("raise ArithmeticError('no such gas')", tmp_path / "job.log")
    assert done.returncode == 1
    assert (tmp_path / "job.log").read_text().splitlines()[-1] == "ArithmeticError: no such gas"


@pytest.mark.parametrize(("before", "ends"), [("default_int_handler", -signal.SIGINT), ("SIG_IGN", 0)])
def test_ctrl_c_ends_a_job_at_once_unless_it_is_ignored(before: str, ends: int, tmp_path: Path) -> None:
    """Without an exception, which nothing can catch and hang in."""
    code = f"""
import signal
from granugas.jobs import logged
signal.signal(signal.SIGINT, signal.{before})
with logged({str(tmp_path / "job.log")!r}):
    try:
        signal.raise_signal(signal.SIGINT)
    except BaseException:
        print("caught")
"""
    assert subprocess.run([sys.executable, "-c", code]).returncode == ends
    assert "caught" not in (tmp_path / "job.log").read_text()


def test_a_job_dies_with_the_process_that_started_it(tmp_path: Path) -> None:
    log = tmp_path / "job.log"
    job = f"from granugas.jobs import logged\nwith logged({str(log)!r}):\n    import time; time.sleep(600)"
    start = f"import subprocess, sys; job = subprocess.Popen([sys.executable, '-c', {job!r}])"
    command = [sys.executable, "-c", f"{start}; print(job.pid, flush=True); job.wait()"]
    parent = subprocess.Popen(command, stdout=subprocess.PIPE, text=True)
    pid = int(parent.stdout.readline())
    wait_for(log.exists)
    parent.kill()
    parent.wait()
    wait_for(lambda: not is_running(pid), 60.0)


def test_a_log_that_cannot_be_written_is_told_in_a_line(tmp_path: Path) -> None:
    (tmp_path / "logs").write_text("in the way")
    done = run_logged("print('never said')", tmp_path / "logs/job.log")
    assert done.returncode == 1 and done.stderr.count("\n") == 1
    assert "logs/job.log: cannot be written (" in done.stderr
