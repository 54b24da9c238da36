"""Studies: what is run, stopped, killed, gathered and sent, with the program that is built here."""
import contextlib
import json
import os
import pathlib
import resource
import shutil
import signal
import subprocess
import sys
import time

import pytest

from program import rows, started
from polynya.study import measures
from study_command import OF_PYTHON, files_of, folder, gathered, planned, study, write_study


def test_any_number_of_jobs_gives_the_same_cases_and_a_finished_one_costs_nothing(folder):
    path = write_study(folder, grid={"ice.thickness_m": [0.4, 0.5, 0.6]}, repetitions=2)
    study("plan", path, "--out", "one", "--trial-seconds", 0)
    study("plan", path, "--out", "two", "--trial-seconds", 0)
    study("run", "one", "--jobs", 1, "--quiet")
    assert "case 4: finished" in study("run", "two", "--case", 4)
    study("run", "two", "--jobs", 2, "--quiet")
    for number in range(6):
        assert files_of(folder / f"one/cases/{number:06d}") == files_of(folder / f"two/cases/{number:06d}")
    assert gathered(folder / "one") == gathered(folder / "two")
    before = (folder / "two/cases/000004/case.json").stat().st_mtime_ns
    study("run", "two", "--case", 4)
    assert (folder / "two/cases/000004/case.json").stat().st_mtime_ns == before


LONG = {"time.until_s": 60, "time.step_s": 0.001, "record.frames_interval_s": 20}  # half a second or more


def wait_for(is_there, seconds=30):
    deadline = time.monotonic() + seconds
    while not is_there() and time.monotonic() < deadline:
        time.sleep(0.005)


def has_rows(run):
    return (run / "forces.csv").exists() and (run / "forces.csv").stat().st_size > 4000


def start_long_case(folder, name):
    """A case whose run has begun to write, and is held there by SIGSTOP."""
    run = planned(folder, name, set=LONG) / "cases/000000/run"
    running = subprocess.Popen([*OF_PYTHON, "run", f"studies/{name}", "--case", "0"], stderr=subprocess.PIPE, text=True)
    wait_for(lambda: running.poll() is not None or has_rows(run))
    assert running.poll() is None
    child = child_of(running)
    os.kill(child, signal.SIGSTOP)
    return running, child


def let_go(held):
    """Lets a process that is held go on, as soon as a signal waits for it or it is gone."""
    deadline = time.monotonic() + 20
    with contextlib.suppress(FileNotFoundError, ProcessLookupError):
        while time.monotonic() < deadline:
            status = dict(line.split(":\t", 1) for line in open(f"/proc/{held}/status") if ":\t" in line)
            if status["State"].startswith("Z") or int(status["SigPnd"], 16) or int(status["ShdPnd"], 16):
                break
            time.sleep(0.001)
        os.kill(held, signal.SIGCONT)


def child_of(process):
    return int(pathlib.Path(f"/proc/{process.pid}/task/{process.pid}/children").read_text().split()[0])


def test_what_is_stopped_or_killed_continues_and_comes_to_the_same_bytes(folder):
    planned(folder, "whole", set=LONG)
    study("run", "studies/whole", "--quiet")
    whole = files_of(folder / "studies/whole/cases/000000")
    for name, end, code in (
        ("stopped", lambda p: p.send_signal(signal.SIGTERM), 75),
        ("killed", lambda p: os.kill(child_of(p), signal.SIGKILL), 75),
        ("orphan", lambda p: p.kill(), -signal.SIGKILL),
    ):
        running, child = start_long_case(folder, name)
        if name == "stopped":
            assert "case 0: another process runs it" in study("run", f"studies/{name}", "--case", 0, code=5)
        end(running)
        let_go(child)
        words = running.communicate()[1]
        assert running.returncode == code, words
        again = [*OF_PYTHON, "run", f"studies/{name}", "--case", "0"]
        if name == "orphan":  # the run itself stops when what started it is gone
            wait_for(lambda: b"another process" not in subprocess.run(again, capture_output=True, check=False).stderr)
        assert (folder / f"studies/{name}/cases/000000/case.json").exists() == (name == "orphan")
        study("run", f"studies/{name}", "--case", 0)
        assert files_of(folder / f"studies/{name}/cases/000000") == whole


