from periplus.msgs.rmf_lift_msgs import msg as msg

__all__ = ["msg"]
