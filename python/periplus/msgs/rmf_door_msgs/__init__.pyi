from periplus.msgs.rmf_door_msgs import msg as msg

__all__ = ["msg"]
