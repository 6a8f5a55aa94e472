"""Datasets of `periplus dataset`, read by the tools of their formats."""

import contextlib
import io
import json
import struct
import subprocess
import sys
import types
import zlib
from pathlib import Path
from typing import Any

import pytest

LABEL = '<plugin filename="gz-sim-label-system" name="gz::sim::systems::Label"><label>{}</label></plugin>'
#: A crate with its face 4 m ahead, half behind a post at 2 m, and a ball to the left. Class 3 is out of sight.
WORLD = """<sdf version="1.9"><world name="yard">
<light name="sun" type="directional"><direction>-0.3 0.2 -1</direction></light>
<model name="floor"><static>true</static><link name="l">
  <collision name="c"><geometry><plane><normal>0 0 1</normal></plane></geometry></collision>
  <visual name="v"><geometry><plane><normal>0 0 1</normal><size>100 100</size></plane></geometry></visual>
  </link></model>
{models}
<model name="cart"><static>true</static><pose>0 0 0.5 0 0 0</pose><link name="base">
  <sensor name="eye" type="camera"><camera><horizontal_fov>1.5707963267948966</horizontal_fov>
    <image><width>160</width><height>120</height></image><clip><near>0.05</near><far>50</far></clip>
    </camera></sensor>
  <sensor name="lidar" type="gpu_lidar"><pose>0 0 0.2 0 0 0</pose><lidar><scan>
    <horizontal><samples>181</samples><min_angle>-1.57</min_angle><max_angle>1.57</max_angle></horizontal>
    <vertical><samples>9</samples><min_angle>-0.3</min_angle><max_angle>0.1</max_angle></vertical></scan>
    <range><min>0.1</min><max>30</max></range></lidar></sensor>
</link></model></world></sdf>"""


def model(name: str, pose: str, shape: str, label: int | None) -> str:
    geometry = f"<geometry>{shape}</geometry>"
    return (
        f'<model name="{name}"><static>true</static><pose>{pose} 0 0 0</pose>'
        f'{LABEL.format(label) if label else ""}<link name="l">'
        f'<collision name="c">{geometry}</collision><visual name="v">{geometry}</visual></link></model>'
    )


CRATE = "<box><size>1 1 1</size></box>"
BALL = "<sphere><radius>0.5</radius></sphere>"
POST = "<box><size>0.1 0.5 1.2</size></box>"
MODELS = (
    model("crate_1", "4.5 0 0.5", CRATE, 1)
    + model("ball", "4 2.5 0.5", BALL, 2)
    + model("post", "2 0.25 0.6", POST, None)
    + model("crate_2", "-3 0 0.5", CRATE, 3)
)


def dataset(folder: Path, layout: str, *words: str) -> dict[str, Any]:
    world = folder / "yard.sdf"
    world.write_text(WORLD.format(models=MODELS))
    command = [sys.executable, "-m", "periplus", "dataset", str(world), "--format", layout]
    command += ["--duration", "1.5", "--rate", "2", "--out", str(folder / layout), "--json", *words]
    result = subprocess.run(command, capture_output=True, text=True, timeout=120)
    assert result.returncode == 0, result.stderr
    report: dict[str, Any] = json.loads(result.stdout)
    return report


def test_coco_is_read_and_scored_by_pycocotools(tmp_path: Path) -> None:
    coco_module = pytest.importorskip("pycocotools.coco", reason="pycocotools is not installed")
    score_module = pytest.importorskip("pycocotools.cocoeval")
    report = dataset(tmp_path, "coco", "--class", "3=hidden")
    assert (report["frames"], report["objects"]) == (3, 6)
    names = {it["id"]: it["name"] for it in report["classes"]}
    assert names == {1: "crate", 2: "ball", 3: "hidden"}
    with contextlib.redirect_stdout(io.StringIO()):
        truth = coco_module.COCO(str(tmp_path / "coco/annotations/instances.json"))
        assert len(truth.getImgIds()) == 3 and sorted(truth.getCatIds()) == [1, 2, 3]
        annotations = truth.loadAnns(truth.getAnnIds())
        for annotation in annotations:
            mask = truth.annToMask(annotation)
            rows, columns = mask.nonzero()
            assert mask.sum() == annotation["area"]
            left, top, width, height = annotation["bbox"]
            assert (columns.min(), rows.min()) == (left, top)
            assert (columns.max() - left + 1, rows.max() - top + 1) == (width, height)
        found = [
            {key: it[key] for key in ("image_id", "category_id", "bbox", "segmentation")} | {"score": 1.0}
            for it in annotations
        ]
        for kind in ("bbox", "segm"):
            boxes = [{k: v for k, v in it.items() if k != "segmentation" or kind == "segm"} for it in found]
            if kind == "segm":
                boxes = [{**it, "segmentation": truth.annToRLE(a)} for it, a in zip(boxes, annotations)]
            score = score_module.COCOeval(truth, truth.loadRes(boxes), kind)
            score.evaluate()
            score.accumulate()
            score.summarize()
            assert score.stats[0] == pytest.approx(1.0), kind
    # f = 80 px: the face of the crate, 1 m at 4 m, has 20 columns from 70 to 90; the post, 0.5 m at 1.95 m, hides those
    # up to the middle of the image.
    crate = next(it for it in annotations if it["category_id"] == 1)
    assert crate["bbox"][0] == 80 and crate["bbox"][2] == 10
    image = (tmp_path / "coco/images/000000.png").read_bytes()
    assert struct.unpack(">II", image[16:24]) == (160, 120)


