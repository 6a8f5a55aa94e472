"""Rays: closed-form distances, shapes of arrays, changes of a scene, and wrong arguments."""

import math
import threading
from collections.abc import Callable
from pathlib import Path

import numpy as np
import periplus
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from hypothesis.extra import numpy as hnp
from periplus import Pose, RayScene

WORLDS = Path(__file__).resolve().parents[2] / "worlds"
SQUARE = ([[2, -1, -1], [2, 1, -1], [2, 1, 1], [2, -1, 1]], [[0, 1, 2], [0, 2, 3]])


def test_primitives_have_closed_forms() -> None:
    shapes: list[tuple[Callable[[RayScene], int], list[float]]] = [
        (lambda s: s.add_box((2, 4, 6)), [4, 3, 2]),
        (lambda s: s.add_sphere(1.5), [3.5, 3.5, 3.5]),
        (lambda s: s.add_cylinder(1, 4), [4, 4, 3]),
        (lambda s: s.add_capsule(1, 2), [4, 4, 3]),
        (lambda s: s.add_ellipsoid((1, 2, 3)), [4, 3, 2]),
        (lambda s: s.add_cone(1, 2), [4.5, 4.5, 4]),
    ]
    for add, expected in shapes:
        scene = RayScene()
        assert add(scene) == 0
        hits = scene.cast(5 * np.eye(3), -np.eye(3))
        np.testing.assert_allclose(hits.distances, expected, atol=1e-9)
        assert hits.ids.tolist() == [0, 0, 0]


def test_a_mesh_a_plane_and_a_height_field() -> None:
    scene = RayScene([SQUARE])
    plane = scene.add_plane(pose=(0, 0, -3, 0, 0, 0), label=7)
    terrain = scene.add_heightfield([[1, 1], [1, 1]], (2, 2), Pose(0, 10))
    hits = scene.cast([[0, 0, 0], [0, 0, 0], [0, 10, 5]], [[1, 0, 0], [0, 0, -1], [0, 0, -1]])
    assert hits.ids.tolist() == [0, plane, terrain]
    np.testing.assert_allclose(hits.distances, [2, 3, 4])
    np.testing.assert_allclose(hits.normals, [[-1, 0, 0], [0, 0, 1], [0, 0, 1]], atol=1e-6)
    assert hits.labels.tolist() == [0, 7, 0]
    assert len(scene) == 3


def test_results_unpack_and_misses_are_infinite() -> None:
    scene = RayScene()
    scene.add_sphere(1.0)
    distances, normals, ids = scene.cast([0, 0, 5], [0, 0, 1])
    assert distances.shape == () and math.isinf(distances) and ids == -1
    assert normals.tolist() == [0, 0, 0]
    assert scene.cast([0, 0, 5], [0, 0, 1]).labels == -1


def test_distances_are_multiples_of_the_direction() -> None:
    scene = RayScene()
    scene.add_sphere(1.0)
    assert scene.cast([5, 0, 0], [-2, 0, 0]).distances == 2.0
    assert scene.cast([5, 0, 0], [0, 0, 0]).ids == -1


def test_the_maximum_distance_may_differ_from_ray_to_ray() -> None:
    scene = RayScene()
    scene.add_sphere(1.0)
    limits = [3.9, 4.1]
    assert scene.occluded([5, 0, 0], [-1, 0, 0], limits).tolist() == [False, True]
    assert np.isinf(scene.distances([5, 0, 0], [-1, 0, 0], limits)).tolist() == [True, False]
    assert scene.cast([5, 0, 0], [-1, 0, 0], max_distance_m=3.0).ids == -1


def test_shapes_broadcast() -> None:
    scene = RayScene()
    scene.add_plane()
    origins = np.zeros((4, 1, 3))
    origins[:, 0, 2] = [1, 2, 3, 4]
    directions = np.broadcast_to([0.0, 0.0, -1.0], (5, 3))
    distances = scene.cast(origins, directions).distances
    assert distances.shape == (4, 5)
    np.testing.assert_allclose(distances, np.repeat([[1], [2], [3], [4]], 5, axis=1))
    assert scene.cast(np.zeros((0, 3)), [1, 0, 0]).distances.shape == (0,)
    assert scene.cast(np.zeros((0, 3)), [1, 0, 0]).normals.shape == (0, 3)