def test_a_case_whose_run_crashes_has_failed(folder):
    running, child = start_long_case(folder, "crashed")
    os.kill(child, signal.SIGABRT)
    let_go(child)
    words = running.communicate()[1]
    assert running.returncode != 0 and "case 0: crashed by signal 6" in words
    assert json.loads((folder / "studies/crashed/cases/000000/case.json").read_text())["state"] == "failed"
    assert "1 failed" in study("run", "studies/crashed", code=4)


def test_workers_whose_parent_is_killed_stop_their_runs_also_in_the_background(folder):
    run = planned(folder, set=LONG | {"time.step_s": 0.0005}) / "cases/000000/run"
    # A batch script starts a study in this way: as a background job of a shell, which ignores SIGINT.
    command = f"{sys.executable} -m polynya.study run studies/s --jobs 1 2>/dev/null & echo $!; wait"
    shell = subprocess.Popen(["bash", "-c", command], stdout=subprocess.PIPE, text=True)
    parent = int(shell.stdout.readline())
    wait_for(lambda: shell.poll() is not None or (run / "forces.csv").exists())
    os.kill(parent, signal.SIGKILL)
    shell.wait()
    wait_for(lambda: list(run.glob("checkpoint-*")))
    assert list(run.glob("checkpoint-*")) and not (run.parent / "case.json").exists()
    assert not pids_of("studies/s"), "workers are left"


def pids_of(words):
    """Processes of this test's Python whose working folder is ours and whose command line has the words."""
    found = []
    for process in pathlib.Path("/proc").glob("[0-9]*"):
        with contextlib.suppress(OSError):
            is_ours = (process / "cwd").resolve() == pathlib.Path.cwd()
            if is_ours and words in (process / "cmdline").read_bytes().decode().split("\0"):
                found.append(process.name)
    return found


def test_a_case_without_room_on_the_disk_is_unfinished_and_continues(folder):
    planned(folder, set={"time.until_s": 60})
    command = [*OF_PYTHON, "run", "studies/s", "--jobs", "1", "--quiet"]
    limit = lambda: resource.setrlimit(resource.RLIMIT_FSIZE, (100_000, 100_000))
    ran = subprocess.run(command, capture_output=True, text=True, preexec_fn=limit, check=False)
    assert ran.returncode != 0 and "File too large" in ran.stderr, ran.stderr
    assert "unfinished" in study("gather", "studies/s", code=75)
    gathered(folder / "studies/s")


def test_a_case_writes_nothing_outside_its_folder(folder):
    planned(folder, repetitions=2)

    def tree():
        return {p: p.stat().st_mtime_ns for p in folder.rglob("*") if p.is_file() and "cases/000001" not in str(p)}

    before = tree()
    study("run", "studies/s", "--case", 1)
    assert tree() == before
    assert sorted(p.name for p in (folder / "studies/s/cases/000001").iterdir()) == ["case.json", "run"]


def test_jobs_stop_with_checkpoints_and_go_on(folder):
    cases = planned(folder, set=LONG, repetitions=3) / "cases"
    run = cases / "000000/run"
    running = subprocess.Popen([*OF_PYTHON, "run", "studies/s", "--jobs", "2"], stderr=subprocess.PIPE)
    wait_for(lambda: running.poll() is not None or has_rows(run))
    running.send_signal(signal.SIGTERM)
    assert running.wait() == 75
    assert list(run.glob("checkpoint-*")) and not (run.parent / "case.json").exists()
    study("run", "studies/s", "--quiet")
    assert len(list(cases.glob("*/case.json"))) == 3


def test_a_terminal_has_a_live_table(folder):
    planned(folder, repetitions=3)
    ours, theirs = os.openpty()
    with subprocess.Popen([*OF_PYTHON, "run", "studies/s", "--jobs", "1"], stderr=theirs) as running:
        os.close(theirs)
        shown = b""
        with contextlib.suppress(OSError):  # the terminal's end
            while part := os.read(ours, 65536):
                shown += part
    os.close(ours)
    assert running.returncode == 0
    for words in ("running          1  case 0", "done             3 of 3  (100 %)",
                  "failed           0", "left          0:00"):
        assert words in shown.decode(), shown.decode()


