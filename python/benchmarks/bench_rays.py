"""Rays from numpy: beside the batch functions of the Rust crate, trimesh + embreex, and MuJoCo.

    pip install trimesh embreex mujoco
    python python/benchmarks/bench_rays.py [turns]

All run on one thread over the same rays, turn by turn, so that a busy moment of the machine hits all alike; of each
the best turn counts. The reference in Rust is the hidden function ``RayScene._batch_time_s``: ``hits_grid`` for
``cast`` and ``cast_grid`` for ``distances``, with rays and results allocated before. Peers that are not installed are
left out.
"""

import os
import sys
import time
from collections.abc import Callable

for name in ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS"):
    os.environ[name] = "1"

import numpy as np
import periplus

RAYS = 100_000


def terrain(cells: int) -> tuple[np.ndarray, np.ndarray]:
    """A wavy surface of 2 * cells**2 triangles, 40 m by 40 m."""
    axis = np.linspace(-20.0, 20.0, cells + 1)
    x, y = np.meshgrid(axis, axis)
    z = 0.8 * np.sin(1.3 * x) * np.cos(0.9 * y) + 0.05 * np.sin(9.0 * x + 5.0 * y)
    vertices = np.stack([x, y, z], axis=-1).reshape(-1, 3)
    corner = (np.arange(cells)[:, None] * (cells + 1) + np.arange(cells)).reshape(-1, 1)
    step = cells + 1
    lower = corner + np.array([0, 1, step + 1])
    upper = corner + np.array([0, step + 1, step])
    return vertices, np.concatenate([lower, upper])


def lidar_rays() -> tuple[np.ndarray, np.ndarray]:
    """A spinning lidar of 100 rows by 1000 columns, 4 m above the floor."""
    up, around = np.meshgrid(np.radians(np.linspace(-30, 5, 100)), np.linspace(0, 2 * np.pi, 1000), indexing="ij")
    directions = np.stack([np.cos(up) * np.cos(around), np.cos(up) * np.sin(around), np.sin(up)], axis=-1)
    return np.array([0.3, 0.2, 4.0]), directions.reshape(-1, 3)


def scattered_rays() -> tuple[np.ndarray, np.ndarray]:
    """Rays from everywhere to everywhere."""
    random = np.random.default_rng(1)
    origins = random.uniform([-18, -18, 1.5], [18, 18, 5], (RAYS, 3))
    directions = random.normal(size=(RAYS, 3))
    directions[:, 2] = -np.abs(directions[:, 2])
    return origins, directions / np.linalg.norm(directions, axis=1, keepdims=True)


def seconds(run: Callable[[], object]) -> float:
    """The better of two runs: the first one fills the caches."""
    times = []
    for _ in range(2):
        start = time.perf_counter()
        run()
        times.append(time.perf_counter() - start)
    return min(times)


def table(title: str, jobs: dict[str, Callable[[], float]], turns: int, ours: str = "periplus cast") -> None:
    best = dict.fromkeys(jobs, float("inf"))
    for _ in range(turns):
        for name, job in jobs.items():
            best[name] = min(best[name], job())
    print(f"\n{title}")
    for name, took in best.items():
        ratio = took / best[ours]
        print(f"  {name:34} {1e3 * took:9.2f} ms  {RAYS / took / 1e6:7.2f} Mrays/s  {ratio:7.2f} x the time of {ours}")
    for what in ("cast", "cast, out=", "distances"):
        rust = best[f"Rust batch for {what.removesuffix(', out=')}"]
        print(f"  {what} from numpy: {100 * (1 - rust / best[f'periplus {what}']):+.1f} % below the rate of Rust")


def ours(scene: periplus.RayScene, origins: np.ndarray, directions: np.ndarray) -> dict[str, Callable[[], float]]:
    hits = scene.cast(origins, directions)
    return {
        "Rust batch for cast": lambda: scene._batch_time_s(origins, directions, "cast", 2),
        "periplus cast": lambda: seconds(lambda: scene.cast(origins, directions, threads=1)),
        "periplus cast, out=": lambda: seconds(lambda: scene.cast(origins, directions, threads=1, out=hits)),
        "Rust batch for distances": lambda: scene._batch_time_s(origins, directions, "distances", 2),
        "periplus distances": lambda: seconds(lambda: scene.distances(origins, directions, threads=1)),
    }