def test_kitti_has_consistent_boxes_clouds_and_calibration(tmp_path: Path) -> None:
    report = dataset(tmp_path, "kitti", "--class", "1=Car")
    assert report["frames"] == 3
    training = tmp_path / "kitti/training"
    lines = (training / "label_2/000001.txt").read_text().splitlines()
    labels = {line.split()[0]: [float(word) for word in line.split()[1:]] for line in lines}
    assert set(labels) == {"Car", "ball"}
    truncated, occluded, alpha, left, top, right, bottom, h, w, length, x, y, z, turn = labels["Car"]
    # Half of it is hidden; its centre is 4.5 m ahead, its bottom 0.5 m below the camera.
    assert (truncated, occluded) == (0.0, 1.0)
    assert [h, w, length] == pytest.approx([1.0, 1.0, 1.0])
    assert [x, y, z] == pytest.approx([0.0, 0.5, 4.5], abs=1e-6)
    assert (left, right) == (70.0, 89.0) and turn == pytest.approx(alpha) == pytest.approx(-1.570796, abs=1e-5)
    text = (training / "calib/000001.txt").read_text()
    calib = {line.split(":")[0]: [float(word) for word in line.split()[1:]] for line in text.splitlines()}
    assert set(calib) == {"P0", "P1", "P2", "P3", "R0_rect", "Tr_velo_to_cam", "Tr_imu_to_velo"}
    assert [len(calib[name]) for name in ("P2", "R0_rect", "Tr_velo_to_cam")] == [12, 9, 12]
    data = (training / "velodyne/000001.bin").read_bytes()
    points = list(struct.iter_unpack("<4f", data))
    assert len(points) * 3 == report["points"]
    transform, projection = calib["Tr_velo_to_cam"], calib["P2"]
    inside = 0
    for point in points:
        at = [sum(transform[4 * row + k] * point[k] for k in range(3)) + transform[4 * row + 3] for row in range(3)]
        if all(abs(value - centre) <= half + 1e-4 for value, centre, half in zip(at, [x, y - h / 2, z], [0.5] * 3)):
            u = (projection[0] * at[0] + projection[2] * at[2]) / at[2]
            v = (projection[5] * at[1] + projection[6] * at[2]) / at[2]
            assert left - 1 <= u <= right + 1 and top - 1 <= v <= bottom + 1
            inside += 1
    assert inside >= 10


def test_lidar_sequences_are_read_by_pykitti(tmp_path: Path) -> None:
    report = dataset(tmp_path, "lidar")
    root = tmp_path / "lidar"
    sequence = root / "sequences/00"
    total = 0
    for number in range(3):
        points = (sequence / f"velodyne/{number:06}.bin").read_bytes()
        labels = [it[0] for it in struct.iter_unpack("<I", (sequence / f"labels/{number:06}.label").read_bytes())]
        assert len(points) == 16 * len(labels)
        total += len(labels)
        # Class and instance; most points are of the floor, which has no label.
        assert {1 | 1 << 16, 2 | 1 << 16} <= set(labels) and labels.count(0) > len(labels) / 2
        for (px, py, pz, _), label in zip(struct.iter_unpack("<4f", points), labels):
            # Positions in the world: the lidar is 0.7 m above the floor.
            is_ball = abs(((px - 4) ** 2 + (py - 2.5) ** 2 + (pz + 0.2) ** 2) ** 0.5 - 0.5) < 1e-3
            assert is_ball == (label & 0xFFFF == 2), (px, py, pz, label)
    assert total == report["points"]
    assert "1: \"crate\"" in (root / "labels.yaml").read_text()
    # The part of pykitti that is not used here imports OpenCV.
    sys.modules.setdefault("cv2", types.ModuleType("cv2"))
    pykitti = pytest.importorskip("pykitti", reason="pykitti is not installed")
    read = pykitti.odometry(str(root), "00")
    assert len(read.timestamps) == len(read.poses) == 3
    assert read.get_velo(1).shape[1] == 4
    # A point ahead of the lidar is at the z of the camera.
    ahead = read.calib.T_cam0_velo @ [2.0, 0.0, 0.0, 1.0]
    assert list(ahead[:3]) == pytest.approx([0.0, 0.0, 2.0], abs=1e-9)
    assert read.poses[2][:3, 3] == pytest.approx([0.0, 0.0, 0.0], abs=1e-9)


def test_the_same_seed_gives_the_same_files(tmp_path: Path) -> None:
    sums = []
    for run in ("a", "b"):
        folder = tmp_path / run
        folder.mkdir()
        dataset(folder, "coco", "--seed", "3")
        files = sorted(it for it in (folder / "coco").rglob("*") if it.is_file())
        sums.append([(it.name, zlib.crc32(it.read_bytes())) for it in files])
    assert sums[0] == sums[1] and len(sums[0]) == 4


def test_a_folder_in_use_and_a_missing_lidar_are_errors(tmp_path: Path) -> None:
    world = tmp_path / "empty.sdf"
    world.write_text('<sdf version="1.9"><world name="w"/></sdf>')
    command = [sys.executable, "-m", "periplus", "dataset", str(world), "--duration", "1"]
    command += ["--format", "lidar", "--out"]
    used = subprocess.run([*command, str(tmp_path)], capture_output=True, text=True, timeout=60)
    assert used.returncode == 2 and "is not empty" in used.stderr
    none = subprocess.run([*command, str(tmp_path / "x")], capture_output=True, text=True, timeout=60)
    assert none.returncode == 2 and "no model here has a lidar" in none.stderr