def test_records_can_be_thinned_to_the_summary_and_brought_back(folder):
    case = planned(folder, "thin", keep="summary") / "cases/000000"
    study("run", planned(folder, "thick"), "--quiet")
    for _ in range(2):
        study("run", "studies/thin", "--quiet")
        assert names_in(case) == ["case.json"]
    study("run", "studies/thin", "--case", 0, "--keep", "all")
    assert files_of(case) == files_of(folder / "studies/thick/cases/000000")


def test_a_partial_gather_says_what_is_missing_and_how_to_repair_it(folder):
    planned(folder, grid={"ice.thickness_m": [0.4, 0.5, 0.6, 0.7]})
    study("run", "studies/s", "--cases", "0,2", "--quiet")
    failed = folder / "studies/s/cases/000003"
    failed.mkdir()
    result = {"state": "failed", "case": 3, "message": "numbers stopped being numbers", "exit_code": 4}
    (failed / "case.json").write_text(json.dumps(result))
    words = study("gather", "studies/s", code=4)
    assert "PARTIAL" in words and "polynya study run studies/s --cases 1" in words
    assert "polynya study run studies/s --retry-failed --cases 3" in words and "case 3: numbers stopped" in words
    cases = rows(folder / "studies/s/table.csv")
    assert [row["state"] for row in cases] == ["finished", "missing", "finished", "failed"]
    assert [row["ice.thickness_m"] for row in cases] == ["0.4", "0.5", "0.6", "0.7"]
    assert cases[1]["resistance_mean_N"] == "" and float(cases[0]["resistance_mean_N"]) > 0
    assert "1 failed" in study("run", "studies/s", code=4)  # a failure is not tried again by itself
    assert "case 3 has failed before; --retry-failed" in study("run", "studies/s", "--case", "3", code=4)
    study("run", "studies/s", "--retry-failed", "--case", "3", "--quiet")
    study("gather", "studies/s")
    summary = json.loads((folder / "studies/s/gather.json").read_text())
    assert summary["is_complete"] and summary["finished"] == 4 and not summary["repair"]


def test_measures_are_those_of_the_run(folder):
    goals = {"port": {"x_m": -51}, "never": {"x_m": 900}, "far": {"distance_m": 20}}
    planned(folder, set={"time.until_s": 30, "fracture.splitting.model": "none"},
            collect={"from_s": 5, "loads": ["thrust_N"], "time_to": goals})
    (row,), run = gathered(folder / "studies/s"), folder / "studies/s/cases/000000/run"
    forces = [{k: float(v) for k, v in r.items() if k != "ship"} for r in rows(run / "forces.csv")]
    kept = [-(r["surge_N"] + r["surge_from_submerged_ice_N"]) for r in forces if r["t_s"] > 5]
    summary = json.loads((run / "summary.json").read_text())
    assert float(row["resistance_mean_N"]) == pytest.approx(sum(kept) / len(kept))
    assert float(row["resistance_peak_N"]) == pytest.approx(max(kept))
    assert int(row["bends"]) == summary["counts"]["bends"] > 0 and row["outcome"] == "bent"
    assert float(row["mean_speed_m_per_s"]) == pytest.approx(1)
    assert float(row["distance_m"]) == pytest.approx(25, abs=0.11)
    assert float(row["time_to_port_s"]) == pytest.approx(10, abs=0.11) and row["time_to_never_s"] == ""
    assert float(row["time_to_far_s"]) == pytest.approx(20, abs=0.11)
    # The energy that keeps the ship at its speed equals the energy that the ice takes from it.
    assert float(row["energy_per_km_J"]) == pytest.approx(1000 * float(row["resistance_mean_N"]), rel=1e-6)


def test_rams_are_measured_from_one_charge_to_the_next():
    columns = {"t_s": [1, 2, 3, 4, 5, 6], "heading_deg": [0] * 6, "vy_m_per_s": [0] * 6,
               "vx_m_per_s": [0, -1, 5, 3, -1, 9], "rams": [0, 1, 1, 1, 2, 2], "gained_m": [0, 0, 4, 6, 6, 6]}
    found = measures.of_rams(columns)
    assert (found["rams"], found["gained_m"]) == (2, 6)
    assert (found["ram_gain_m"], found["ram_time_s"], found["ram_speed_m_per_s"]) == (6, 3, 5)
    few = measures.of_rams(columns | {"rams": [0, 1, 1, 1, 1, 1]})
    assert few["rams"] == 1 and few["ram_gain_m"] is None
    assert measures.of_rams({"t_s": [1]}) == {}
