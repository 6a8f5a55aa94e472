"""Parameter sweeps: runs of a scenario over a grid of parameters and seeds, here, on a Ray cluster, or as a search.

The engine is that of the command ``periplus sweep``. The results are the same to the byte, whatever ran them.

>>> from periplus.sweeps import sweep
>>> sweep("missing.scenario.yaml", {"loss": [0.1, 0.2]})
Traceback (most recent call last):
periplus.sweeps.SweepFailed: cannot read missing.scenario.yaml: there is no such file
"""

from __future__ import annotations

import json
import os
import socket
import subprocess
import sys
import tempfile
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Optional, Union

from periplus import _native
from periplus._types import StrPath

__all__ = ["Metric", "Point", "Sweep", "SweepFailed", "sweep"]

Values = Union[str, Sequence[Any]]
"""Values of a parameter: a list, or a text such as ``"0.3:0.8:6"``."""


class SweepFailed(RuntimeError):
    """A sweep that cannot start, or runs that have no result."""


@dataclass(frozen=True)
class Metric:
    """Statistics of a column over the seeds of a point.

    >>> from periplus.sweeps import Metric
    >>> Metric("length_m", 20, 3.1, 2.9, 3.0, 3.4).median
    3.0
    """

    name: str
    """Name of the column."""
    count: int
    """Number of runs with a value."""
    mean: float
    """Mean value."""
    q10: float
    """Quantile of 10 %."""
    median: float
    """Median."""
    q90: float
    """Quantile of 90 %."""


@dataclass(frozen=True)
class Point:
    """Point of a sweep.

    >>> from periplus.sweeps import Point
    >>> Point({"loss": "0.1"}, 20, {}).values
    {'loss': '0.1'}
    """

    values: dict[str, str]
    """Values of the parameters, as texts."""
    runs: int
    """Number of runs."""
    metrics: dict[str, Metric]
    """Metrics by name."""


class Sweep:
    """Result of a sweep.

    >>> from periplus.sweeps import Sweep
    >>> Sweep({"runs": 0, "points": [], "table": "a/sweep.parquet", "picture": "a/overview.svg"}).table.name
    'sweep.parquet'
    """

    def __init__(self, values: Mapping[str, Any]) -> None:
        """Take the summary as ``periplus sweep --json`` prints it."""
        self.values: dict[str, Any] = dict(values)

    @property
    def table(self) -> Path:
        """Parquet file with a row for each run: ``polars.read_parquet(sweep.table)``."""
        return Path(self.values["table"])

    @property
    def picture(self) -> Path:
        """SVG with each metric over each parameter."""
        return Path(self.values["picture"])

    @property
    def points(self) -> list[Point]:
        """Points with their statistics, in the order of the table."""
        return [
            Point(
                dict(one["values"]), int(one["runs"]), {own["name"]: Metric(**own) for own in one["metrics"]}
            )
            for one in self.values["points"]
        ]

    def __repr__(self) -> str:
        return f"<Sweep of {self.values['runs']} runs, {len(self.values['points'])} points>"


def sweep(
    scenario: StrPath,
    parameters: Optional[Mapping[str, Values]] = None,
    *,
    points: Optional[Sequence[Mapping[str, Any]]] = None,
    seeds: int = 1,
    seed: Optional[int] = None,
    variables: Optional[Mapping[str, Any]] = None,
    out: Optional[StrPath] = None,
    workers: Optional[int] = None,
    ray: Optional[str] = None,
    artifacts: bool = True,
) -> Sweep:
    """Run a scenario file at all combinations of ``parameters``, or at these ``points``, with ``seeds`` seeds each.

    Runs in ``workers`` processes here, or on the Ray cluster at the address ``ray``. Runs whose results are in the folder
    ``out`` are not repeated. Raises :class:`SweepFailed` if a run has no result; assertions that fail are results.

    >>> from periplus.sweeps import sweep
    >>> sweep("missing.scenario.yaml", seeds=20)
    Traceback (most recent call last):
    periplus.sweeps.SweepFailed: cannot read missing.scenario.yaml: there is no such file
    """
    words = [*_own_command(), "sweep", str(scenario), "--seeds", str(seeds), "--json"]
    for name, values in (parameters or {}).items():
        text = values if isinstance(values, str) else ",".join(_text(value) for value in values)
        words += ["--param", f"{name}={text}"]
    for name, value in (variables or {}).items():
        words += ["--set", f"{name}={_text(value)}"]
    for option, given in (("--seed", seed), ("--out", out), ("--workers", workers), ("--ray", ray)):
        if given is not None:
            words += [option, str(given)]
    if not artifacts:
        words.append("--no-artifacts")
    with tempfile.TemporaryDirectory(prefix="periplus-points-") as folder:
        if points is not None:
            file = Path(folder) / "points.json"
            file.write_text(json.dumps([dict(point) for point in points]), encoding="utf-8")
            words += ["--points", str(file)]
        return Sweep(_summary(words))


