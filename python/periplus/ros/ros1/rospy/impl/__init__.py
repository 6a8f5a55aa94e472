"""Inner modules of rospy that programs import."""
