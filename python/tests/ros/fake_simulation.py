"""A substitute for the simulation that a program in lockstep is connected to, and a program that runs scripts with it.

`python fake_simulation.py FILE [ARGUMENTS]`: runs FILE in step with it. Variables: FAKE_MESSAGES, times of arrivals [ns] separated by
commas; FAKE_END, end of the simulation [ns].
"""

import os
import sys
import time


class FakeSimulation:
    """The lockstep part of `RosGraph`: time jumps to the next event."""

    def __init__(self, messages: tuple[int, ...] = (), end_ns: int | None = None) -> None:
        self.is_lockstep = True
        self.events = 0
        self.exchanges = 0
        self.arrivals = sorted(messages)
        self.end_ns = end_ns
        self._now_ns = 0
        self._was_woken = False
        # The true clock: lockstep replaces it.
        self._sleep = time.sleep

    def now_ns(self) -> int:
        return self._now_ns

    steady_ns = now_ns

    def wake(self) -> None:
        self.events += 1
        self._was_woken = True

    def exchange(self, wake_ns: int | None, wants_messages: bool) -> None:
        self.exchanges += 1
        if self._was_woken:
            self._was_woken = False
            return
        times = [] if wake_ns is None else [wake_ns]
        if wants_messages and self.arrivals:
            times.append(self.arrivals[0])
        if self.end_ns is not None and (not times or min(times) > self.end_ns):
            self._now_ns = self.end_ns
            raise ConnectionResetError("the simulation has ended")
        if not times:
            # Nothing will ever happen: only a signal can go on.
            for _ in range(2000):
                if self._was_woken:
                    return
                self._sleep(0.01)
            sys.stderr.write("hangs\n")
            os._exit(70)
        self._now_ns = max(self._now_ns, min(times))
        while self.arrivals and self.arrivals[0] <= self._now_ns:
            self.arrivals.pop(0)
            self.events += 1


if __name__ == "__main__":
    from periplus.ros import _faults, _lockstep, _run

    end = os.environ.get("FAKE_END")
    times = tuple(int(word) for word in os.environ.get("FAKE_MESSAGES", "").split(",") if word)
    graph = FakeSimulation(times, int(end) if end else None)
    sys.modules["fake_graph"] = graph  # type: ignore[assignment]
    sys.argv[:] = sys.argv[1:]
    sys.path[0] = os.path.dirname(os.path.abspath(sys.argv[0]))
    _faults.install()
    _lockstep.start("fake", graph=graph)
    _run.run_script(sys.argv[0])