def test_results_are_overwritten_on_request() -> None:
    scene = RayScene()
    ball = scene.add_sphere(1.0)
    first = scene.cast([[5, 0, 0]], [-1, 0, 0])
    scene.move(ball, (1, 0, 0))
    again = scene.cast([[5, 0, 0]], [-1, 0, 0], out=first)
    assert again.distances is first.distances and first.distances.tolist() == [3.0]
    out = np.zeros(1, np.float32)
    assert scene.distances([[5, 0, 0]], [-1, 0, 0], out=out) is out and out[0] == 3
    for wrong in (np.zeros(1), np.zeros(2, np.float32), "out"):
        with pytest.raises(ValueError, match="out"):
            scene.distances([[5, 0, 0]], [-1, 0, 0], out=wrong)  # type: ignore[arg-type]
    with pytest.raises(ValueError, match="out"):
        scene.cast([5, 0, 0], [-1, 0, 0], out=first)


def test_shapes_move_and_go() -> None:
    scene = RayScene([SQUARE])
    assert scene.distances([0, 0, 0], [1, 0, 0]) == 2
    scene.move(0, (1, 0, 0))
    assert scene.distances([0, 0, 0], [1, 0, 0]) == 3
    scene.move(0, (4, 0, 0))
    assert scene.distances([0, 0, 0], [1, 0, 0]) == 6
    assert scene.pose(0) == Pose(4)
    late = scene.add_mesh(*SQUARE)
    scene.move(late, Pose(-1))
    hits = scene.cast([0, 0, 0], [1, 0, 0])
    assert hits.distances == 1 and hits.ids == late
    scene.remove(late)
    assert scene.cast([0, 0, 0], [1, 0, 0]).ids == 0
    with pytest.raises(KeyError):
        scene.move(late, Pose())
    with pytest.raises(KeyError):
        scene.remove(-1)


def test_threads_change_no_bit() -> None:
    random = np.random.default_rng(3)
    scene = RayScene()
    for _ in range(30):
        scene.add_sphere(random.uniform(0.1, 1), (*random.uniform(-5, 5, 3), 0, 0, 0))
    vertices = random.uniform(-5, 5, (300, 3))
    scene.add_mesh(vertices, np.arange(300).reshape(100, 3))
    directions = random.normal(size=(200, 150, 3))
    one, many = (scene.cast([0, 0, 0], directions, threads=count) for count in (1, 5))
    for first, other in zip(one, many, strict=True):
        np.testing.assert_array_equal(first, other)
    np.testing.assert_array_equal(scene.cast([0, 0, 0], directions[7, 9]).distances, one.distances[7, 9])
    np.testing.assert_array_equal(scene.distances([0, 0, 0], directions), one.distances.astype(np.float32))
    np.testing.assert_array_equal(scene.occluded([0, 0, 0], directions), one.ids >= 0)


