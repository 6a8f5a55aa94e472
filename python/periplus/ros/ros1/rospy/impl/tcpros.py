"""Names of rospy's transport."""

from rospy.impl.tcpros_base import DEFAULT_BUFF_SIZE
from rospy.service import Service, ServiceProxy

__all__ = ["DEFAULT_BUFF_SIZE", "Service", "ServiceProxy"]