def test_what_is_measured_begins_where_the_ship_has_gone_so_far(folder):
    planned(folder, set={"time.until_s": 30, "fracture.splitting.model": "none"}, collect={"from_m": 12.05})
    (row,), run = gathered(folder / "studies/s"), folder / "studies/s/cases/000000/run"
    forces = [{k: float(v) for k, v in r.items() if k != "ship"} for r in rows(run / "forces.csv")]
    kept = [-(r["surge_N"] + r["surge_from_submerged_ice_N"]) for r in forces if r["t_s"] > 12.1 + 1e-9]
    assert float(row["resistance_mean_N"]) == pytest.approx(sum(kept) / len(kept))
    assert float(row["distance_m"]) == pytest.approx(17.9, abs=0.11)


def names_in(folder):
    return sorted(path.name for path in folder.iterdir())


def test_a_chunk_is_packed_into_one_file_and_read_from_it(folder):
    cases = planned(folder, "s", "--chunk", 2, repetitions=5, archive=True) / "cases"
    planned(folder, "loose", "--chunk", 2, repetitions=5)
    study("run", "studies/s", "--chunk", 1, "--quiet")
    assert names_in(cases) == ["000001.tar"]
    packed = (cases / "000001.tar").read_bytes()
    left = cases / "000001/000002"  # by a kill
    left.mkdir(parents=True)
    (left / "case.json").write_text("{")
    study("run", "studies/s", "--chunk", 1, "--quiet")
    assert not left.exists() and (cases / "000001.tar").read_bytes() == packed
    assert gathered(folder / "studies/s") == gathered(folder / "studies/loose")
    assert names_in(cases) == ["000000.tar", "000001.tar", "000002.tar"]
    study("run", "studies/s", "--case", 3)
    study("run", "studies/s", "--quiet")
    assert names_in(cases) == ["000000.tar", "000001.tar", "000002.tar"]


def test_a_packed_case_can_run_again(folder):
    cases = planned(folder, "s", "--chunk", 2, repetitions=4, archive=True, keep="summary") / "cases"
    study("run", "studies/s", "--quiet")
    study("run", "studies/s", "--case", 3, "--keep", "all")
    assert (cases / "000001/000003/run/frames.bin").exists() and not (cases / "000001.tar").exists()
    gathered(folder / "studies/s")
    assert names_in(cases) == ["000000.tar", "000001.tar"]


def test_slurms_script_has_the_chunks_that_are_left(folder):
    planned(folder, "s", "--chunk", 2, repetitions=8)
    study("run", "studies/s", "--cases", "2-3", "--quiet")
    study("slurm", "studies/s", "--throttle", 7, "--time", "2:30:00", "--sbatch=--partition=long")
    script = (folder / "studies/s/slurm/array.sbatch").read_text()
    for option in ("array=0,2-3%7", "time=2:30:00", "requeue", "partition=long"):
        assert f"#SBATCH --{option}\n" in script
    assert subprocess.run(["bash", "-n", folder / "studies/s/slurm/array.sbatch"], check=False).returncode == 0
    study("run", "studies/s", "--quiet")
    assert "every case has ended" in study("slurm", "studies/s")


def test_slurm_runs_failed_cases_of_packed_chunks_again_where_it_is_asked_to(folder):
    case = planned(folder, archive=True) / "cases/000000"
    case.mkdir(parents=True)
    result = {"state": "failed", "case": 0, "message": "numbers stopped being numbers", "exit_code": 4}
    (case / "case.json").write_text(json.dumps(result))
    study("run", "studies/s", "--quiet", code=4)
    assert names_in(folder / "studies/s/cases") == ["000000.tar"]
    assert "every case has ended" in study("slurm", "studies/s")
    assert "1 task" in study("slurm", "studies/s", "--retry-failed")