def mujoco_rays(xml: str, origins: np.ndarray, directions: np.ndarray) -> dict[str, Callable[[], float]]:
    try:
        import mujoco
    except ImportError:
        print("SKIPPED: mujoco is not installed")
        return {}
    model = mujoco.MjModel.from_xml_string(xml)
    data = mujoco.MjData(model)
    mujoco.mj_forward(model, data)
    flat = np.ascontiguousarray(directions).reshape(-1)
    ids, distances = np.zeros(RAYS, np.int32), np.zeros(RAYS)
    normals = np.zeros(3 * RAYS)
    origin = np.asarray(origins, float).reshape(3)

    def run() -> None:
        try:
            mujoco.mj_multiRay(model, data, origin, flat, None, 1, -1, ids, distances, None, RAYS, 1e10)
        except TypeError:
            mujoco.mj_multiRay(model, data, origin, flat, None, 1, -1, ids, distances, RAYS, 1e10)

    try:
        run()
    except TypeError:
        def run() -> None:
            mujoco.mj_multiRay(model, data, origin, flat, None, 1, -1, ids, distances, normals, RAYS, 1e10)
    return {"MuJoCo mj_multiRay (no normals)": lambda: seconds(run)}


def trimesh_rays(
    vertices: np.ndarray, triangles: np.ndarray, origins: np.ndarray, directions: np.ndarray
) -> dict[str, Callable[[], float]]:
    try:
        import embreex  # noqa: F401
        import trimesh
    except ImportError:
        print("SKIPPED: trimesh and embreex are not installed")
        return {}
    mesh = trimesh.Trimesh(vertices, triangles, process=False)
    every = np.ascontiguousarray(np.broadcast_to(origins, directions.shape))
    tracer = trimesh.ray.ray_pyembree.RayMeshIntersector(mesh)
    _ = mesh.face_normals

    def first() -> None:
        tracer.intersects_first(every, directions)

    def location() -> None:
        places, rays, hit = tracer.intersects_location(every, directions, multiple_hits=False)
        distances = np.full(len(every), np.inf)
        distances[rays] = np.linalg.norm(places - every[rays], axis=1)
        normals = np.zeros((len(every), 3))
        normals[rays] = mesh.face_normals[hit]

    def embree_alone() -> None:
        tracer._scene.run(every.astype(np.float32), directions.astype(np.float32), query="DISTANCE")

    return {
        "trimesh + embreex, same results": lambda: seconds(location),
        "trimesh + embreex, triangles only": lambda: seconds(first),
        "embreex alone, distances": lambda: seconds(embree_alone),
    }


def primitives() -> tuple[periplus.RayScene, str]:
    """Sixty boxes, spheres and cylinders on a plane."""
    random = np.random.default_rng(7)
    scene = periplus.RayScene()
    scene.add_plane()
    geoms = ['<geom type="plane" size="0 0 1"/>']
    for number in range(60):
        x, y = random.uniform(-15, 15, 2)
        side = random.uniform(0.3, 1.2)
        pose = (x, y, 1.0, 0.0, 0.0, 0.0)
        if number % 3 == 0:
            scene.add_box((side, side, 2.0), pose)
            geoms.append(f'<geom type="box" size="{side / 2} {side / 2} 1" pos="{x} {y} 1"/>')
        elif number % 3 == 1:
            scene.add_sphere(side / 2, pose)
            geoms.append(f'<geom type="sphere" size="{side / 2}" pos="{x} {y} 1"/>')
        else:
            scene.add_cylinder(side / 2, 2.0, pose)
            geoms.append(f'<geom type="cylinder" size="{side / 2} 1" pos="{x} {y} 1"/>')
    return scene, f"<mujoco><worldbody>{''.join(geoms)}</worldbody></mujoco>"


def mujoco_mesh(vertices: np.ndarray, triangles: np.ndarray) -> str:
    points = " ".join(f"{value:.6f}" for value in vertices.reshape(-1))
    corners = " ".join(map(str, triangles.reshape(-1)))
    return (
        f'<mujoco><asset><mesh name="m" inertia="shell" vertex="{points}" face="{corners}"/></asset>'
        '<worldbody><geom type="mesh" mesh="m"/></worldbody></mujoco>'
    )


def main() -> None:
    turns = int(sys.argv[1]) if len(sys.argv) > 1 else 7
    for cells in (160, 400):
        vertices, triangles = terrain(cells)
        scene = periplus.RayScene([(vertices, triangles)])
        for kind, rays in (("lidar", lidar_rays()), ("scattered", scattered_rays())):
            origins, directions = rays
            jobs = ours(scene, origins, directions)
            jobs |= trimesh_rays(vertices, triangles, origins, directions)
            if kind == "lidar" and cells == 160:
                jobs |= mujoco_rays(mujoco_mesh(vertices, triangles), origins, directions)
            table(f"mesh of {len(triangles)} triangles, {kind} rays", jobs, turns)
    scene, xml = primitives()
    origins, directions = lidar_rays()
    origins[2] = 1.2
    table("61 primitives, lidar rays", ours(scene, origins, directions) | mujoco_rays(xml, origins, directions), turns)


if __name__ == "__main__":
    main()