def test_a_scene_is_cast_and_changed_by_several_threads() -> None:
    scene = RayScene()
    ball = scene.add_sphere(1.0)
    failures = []

    def cast() -> None:
        for _ in range(50):
            distance = scene.cast([10, 0, 0], [[-1, 0, 0]] * 100).distances
            if not (np.all(distance == 9) or np.all(distance == 8)):
                failures.append(distance)

    def move() -> None:
        for turn in range(200):
            scene.move(ball, (turn % 2, 0, 0))

    threads = [threading.Thread(target=job) for job in (cast, cast, move)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert not failures


def test_a_world_is_read() -> None:
    scene = RayScene.from_file(WORLDS / "cube_and_sphere.sdf")
    assert len(scene) == len(scene.names) > 2
    hits = scene.cast([0, 0, 20], [0, 0, -1])
    assert hits.distances <= 20 and "::" in scene.names[int(hits.ids)]
    assert len(RayScene.from_file(WORLDS / "cube_and_sphere.sdf", geometry="collision")) > 2


def test_a_mesh_file_is_read(tmp_path: Path) -> None:
    file = tmp_path / "square.obj"
    file.write_text("v 2 -1 -1\nv 2 1 -1\nv 2 1 1\nf 1 2 3\n")
    assert RayScene.from_file(file).distances([0, 0.5, 0], [1, 0, 0]) == 2


def test_broken_files(tmp_path: Path) -> None:
    with pytest.raises(FileNotFoundError):
        RayScene.from_file(tmp_path / "none.sdf")
    file = tmp_path / "bad.sdf"
    file.write_text("<sdf version='1.9'>\n<world></sdf>")
    with pytest.raises(periplus.FileError) as error:
        RayScene.from_file(file)
    assert error.value.line == 2
    with pytest.raises(ValueError, match="geometry"):
        RayScene.from_file(file, geometry="both")  # type: ignore[arg-type]


@pytest.mark.parametrize(
    ("wrong", "error", "words"),
    [
        (lambda s: s.cast([0, 0], [1, 0, 0]), ValueError, "origins"),
        (lambda s: s.cast([0, 0, 0], "up"), TypeError, "directions"),
        (lambda s: s.cast([0, 0, math.nan], [1, 0, 0]), ValueError, "`origins` must be finite"),
        (lambda s: s.cast([0, 0, 0], [math.inf, 0, 0]), ValueError, "`directions` must be finite"),
        (lambda s: s.distances([0, 0, 0], [math.nan, 0, 0]), ValueError, "directions"),
        (lambda s: s.occluded([0, 0, 0], [math.nan, 0, 0]), ValueError, "directions"),
        (lambda s: s.cast([0, 0, 0], [1, 0, 0], math.nan), ValueError, "max_distance_m"),
        (lambda s: s.cast(np.zeros((2, 3)), np.zeros((3, 3))), ValueError, "broadcast"),
        (lambda s: s.cast([0, 0, 0], [1, 0, 0], threads=0), ValueError, "threads"),
        (lambda s: s.add_sphere(0.0), ValueError, "size"),
        (lambda s: s.add_sphere(math.nan), ValueError, "size"),
        (lambda s: s.add_box((1, math.inf, 1)), ValueError, "size"),
        (lambda s: s.add_box((1, 1)), ValueError, "size"),
        (lambda s: s.add_mesh([[0, 0, 0]], [[0, 0, 1]]), ValueError, "triangles"),
        (lambda s: s.add_mesh([[0, 0, 0]], [[0, 0, -1]]), ValueError, "triangles"),
        (lambda s: s.add_mesh([[0, 0, 0]], [[0.0, 0.0, 0.5]]), TypeError, "integers"),
        (lambda s: s.add_mesh([[math.nan, 0, 0]], [[0, 0, 0]]), ValueError, "vertices"),
        (lambda s: s.add_heightfield([[1, 2]], (1, 1)), ValueError, "two"),
        (lambda s: s.add_sphere(1.0, pose=(1, 2)), TypeError, "pose"),
        (lambda s: RayScene([1]), TypeError, "meshes"),  # type: ignore[list-item]
    ],
)
def test_wrong_arguments(wrong, error, words) -> None:  # type: ignore[no-untyped-def]
    scene = RayScene()
    scene.add_plane()
    with pytest.raises(error, match=words):
        wrong(scene)


@settings(max_examples=60, deadline=None)
@given(
    origins=hnp.arrays(
        dtype=st.sampled_from([np.float64, np.float32, np.int32, np.uint8, np.bool_]),
        shape=hnp.array_shapes(min_dims=0, max_dims=4, max_side=4),
    ),
    directions=hnp.arrays(dtype=np.float64, shape=hnp.array_shapes(min_dims=0, max_dims=4, max_side=4)),
    step=st.sampled_from([1, 2, -1]),
)
def test_any_arrays_end_in_results_or_clear_errors(
    origins: np.ndarray, directions: np.ndarray, step: int
) -> None:
    scene = RayScene()
    scene.add_box((1, 1, 1))
    origins = origins[..., ::step] if origins.ndim else origins
    try:
        hits = scene.cast(origins, directions)
    except (ValueError, TypeError):
        return
    shape = np.broadcast_shapes(origins.shape[:-1], directions.shape[:-1])
    assert hits.distances.shape == hits.ids.shape == shape
    assert hits.normals.shape == (*shape, 3)
    assert np.all((hits.ids == -1) == np.isinf(hits.distances))


def test_strided_and_read_only_arrays() -> None:
    scene = RayScene()
    scene.add_plane()
    wide = np.zeros((10, 6))
    wide[:, 4] = 1.0
    origins = wide[::2, ::-2] + [0, 0, 2.0]
    assert origins.shape == (5, 3)
    directions = np.asfortranarray(np.tile([0.0, 0.0, -1.0], (5, 1)))
    directions.flags.writeable = False
    np.testing.assert_allclose(scene.distances(origins, directions), 2.0)