def _own_command() -> list[str]:
    return [sys.executable, "-m", "periplus"]


def _text(value: Any) -> str:
    return str(value).lower() if isinstance(value, bool) else str(value)


def _summary(words: Sequence[str]) -> dict[str, Any]:
    """Run ``periplus sweep`` with ``--json``, and return what it prints."""
    ended = subprocess.run(words, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, check=False)
    if ended.returncode != 0:
        lines = [line for line in ended.stderr.splitlines() if line.strip()]
        reason = "\n".join(lines).removeprefix("error: ")
        raise SweepFailed(reason or f"periplus sweep ended with {ended.returncode}")
    values: dict[str, Any] = json.loads(ended.stdout)
    return values


# ---- Ray


MAX_RETRIES = 3
"""Number of times that Ray repeats a run whose node or process is lost."""

CONNECT_TIMEOUT_S = 10.0
"""Time in which the head of a Ray cluster must accept a connection [s]."""

WINDOW_FACTOR = 3
"""Number of tasks that wait for each processor of the cluster."""

MIN_WINDOW = 8
"""Number of tasks that are submitted at least."""


def _install(files: Mapping[str, bytes], folders: Sequence[str], name: str) -> Path:
    """Write the copy of a sweep's files on this node, unless it is there."""
    tree = Path(tempfile.gettempdir()) / f"periplus-sweep-{os.getuid() if hasattr(os, 'getuid') else 0}" / name
    if tree.exists():
        return tree
    part = tree.with_name(f"{name}.{os.getpid()}.part")
    for folder in folders:
        (part / folder).mkdir(parents=True, exist_ok=True)
    for path, content in files.items():
        (part / path).parent.mkdir(parents=True, exist_ok=True)
        (part / path).write_bytes(content)
    try:
        part.rename(tree)
    except OSError:
        # Another process of this node was faster.
        if not tree.exists():
            raise
    return tree


def _run_job(
    plan: str, index: int, files: Mapping[str, bytes], folders: Sequence[str], name: str, artifacts: bool
) -> tuple[Optional[str], dict[str, bytes], str]:
    """Run a job on this node. Returns the result, the artifacts by name, and the reason if there is no result."""
    tree = _install(files, folders, name)
    with tempfile.TemporaryDirectory(prefix="periplus-run-") as folder:
        kept = Path(folder) / "run"
        try:
            result = _native.run_sweep_job(plan, index, tree, kept if artifacts else None)
        except RuntimeError as error:
            return None, {}, str(error)
        made = {path.name: path.read_bytes() for path in kept.iterdir()} if kept.exists() else {}
        return result, made, ""


def _store(folder: Path, key: str, result: str, artifacts: Mapping[str, bytes]) -> None:
    """Store a result under its key; its artifacts appear before it does."""
    if artifacts:
        failures = folder / "failures"
        part = failures / f"{key}.{os.getpid()}.part"
        part.mkdir(parents=True, exist_ok=True)
        for name, content in artifacts.items():
            (part / name).write_bytes(content)
        if not (failures / key).exists():
            part.rename(failures / key)
    file = folder / "results" / f"{key}.json"
    part = file.with_name(f"{file.name}.{os.getpid()}.part")
    part.write_text(result, encoding="utf-8", newline="\n")
    part.replace(file)


