"""Constants of rospy's transport."""

DEFAULT_BUFF_SIZE = 65536