def test_slurm_gets_the_memory_asked_for_twice_and_each_job_is_named_as_it_is_taken(folder, monkeypatch):
    (folder / "bin").mkdir()
    sbatch = folder / "bin" / "sbatch"
    sbatch.write_text("""#!/bin/sh
for script; do :; done  # the last word
grep -q mem-per-cpu=$LEAST "$script" || { echo "Memory specification can not be satisfied" >&2; exit 1; }
case $script in */array.sbatch) echo 71 ;; *) echo "$2" >"$0.words"; echo "72;cluster" ;; esac
""")
    sbatch.chmod(0o755)
    monkeypatch.setenv("PATH", f"{sbatch.parent}:{os.environ['PATH']}")
    planned(folder)
    monkeypatch.setenv("LEAST", "0$")
    words = study("slurm", "studies/s", "--submit", "--memory", 0)
    assert "job 71\n" in words and "job 72, to gather" in words
    assert sbatch.with_suffix(".words").read_text() == "--dependency=afterany:71\n"
    monkeypatch.setenv("LEAST", "500M$")  # by default the gathering job asks for more
    words = study("slurm", "studies/s", "--submit", code=5)
    assert "job 71\n" in words and "can not be satisfied" in words
    assert "job 71 runs the cases; what gathers after it is still to submit: sbatch --dependency=afterany:71 " in words


@pytest.mark.skipif(not shutil.which("parallel"), reason="GNU parallel is not installed")
def test_the_line_for_gnu_parallel_runs_all_chunks(folder):
    planned(folder, "s", "--chunk", 2, repetitions=4)
    line = study("parallel", "studies/s", "--jobs", 2)
    # The line names the program that users start, `polynya study`, whereas the test starts Python.
    wrapper = folder / "bin"
    wrapper.write_text(f'#!/bin/sh\nshift\nexec {sys.executable} -m polynya.study "$@"\n')
    wrapper.chmod(0o755)
    line = line.replace(os.environ["POLYNYA_PROGRAM"], str(wrapper))
    subprocess.run(["bash", "-c", line], capture_output=True, check=True)
    study("gather", "studies/s")


def test_a_report_without_numpy_names_what_to_install(folder, monkeypatch):
    planned(folder)
    (folder / "numpy.py").write_text("raise ModuleNotFoundError(name='numpy')")
    monkeypatch.setenv("PYTHONPATH", f"{folder}:{os.environ['PYTHONPATH']}")
    words = study("report", "studies/s", code=5, by=started)
    assert words.startswith("polynya study: ") and "has no numpy: " in words and "./setup.sh python" in words
    study("gather", "studies/s", code=75, by=started)  # does without


def test_a_folder_without_a_plan_and_a_study_not_planned_are_named(folder):
    assert "no study is planned there" in study("gather", folder, code=5)
    path = write_study(folder)
    assert f"polynya study plan {path}" in study("gather", path, code=5)
    study("plan", path, "--trial-seconds", 0)
    assert "there is no case 7" in study("run", path, "--case", 7, code=2)
    plan = folder / "studies/s/plan.json"
    for text, message in (('{"format": 99}', "of format 99; this polynya reads format 1"), ("[]", "not a JSON object"),
                          ('{"format": 1}', '"name" is missing or of another kind'), ("{", "plan.json:1:2: not JSON")):
        plan.write_text(text)
        for words in (("plan", path, "--trial-seconds", 0), ("run", "studies/s"), ("gather", "studies/s")):
            assert f"studies/s/plan.json" in (told := study(*words, code=5)) and message in told
    (folder / "full").mkdir()
    (folder / "full" / "x").touch()
    assert "not empty" in study("plan", path, "--out", "full", code=5)


def test_a_file_that_changed_after_it_was_planned_is_not_run_by_the_old_plan(folder):
    path = write_study(folder, set={"time.until_s": 0.1})
    study("plan", path, "--repetitions", 2, "--trial-seconds", 0)
    later = time.time() + 5
    os.utime(path, (later, later))
    study("run", path, "--quiet")  # the text is the same, and the plan may have other repetitions
    write_study(folder, set={"time.until_s": 0.2})
    os.utime(path, (later, later))
    told = study("run", path, code=5)
    assert "planned from an earlier text of" in told and "which now has other set" in told
    write_study(folder, set={"time.until_s": 0.1}, grid={"ice.friction": [0.1, 0.2]})
    os.utime(path, (later, later))
    assert "now has other varied" in study("run", path, code=5)
    study("run", "studies/s", "--quiet")  # the folder's own plan