def _tree_of(plan_file: Path) -> Path:
    """Folder with the copy of the files of a plan."""
    return plan_file.parent / "inputs"


def _answers(address: str) -> bool:
    """True if something listens at HOST:PORT. Ray itself tries for minutes."""
    host, _, port = address.rpartition("://")[2].rpartition(":")
    if not host or not port.isdigit():
        return True
    try:
        with socket.create_connection((host.strip("[]"), int(port)), timeout=CONNECT_TIMEOUT_S):
            return True
    except OSError:
        return False


def _run_on_ray(order: Mapping[str, Any]) -> int:
    """Run jobs on a Ray cluster. Writes a line of JSON for each end of a job, and one with the number of starts."""
    try:
        import ray
    except ImportError:
        _complain(f"`--ray` needs Ray in this Python: `{sys.executable} -m pip install ray`")
        return 1
    plan_file = Path(order["plan"])
    plan_text = plan_file.read_text(encoding="utf-8")
    plan = json.loads(plan_text)
    name = _native.sweep_tree_name(plan_text)
    tree = _tree_of(plan_file) / name
    entries = sorted(path for path in tree.rglob("*"))
    files = {str(path.relative_to(tree)): path.read_bytes() for path in entries if path.is_file()}
    folders = [str(path.relative_to(tree)) for path in entries if path.is_dir()]
    address = order["address"]
    if not _answers(address):
        _complain(f"there is no Ray cluster at `{address}`; `ray start --head` prints the address of one")
        return 1
    try:
        ray.init(address=address, log_to_driver=False, logging_level="ERROR")
    except (ConnectionError, ValueError, RuntimeError) as error:
        _complain(f"there is no Ray cluster at `{address}`: {str(error).strip().splitlines()[0]}")
        return 1

    keeps = bool(order["artifacts"])

    def run(index: int, plan: str, files: Mapping[str, bytes], starts: Any) -> Any:
        # Waits, so that a start is counted before the run begins.
        ray.get(starts.begin.remote(index))
        return _run_job(plan, index, files, folders, name, keeps)

    from ray.util.scheduling_strategies import NodeAffinitySchedulingStrategy

    here = NodeAffinitySchedulingStrategy(ray.get_runtime_context().get_node_id(), soft=False)
    starts = ray.remote(num_cpus=0)(_Starts).options(scheduling_strategy=here).remote()
    task = ray.remote(num_cpus=1, max_retries=MAX_RETRIES, scheduling_strategy="SPREAD")(run)
    shared = (ray.put(plan_text), ray.put(files))
    waiting: dict[Any, int] = {}
    jobs: Iterator[int] = iter(order["jobs"])

    def submit() -> bool:
        index = next(jobs, None)
        if index is None:
            return False
        waiting[task.remote(index, *shared, starts)] = index
        return True

    window = max(MIN_WINDOW, WINDOW_FACTOR * int(ray.cluster_resources().get("CPU", 1)))
    while len(waiting) < window and submit():
        pass
    while waiting:
        ready, _ = ray.wait(list(waiting), num_returns=1)
        index = waiting.pop(ready[0])
        failure: Optional[str] = None
        try:
            result, artifacts, reason = ray.get(ready[0])
            if result is None:
                failure = reason
            else:
                _store(plan_file.parent, plan["jobs"][index]["key"], result, artifacts)
        except ray.exceptions.RayError as error:
            failure = f"Ray could not run it: {str(error).strip().splitlines()[0]}"
        _say_event({"job": index, "failure": failure})
        submit()
    counts: dict[int, int] = ray.get(starts.counts.remote())
    _say_event({"started": sum(counts.values()), "starts": counts})
    ray.shutdown()
    return 0


class _Starts:
    """Count of the starts of runs, on the node of the driver."""

    def __init__(self) -> None:
        self.count: dict[int, int] = {}

    def begin(self, index: int) -> None:
        self.count[index] = self.count.get(index, 0) + 1

    def counts(self) -> dict[int, int]:
        return self.count


def _say_event(event: Mapping[str, Any]) -> None:
    print(json.dumps(event), flush=True)


def _complain(text: str) -> None:
    print(f"error: {text}", file=sys.stderr)


# ---- search


