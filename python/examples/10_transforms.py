"""Looks up transforms, and filters odometry and an IMU."""

import numpy as np

from periplus import Ekf, Pose, TfBuffer, TransformExtrapolationError


def main() -> None:
    buffer = TfBuffer()
    buffer.set_transform("odom", "base_link", Pose(1.0), time_s=1.0)
    buffer.set_transform("odom", "base_link", Pose(2.0), time_s=2.0)
    buffer.set_transform("base_link", "camera", Pose(0.1, yaw=np.pi / 2), is_static=True)
    # Between two samples, through two edges: a point 1 m in front of the camera, which looks left.
    odom_from_camera = buffer.lookup("odom", "camera", 1.5)
    point = odom_from_camera.transform([1.0, 0.0, 0.0])
    print(f"the point is at {point.round(3)} in odom")
    assert np.allclose(point, [1.6, 1.0, 0.0])
    try:
        buffer.lookup("odom", "camera", 3.0)
    except TransformExtrapolationError as error:
        print(error)
    else:
        raise AssertionError("a transform of the future was found")

    ekf = Ekf(two_d_mode=True, odom0="odom", odom0_config=[False] * 6 + [True] + [False] * 8)
    covariance = np.diag([0.01] * 6)
    for tick in range(100):
        ekf.add_twist("odom0", [0.5, 0.0, 0.0], [0.0, 0.0, 0.0], covariance, time_s=0.02 * tick)
        ekf.update(0.02 * tick)
    print(f"after 2 s at 0.5 m/s the filter is at x = {ekf.pose.x:.3f} m")
    assert abs(ekf.pose.x - 1.0) < 0.05


if __name__ == "__main__":
    main()
