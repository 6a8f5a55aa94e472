"""Messages of sensors; `sensor_msgs.point_cloud2` reads and makes point clouds."""
