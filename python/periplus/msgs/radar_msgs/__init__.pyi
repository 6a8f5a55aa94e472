from periplus.msgs.radar_msgs import msg as msg

__all__ = ["msg"]
