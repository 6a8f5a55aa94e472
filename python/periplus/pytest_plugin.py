"""Plugin of pytest: scenarios and simulations as tests.

It is loaded with the package. Fixtures: ``scenario`` builds scenarios and runs them, ``world``, ``robot``,
``simulation``, ``navigation`` and ``ros`` are parts of a simulation for tests that step it themselves. Files named
``*.scenario.yaml`` are tests. Options: ``--periplus-artifacts DIR`` keeps recordings, pictures and logs of tests that
fail, ``--periplus-seed N`` sets the seed.

.. code-block:: python

    def test_delivery(scenario):
        run = scenario("worlds/house.sdf", "robot.urdf.xacro", nodes=["slam", "navigation"])
        run.goal((3, 0)).fault("dropout", topic="/scan", at=5, until=3)
        run.reached(within=0.3).no_collision().min_clearance(0.1)
        run.check()
"""

from __future__ import annotations

import re
import shutil
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import TYPE_CHECKING, Any, Optional

import pytest

import periplus.ros
from periplus.scenarios import Scenario, ScenarioFailed, ScenarioReport, load

if TYPE_CHECKING:
    from periplus import Simulation, World
    from periplus.navigation import Navigation

FILE_ENDING = ".scenario.yaml"
"""End of the names of files that are collected."""


def pytest_addoption(parser: pytest.Parser) -> None:
    """Add the options."""
    group = parser.getgroup("periplus", "simulated robots")
    group.addoption(
        "--periplus-artifacts",
        metavar="DIR",
        default=None,
        help="keep recording, map, picture and log of each test that fails, in a folder of this one",
    )
    group.addoption(
        "--periplus-seed",
        metavar="NUMBER",
        type=int,
        default=None,
        help="seed of all simulations and scenarios (default: that of the test)",
    )


def pytest_configure(config: pytest.Config) -> None:
    """Add the marker, and the modules of ROS where no ROS is installed, so that tests can import ``rclpy``."""
    if periplus.ros.installed_ros() is None:
        periplus.ros.activate(quiet=True)
    config.addinivalue_line(
        "markers",
        "periplus(world, robot, pose, arguments, physics, seed, slam): files and options of the fixtures `world`, "
        "`robot`, `simulation` and `navigation`",
    )


# ---- scenarios


def _seed(config: pytest.Config) -> Optional[int]:
    seed: Optional[int] = config.getoption("--periplus-seed")
    return seed


def _folder(config: pytest.Config, node_id: str) -> Optional[Path]:
    """Folder for the artifacts of a test."""
    base = config.getoption("--periplus-artifacts")
    if base is None:
        return None
    return Path(base) / re.sub(r"[^\w.-]+", "_", node_id).strip("_")


def _record(properties: Callable[[str, object], None], report: ScenarioReport) -> None:
    """Add seed and scores to the results in JUnit XML."""
    properties("seed", report.seed)
    for name, value in report.scores.items():
        properties(name, value)
    if report.artifacts is not None:
        properties("artifacts", str(report.artifacts))


class TestScenario(Scenario):
    """A scenario of a test: its seed and artifacts are those of the options."""

    __test__ = False

    def __init__(
        self,
        *arguments: Any,
        settings: tuple[Optional[int], Optional[Path]],
        record: Callable[[str, object], None],
        **values: Any,
    ) -> None:
        """Take the arguments of :class:`~periplus.scenarios.Scenario`."""
        super().__init__(*arguments, **values)
        self._settings = settings
        self._record = record

    def run(self, **options: Any) -> ScenarioReport:
        """Run the scenario and return its report; its scores are in the results of pytest."""
        seed, folder = self._settings
        options.setdefault("seed", seed)
        options.setdefault("artifacts", folder)
        report = super().run(**options)
        _record(self._record, report)
        return report


@pytest.fixture
def scenario(
    request: pytest.FixtureRequest, record_property: Callable[[str, object], None]
) -> Callable[..., TestScenario]:
    """Builder of scenarios, with the arguments of :class:`~periplus.scenarios.Scenario`."""
    node = request.node
    seed, folder = _seed(request.config), _folder(request.config, node.nodeid)
    count = 0

    def build(*arguments: Any, **values: Any) -> TestScenario:
        nonlocal count
        count += 1
        own = folder if folder is None or count == 1 else folder.with_name(f"{folder.name}_{count}")
        values.setdefault("name", node.name)
        return TestScenario(*arguments, settings=(seed, own), record=record_property, **values)

    return build


