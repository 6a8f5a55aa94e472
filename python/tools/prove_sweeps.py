"""Prove that a sweep is the same to the byte on a local pool and on a Ray cluster that loses a node.

Starts a cluster of three nodes on this machine (``ray.cluster_utils.Cluster``), kills one of them in the middle of a sweep
of 200 runs, and compares the tables. Then measures the speed-up of the local pool. Run by ``cargo xtask sweeps``.
"""

from __future__ import annotations

import argparse
import hashlib
import json
import os
import resource
import shutil
import subprocess
import sys
import time
from pathlib import Path
from typing import Any

ROOT = Path(__file__).parents[2]
SCENARIO = ROOT / "scenarios" / "navigation_lost_scans.scenario.yaml"
"""A robot drives to a goal, with AMCL and the servers of Nav2, while scans are lost."""

GRID = ["--param", "inflation_radius=0.3:0.7:5", "--param", "loss=0.3,0.7"]
SEEDS = 20
RUNS = 10 * SEEDS

NODES = 3
NODE_CPUS = 2

KILL_AFTER_RUNS = RUNS // 3
"""Number of results after which a node is killed."""

SPEED_SEEDS = 4
"""Seeds of each point in the measurement of the speed-up: 40 runs."""


def words(out: Path, seeds: int, *options: str) -> list[str]:
    command = [sys.executable, "-m", "periplus", "sweep", str(SCENARIO), *GRID]
    return [*command, "--seeds", str(seeds), "--out", str(out), "--json", *options]


def summary(command: list[str]) -> dict[str, Any]:
    done = subprocess.run(command, stdout=subprocess.PIPE, cwd=ROOT, check=True)
    values: dict[str, Any] = json.loads(done.stdout)
    return values


def digest(out: Path) -> str:
    return hashlib.sha256((out / "sweep.parquet").read_bytes()).hexdigest()


def results(out: Path) -> int:
    return len(list((out / "results").glob("*.json")))


def on_ray(out: Path) -> dict[str, Any]:
    """Run the sweep on three nodes and kill one that is not the head."""
    os.environ.setdefault("RAY_raylet_start_wait_time_s", "180")
    from ray.cluster_utils import Cluster

    cluster = Cluster(initialize_head=True, head_node_args={"num_cpus": NODE_CPUS})
    try:
        others = [cluster.add_node(num_cpus=NODE_CPUS) for _ in range(NODES - 1)]
        print(f"cluster of {NODES} nodes with {NODE_CPUS} processors each")
        running = subprocess.Popen(words(out, SEEDS, "--ray", cluster.address), stdout=subprocess.PIPE, cwd=ROOT)
        while running.poll() is None and results(out) < KILL_AFTER_RUNS:
            time.sleep(0.05)
        at_kill = results(out)
        cluster.remove_node(others[-1], allow_graceful=False)
        print(f"a node was killed after {at_kill} of {RUNS} runs")
        text, _ = running.communicate()
        if running.returncode != 0:
            raise SystemExit(f"the sweep on Ray ended with {running.returncode}")
        values: dict[str, Any] = json.loads(text)
        return values
    finally:
        cluster.shutdown()


def check(holds: bool, text: str) -> None:
    print(f"{'pass' if holds else 'FAIL'} {text}")
    if not holds:
        raise SystemExit(1)


def prove(folder: Path) -> None:
    local, cluster = folder / "local", folder / "ray"
    for out in (local, cluster):
        shutil.rmtree(out, ignore_errors=True)
    first = summary(words(local, SEEDS, "--workers", "2"))
    check(first["ran"] == RUNS, f"local pool: {first['ran']} runs")
    second = on_ray(cluster)
    started = second["started"]
    check(second["ran"] == RUNS, f"Ray: {second['ran']} runs")
    lost = started - RUNS
    check(0 <= lost <= NODE_CPUS, f"{started} starts: {lost} runs were lost with the node and repeated")
    check(digest(local) == digest(cluster), f"the same table: sha256 {digest(local)}")
    again = summary(words(cluster, SEEDS, "--workers", "2"))
    check((again["ran"], again["reused"]) == (0, RUNS), f"again: {again['ran']} runs, {again['reused']} were there")
    check(digest(cluster) == digest(local), "and the same table")

    import pyarrow.parquet as parquet

    table = parquet.read_table(local / "sweep.parquet")
    check(table.num_rows == RUNS, f"pyarrow reads {table.num_rows} rows and {table.num_columns} columns")


def measure(folder: Path) -> None:
    """Alternate one worker and two; compare wall time and processor time."""
    best: dict[int, float] = {}
    for _ in range(2):
        for workers in (1, 2):
            out = folder / "speed"
            shutil.rmtree(out, ignore_errors=True)
            load, began, used = os.getloadavg()[0], time.monotonic(), cpu_s()
            count = summary(words(out, SPEED_SEEDS, "--workers", str(workers), "--no-artifacts"))["ran"]
            took, spent = time.monotonic() - began, cpu_s() - used
            best[workers] = min(took, best.get(workers, took))
            print(f"{workers} workers: {count} runs in {took:.1f} s, {spent:.1f} s of processors, load {load:.1f}")
    print(f"speed-up of two workers: {best[1] / best[2]:.2f}")


def cpu_s() -> float:
    used = resource.getrusage(resource.RUSAGE_CHILDREN)
    return used.ru_utime + used.ru_stime


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--out", type=Path, default=ROOT / "target" / "sweeps")
    parser.add_argument("--only", choices=["proof", "speed"])
    options = parser.parse_args()
    options.out.mkdir(parents=True, exist_ok=True)
    if options.only != "speed":
        prove(options.out)
    if options.only != "proof":
        measure(options.out)


if __name__ == "__main__":
    main()