def _search(order: Mapping[str, Any]) -> int:
    """Search with Optuna: one point after the other, whose seeds run in parallel. The sequence depends on the seed only."""
    try:
        import optuna
    except ImportError:
        _complain(f"`--search` needs Optuna in this Python: `{sys.executable} -m pip install optuna`")
        return 1
    optuna.logging.set_verbosity(optuna.logging.WARNING)
    sampler = optuna.samplers.TPESampler(seed=int(order["sampler_seed"]))
    study = optuna.create_study(direction=order["direction"], sampler=sampler)
    column = order["column"]
    tried: list[dict[str, str]] = []
    try:
        for number in range(int(order["trials"])):
            trial = study.ask()
            point = {one["name"]: _suggest(trial, one) for one in order["parameters"]}
            if point not in tried:
                tried.append(point)
            (found,) = _points(order, [point], fresh=True)
            metric = found.metrics.get(column)
            if metric is None:
                if number == 0:
                    _check_column(found, column)
                study.tell(trial, state=optuna.trial.TrialState.FAIL)
            else:
                study.tell(trial, metric.mean)
            if not order["quiet"]:
                value = "no value" if metric is None else f"{metric.mean:.6g}"
                words = " ".join(f"{name}={value}" for name, value in point.items())
                print(f"{number + 1}: {words}: {column} {value}", file=sys.stderr)
        summary = Sweep(_summary(_search_words(order, tried, fresh=False)))
    except SweepFailed as error:
        _complain(str(error))
        return 1
    complete = [it for it in study.trials if it.state == optuna.trial.TrialState.COMPLETE]
    best = study.best_trial if complete else None
    found_best = None if best is None else {"values": _texts(best.params), "value": best.value}
    if order["json"]:
        print(json.dumps({**summary.values, "best": found_best}, indent=2))
    elif not order["quiet"]:
        if found_best is None:
            print(f"no point has a value of {column}", file=sys.stderr)
        else:
            words = " ".join(f"{name}={value}" for name, value in found_best["values"].items())
            print(f"best: {words}: {column} {found_best['value']:.6g}", file=sys.stderr)
        print(f"table: {summary.table}\npicture: {summary.picture}", file=sys.stderr)
    return 0


def _texts(params: Mapping[str, Any]) -> dict[str, str]:
    """Values of a trial as texts."""
    return {name: _text(value) for name, value in params.items()}


def _suggest(trial: Any, parameter: Mapping[str, Any]) -> str:
    if "values" in parameter:
        return str(trial.suggest_categorical(parameter["name"], parameter["values"]))
    return repr(trial.suggest_float(parameter["name"], parameter["low"], parameter["high"]))


def _search_words(order: Mapping[str, Any], points: Sequence[Mapping[str, str]], fresh: bool) -> list[str]:
    options = [word for word in order["options"] if fresh or word != "--fresh"]
    out = Path(order["out"])
    out.mkdir(parents=True, exist_ok=True)
    file = out / "points.json"
    file.write_text(json.dumps([dict(point) for point in points]), encoding="utf-8")
    words = [*order["program"], "sweep", order["scenario"], "--out", str(out), "--points", str(file)]
    return [*words, *options, "--json"]


def _points(order: Mapping[str, Any], points: Sequence[Mapping[str, str]], fresh: bool) -> list[Point]:
    return Sweep(_summary(_search_words(order, points, fresh))).points


def _check_column(point: Point, column: str) -> None:
    """Raise for a column that has no value at the first point: most likely it is misspelled."""
    known = ", ".join(point.metrics) or "no metrics"
    raise SweepFailed(f"no run of the first point has a value of `{column}`; the table has {known}")


def _main(words: Sequence[str]) -> int:
    parts = {"ray": _run_on_ray, "search": _search}
    if len(words) != 1 or words[0] not in parts:
        _complain("this module is started by `periplus sweep`")
        return 2
    try:
        return parts[words[0]](json.load(sys.stdin))
    except KeyboardInterrupt:
        return 130


if __name__ == "__main__":
    # Ray sends functions of a module by name, and those of a program by value.
    from periplus import sweeps

    sys.exit(sweeps._main(sys.argv[1:]))