def pytest_collect_file(file_path: Path, parent: pytest.Collector) -> Optional[ScenarioFile]:
    """Collect scenario files."""
    if not file_path.name.endswith(FILE_ENDING):
        return None
    collected: ScenarioFile = ScenarioFile.from_parent(parent, path=file_path)
    return collected


class ScenarioFile(pytest.File):
    """A scenario file as a collection of one test."""

    def collect(self) -> Iterator[ScenarioItem]:
        """Return the test."""
        yield ScenarioItem.from_parent(self, name=self.path.name.removesuffix(FILE_ENDING))


class ScenarioItem(pytest.Item):
    """A scenario file as a test."""

    def runtest(self) -> None:
        """Run the scenario and require its assertions."""
        folder = _folder(self.config, self.nodeid)
        report = load(self.path, seed=_seed(self.config), artifacts=folder)
        _record(lambda name, value: self.user_properties.append((name, value)), report)
        if not report.passed:
            raise ScenarioFailed(report)

    def repr_failure(self, excinfo: pytest.ExceptionInfo[BaseException], style: Any = None) -> Any:
        """Show what failed, and not the code of the plugin."""
        if isinstance(excinfo.value, (ScenarioFailed, ValueError, RuntimeError)):
            return str(excinfo.value)
        return super().repr_failure(excinfo, style)

    def reportinfo(self) -> tuple[Path, Optional[int], str]:
        """Return file and name."""
        return self.path, None, self.name


# ---- simulations


def _options(request: pytest.FixtureRequest) -> dict[str, Any]:
    marker = request.node.get_closest_marker("periplus")
    return {} if marker is None else dict(marker.kwargs)


@pytest.hookimpl(hookwrapper=True)
def pytest_runtest_makereport(item: pytest.Item) -> Iterator[None]:
    """Remember whether the test failed, for the fixtures that keep artifacts."""
    outcome = yield
    report = outcome.get_result()  # type: ignore[attr-defined]
    if report.when == "call":
        item.stash[_HAS_FAILED] = report.failed


_HAS_FAILED = pytest.StashKey[bool]()


@pytest.fixture
def robot(request: pytest.FixtureRequest) -> Optional[str]:
    """File of the robot, from the marker ``periplus(robot=...)``; None without one."""
    path: Optional[str] = _options(request).get("robot")
    return path


@pytest.fixture
def world(request: pytest.FixtureRequest, robot: Optional[str]) -> World:
    """World of the marker ``periplus(world=..., robot=..., pose=...)``; without one, that of the demo."""
    from periplus import World

    options = _options(request)
    path = options.get("world")
    if path is None and robot is None:
        return World.demo()
    made = World() if path is None else World.load(path)
    if robot is not None:
        made.add_robot(robot, options.get("pose"), options.get("arguments"))
    return made


@pytest.fixture
def simulation(request: pytest.FixtureRequest, world: World) -> Iterator[Simulation]:
    """Simulation of the world. Of a test that fails its recording and a picture are kept."""
    from periplus import Simulation

    options = _options(request)
    seed = _seed(request.config)
    seed = options.get("seed", 0) if seed is None else seed
    made = Simulation(world, seed=seed, physics=options.get("physics", "rigid"))
    folder = _folder(request.config, request.node.nodeid)
    if folder is not None:
        folder.mkdir(parents=True, exist_ok=True)
        # Images and clouds of all sensors would make every run slow.
        light = [topic for topic, kind in made.topics.items() if kind.split("/")[-1] not in _HEAVY]
        made.record(folder / "run.mcap", topics=light)
    yield made
    if folder is None:
        return
    made.stop_recording()
    if request.node.stash.get(_HAS_FAILED, False):
        (folder / "picture.png").write_bytes(made._repr_png_())
    else:
        shutil.rmtree(folder, ignore_errors=True)


_HEAVY = {"Image", "CompressedImage", "CameraInfo", "PointCloud2", "PointCloud"}


@pytest.fixture
def navigation(request: pytest.FixtureRequest, simulation: Simulation) -> Navigation:
    """Navigation beside the robot of the simulation: ``navigation.go_to((2, 1, 0)).reached``."""
    from periplus.navigation import Navigation

    options = _options(request)
    return Navigation(simulation, slam=options.get("slam", True), start_pose=options.get("pose"))


