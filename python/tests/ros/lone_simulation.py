"""Runs a script in lockstep with a simulation that has nothing but this process: `python lone_simulation.py FILE [ARGUMENTS]`.

Topics and services are those of a graph without a network; time jumps to the next wake-up. `LONE_END` is the simulated time
at which the simulation ends [s].
"""

import os
import sys
from typing import Any

from periplus import _native

_RealGraph: Any = _native.RosGraph  # type: ignore[attr-defined]


class LoneSimulation:
    """The clock that all graphs of the process share."""

    def __init__(self) -> None:
        # Not zero, so that programs can ask for times before.
        self.time_ns = 1000 * 10**9
        self.end_ns = round(float(os.environ["LONE_END"]) * 1e9) if "LONE_END" in os.environ else None
        self.graphs: list[Any] = []

    def graph(self, arguments: list[str] | None = None, **_: Any) -> "LoneGraph":
        made = LoneGraph(self, arguments or [])
        self.graphs.append(made)
        return made


class LoneGraph:
    """`RosGraph` in lockstep with a `LoneSimulation`."""

    is_lockstep = True

    def __init__(self, simulation: LoneSimulation, arguments: list[str]) -> None:
        self._simulation = simulation
        self._graph = _RealGraph(arguments, network=False)

    def __getattr__(self, name: str) -> Any:
        return getattr(self._graph, name)

    def now_ns(self) -> int:
        return self._simulation.time_ns

    steady_ns = now_ns

    def wait(self, seen: int, timeout_ns: int | None = None) -> int:
        raise AssertionError("in lockstep, waits go through periplus.ros._waiting")

    def exchange(self, wake_ns: int | None, wants_messages: bool) -> None:
        # A wake-up by a signal handler comes as an event; nothing else arrives while no thread runs.
        end_ns = self._simulation.end_ns
        if end_ns is not None and (wake_ns is None or wake_ns > end_ns):
            self._simulation.time_ns = end_ns
            raise ConnectionError("the simulation has ended")
        before = [graph.events for graph in self._simulation.graphs]
        if wake_ns is None:
            for _ in range(100):
                _RealGraph.wait(self._graph, self._graph.events, 100_000_000)
                if before != [graph.events for graph in self._simulation.graphs]:
                    return
            sys.stderr.write("nothing will ever happen\n")
            os._exit(70)
        self._simulation.time_ns = max(self._simulation.time_ns, wake_ns)


if __name__ == "__main__":
    from periplus.ros import _faults, _lockstep, _run, activate

    simulation = LoneSimulation()
    _native.RosGraph = simulation.graph  # type: ignore[attr-defined]
    sys.argv[:] = sys.argv[1:]
    script = os.path.abspath(sys.argv[0])
    sys.path[0] = os.path.dirname(script)
    activate()
    _faults.install()
    _lockstep.start("alone")
    _run.run_script(script)
