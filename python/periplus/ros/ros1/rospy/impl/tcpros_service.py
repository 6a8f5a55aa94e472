"""Services, under the module name of rospy's transport."""

from rospy.service import Service, ServiceProxy, wait_for_service

__all__ = ["Service", "ServiceProxy", "wait_for_service"]
