"""Scores of pairs of trajectories by PyPI's evo: a line of JSON for each folder with truth.tum and estimate.tum."""

import copy
import json
import math
import sys
from pathlib import Path

from evo.core import metrics, sync
from evo.core.metrics import PoseRelation, Unit
from evo.core.trajectory import PoseTrajectory3D
from evo.tools import file_interface

RELATIONS = {
    "trans_part": PoseRelation.translation_part,
    "angle_rad": PoseRelation.rotation_angle_rad,
    "angle_deg": PoseRelation.rotation_angle_deg,
    "rot_part": PoseRelation.rotation_part,
    "full": PoseRelation.full_transformation,
}
DELTAS = {"frames": (3, Unit.frames), "metres": (1.5, Unit.meters), "radians": (0.4, Unit.radians)}


def aligned(truth: PoseTrajectory3D, estimate: PoseTrajectory3D, method: str) -> PoseTrajectory3D:
    estimate = copy.deepcopy(estimate)
    if method == "origin":
        estimate.align_origin(truth)
    elif method != "none":
        estimate.align(truth, correct_scale=method == "sim3", correct_only_scale=method == "scale")
    return estimate


def scores(folder: Path) -> dict[str, dict[str, float]]:
    truth = file_interface.read_tum_trajectory_file(folder / "truth.tum")
    estimate = file_interface.read_tum_trajectory_file(folder / "estimate.tum")
    truth, estimate = sync.associate_trajectories(truth, estimate, max_diff=0.01)
    found = {}
    for relation, kind in RELATIONS.items():
        for method in ["none", "origin", "se3", "sim3", "scale"]:
            metric = metrics.APE(kind)
            metric.process_data((truth, aligned(truth, estimate, method)))
            found[f"ape {relation} {method}"] = metric.get_all_statistics()
        for unit, (delta, delta_unit) in DELTAS.items():
            for all_pairs in [False, True]:
                metric = metrics.RPE(kind, delta, delta_unit, all_pairs=all_pairs)
                metric.process_data((truth, estimate))
                found[f"rpe {relation} {unit} {str(all_pairs).lower()}"] = metric.get_all_statistics()
    assert all(math.isfinite(value) for values in found.values() for value in values.values())
    return found


for path in sys.argv[1:]:
    print(json.dumps({"folder": path, "scores": scores(Path(path))}))