class RosTopics:
    """Topics of a simulation for a test, and nodes of ``rclpy`` among those of the simulation."""

    def __init__(self, simulation: Simulation) -> None:
        """Take the simulation."""
        self._simulation = simulation
        self._messages: dict[str, list[Any]] = {}
        self._subscriptions: list[Any] = []
        self._executor: Any = None

    def node(self, name: str, **options: Any) -> Any:
        """Return a node of ``rclpy`` on the clock of the simulation; ``options`` are those of ``rclpy.node.Node``.

        Its messages stay in this process. ``spin`` calls what it subscribes to, its timers and its services.
        """
        return self.add_node(lambda context: self._node_class()(name, context=context, **options))

    def add_node(self, make: Callable[[Any], Any]) -> Any:
        """Add the node that ``make`` returns for a context, such as ``lambda context: MyNode(context=context)``."""
        node = make(self._ros_executor().context)
        self._executor.add_node(node)
        return node

    def spin(self, seconds: float) -> None:
        """Run for a simulated time; after each step the nodes handle what has arrived."""
        end_s = self._simulation.time_s + seconds
        while self._simulation.time_s < end_s - 1e-9:
            self._simulation.step()
            self._handle()

    def spin_until(self, condition: Callable[[], Any], *, timeout_s: float = 5.0) -> Any:
        """Step the simulation until a condition gives something true, and return it."""
        end_s = self._simulation.time_s + timeout_s
        while True:
            found = condition()
            if found:
                return found
            if self._simulation.time_s >= end_s:
                raise AssertionError(f"the condition did not hold within {timeout_s} s of simulated time")
            self._simulation.step()
            self._handle()

    def _handle(self) -> None:
        """Let the nodes handle everything that waits."""
        if self._executor is None:
            return
        from rclpy.executors import TimeoutException

        for _ in range(_MAX_CALLBACKS):
            try:
                callback, _, _ = self._executor.wait_for_ready_callbacks(timeout_sec=0.0)
            except TimeoutException:
                return
            callback()

    def _node_class(self) -> Any:
        self._ros_executor()
        from rclpy.node import Node

        return Node

    def _ros_executor(self) -> Any:
        """Executor of a context in the graph of the simulation."""
        if self._executor is None:
            if not periplus.ros.activate(quiet=True).own:
                raise RuntimeError("the nodes of `ros` need the rclpy of Periplus, but that of the installed ROS is in use")
            import rclpy
            from rclpy.executors import SingleThreadedExecutor

            context = rclpy.Context()
            context.init(["test", "--ros-args", "-p", "use_sim_time:=true"], graph_of=self._simulation.ros_graph)
            self._executor = SingleThreadedExecutor(context=context)
        return self._executor

    def close(self) -> None:
        """Remove the nodes."""
        if self._executor is not None:
            for node in self._executor.get_nodes():
                node.destroy_node()
            self._executor.context.try_shutdown()
            self._executor = None

    def publish(self, topic: str, message: Any) -> None:
        """Publish a message of ``periplus.msgs``."""
        self._simulation.publish(topic, message)

    def messages(self, topic: str) -> list[Any]:
        """Return the messages of a topic since the first call for it, oldest first."""
        if topic not in self._messages:
            received: list[Any] = []
            self._messages[topic] = received
            self._subscriptions.append(self._simulation.subscribe(topic, received.append))
        return self._messages[topic]

    def wait_for(self, topic: str, *, timeout_s: float = 5.0) -> Any:
        """Step the simulation until the next message of a topic, and return it."""
        received = self.messages(topic)
        count, end_s = len(received), self._simulation.time_s + timeout_s
        while len(received) == count:
            if self._simulation.time_s >= end_s:
                raise AssertionError(f"no message on {topic} within {timeout_s} s of simulated time")
            self._simulation.step()
        return received[count]

    def rate(self, topic: str, *, over_s: float = 2.0) -> float:
        """Run for a simulated time and return the rate of a topic [Hz]."""
        received = self.messages(topic)
        count = len(received)
        self._simulation.run(over_s)
        return (len(received) - count) / over_s


_MAX_CALLBACKS = 10_000
"""Callbacks of nodes in one step, after which the next begins."""


@pytest.fixture
def ros(simulation: Simulation) -> Iterator[RosTopics]:
    """Topics of the simulation, and nodes of ``rclpy``: publish, wait for messages, measure rates."""
    topics = RosTopics(simulation)
    yield topics
    topics.close()
