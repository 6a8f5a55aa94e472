from periplus.msgs.rmf_fleet_msgs import msg as msg

__all__ = ["msg"]
